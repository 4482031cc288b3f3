"""Fronts: sets of trade-offs, how good they are, which one to take, and where other results lie beside them."""

from pathloom.fronts.against import Placement, Rival, place
from pathloom.fronts.asked import Asked
from pathloom.fronts.choosing import knee, preferred, pseudo_weights
from pathloom.fronts.indicators import (
    additive_epsilon,
    attainment,
    hypervolume,
    hypervolume_ratio,
    igd_plus,
    indicators,
    non_dominated,
    reference_point,
)
from pathloom.fronts.result import Choice, ParetoResult
from pathloom.fronts.verified import Verified, verified

__all__ = [
    "Asked",
    "Choice",
    "ParetoResult",
    "Placement",
    "Rival",
    "Verified",
    "additive_epsilon",
    "attainment",
    "hypervolume",
    "hypervolume_ratio",
    "igd_plus",
    "indicators",
    "knee",
    "non_dominated",
    "place",
    "preferred",
    "pseudo_weights",
    "reference_point",
    "verified",
]
