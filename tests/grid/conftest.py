"""What the tests of the grid room share."""

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from pathloom.errors import MapError


@pytest.fixture
def forbidden(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the system open no file: permission bits would not do, since they do not hold for root, nor on Windows."""

    def refuse(path: Path, *_: object, **__: object) -> None:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))

    monkeypatch.setattr(Path, "open", refuse)


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
