"""Plugins: the one hook, and a loader that takes them one by one.

pluggy's own loader skips the second plugin of a name in silence, and one
broken plugin ends every command. Here each plugin has a manager of its own, is
loaded when a name first needs it, and costs only itself when it is broken, does
not come to an end, or prints.
"""

import importlib.metadata
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from inspect import isabstract
from typing import Any, TypeAlias

import pluggy

from pathloom.errors import PluginError, PluginWarning
from pathloom.kernel.component import Component, parameters
from pathloom.kernel.importing import cause, misfit, within_limits

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
    """What is imported, where it is known."""
    requirements: Callable[[], Sequence[str]] = tuple
    """Returns what its distribution requires."""

    def __str__(self) -> str:
        by = f" ({self.distribution} {self.version})" if self.distribution else ""
        return f"plugin {self.namespace!r}{by}"


def installed() -> Iterator[Source]:
    """Yield the plugins that are installed, in the order of their names."""
    sources = map(_source, importlib.metadata.entry_points(group=GROUP))
    yield from sorted(sources, key=lambda source: (source.namespace, source.distribution))


def _source(point: importlib.metadata.EntryPoint) -> Source:
    if (dist := point.dist) is None:
        return Source(point.name, point.load, module=point.module)
    name, version = _name_and_version(dist)
    return Source(
        point.name, point.load, name, version, ours=name == "pathloom", module=point.module,
        requirements=lambda: dist.requires or (),
    )  # fmt: skip


def _name_and_version(dist: importlib.metadata.Distribution) -> tuple[str, str]:
    """Return what ``dist.name`` and ``dist.version`` are, each of which would parse all of the metadata."""
    head = (dist.read_text("METADATA") or "").partition("\n\n")[0]
    found = dict(re.findall(r"^(Name|Version): *(\S+)", head, re.MULTILINE))
    return found.get("Name") or dist.name, found.get("Version") or dist.version


def components_of(source: Source) -> list[type[Component]]:
    """Load a plugin and return the components that it registers.

    Warns with a `PluginWarning` of what it prints meanwhile, which does not reach standard output.

    Raises
    ------
    PluginError
        If it does not import, or not in time, is built for another pathloom, has no
        hook, or registers something unusable; the message names plugin,
        distribution, version and cause.
    """
    try:
        if source.ours or source.module in sys.modules:  # what is there already does not hang
            return _registered(source)
        if wrong := misfit(source.requirements()):
            raise PluginError(wrong)
        found, printed = within_limits(lambda: _registered(source))
    except (Exception, SystemExit) as error:
        why = str(error) if isinstance(error, PluginError) else cause(error)
        raise PluginError(f"{source}: {why}".replace("\n", " ")) from error
    if printed:
        warnings.warn(f"{source}: prints when it is imported: {printed!r}", PluginWarning, stacklevel=2)
    return found


def _registered(source: Source) -> list[type[Component]]:
    """Import a plugin and return the components that it registers."""
    found: list[type[Component]] = []

    def add(component: type[Component]) -> None:
        _check_component(component)
        if not source.ours:
            _check_fields(component)
        if any((c.kind, c.name) == (component.kind, component.name) for c in found):
            raise PluginError(f"registers two components of kind {component.kind!r} called {component.name!r}")
        found.append(component)

    module = source.load()
    manager = pluggy.PluginManager(GROUP)
    manager.add_hookspecs(Hooks)
    manager.register(module, source.namespace)
    manager.check_pending()
    if not manager.hook.register.get_hookimpls():
        raise PluginError("has no function `register` marked with `pathloom.hookimpl`")
    manager.hook.register(add=add)
    return found


def _check_component(component: object) -> None:
    shown = getattr(component, "__qualname__", repr(component))
    if isinstance(component, Component):
        raise PluginError(f"registers {shown}, which is no class: register {type(component).__qualname__}")
    if not isinstance(component, type) or not issubclass(component, Component):
        raise PluginError(f"registers {shown}, which inherits from no kind of component")
    if not component.kind:
        raise PluginError(f"registers {shown}, which has no kind: inherit from Sampling, Mutation, …")
    kinds = dict.fromkeys(kind for base in component.__mro__ if (kind := vars(base).get("kind")))
    if len(kinds) > 1:
        raise PluginError(f"registers {shown}, which is of several kinds: {', '.join(kinds)}")
    if "__dataclass_params__" not in vars(component) or not component.__dataclass_params__.frozen:  # type: ignore[attr-defined]
        raise PluginError(
            f"registers {shown}, which is not a frozen dataclass: add @dataclass(frozen=True, kw_only=True)"
        )
    if isabstract(component):
        lacks = ", ".join(sorted(vars(component)["__abstractmethods__"]))
        raise PluginError(f"registers {shown}, which lacks {lacks}")


def _check_fields(component: type[Component]) -> None:
    try:
        parameters(component)
    except Exception as error:
        raise PluginError(
            f"registers {component.__qualname__}, whose fields cannot be read: {type(error).__name__}: {error}"
        ) from error
