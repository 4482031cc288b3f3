"""Plugins: the one hook, and a loader that takes them one by one.

pluggy's own loader skips the second plugin of a name in silence, and one
broken plugin ends every command. Here each plugin has a manager of its own, is
loaded when a name first needs it, and costs only itself when it is broken.
"""

import importlib.metadata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from inspect import isabstract
from typing import Any, TypeAlias

import pluggy

from pathloom.errors import PluginError
from pathloom.kernel.component import Component

GROUP = "pathloom"
"""The entry-point group: the entry point's name is the plugin's namespace, its value a module."""

hookspec = pluggy.HookspecMarker(GROUP)
hookimpl = pluggy.HookimplMarker(GROUP)

Add: TypeAlias = Callable[[type[Component]], None]


class Hooks:
    """What a plugin can implement."""

    @hookspec
    def register(self, add: Add) -> None:
        """Call ``add`` with every component class that the plugin brings."""


@dataclass(frozen=True)
class Source:
    """A plugin that is installed, loaded or not."""

    namespace: str
    load: Callable[[], Any]
    """Returns the module or object that holds the hook implementation."""
    distribution: str = ""
    version: str = ""
    ours: bool = False
    """Whether it is part of pathloom's own distribution."""
    module: str = ""
    """The module that is loaded, where that is known before it is."""

    def __str__(self) -> str:
        by = f" ({self.distribution} {self.version})" if self.distribution else ""
        return f"plugin {self.namespace!r}{by}"


def installed() -> Iterator[Source]:
    """Yield the plugins that are installed, in the order of their names."""
    points = importlib.metadata.entry_points(group=GROUP)
    for point in sorted(points, key=lambda p: (p.name, p.dist.name if p.dist else "")):
        name, version = (point.dist.name, point.dist.version) if point.dist else ("", "")
        yield Source(point.name, point.load, name, version, ours=name == "pathloom", module=point.module)


def components_of(source: Source) -> list[type[Component]]:
    """Load a plugin and return the components that it registers.

    Raises
    ------
    PluginError
        If it does not import, has no hook, or registers something unusable;
        the message names plugin, distribution, version and cause.
    """
    found: list[type[Component]] = []

    def add(component: type[Component]) -> None:
        _check_component(component)
        if any((c.kind, c.name) == (component.kind, component.name) for c in found):
            raise PluginError(f"registers two components of kind {component.kind!r} called {component.name!r}")
        found.append(component)

    try:
        module = source.load()
        manager = pluggy.PluginManager(GROUP)
        manager.add_hookspecs(Hooks)
        manager.register(module, source.namespace)
        manager.check_pending()
        if not manager.hook.register.get_hookimpls():
            raise PluginError("has no function `register` marked with `pathloom.hookimpl`")
        manager.hook.register(add=add)
    except (Exception, SystemExit) as error:
        cause = str(error) if isinstance(error, PluginError) else f"does not import: {type(error).__name__}: {error}"
        raise PluginError(f"{source}: {cause}".replace("\n", " ")) from error
    return found


def _check_component(component: object) -> None:
    shown = getattr(component, "__qualname__", repr(component))
    if not isinstance(component, type) or not issubclass(component, Component):
        raise PluginError(f"registers {shown}, which inherits from no kind of component")
    if not component.kind:
        raise PluginError(f"registers {shown}, which has no kind: inherit from Sampling, Mutation, …")
    if "__dataclass_params__" not in vars(component) or not component.__dataclass_params__.frozen:  # type: ignore[attr-defined]
        raise PluginError(
            f"registers {shown}, which is not a frozen dataclass: add @dataclass(frozen=True, kw_only=True)"
        )
    if isabstract(component):
        lacks = ", ".join(sorted(vars(component)["__abstractmethods__"]))
        raise PluginError(f"registers {shown}, which lacks {lacks}")
