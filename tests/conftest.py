"""Shared by all tests: one kernel cache, one hypothesis profile, and where the data are."""

import os
import subprocess
import sys
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


LOAD = """
import sys
from pathloom import compiled

for family in compiled.FAMILIES[:: int(sys.argv[1])]:
    getattr(compiled, family)
"""


def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile whatever is not in the cache yet, before any test, so that no command has to say that it does.

    Two processes begin at either end, and each takes what the other has done from the cache.
    """
    if not hasattr(session.config, "workerinput") and not session.config.option.collectonly:
        loading = [subprocess.Popen([sys.executable, "-c", LOAD, way]) for way in ("1", "-1")]
        for process in loading:
            process.wait()
