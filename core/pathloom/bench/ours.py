"""Our own planners and exact searches, as they enter a benchmark."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve, Until
from pathloom.errors import ConfigError
from pathloom.exact import any_angle_path, octile_path
from pathloom.kernel.compose import compose
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import iterate, run
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem

TREES = {"use": "imga", "sampling": "perturbed-trees"}


class Ours(Peer):
    """A planner of pathloom. Each run makes its tables of the map anew: nothing is prepared."""

    distribution: ClassVar[str] = "pathloom"

    def __init__(self, planner: str | Mapping[str, Any]) -> None:
        self.planner = compose(planner)
        self.name = planner if isinstance(planner, str) else shown(planner)
        self.about = "tables of the map made in each run"

    def prepare(self, problem: PathProblem) -> Solve:
        def solve(seed: int, seconds: float = math.inf, target: float = 0.0) -> Answer:
            fresh = replace(problem)
            if not fresh.reachable:
                return None
            if target > 0.0:
                return _to_target(fresh, self.planner, seed, Until(seconds, target))
            limit = seconds if seconds < math.inf else None
            return _path(fresh, run(fresh, self.planner, seed, time_limit=limit).outcome.solution)

        return solve


class Exact(Peer):
    """One of our exact searches."""

    distribution: ClassVar[str] = "pathloom"
    draws: ClassVar[bool] = False

    def __init__(self, name: str, about: str, search: Callable[[PathProblem], tuple[float, Path | None]]) -> None:
        self.name, self.about, self._search = name, about, search

    def prepare(self, problem: PathProblem) -> Solve:
        return lambda *_: self._search(replace(problem))[1]


EXACT = (
    Exact("any-angle search", "our exact search over the centres of free cells; no time limit", any_angle_path),
    Exact("octile search", "our exact search over the 8 neighbours; no time limit", octile_path),
)


def usual() -> list[str | Mapping[str, Any]]:
    """Return the planners that are measured unless others are named: `loom` once there is one, and IMGA."""
    try:
        default_registry().find(Planner, "loom")
    except ConfigError:
        return ["imga", TREES]
    return ["loom", "imga", TREES]


def shown(planner: object) -> str:
    """Return what a table calls a planner."""
    return planner if isinstance(planner, str) else str(planner).replace("'", "")


def _to_target(problem: PathProblem, planner: Planner, seed: int, until: Until) -> Answer:
    """Return the first path that is short enough, looked for after each generation."""
    path: Answer = None
    for state in iterate(problem, planner, seed):
        path = _path(problem, planner.result(state).solution)
        length = math.inf if path is None else float(np.hypot(*np.diff(path, axis=0).T).sum())
        if until.over(length):
            break
    return path


def _path(problem: PathProblem, row: Any) -> Answer:
    return None if row is None else problem.representation.decode(row)
