"""What the tests of the grid room share."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from pathloom.errors import MapError


@pytest.fixture(scope="session")
def data() -> Path:
    """Return the folder of real maps, which are not ours to ship."""
    folder = os.environ.get("PATHLOOM_DATA")
    if not folder:
        pytest.skip("PATHLOOM_DATA is not set: no real maps to read")
    return Path(folder)


@pytest.fixture(scope="session")
def refused() -> Callable[..., str]:
    """Return a function that wants a MapError of one line and returns its message."""

    def message(call: Callable[..., object], *args: object, **options: object) -> str:
        with pytest.raises(MapError) as caught:
            call(*args, **options)
        line = str(caught.value)
        assert line
        assert line.isprintable(), line
        return line

    return message
