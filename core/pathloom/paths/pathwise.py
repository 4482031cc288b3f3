"""Path-wise bases: operators written for one path at a time, in plain Python.

The loop works on whole populations; these bases take its rows apart and put
them together again, all rows at once, so that the operator's own code is what
costs. What a path-wise operator returns is checked: a path that leaves the map,
loses start or goal, or collides is dropped, its parent kept, and the failure
counted.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

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
from pathloom.paths.cell_paths import Path, cells_of
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
            # No more at once than may be wanted, whatever becomes of them.
            drawn = [self.sample_one(it, rng) for _ in range(min(n - len(paths), self.tries - failed))]
            legal = iter(_checked([path for path in drawn if path is not None], it, self).legal.tolist())
            for path in drawn:
                if path is not None and next(legal):
                    paths.append(without_repeats(np.asarray(path)))
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
        parents = iter(paths_of(population, pairs.ravel(), it))
        children: list[Any] = []
        for mother, father in zip(parents, parents, strict=True):
            children += self.cross_one(mother, father, it, rng)
        return _with(population, pairs.ravel(), children, it, self, "crossover failed")


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
        children = [self.mutate(path, it, rng) for path in paths_of(population, chosen, it)]
        return _with(population, chosen, children, it, self, "mutation failed")


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
        every = np.arange(len(population))
        found = [self.repair(path, it, rng) for path in paths_of(population, every, it)]
        changed = [k for k, path in enumerate(found) if path is not None]
        return _with(population, every[changed], [found[k] for k in changed], it, self, "repair failed")


@dataclass(frozen=True, kw_only=True)
class PathObjective(Objective):
    """An objective of one path at a time."""

    works_on: ClassVar[str] = "cells"

    @abstractmethod
    def measure_one(self, path: Path, problem: PathProblem) -> float:
        """Return the value of a path (k, 2), to be minimised."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem)
        every = paths_of(population, np.arange(len(population)), it)
        return np.array([self.measure_one(path, it) for path in every], np.float64)


def path_problem(problem: Problem) -> PathProblem:
    """Return the problem, which is one of paths: the planner has seen to that before the first step."""
    assert isinstance(problem, PathProblem), "operators on cells are only composed for path problems"
    return problem


def paths_of(population: Population, rows: Indices, problem: PathProblem) -> list[Path]:
    """Return the paths (k, 2) of some rows of a population, each an array of its own to write into."""
    chosen = population[rows]
    inside = chosen >= 0
    cells = cells_of(chosen[inside], problem.context.cols)
    ends = inside.sum(axis=1).cumsum().tolist()
    return [cells[first:last] for first, last in zip([0, *ends], ends, strict=False)]


def without_repeats(path: NDArray[Any]) -> NDArray[Any]:
    """Return the path with cells that directly follow themselves named once."""
    if len(path) < 2:
        return path
    return path[np.concatenate(([True], (path[1:] != path[:-1]).any(axis=1)))]


class _Checked(NamedTuple):
    """Paths, one behind the other, and which of them lead from start to goal over free segments."""

    ids: NDArray[np.int32]
    """(k,), the flat ids of all their cells."""
    of: NDArray[np.intp]
    """(k,), which path each cell belongs to."""
    legal: NDArray[np.bool_]
    """(n,)."""


def _checked(paths: Sequence[Any], problem: PathProblem, owner: Any) -> _Checked:
    """Return the cells of n paths, and for each path whether it leads from start to goal over free segments.

    Raises
    ------
    PluginError
        If a path is no (k, 2) array of integers.
    """
    it = problem.context
    arrays = [_cells(path, owner) for path in paths]
    lengths = np.array([len(path) for path in arrays], np.intp)
    of = np.arange(len(arrays)).repeat(lengths)
    if len(of) == 0:
        return _Checked(np.empty(0, np.int32), of, np.zeros(len(arrays), np.bool_))
    rows, cols = np.concatenate(arrays).T
    ids = (rows * it.cols + cols).astype(np.int32)
    on_the_map = (rows >= 0) & (rows < it.rows) & (cols >= 0) & (cols < it.cols)
    last = lengths.cumsum() - 1  # of an empty path: the cell before it, which does not count
    legal = (lengths > 0) & (ids[last - lengths + 1 - (lengths == 0)] == it.start) & (ids[last] == it.goal)
    legal[of[~on_the_map]] = False
    tested = legal[of]
    from_, to = ids[:-1], ids[1:]
    segment = (of[1:] == of[:-1]) & tested[1:]
    free = compiled.segments.segments_free(it.blocked, it.cols, from_[segment], to[segment], it.policy)
    legal[of[1:][segment][~free]] = False
    return _Checked(ids, of, legal)


def _cells(path: Any, owner: Any) -> NDArray[np.int64]:
    """Return what an operator returned as a path, if it is one."""
    cells = path if isinstance(path, np.ndarray) else np.asarray(path)
    if cells.ndim != 2 or cells.shape[1] != 2 or cells.dtype.kind not in "iu":
        wanted = "wanted a path as an int array of shape (k, 2)"
        raise PluginError(f"{owner.kind} {owner.name!r}: {wanted}; got {cells.dtype} {cells.shape}")
    return cells.astype(np.int64, copy=False)


def _with(
    population: Population, rows: Indices, paths: Sequence[Any], problem: PathProblem, owner: Any, event: str
) -> Population:
    """Return the population with other paths in some of its rows, as far as they are legal."""
    if len(paths) == 0:
        return population
    ids, of, legal = _checked(paths, problem, owner)
    count(event, len(legal) - int(legal.sum()))
    kept = legal[of]
    kept[1:] &= (ids[1:] != ids[:-1]) | (of[1:] != of[:-1])  # cells that directly follow themselves are named once
    ids, of = ids[kept], of[kept]
    lengths = np.bincount(of, minlength=len(legal))
    place = np.arange(len(of)) - (lengths.cumsum() - lengths)[of]
    width = max(population.shape[1], int(lengths.max()))
    out = np.full((len(population), width), -1, np.int32)
    out[:, : population.shape[1]] = population
    out[rows[legal]] = -1
    out[rows[of], place] = ids
    return out
