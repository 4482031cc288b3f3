"""Plain: what a value is made of, so that two values can be compared byte by byte."""

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np

from pathloom.grid import OccupancyGrid
from pathloom.kernel.state import State
from pathloom.paths.problem import PathProblem

Plain = Any
"""Nested tuples of texts, numbers and bytes."""


def plain(value: Any) -> Plain:
    """Return what a value is made of; a state's time does not count."""
    if isinstance(value, np.ndarray):
        return ("array", value.dtype.str, value.shape, value.tobytes())
    if isinstance(value, np.generic):
        return (value.dtype.str, value.tobytes())
    if isinstance(value, (bool, int, str, bytes, type(None))):
        return value
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, OccupancyGrid):
        return plain(value.occupied)
    if isinstance(value, Mapping):
        return ("table", tuple(sorted(((str(k), plain(v)) for k, v in value.items()), key=repr)))
    if isinstance(value, (tuple, list)):
        return (type(value).__name__, tuple(map(plain, value)))
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [f.name for f in dataclasses.fields(value)]
        skipped = {"seconds"} if isinstance(value, State) else set()
        return (type(value).__qualname__, tuple((n, plain(getattr(value, n))) for n in names if n not in skipped))
    return repr(value)


def tables(value: Any) -> dict[str, Plain]:
    """Return the tables of a problem's map that have been worked out so far, wherever the problem is in a value."""
    found: dict[str, Plain] = {}
    for one in value if isinstance(value, tuple) else (value,):
        problem = one.problem if isinstance(one, State) else one
        if isinstance(problem, PathProblem):
            worked_out = vars(problem.context).items()
            found |= {name: plain(table) for name, table in worked_out if isinstance(table, np.ndarray)}
    return found
