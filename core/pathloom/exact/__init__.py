"""Exact references, and the validator that trusts nobody."""

from pathloom.exact.additive import Optimum, additive_optimum, additive_path
from pathloom.exact.any_angle import any_angle_path, any_angle_search
from pathloom.exact.front import exact_front
from pathloom.exact.octile import octile_path
from pathloom.exact.taut import taut_length, taut_way
from pathloom.exact.validator import Contacts, contacts, validate

__all__ = [
    "Contacts",
    "Optimum",
    "additive_optimum",
    "additive_path",
    "any_angle_path",
    "any_angle_search",
    "contacts",
    "exact_front",
    "octile_path",
    "taut_length",
    "taut_way",
    "validate",
]
