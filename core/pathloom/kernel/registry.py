"""Registry: names to components and back.

A full name is ``plugin/component``; the kernel's own components have no prefix.
Where the prefix is left out, the kernel is asked first, then the plugins that
come with pathloom, then the others: an installed plugin that nobody names can
neither change what a name means nor cost anything.
"""

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from typing import TypeVar

from pathloom.deprecation import warn
from pathloom.errors import ConfigError, PluginError
from pathloom.kernel.component import Component
from pathloom.kernel.plugins import Source, components_of, installed
from pathloom.naming import a, closest

CORE = "core"
"""Namespace of the components that need no prefix."""

C = TypeVar("C", bound=Component)


@dataclass(frozen=True)
class Entry:
    """A component under its name, and the plugin that brought it."""

    name: str
    component: type[Component]
    source: Source


class Registry:
    """The plugins that there are, each loaded when a name first needs it."""

    def __init__(self, sources: Iterable[Source]) -> None:
        self._sources: dict[str, Source] = {}
        self._broken: dict[str, PluginError] = {}
        self._entries: dict[str, list[Entry]] = {}
        self._names: dict[type[Component], str] = {}
        for source in sources:
            self._admit(source)

    def _admit(self, source: Source) -> None:
        rival = self._sources.get(source.namespace)
        if rival is None:
            self._sources[source.namespace] = source
            return
        both = " and ".join(f"{s.distribution} {s.version}".strip() or "an unknown package" for s in (rival, source))
        clash = PluginError(f"plugin name {source.namespace!r} is claimed twice: by {both}; uninstall one")
        if rival.ours or source.ours:  # ours goes on working; the other one is reported
            self._sources[source.namespace] = rival if rival.ours else source
            loser = source if rival.ours else rival
            self._broken[f"{source.namespace} of {loser.distribution}"] = clash
        else:
            self._broken[source.namespace] = clash

    @property
    def namespaces(self) -> tuple[str, ...]:
        """The namespaces of all plugins, the kernel's own first, then ours, then the others."""
        return tuple(sorted(self._sources, key=lambda n: (n != CORE, not self._sources[n].ours, n)))

    def source(self, namespace: str) -> Source:
        """Return the plugin of a namespace."""
        return self._sources[namespace]

    def entries(self, namespace: str) -> list[Entry]:
        """Return the components of one plugin, loading it if need be.

        Raises
        ------
        PluginError
            If the plugin is broken, or its name is claimed twice.
        """
        if namespace in self._broken:
            raise self._broken[namespace]
        if namespace not in self._entries:
            source = self._sources[namespace]
            prefix = "" if namespace == CORE else f"{namespace}/"
            try:
                found = components_of(source)
            except PluginError as error:
                self._broken[namespace] = error
                raise
            self._entries[namespace] = [Entry(prefix + c.name, c, source) for c in found]
            self._names.update((c, prefix + c.name) for c in found)
        return self._entries[namespace]

    def all_entries(self, kind: type[Component] = Component) -> Iterator[Entry]:
        """Yield every component of a kind of every plugin that works."""
        for namespace in self.namespaces:
            try:
                entries = self.entries(namespace)
            except PluginError:
                continue  # reported by `broken`
            yield from (entry for entry in entries if issubclass(entry.component, kind))

    def broken(self) -> dict[str, PluginError]:
        """Load all plugins and return what is wrong with those that do not work, by namespace."""
        for _ in self.all_entries():
            pass
        return dict(self._broken)

    def find(self, kind: type[C], name: str, where: str = "") -> type[C]:
        """Return the component of a kind under a full or a bare name.

        Raises
        ------
        ConfigError
            If there is none, or several; the message says what was probably meant.
        PluginError
            If the plugin that is named is broken.
        """
        at = f"{where}: " if where else ""
        namespace, slash, tail = name.rpartition("/")
        if slash:
            if namespace not in self._sources:
                raise ConfigError(f"{at}no plugin is called {namespace!r}; {closest(namespace, self._sources)}")
            found = [e for e in self.entries(namespace) if e.component.name == tail]
        else:
            found = self._bare(kind, name)
        fitting = [e for e in found if issubclass(e.component, kind)]
        if len(fitting) > 1:
            raise ConfigError(f"{at}{name!r} is ambiguous: {' or '.join(repr(e.name) for e in fitting)}")
        if fitting:
            return fitting[0].component  # type: ignore[return-value]
        if former := self._formerly(kind, namespace, tail):
            warn(f"{at}the name {name!r}", former.component.formerly[tail], repr(former.name))
            return former.component  # type: ignore[return-value]
        if found:
            raise ConfigError(f"{at}{name!r} is {a(found[0].component.kind)}, not {a(kind.kind)}")
        hint = closest(name, (e.name for e in self.all_entries(kind)))
        raise ConfigError(f"{at}no {kind.kind} is called {name!r}; {hint}")

    def _formerly(self, kind: type[Component], namespace: str, tail: str) -> Entry | None:
        """Return the component of a kind that bore a name before, if there is one."""
        for entry in self.all_entries(kind):
            if tail in entry.component.formerly and namespace in ("", entry.source.namespace):
                return entry
        return None

    def _bare(self, kind: type[Component], name: str) -> list[Entry]:
        """Return the entries of a bare name in the first tier that has one of the kind, else those of other kinds."""
        others: list[Entry] = []
        for tier in self._tiers():
            found = []
            for namespace in tier:
                try:
                    found += [e for e in self.entries(namespace) if e.component.name == name]
                except PluginError:
                    continue  # a broken plugin that nobody named is nobody's concern here
            fitting = [e for e in found if issubclass(e.component, kind)]
            if fitting:
                return fitting
            others += found
        return others

    def _tiers(self) -> Iterator[list[str]]:
        yield [n for n in self.namespaces if n == CORE]
        yield [n for n in self.namespaces if n != CORE and self._sources[n].ours]
        yield [n for n in self.namespaces if n != CORE and not self._sources[n].ours]

    def name_of(self, component: type[Component]) -> str:
        """Return the full name of a component class; for one that no plugin registered, its Python name."""
        if component not in self._names:
            for namespace in self._likely(component):
                with suppress(PluginError):  # a broken plugin has brought nothing
                    self.entries(namespace)
                if component in self._names:
                    break
        return self._names.get(component, f"{component.__module__}.{component.__qualname__}")

    def _likely(self, component: type[Component]) -> list[str]:
        """Return the plugins that may have brought a component: first its own package's, of whomever, then ours."""
        package = component.__module__.partition(".")[0]
        own = [n for n in self.namespaces if self._sources[n].module.partition(".")[0] == package]
        return own + [n for n in self.namespaces if self._sources[n].ours and n not in own]


@cache
def default_registry() -> Registry:
    """Return the registry of all installed plugins."""
    return Registry(installed())
