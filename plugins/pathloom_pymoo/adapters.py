"""The other direction: pathloom's problems and operators for people with their own pymoo code.

Everything here is an ordinary part of pymoo: a ``Problem``, a ``Sampling``, a
``Crossover``, a ``Mutation``, a ``Repair`` and a ``DuplicateElimination``, to be
handed to any of its genetic algorithms. Individuals are paths as rows of flat
cell ids, padded with −1.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pymoo.core.crossover
import pymoo.core.duplicate
import pymoo.core.mutation
import pymoo.core.problem
import pymoo.core.repair
import pymoo.core.sampling
from numpy.typing import NDArray

import pathloom as pl
from pathloom.kernel.compose import build
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.evaluation import measure
from pathloom.kernel.registry import default_registry
from pathloom.paths.constraints import parse_constraint

Cells = NDArray[np.int32]


class PathsProblem(pymoo.core.problem.Problem):  # type: ignore[misc]
    """A path problem with objectives, for pymoo.

    Parameters
    ----------
    problem
        Map, start, goal and corner policy.
    objectives
        Objectives, or their names.
    constraints
        Constraints, or texts as ``length <= 1.2 x optimum``.
    width
        Room for the cells of a path. By default 8 (height + width); operators
        leave an individual as it is where a longer path would come out.
    """

    def __init__(
        self,
        problem: pl.PathProblem,
        objectives: Sequence[pl.Objective | str],
        constraints: Sequence[Constraint | str] = (),
        width: int | None = None,
    ) -> None:
        self.path_problem = problem
        self.objectives = [_component(pl.Objective, one) for one in objectives]
        self.constraints = [parse_constraint(one) if isinstance(one, str) else one for one in constraints]
        it = problem.context
        cells = it.rows * it.cols
        super().__init__(
            n_var=width or min(cells, 8 * (it.rows + it.cols)), n_obj=len(self.objectives),
            n_ieq_constr=len(self.constraints), xl=-1, xu=cells - 1, vtype=int,
        )  # fmt: skip

    def _evaluate(self, X: NDArray[Any], out: dict[str, Any], *_: Any, **__: Any) -> None:
        population = X.astype(np.int32)
        out["F"] = measure(self.objectives, population, self.path_problem)
        if self.constraints:
            broken = [one.violation(population, self.path_problem) for one in self.constraints]
            out["G"] = np.stack(broken, axis=1)


class PathSampling(pymoo.core.sampling.Sampling):  # type: ignore[misc]
    """A sampling of pathloom, by itself, by name or as a table with ``use``."""

    def __init__(self, sampling: pl.Sampling | str | Mapping[str, Any]) -> None:
        super().__init__()
        self.component = _component(pl.Sampling, sampling)

    def _do(self, problem: PathsProblem, n_samples: int, *_: Any, random_state: Any = None, **__: Any) -> Cells:
        population = self.component.sample(problem.path_problem, n_samples, random_state)
        fits = (population[:, problem.n_var :] < 0).all(axis=1)
        return _padded(population[fits], problem.n_var)


class PathCrossover(pymoo.core.crossover.Crossover):  # type: ignore[misc]
    """A crossover of pathloom; ``prob`` is its rate unless another one is given."""

    def __init__(self, crossover: pl.Crossover | str | Mapping[str, Any], prob: float | None = None) -> None:
        self.component = _component(pl.Crossover, crossover)
        super().__init__(2, 2, prob=self.component.rate if prob is None else prob)

    def _do(self, problem: PathsProblem, X: NDArray[Any], *_: Any, random_state: Any = None, **__: Any) -> Cells:
        matings = X.shape[1]
        parents = _compact(X.swapaxes(0, 1).reshape(2 * matings, -1))
        pairs = np.arange(2 * matings).reshape(-1, 2)
        children = self.component.cross(parents, pairs, problem.path_problem, random_state)
        return _or_before(children, parents, problem.n_var).reshape(matings, 2, -1).swapaxes(0, 1)


class PathMutation(pymoo.core.mutation.Mutation):  # type: ignore[misc]
    """A mutation of pathloom; ``prob`` is its rate unless another one is given."""

    def __init__(self, mutation: pl.Mutation | str | Mapping[str, Any], prob: float | None = None) -> None:
        self.component = _component(pl.Mutation, mutation)
        super().__init__(prob=self.component.rate if prob is None else prob)

    def _do(self, problem: PathsProblem, X: NDArray[Any], *_: Any, random_state: Any = None, **__: Any) -> Cells:
        population = _compact(X)
        mutants = self.component.apply(population, np.arange(len(X)), problem.path_problem, random_state)
        return _or_before(mutants, population, problem.n_var)


class PathRepair(pymoo.core.repair.Repair):  # type: ignore[misc]
    """A repair of pathloom."""

    def __init__(self, repair: pl.Repair | str | Mapping[str, Any]) -> None:
        super().__init__()
        self.component = _component(pl.Repair, repair)

    def _do(self, problem: PathsProblem, X: NDArray[Any], *_: Any, random_state: Any = None, **__: Any) -> Cells:
        population = _compact(X)
        repaired = self.component.apply(population, problem.path_problem, random_state)
        return _or_before(repaired, population, problem.n_var)


class NoDuplicatePaths(pymoo.core.duplicate.DuplicateElimination):  # type: ignore[misc]
    """Drop paths that are there already, told by their bytes.

    pymoo's default compares all pairs, in nearly all of the time that a generation
    takes; its ``HashDuplicateElimination`` with its default function drops nothing.
    """

    def _do(self, pop: Any, other: Any, is_duplicate: NDArray[np.bool_]) -> NDArray[np.bool_]:
        seen = set() if other is None else {individual.X.tobytes() for individual in other}
        for k, individual in enumerate(pop):
            key = individual.X.tobytes()
            is_duplicate[k] = key in seen
            seen.add(key)
        return is_duplicate


def _component(kind: type[Any], value: Any) -> Any:
    """Return a component that is given by itself, by name or as a table."""
    return build(kind, value, default_registry(), kind.kind)


def _compact(X: NDArray[Any]) -> Cells:
    """Return a population as pathloom's operators take it."""
    return np.ascontiguousarray(X, np.int32)


def _padded(population: Cells, width: int) -> Cells:
    """Return the population in an array of this width."""
    out = np.full((len(population), width), -1, np.int32)
    out[:, : population.shape[1]] = population[:, :width]
    return out


def _or_before(population: Cells, before: Cells, width: int) -> Cells:
    """Return the population in an array of this width, with the row of before where the new path has no room."""
    fits = np.asarray((population[:, width:] < 0).all(axis=1))
    return np.where(fits[:, np.newaxis], _padded(population, width), before)
