"""Compiled kernels. They know arrays only: no problem, no grid, no population object.

Families, each loaded when something first asks for it: ``segments`` (tests and distances),
``cells`` (operators and objectives on populations of cell paths), ``search`` (trees, exact
searches) and ``walks``. Loading compiles a family once for a machine; from then
on it comes from numba's cache.
"""

import importlib
from types import ModuleType
from typing import TYPE_CHECKING

from pathloom.compiled.jit import loading

if TYPE_CHECKING:
    from pathloom.compiled import cells as cells
    from pathloom.compiled import search as search
    from pathloom.compiled import segments as segments
    from pathloom.compiled import walks as walks

FAMILIES = ("segments", "cells", "search", "walks")


def __getattr__(name: str) -> ModuleType:
    if name not in FAMILIES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    with loading(name):
        return importlib.import_module(f"{__name__}.{name}")
