"""Path-wise bases: operators written for one path at a time, in plain Python.

The loop works on whole populations; these bases take its rows apart and put
them together again. What a path-wise operator returns is checked: a path that
leaves the map, loses start or goal, or collides is dropped, its parent kept,
and the failure counted.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.errors import PluginError
from pathloom.kernel.component import Count
from pathloom.kernel.counting import count
from pathloom.kernel.evaluation import Floats, Objective
from pathloom.kernel.operators import Crossover, Indices, Mutation, Repair, Sampling
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.cell_paths import Path, flat_ids
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class PathSampling(Sampling):
    """A sampling that draws one path at a time."""

    works_on: ClassVar[str] = "cells"

    tries: Count = 100
    """Failures in a row after which no more individuals are looked for."""

    @abstractmethod
    def sample_one(self, problem: PathProblem, rng: np.random.Generator) -> Path | None:
        """Return a path (k, 2) from start to goal, or ``None`` for a failure."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        paths: list[NDArray[Any]] = []
        failed = 0
        while len(paths) < n and failed < self.tries:
            drawn = self.sample_one(it, rng)
            if drawn is not None and legal([drawn], it, self)[0]:
                paths.append(without_repeats(drawn))
                failed = 0
            else:
                count("samples failed")
                failed += 1
        return it.representation.encode(paths)


@dataclass(frozen=True, kw_only=True)
class PathCrossover(Crossover):
    """A crossover of one pair at a time."""

    works_on: ClassVar[str] = "cells"

    @abstractmethod
    def cross_one(
        self, mother: Path, father: Path, problem: PathProblem, rng: np.random.Generator
    ) -> tuple[Path, Path]:
        """Return two children of two paths (k, 2); return a parent for "no child"."""

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        decode = it.representation.decode
        children: dict[int, NDArray[Any]] = {}
        for x, y in pairs.tolist():
            children[x], children[y] = self.cross_one(decode(population[x]), decode(population[y]), it, rng)
        return _with(population, children, it, self, "crossover failed")


@dataclass(frozen=True, kw_only=True)
class PathMutation(Mutation):
    """A mutation of one path at a time."""

    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    @abstractmethod
    def mutate(self, path: Path, problem: PathProblem, rng: np.random.Generator) -> Path:
        """Return a changed copy of a path (k, 2), or the path itself for "no change"."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        children = {int(k): self.mutate(it.representation.decode(population[k]), it, rng) for k in chosen}
        return _with(population, children, it, self, "mutation failed")


@dataclass(frozen=True, kw_only=True)
class PathRepair(Repair):
    """A repair, or refinement, of one path at a time."""

    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    @abstractmethod
    def repair(self, path: Path, problem: PathProblem, rng: np.random.Generator) -> Path | None:
        """Return a better path (k, 2), the path itself, or ``None`` where there is nothing to be done."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        repaired = {}
        for k, row in enumerate(population):
            path = self.repair(it.representation.decode(row), it, rng)
            if path is not None:
                repaired[k] = path
        return _with(population, repaired, it, self, "repair failed")


@dataclass(frozen=True, kw_only=True)
class PathObjective(Objective):
    """An objective of one path at a time."""

    works_on: ClassVar[str] = "cells"

    @abstractmethod
    def measure_one(self, path: Path, problem: PathProblem) -> float:
        """Return the value of a path (k, 2), to be minimised."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem)
        return np.array([self.measure_one(it.representation.decode(row), it) for row in population], np.float64)


def path_problem(problem: Problem) -> PathProblem:
    """Return the problem, which is one of paths: the planner has seen to that before the first step."""
    assert isinstance(problem, PathProblem), "operators on cells are only composed for path problems"
    return problem


def without_repeats(path: NDArray[Any]) -> NDArray[Any]:
    """Return the path with cells that directly follow themselves named once."""
    if len(path) < 2:
        return path
    return path[np.concatenate(([True], (path[1:] != path[:-1]).any(axis=1)))]


def legal(paths: Sequence[Any], problem: PathProblem, owner: Any) -> NDArray[np.bool_]:
    """Return for each path whether it leads from start to goal over free cells along free segments.

    Raises
    ------
    PluginError
        If a path is no (k, 2) array of integers.
    """
    it = problem.context
    ok = np.zeros(len(paths), np.bool_)
    first: list[NDArray[Any]] = []
    second: list[NDArray[Any]] = []
    of: list[NDArray[Any]] = []
    ends = np.array(problem.ends)
    for k, path in enumerate(paths):
        cells = np.asarray(path)
        if cells.ndim != 2 or cells.shape[1] != 2 or cells.dtype.kind not in "iu":
            wanted = "wanted a path as an int array of shape (k, 2)"
            raise PluginError(f"{owner.kind} {owner.name!r}: {wanted}; got {cells.dtype} {cells.shape}")
        if len(cells) == 0 or (cells[0] != ends[0]).any() or (cells[-1] != ends[1]).any():
            continue
        if (cells < 0).any() or (cells[:, 0] >= it.rows).any() or (cells[:, 1] >= it.cols).any():
            continue
        ids = flat_ids(cells, it.cols)
        ok[k] = True
        first.append(ids[:-1])
        second.append(ids[1:])
        of.append(np.full(len(ids) - 1, k))
    if first:
        free = compiled.segments.segments_free(
            it.blocked, it.cols, np.concatenate(first), np.concatenate(second), it.policy
        )
        ok[np.concatenate(of)[~free]] = False
    return ok


def _with(
    population: Population, changed: dict[int, NDArray[Any]], problem: PathProblem, owner: Any, event: str
) -> Population:
    """Return the population with some rows changed, where the new path is legal."""
    if not changed:
        return population
    ok = legal(list(changed.values()), problem, owner)
    count(event, int((~ok).sum()))
    good = {k: without_repeats(np.asarray(p)) for (k, p), fine in zip(changed.items(), ok, strict=True) if fine}
    width = max([population.shape[1], *(len(p) for p in good.values())])
    out = np.full((len(population), width), -1, np.int32)
    out[:, : population.shape[1]] = population
    for k, path in good.items():
        out[k] = -1
        out[k, : len(path)] = flat_ids(path, problem.context.cols)
    return out
