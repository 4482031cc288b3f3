"""Exact references, and the validator that trusts nobody."""

from pathloom.exact.any_angle import any_angle_path
from pathloom.exact.octile import octile_path
from pathloom.exact.validator import Contacts, contacts, validate

__all__ = ["Contacts", "any_angle_path", "contacts", "octile_path", "validate"]
