import pytest

import pathloom.components
import pathloom_baselines
import pathloom_imga
from kernel import one_max, sphere
from pathloom.kernel.plugins import Source
from pathloom.kernel.registry import Registry


def source(namespace, module, distribution="toys", version="1.0"):
    return Source(namespace, lambda: module, distribution, version, ours=distribution == "pathloom")


@pytest.fixture
def registry():
    return Registry(
        [
            source("core", pathloom.components, "pathloom"),
            source("imga", pathloom_imga, "pathloom"),
            source("baselines", pathloom_baselines, "pathloom"),
            source("onemax", one_max),
            source("sphere", sphere),
        ]
    )
