"""Packages: the promises of all components that a plugin, or a distribution, brings, and what becomes of them."""

import io
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from typing import Literal

from pathloom.errors import ConfigError, PluginError
from pathloom.kernel.component import Component
from pathloom.kernel.registry import Registry, default_registry
from pathloom.naming import closest
from pathloom.testing.check import Broken, Check, Inapplicable
from pathloom.testing.contract import checks_for

Found = Literal["kept", "broken", "not tried"]


@dataclass(frozen=True)
class Promise:
    """A check of one registered component."""

    name: str
    """The component's full name."""
    component: Component | type[Component]
    check: Check

    def __str__(self) -> str:
        return f"{self.component.kind}:{self.name}:{self.check.name}"

    def __call__(self) -> None:
        """Find out whether it is kept; see `Check`."""
        self.check(self.component)


@dataclass(frozen=True)
class Verdict:
    """What became of a promise."""

    plugin: str
    """The plugin with its distribution and version."""
    kind: str
    name: str
    """The component's full name."""
    check: str
    promise: str
    found: Found
    message: str
    """What was expected and what was found, or why nothing was tried."""


def promises_of(package: str | None = None, registry: Registry | None = None) -> Iterator[Promise]:
    """Yield the promises of all components of a package; see `plugins_of`.

    Raises
    ------
    ConfigError
        If nothing is called so.
    PluginError
        If one of its plugins is broken.
    """
    registry = registry or default_registry()
    plugins, broken = plugins_of(package, registry)
    if broken:
        raise next(iter(broken.values()))
    for namespace in plugins:
        for entry in registry.entries(namespace):
            for component, check in checks_for(entry.component):
                yield Promise(entry.name, component, check)


def plugins_of(
    package: str | None = None, registry: Registry | None = None
) -> tuple[list[str], dict[str, PluginError]]:
    """Return the namespaces of a package that can be checked, and what is wrong with those that cannot.

    Parameters
    ----------
    package
        A plugin's namespace, or the name of a distribution; without it, all plugins are meant that are not ours.

    Raises
    ------
    ConfigError
        If nothing is called so.
    """
    registry = registry or default_registry()
    known = {name: registry.source(name) for name in registry.namespaces}
    found = [name for name, source in known.items() if package is None and not source.ours]
    if package in known:
        found = [package]
    elif package is not None:
        wanted = _canonical(package)
        found = [name for name, source in known.items() if _canonical(source.distribution) == wanted]
        if not found:
            names = {*known, *(source.distribution for source in known.values() if source.distribution)}
            hint = closest(package, names)
            raise ConfigError(f"check: no plugin and no package with plugins is called {package!r}; {hint}")
    broken: dict[str, PluginError] = {}
    for namespace in found:
        try:
            registry.entries(namespace)
        except PluginError as error:
            broken[namespace] = error
    return [name for name in found if name not in broken], broken


def examined(namespace: str, registry: Registry | None = None) -> Iterator[Verdict]:
    """Try all promises of a plugin's components, and yield what becomes of each."""
    registry = registry or default_registry()
    source = str(registry.source(namespace))
    for promise in promises_of(namespace, registry):
        found, message = _found(promise)
        about = promise.component.kind, promise.name, promise.check.name, promise.check.promise
        yield Verdict(source, *about, found, message)


def _found(promise: Promise) -> tuple[Found, str]:
    """Return what becomes of a promise, and why. What is printed meanwhile goes nowhere."""
    with redirect_stdout(io.StringIO()):
        try:
            promise()
        except Inapplicable as reason:
            return "not tried", str(reason)
        except Broken as error:
            return "broken", str(error)
        except Exception as error:
            return "broken", f"expected an answer; found {type(error).__name__}: {error}"
    return "kept", ""


def _canonical(distribution: str) -> str:
    return distribution.lower().replace("_", "-").replace(".", "-")
