"""Planners that search with real vectors, each of which stands for a path.

    first vectors → evaluation → [ move, with as many evaluations as it takes ] until termination

A method is a rule of motion and a way to read vectors as paths.
"""

import time
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError
from pathloom.kernel.component import Count
from pathloom.kernel.counting import count, counting
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.operators import Indices
from pathloom.kernel.planner import Outcome, Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.kernel.search import Search
from pathloom.kernel.state import Deme, Individual, State, generator
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True)
class Vectors:
    """Vectors, the paths that they stand for, and what these are worth.

    They are compared by Deb's rules (2000): a feasible one is better than an
    infeasible one, of two infeasible ones that with the smaller violation, of two
    feasible ones the fitter.
    """

    genes: Floats
    """(n, d), whatever they mean to the planner."""
    paths: Population
    """(n, width), which may collide."""
    values: Floats
    """(n, m), of the objectives."""
    violations: Floats
    """(n,), 0 for what counts as feasible."""
    fitness: Floats
    """(n,), to be maximised; minus the violation of those that are infeasible."""
    costs: Floats
    """(n,), to be minimised, in one number: weighted sum of the objectives plus penalty."""

    def __len__(self) -> int:
        """Return the number of vectors."""
        return len(self.costs)

    def better(self, than: "Vectors") -> NDArray[np.bool_]:
        """Return of each vector whether it is better than its counterpart, or than the one that there is."""
        same = self.violations == than.violations
        return np.asarray((self.violations < than.violations) | (same & (self.fitness > than.fitness)))

    def order(self) -> Indices:
        """Return the rows (n,) from the best to the worst, equal ones as they stand."""
        return np.lexsort((-self.fitness, self.violations))

    def best(self) -> int:
        """Return the row of the best; the first of several."""
        least = self.violations.min()
        return int(np.argmax(np.where(self.violations == least, self.fitness, -np.inf)))

    def at(self, rows: Any) -> "Vectors":
        """Return those of some rows."""
        return Vectors(
            self.genes[rows], self.paths[rows], self.values[rows],
            self.violations[rows], self.fitness[rows], self.costs[rows],
        )  # fmt: skip

    def replaced(self, where: NDArray[np.bool_], by: "Vectors") -> "Vectors":
        """Return them with some (n,) replaced by their counterparts."""
        column = where[:, np.newaxis]
        return Vectors(
            np.where(column, by.genes, self.genes),
            np.where(column, by.paths, self.paths),
            np.where(column, by.values, self.values),
            np.where(where, by.violations, self.violations),
            np.where(where, by.fitness, self.fitness),
            np.where(where, by.costs, self.costs),
        )

    def joined(self, others: "Vectors") -> "Vectors":
        """Return them and others."""
        pairs = ((getattr(self, name), getattr(others, name)) for name in self.__dataclass_fields__)
        return Vectors(*map(np.concatenate, pairs))


@dataclass(frozen=True, kw_only=True)
class VectorState(State):
    """Where a planner that searches with vectors stands."""

    vectors: Vectors
    """The individuals."""
    top: Vectors
    """The best of all that were ever valued (1 row)."""
    legal: Vectors | None = None
    """The best of those whose path is legal (1 row), if there was one."""
    memory: Any = None
    """What else the method remembers: plain data."""


class Judge:
    """Values vectors for one step of a planner, and remembers the best of all, those before the step included."""

    def __init__(
        self, planner: "VectorPlanner", problem: PathProblem, top: Vectors | None = None, legal: Vectors | None = None
    ) -> None:
        self.planner, self.problem = planner, problem
        self.top, self.legal = top, legal

    def __call__(self, genes: Floats) -> Vectors:
        """Return the vectors of genes (n, d) with their paths and what these are worth."""
        count("evaluations", len(genes))
        vectors, legal = self.planner.evaluate_genes(genes, self.problem)
        if len(vectors) == 0:
            return vectors
        best = vectors.best()
        self.top = _best_of(self.top, vectors, best)
        if not legal[best] and legal.any():  # by a rule that takes some illegal paths for feasible
            rows = np.flatnonzero(legal)
            best = rows[vectors.at(rows).best()]
        if legal[best]:
            self.legal = _best_of(self.legal, vectors, best)
        return vectors


@dataclass(frozen=True, kw_only=True)
class VectorPlanner(Planner, ABC):
    """A planner that moves a population of real vectors."""

    population: Count = 100
    """Number of vectors."""

    @abstractmethod
    def first_genes(self, problem: PathProblem, rng: np.random.Generator) -> Floats:
        """Return the genes (n, d) with which the search begins."""

    @abstractmethod
    def evaluate_genes(self, genes: Floats, problem: PathProblem) -> tuple[Vectors, NDArray[np.bool_]]:
        """Return the vectors of genes (n, d) with what they are worth, and of each whether its path is legal."""

    @abstractmethod
    def move(self, state: VectorState, judge: Judge, rng: np.random.Generator) -> tuple[Vectors, Any]:
        """Return the vectors and the memory after one more iteration; ``judge`` values genes (n, d)."""

    def remember(self, vectors: Vectors) -> Any:
        """Return the memory with which the first iteration begins."""
        return None

    def start(self, problem: Problem, rng: np.random.Generator) -> VectorState:
        if not isinstance(problem, PathProblem):
            raise ConfigError(f"planner {self.name!r} plans paths; got a problem of kind {problem.name!r}")
        began = time.perf_counter()
        with counting() as counts:
            judge = Judge(self, problem)
            vectors = judge(self.first_genes(problem, rng))
            before = State(problem, rng.bit_generator.state)
            return self._reached(before, 0, vectors, self.remember(vectors), judge, rng, counts, began)

    def step(self, state: State) -> VectorState:
        assert isinstance(state, VectorState), "a state of this planner"
        began = time.perf_counter()
        rng = generator(state.random)
        with counting() as counts:
            judge = Judge(self, path_problem(state.problem), state.top, state.legal)
            vectors, memory = self.move(state, judge, rng)
            return self._reached(state, state.generation + 1, vectors, memory, judge, rng, counts, began)

    def result(self, state: State) -> Outcome:
        if state.answer is None:
            return Outcome(None, reason=self.nothing(state))
        return Outcome(state.answer.row, state.answer)

    def nothing(self, state: State) -> str:
        """Say why there is no answer."""
        return f"no feasible vector among {state.evaluations} evaluations"

    def _reached(
        self, before: State, generation: int, vectors: Vectors, memory: Any, judge: Judge,
        rng: np.random.Generator, counts: dict[str, int], began: float,
    ) -> VectorState:  # fmt: skip
        was = before if isinstance(before, VectorState) else None
        best, answer = before.best, before.answer
        if was is None or judge.top is not was.top:
            assert judge.top is not None, "there is at least one vector"
            best = _individual(judge.top, generation)
        if judge.legal is not None and (was is None or judge.legal is not was.legal):
            answer = _individual(judge.legal, generation)
        deme = Deme(vectors.paths, vectors.values, vectors.fitness)
        fields = Search.recorded(before, deme, best, generation, rng, counts, began) | {"answer": answer}
        return VectorState(**fields, vectors=vectors, top=judge.top, legal=judge.legal, memory=memory)


def _best_of(kept: Vectors | None, vectors: Vectors, row: int) -> Vectors:
    """Return the better of a kept vector and one row of some others."""
    one = vectors.at(slice(row, row + 1))
    return one if kept is None or one.better(kept)[0] else kept


def _individual(vector: Vectors, generation: int) -> Individual:
    return Individual(vector.paths[0], vector.values[0], float(vector.fitness[0]), generation)
