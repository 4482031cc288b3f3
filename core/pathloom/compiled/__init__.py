"""Compiled kernels. They know arrays only: no problem, no grid, no population object.

Populations are int32 (n, width): flat cell ids, padded with −1. Each family is a
module, loaded when something first asks for it: ``segments`` (collision tests,
deletion of points), ``measures``, ``insertion``, ``exchange``, ``identity``,
``search`` (trees, exact searches), ``walks``. Loading compiles a family once for a
machine; from then on it comes from numba's cache.
"""

import importlib
from types import ModuleType
from typing import TYPE_CHECKING

from pathloom.compiled.jit import loading

if TYPE_CHECKING:
    from pathloom.compiled import angles as angles
    from pathloom.compiled import ants as ants
    from pathloom.compiled import any_angle as any_angle
    from pathloom.compiled import crossing as crossing
    from pathloom.compiled import curves as curves
    from pathloom.compiled import decoding as decoding
    from pathloom.compiled import distances as distances
    from pathloom.compiled import exchange as exchange
    from pathloom.compiled import forests as forests
    from pathloom.compiled import fronts as fronts
    from pathloom.compiled import guided as guided
    from pathloom.compiled import headings as headings
    from pathloom.compiled import identity as identity
    from pathloom.compiled import insertion as insertion
    from pathloom.compiled import joining as joining
    from pathloom.compiled import libraries as libraries
    from pathloom.compiled import measures as measures
    from pathloom.compiled import merging as merging
    from pathloom.compiled import midpoints as midpoints
    from pathloom.compiled import pooling as pooling
    from pathloom.compiled import priced as priced
    from pathloom.compiled import probabilities as probabilities
    from pathloom.compiled import rays as rays
    from pathloom.compiled import rejoining as rejoining
    from pathloom.compiled import rerouting as rerouting
    from pathloom.compiled import reshaping as reshaping
    from pathloom.compiled import search as search
    from pathloom.compiled import seeding as seeding
    from pathloom.compiled import segments as segments
    from pathloom.compiled import sight as sight
    from pathloom.compiled import taut as taut
    from pathloom.compiled import tightening as tightening
    from pathloom.compiled import trees as trees
    from pathloom.compiled import trial as trial
    from pathloom.compiled import walks as walks

FAMILIES = (
    "angles",
    "any_angle",
    "ants",
    "crossing",
    "curves",
    "decoding",
    "distances",
    "exchange",
    "forests",
    "fronts",
    "guided",
    "headings",
    "identity",
    "insertion",
    "joining",
    "libraries",
    "measures",
    "merging",
    "midpoints",
    "pooling",
    "priced",
    "probabilities",
    "rays",
    "rejoining",
    "rerouting",
    "reshaping",
    "search",
    "seeding",
    "segments",
    "sight",
    "taut",
    "tightening",
    "trees",
    "trial",
    "walks",
)


def __getattr__(name: str) -> ModuleType:
    if name not in FAMILIES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    with loading(name):
        return importlib.import_module(f"{__name__}.{name}")
