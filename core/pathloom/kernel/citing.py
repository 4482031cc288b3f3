"""Citing: what planners and their parts were published in."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from pathloom.kernel.component import members
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import Entry, Registry, default_registry


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


def works_of(planners: Iterable[Planner], registry: Registry | None = None) -> list[Work]:
    """Return what planners and their parts were published in, each once; what has no reference is left out.

    The planners' own works come first. A part is published in its plugin's paper,
    where all planners of the plugin come from one.
    """
    registry = registry or default_registry()
    kinds, spaces = set(), set()
    for planner in planners:
        kinds.add(type(planner))
        parts = [planner, *(part for _, part in members(planner)), *planner.terms.objectives()]
        spaces |= {registry.name_of(type(part)).partition("/")[0] for part in parts}
    entries = list(registry.all_entries(Planner))
    spaces &= _of_one_paper(entries)
    found: dict[str, Work] = {}
    for entry in sorted(entries, key=lambda entry: entry.component not in kinds):
        work = Work(getattr(entry.component, "reference", ""), getattr(entry.component, "bibtex", ""))
        of_a_part = work.bibtex and entry.source.namespace in spaces
        if work.text and (entry.component in kinds or of_a_part):
            found.setdefault(work.bibtex or work.text, work)
    return list(found.values())


def _of_one_paper(entries: Iterable[Entry]) -> set[str]:
    """Return the plugins whose planners come from one paper: who uses a part of them cites it."""
    papers: dict[str, set[str]] = {}
    for entry in entries:
        papers.setdefault(entry.source.namespace, set()).add(getattr(entry.component, "bibtex", ""))
    return {space for space, entries_of in papers.items() if len(entries_of) == 1}
