"""Shared by all tests: one kernel cache, one hypothesis profile, and where the data are."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("pathloom", deadline=None, derandomize=True, max_examples=60)
settings.load_profile("pathloom")


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of maps that are not ours to ship."""
    folder = os.environ.get("PATHLOOM_DATA")
    if not folder:
        pytest.skip("PATHLOOM_DATA is not set: the folder with Moving AI, ROS and GA maps")
    return Path(folder)


@pytest.fixture(scope="session", autouse=True)
def kernels() -> None:
    """Compile whatever is not in the cache yet, once for all tests, so that no command has to say that it does."""
    from pathloom import compiled

    for family in compiled.FAMILIES:
        getattr(compiled, family)
