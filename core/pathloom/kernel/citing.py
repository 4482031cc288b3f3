"""Citing: what planners and their parts were published in."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from pathloom.errors import PluginError
from pathloom.kernel.component import Component, members, parameters
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import Registry, default_registry


@dataclass(frozen=True)
class Work:
    """Something published."""

    text: str
    """As it stands in a list of references."""
    bibtex: str
    """Empty where there is no entry."""

    @property
    def key(self) -> str:
        """The key of the entry, or nothing."""
        found = re.match(r"\s*@\w+\{([^,\s]+)", self.bibtex)
        return found[1] if found else ""


def works_of(components: Iterable[Component], registry: Registry | None = None) -> list[Work]:
    """Return what components, planners mostly, and their parts were published in, each once.

    The components' own works come first. A part that names no work of its own was
    published in its plugin's paper, where all planners of the plugin come from one.
    What has no reference is left out.
    """
    registry = registry or default_registry()
    first = list(components)
    inner = [part for component in first for part in parts_of(component)]
    works = [_own(type(component)) for component in first]
    works += [_own(type(part)) or _paper_of(type(part), registry) for part in (*first, *inner)]
    found: dict[str, Work] = {}
    for work in works:
        if work is not None:
            found.setdefault(work.bibtex or work.text, work)
    return list(found.values())


def parts_of(component: Component) -> Iterator[Component]:
    """Yield all that a component is made of, its parts' parts and its objectives too, observers left out."""
    for parameter in parameters(type(component)):
        value = getattr(component, parameter.name)
        if isinstance(value, Terms):
            for objective in value.objectives():
                yield objective
                yield from parts_of(objective)
    for slot, part in members(component):
        if slot != "observers":
            yield part
            yield from parts_of(part)


def _own(component: type[Component]) -> Work | None:
    work = Work(component.reference, component.bibtex)
    return work if work.text or work.bibtex else None


def _paper_of(component: type[Component], registry: Registry) -> Work | None:
    """Return the one work that all planners of a component's plugin come from, if that is so."""
    namespace, slash, _ = registry.name_of(component).partition("/")
    if not slash:
        return None
    try:
        planners = [e.component for e in registry.entries(namespace) if issubclass(e.component, Planner)]
    except PluginError:
        return None  # whoever is used all the same came in by hand
    works = {planner.bibtex: _own(planner) for planner in planners}
    return works.popitem()[1] if len(works) == 1 and "" not in works else None
