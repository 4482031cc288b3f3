"""Parameters: what a component declares is what it takes."""

import dataclasses
from collections.abc import Iterator
from typing import Any

from pathloom.errors import PathloomError
from pathloom.kernel.component import Component, Parameter, parameters
from pathloom.kernel.termination import MaxGenerations, Termination
from pathloom.paths.objectives import Length
from pathloom.testing.check import Broken, expect, promise
from pathloom.testing.values import beside, outside, within


@promise("parameters-refused")
def refused(component: Component) -> None:
    """A value of another type, or beyond its range, is refused by name with a ConfigError."""
    for parameter in parameters(type(component)):
        for wrong in _wrong(parameter):
            found = _told(component, parameter, wrong)
            expect(found is not None, f"expected {parameter.name} to be {parameter.allowed}; found {wrong!r} accepted")
            expect(
                parameter.name in str(found),
                f"expected a message that names {parameter.name!r}, given {wrong!r}; found {found!r}",
            )


@promise("parameters-taken")
def taken(component: Component) -> None:
    """A value within its range is taken, or refused with a ConfigError where two do not go together."""
    for parameter in parameters(type(component)):
        if parameter.slot or parameter.slots:
            continue
        values = [*within(parameter.hint), *beside(getattr(component, parameter.name), parameter.hint)]
        refusals = [_told(component, parameter, value) for value in values]
        expect(
            not values or None in refusals,
            f"expected {parameter.name} to take {parameter.allowed}; found all of {values} refused: {refusals[:1]}",
        )


def _wrong(parameter: Parameter) -> Iterator[Any]:
    if kind := parameter.slot or parameter.slots:
        stranger = Length() if issubclass(kind, Termination) else MaxGenerations()
        if issubclass(kind, type(stranger)) or isinstance(stranger, kind):
            return
        yield (stranger,) if parameter.slots else stranger
        yield "a name"
    else:
        yield from outside(parameter.hint)


def _told(component: Component, parameter: Parameter, value: Any) -> str | None:
    """Return why a component refuses a value, or ``None`` if it takes it."""
    try:
        dataclasses.replace(component, **{parameter.name: value})  # type: ignore[type-var]
    except PathloomError as error:
        return str(error)
    except Exception as error:
        raised = f"{type(error).__name__}: {error}"
        raise Broken(
            f"expected {parameter.name} = {value!r} to be taken or refused by a ConfigError; found {raised}"
        ) from error
    return None


CHECKS = (refused, taken)
