"""Contract: all checks, and which of them concern a component."""

from typing import NamedTuple

from pathloom.errors import PathloomError
from pathloom.kernel.component import Component
from pathloom.kernel.registry import default_registry
from pathloom.testing import (
    determinism,
    form,
    maps,
    parameters,
    paths,
    preference,
    purity,
    round_trip,
    rows,
    running,
    shapes,
    states,
    symmetry,
)
from pathloom.testing.check import Broken, Check
from pathloom.testing.making import made

FAMILIES = (
    form, parameters, round_trip, purity, determinism, shapes, paths, rows, preference, maps, states, symmetry,
    running,
)  # fmt: skip
CHECKS: tuple[Check, ...] = tuple(check for family in FAMILIES for check in family.CHECKS)
"""All checks, the cheap ones first."""


class Pair(NamedTuple):
    """A component, or a class of which none could be made, and a check that concerns it."""

    component: Component | type[Component]
    check: Check


def _is_made(component: Component | type[Component]) -> None:
    if isinstance(component, type):
        try:
            made(component)
        except PathloomError as error:
            raise Broken(f"expected a component of defaults and `example`; found {error}") from error


MADE = Check(
    "made", "It can be made of its defaults, or of what its class attribute `example` says.", (Component,), _is_made
)


def checks_for(component: Component | type[Component] | str) -> tuple[Pair, ...]:
    """Return the checks that concern a component, each with the component, as `pytest.mark.parametrize` takes them.

    Parameters
    ----------
    component
        A component; a class, of which one is made (see `Component.example`); or a registered name. One name may stand
        for components of several kinds; then all of them are meant.

    Raises
    ------
    ConfigError
        If no component is called so.
    """
    if isinstance(component, str):
        return tuple(pair for one in _called(component) for pair in checks_for(one))
    if isinstance(component, type):
        try:
            component = made(component)
        except PathloomError:
            return (Pair(component, MADE),)  # nothing else can be found out
    return tuple(Pair(component, check) for check in (MADE, *CHECKS) if check.concerns(component))


def _called(name: str) -> list[type[Component]]:
    registry = default_registry()
    found = [entry.component for entry in registry.all_entries() if entry.name == name]
    return found or [registry.find(Component, name)]
