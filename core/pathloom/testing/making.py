"""Making a component to be tried: of its defaults, of its example, and of whatever fits where it says neither."""

from collections.abc import Iterator
from functools import cache
from typing import Any

from pathloom.errors import ConfigError
from pathloom.kernel.component import Component, Parameter, members, parameters
from pathloom.kernel.compose import build
from pathloom.kernel.evaluation import Term, Terms
from pathloom.kernel.plugins import Source, hookimpl, installed
from pathloom.kernel.registry import Registry, default_registry
from pathloom.paths.objectives import Length
from pathloom.testing.values import within


def made(component: type[Component]) -> Component:
    """Return a component of a class, to be tried.

    What it needs and has no default for is taken from its ``example``, a table
    as in a config; what that leaves out is the first component of the kind that
    a slot takes, or the first value that a parameter allows.

    Raises
    ------
    ConfigError
        If it cannot be built of these.
    """
    registry = registry_with(component)
    needed = {p.name: _anything(p, component) for p in parameters(component) if p.required}
    table = {"use": registry.name_of(component), **needed, **component.example}
    return build(component, table, registry, component.name)


def _anything(parameter: Parameter, component: type[Component]) -> Any:
    """Return a value for a parameter that has no default."""
    if kind := parameter.slot or parameter.slots:
        usual = _usual(kind, component)
        return (usual,) if parameter.slots else usual
    if parameter.own_type is Terms:
        return Terms([Term("length", Length())])
    for value in within(parameter.hint):
        return value
    raise ConfigError(f"{component.name}: needs {parameter.name!r}; say a value in the class attribute `example`")


def _usual(kind: type[Component], but: type[Component]) -> Component:
    """Return the first component of a kind that needs nothing, other than one."""
    for entry in default_registry().all_entries(kind):
        if entry.component is not but and not any(p.required for p in parameters(entry.component)):
            return entry.component()
    raise ConfigError(f"{but.name}: no {kind.kind} is there to fill its slot; say one in the class attribute `example`")


def registry_with(component: type[Component] | Component) -> Registry:
    """Return a registry that knows a component and its parts, whether a plugin has registered them or not."""
    unknown: dict[type[Component], None] = {}
    for one in _parts(component) if isinstance(component, Component) else [component]:
        kind = one if isinstance(one, type) else type(one)
        if default_registry().name_of(kind) == f"{kind.__module__}.{kind.__qualname__}":
            unknown[kind] = None
    return _registry_with(tuple(unknown)) if unknown else default_registry()


@cache
def _registry_with(components: tuple[type[Component], ...]) -> Registry:
    class Module:
        """Stands for a plugin's module."""

        @staticmethod
        @hookimpl
        def register(add: Any) -> None:
            for component in components:
                add(component)

    registry = Registry([*installed(), Source("tried", lambda: Module)])
    registry.entries("tried")  # from now on it knows their names
    return registry


def _parts(component: Component) -> Iterator[Component]:
    """Yield a component and all that it is made of."""
    yield component
    inner = [part for _, part in members(component)]
    for parameter in parameters(type(component)):
        value = getattr(component, parameter.name)
        if isinstance(value, Terms):
            inner += value.objectives()
    for part in inner:
        yield from _parts(part)
