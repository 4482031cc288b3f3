"""Round trips: a component is a value that can be compared, hashed, pickled, written into a config and read back."""

import dataclasses
import pickle
import tomllib

import tomli_w

from pathloom.kernel.component import Component, parameters
from pathloom.kernel.compose import build, freeze
from pathloom.testing.check import Broken, expect, promise
from pathloom.testing.making import registry_with


@promise("value")
def value(component: Component) -> None:
    """It is frozen, equal to one with the same parameters, and hashable."""
    other = object.__new__(type(component))
    for field in dataclasses.fields(component):  # type: ignore[arg-type]
        object.__setattr__(other, field.name, getattr(component, field.name))
    expect(other == component, f"expected two of the same parameters to be equal; found {component} and {other}")
    try:
        same = hash(component) == hash(other)
    except TypeError as error:
        raise Broken(f"expected a hash; found {error}") from error
    expect(same, "expected two of the same parameters to have one hash; found two")
    for parameter in parameters(type(component)):
        try:
            setattr(component, parameter.name, getattr(component, parameter.name))
        except dataclasses.FrozenInstanceError:
            continue
        raise Broken(f"expected it to be frozen; found that {parameter.name!r} can be set")


@promise("pickled")
def pickled(component: Component) -> None:
    """Pickled and unpickled it is equal to what it was."""
    try:
        back = pickle.loads(pickle.dumps(component))  # noqa: S301 - of this very process
    except Exception as error:
        raise Broken(f"expected it to be pickled and unpickled; found {type(error).__name__}: {error}") from error
    expect(back == component, f"expected {component}; found {back}")


@promise("rebuilt")
def rebuilt(component: Component) -> None:
    """Frozen into a config, written as TOML, read and composed again it is equal to what it was."""
    registry = registry_with(component)
    try:
        table = freeze(component, registry)
        read = tomllib.loads(tomli_w.dumps(table))
        back = build(type(component), read, registry, component.name)
    except Exception as error:
        raise Broken(f"expected a table that rebuilds it; found {type(error).__name__}: {error}") from error
    expect(back == component, f"expected {component}; found {back}, rebuilt from {table}")


CHECKS = (value, pickled, rebuilt)
