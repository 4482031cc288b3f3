"""Claims: what a paper says, measured again.

A paper's plugin registers one component of kind ``claim`` for each table or
statement of the paper. It yields a finding for every number: what the paper
says, what we measure, and whether the one holds in the other.
"""

import json
import os
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, Literal

import numpy as np

from pathloom.errors import ConfigError
from pathloom.kernel.component import Component
from pathloom.kernel.compose import compose, freeze
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import CORE, Registry, default_registry
from pathloom.naming import closest
from pathloom.paths.context import Corners
from pathloom.paths.maps import load_map
from pathloom.paths.metrics import metrics
from pathloom.paths.problem import Cell, PathProblem
from pathloom.planning import plan
from pathloom.result import Result

Verdict = Literal["holds", "holds in direction", "does not hold", "not testable"]

NEEDS_DATA = "needs a map that is not ours to ship (PATHLOOM_DATA)"
"""What is measured where a map that a paper prints as a picture only is not at hand."""


@dataclass(frozen=True)
class Finding:
    """One statement of a paper, and what became of it."""

    place: str
    """Table, figure or section."""
    says: str
    """What the paper says, with its numbers."""
    measured: str
    """What we measure: numbers, seeds and maps; or why nothing can be measured."""
    verdict: Verdict
    timed: bool = False
    """Whether the verdict depends on the clock, and so on the machine."""


def verdict(holds: bool | np.bool_, direction: bool | np.bool_ = False) -> Verdict:
    """Return the verdict on a statement that holds as it stands, or at least in its direction."""
    return "holds" if holds else "holds in direction" if direction else "does not hold"


def untestable(place: str, says: str, why: str) -> Finding:
    """Return the finding that nothing can be measured, and why."""
    return Finding(place, says, why, "not testable")


@dataclass(frozen=True)
class Comparison:
    """Paired values of two methods, compared."""

    wins: int
    """Pairs in which the first value is smaller."""
    ties: int
    pairs: int
    p: float
    """One-sided Wilcoxon signed-rank: how likely such a lead is by chance."""

    def __str__(self) -> str:
        tied = f" ({self.ties} ties)" if self.ties else ""
        return f"{self.wins} of {self.pairs}{tied}, p = {self.p:.2g}"


def smaller(first: Sequence[float], second: Sequence[float]) -> Comparison:
    """Compare paired values: how far the first method's are the smaller ones."""
    from scipy.stats import wilcoxon

    a, b = np.asarray(first, np.float64), np.asarray(second, np.float64)
    p = float(wilcoxon(a, b, alternative="less").pvalue) if (a != b).any() else 1.0
    return Comparison(int((a < b).sum()), int((a == b).sum()), len(a), p)


@dataclass
class Bench:
    """Where claims are tried: it makes the problems and runs the planners, each combination once."""

    full: bool = True
    """As many runs as the paper, or a few that show the direction."""
    data: Path | None = field(default_factory=lambda: Path(d) if (d := os.environ.get("PATHLOOM_DATA")) else None)
    """The folder with maps that are not ours to ship."""
    _runs: dict[str, list[Result]] = field(default_factory=dict, repr=False)

    def seeds(self, full: int, reduced: int) -> int:
        """Return how many seeds to run."""
        return full if self.full else reduced

    def problem(
        self,
        source: str | Path,
        *,
        start: Cell | str = "bottom-left",
        goal: Cell | str = "top-right",
        corners: Corners = "allow",
    ) -> PathProblem:
        """Return the problem on a map, under the papers' corner policy."""
        return PathProblem(load_map(source, corners=corners), start=start, goal=goal, corners=corners)

    def recovered(self, file: str, **ends: Any) -> PathProblem | None:
        """Return the problem on a map of ``PATHLOOM_DATA`` that a paper prints as a picture only, if it is at hand."""
        if self.data is None or not (path := self.data / file).is_file():
            return None
        return self.problem(path, **ends)

    def runs(self, planner: str | Mapping[str, Any] | Planner, problem: PathProblem, seeds: int) -> list[Result]:
        """Return the results of seeds 0 to ``seeds`` − 1; those that were run before are not run again."""
        composed = compose(planner)
        which = [freeze(composed.unwatched, default_registry()), problem.grid.sha256, problem.ends, problem.corners]
        results = self._runs.setdefault(json.dumps(which, sort_keys=True), [])
        results += [plan(problem, composed, seed=seed) for seed in range(len(results), seeds)]
        return results[:seeds]

    @staticmethod
    def unrefined(result: Result) -> dict[str, Any]:
        """Return the metrics of the path that a run on the bench found, before the planner refined it."""
        assert result.path_problem is not None, "only results read from a file lack their problem"
        assert result.unrefined is not None, "asked of a run that found nothing"
        return metrics(result.unrefined, result.path_problem)


@dataclass(frozen=True, kw_only=True)
class Claim(Component, ABC):
    """A table, figure or statement of a paper that can be tried again. ``source`` says where it stands."""

    kind: ClassVar[str] = "claim"

    @abstractmethod
    def examine(self, bench: Bench) -> Iterator[Finding]:
        """Yield a finding for every number, measured on the bench."""


def claims_of(namespace: str | None = None, registry: Registry | None = None) -> Iterator[tuple[str, Claim]]:
    """Yield the claims of one plugin, or of all, each with the plugin's name.

    Raises
    ------
    ConfigError
        If there is no such plugin, or it claims nothing.
    """
    registry = registry or default_registry()
    known = [n for n in registry.namespaces if n != CORE]
    if namespace is not None and namespace not in known:
        raise ConfigError(f"no plugin is called {namespace!r}; {closest(namespace, known)}")
    if namespace is not None:
        registry.entries(namespace)  # says so if it is broken
    found = [e for e in registry.all_entries(Claim) if namespace in (None, e.source.namespace)]
    if not found:
        raise ConfigError(f"plugin {namespace!r} claims nothing" if namespace else "no plugin claims anything")
    for entry in found:
        yield entry.source.namespace, entry.component()  # type: ignore[misc]
