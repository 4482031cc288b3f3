"""The loop of all multi-objective planners: whole arrays around the parts of pymoo's algorithms.

    sampling → evaluation → survival
             → [ children → evaluation → survival ] until termination

Parents and survivors are chosen as pymoo chooses them, the rest is done by components.
"""

import time
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import (
    ConfigError,
    Count,
    Crossover,
    Deme,
    Floats,
    Indices,
    Mutation,
    Objective,
    Outcome,
    Population,
    Problem,
    Repair,
    Sampling,
    State,
    Terms,
    count,
)
from pathloom.exact.aloof import Aloof
from pathloom.exact.scalarised import Scalarised
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import measure
from pathloom.kernel.evolution import check_requirements
from pathloom.kernel.front import Front, FrontPlanner
from pathloom.kernel.sampling import Mixed
from pathloom.kernel.search import Search, check_representation
from pathloom.kernel.state import Individual, generator
from pathloom.kernel.variation import Variation
from pathloom.paths.constraints import check_constraints
from pathloom.paths.exchange import SharedNode
from pathloom.paths.objectives import Length, Turns, UnsafeCells
from pathloom.paths.reroute import Reroute
from pathloom.paths.tree_seeding import PerturbedTrees
from pathloom_pymoo.archive import compromise, merged
from pathloom_pymoo.state import FrontState

Marks = Mapping[str, NDArray[Any]]


@dataclass(frozen=True, kw_only=True)
class MultiObjective(FrontPlanner):
    """A multi-objective evolutionary algorithm: pymoo chooses, pathloom's operators vary."""

    constrained: ClassVar[bool] = True
    """Whether the algorithm heeds constraints."""

    population: Count = 100
    """Number of individuals."""
    objectives: Terms = Terms({"length": Length(), "unsafe-cells": UnsafeCells(), "turns": Turns()})
    """Two to five. Weights only choose the one answer of ``plan`` among the trade-offs."""
    constraints: tuple[Constraint, ...] = ()
    """What every answer must keep to."""
    sampling: Sampling = Mixed(parts=(Aloof(rest=Scalarised()), PerturbedTrees()))
    """Makes the first population. What it minimises itself, left at its default, gives way to the objectives."""
    crossover: Crossover | None = SharedNode()
    """Mixes the pairs."""
    mutation: Mutation | None = Reroute(rate=0.3)
    """Changes single individuals."""
    repair: Repair | None = None
    """Mends or improves every child."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_objectives(self.objectives)
        check_constraints(self.constraints)
        check_requirements(self.sampling, self.crossover, self.mutation, self.repair)
        if self.constraints and not self.constrained:
            raise ConfigError(f"constraints: pymoo's {self.name} knows none; got {len(self.constraints)}")

    def start(self, problem: Problem, rng: np.random.Generator) -> FrontState:
        check_representation(self, self.objectives, problem)
        began = time.perf_counter()
        with counting() as counts:
            drawn = self.sampling.serving(self.objectives).sample(problem, self.population, rng)
            drawn = drawn.take(problem.representation.distinct(drawn)[0], 0)
            values, violation = self.evaluate(drawn, problem)
            front = Front(drawn[:0], values[:0])
            before = FrontState(problem, rng.bit_generator.state, violation=violation[:0], archive=front)
            deme = self._deme(drawn, values)
            return self._reached(before, deme, violation, deme, violation, np.arange(0), rng, counts, began)

    def step(self, state: State) -> FrontState:
        assert isinstance(state, FrontState)
        began = time.perf_counter()
        rng, problem, deme = generator(state.random), state.problem, state.demes[0]
        with counting() as counts:
            children, served = self.children(state, rng)
            values, violation = self.evaluate(children, problem)
            born = self._deme(children, values)
            kept = self.admitted(values, state)
            both = self._deme(
                problem.representation.stack(deme.population, children.take(kept, 0)),
                np.concatenate((deme.values, values.take(kept, 0))),
            )
            violations = np.concatenate((state.violation, violation.take(kept)))
            return self._reached(state, both, violations, born, violation, served, rng, counts, began)

    def vary(self, population: Population, fitness: Floats, state: FrontState, rng: np.random.Generator) -> Population:
        """Return two children for each two rows of parents (2 k, width), pair after pair; ``fitness`` (2 k,)."""
        return self._variation.offspring(
            population, fitness, lambda: np.arange(len(population)).reshape(-1, 2), state.problem,
            self.progress(state), rng,
        )  # fmt: skip

    @cached_property
    def _variation(self) -> Variation:
        return Variation(self.crossover, self.mutation, self.repair).serving(self.objectives)

    def admitted(self, values: Floats, state: FrontState) -> Indices:
        """Return which of the children (n, m) compete with the population; all of them count for the front."""
        return np.arange(len(values))

    def evaluate(self, population: Population, problem: Problem) -> tuple[Floats, Floats]:
        """Return values (n, m) and violations (n,), and count the evaluations.

        An infeasible individual, one with an infinite value, breaks everything.
        """
        count("evaluations", len(population))
        values = measure(self._measured, population, problem)
        violation = np.zeros(len(population))
        for constraint in self.constraints:
            violation += constraint.violation(population, problem)
        if not np.isfinite(values.sum()):
            violation[~np.isfinite(values).all(axis=1)] = np.inf
        return values, violation

    @abstractmethod
    def children(self, state: FrontState, rng: np.random.Generator) -> tuple[Population, Indices]:
        """Return new individuals, and the place (k,) that each is made for, where the algorithm has places."""

    @abstractmethod
    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        """Return who of parents and children survives, as the algorithm has it, what marks them, and its new memory.

        ``values`` (n, m) and ``violation`` (n,) are those of the population of
        ``state``, empty before the first generation, and then of its children;
        ``served`` are the places that these are made for. Marks are one a row.
        """

    def front(self, state: State) -> Front:
        assert isinstance(state, FrontState)
        return state.archive

    def result(self, state: State) -> Outcome:
        if state.answer is not None:
            return Outcome(state.answer.row, state.answer)
        if not isinstance(state, FrontState) or len(state.violation) == 0:
            tries = state.counts.get("samples failed", 0)
            return Outcome(None, reason=f"{self.sampling.name!r} found no first individual in {tries} tries")
        return Outcome(None, reason=f"every path breaks a constraint, the best one by {state.violation.min():.4g}")

    def fitness_of(self, row: NDArray[Any], problem: Problem) -> tuple[dict[str, float], float | None]:
        values = measure(self._measured, row[np.newaxis], problem)
        fitness = float(self._deme(row[np.newaxis], values).fitness[0])
        return dict(zip(self.objectives.labels, values[0].tolist(), strict=True)), fitness

    @cached_property
    def _measured(self) -> list[Objective]:
        return list(self.objectives.objectives())

    def fitness(self, values: Floats) -> Floats:
        """Return minus the weighted sums of values (n, m): what is reported, the algorithm does not go by it."""
        return np.asarray(-(values @ self._weights))

    @cached_property
    def _weights(self) -> Floats:
        return self.objectives.weights

    def _deme(self, population: Population, values: Floats) -> Deme:
        """Return a population with its values and fitness."""
        return Deme(population, values, self.fitness(values), np.arange(len(population)))

    def _reached(
        self, before: FrontState, both: Deme, violations: Floats, born: Deme, violation: Floats, served: Indices,
        rng: np.random.Generator, counts: dict[str, int], began: float,
    ) -> FrontState:  # fmt: skip
        """Return the state after the survival of some of ``both``; ``born`` are the ones evaluated in this step."""
        generation = before.generation + 1 if len(before.demes) else 0
        rows, marks, memory = np.arange(0), before.marks, before.memory
        if len(both):
            rows, marks, memory = self.survivors(both.values, violations, served, before, rng)
        deme = Deme(
            both.population.take(rows, 0), both.values.take(rows, 0), both.fitness.take(rows), np.arange(len(rows))
        )
        front, best, answer = before.archive, before.best, before.answer
        feasible = (violation == 0.0).nonzero()[0]
        changed = False
        if len(feasible):
            population, values = born.population.take(feasible, 0), born.values.take(feasible, 0)
            front, changed = merged(front, population, values, before.problem.representation)
        if changed:
            fitness = self.fitness(front.values)
            best = self._individual(front, int(fitness.argmax()), fitness, generation)
            answer = self._individual(front, compromise(front.values, self._weights), fitness, generation)
        state = Search.recorded(before, deme, best, generation, rng, counts, began)
        state |= {"answer": answer, "violation": violations.take(rows), "archive": front, "memory": memory}
        state |= {"marks": {name: mark.take(rows) for name, mark in marks.items()}}
        return FrontState(**state)

    @staticmethod
    def _individual(front: Front, row: int, fitness: Floats, generation: int) -> Individual:
        return Individual(front.population[row], front.values[row], float(fitness[row]), generation)


def check_objectives(objectives: Terms) -> None:
    """Refuse objectives between which there is nothing to trade off.

    Raises
    ------
    ConfigError
        What was found, and what is allowed.
    """
    if not 2 <= len(objectives) <= 5:
        found = ", ".join(objectives.labels)
        raise ConfigError(f"objectives: allowed are 2 to 5 objectives; got {len(objectives)}: {found}")
    seen: dict[Objective, str] = {}
    for term in objectives:
        if term.objective in seen:
            raise ConfigError(f"objectives: {term.label!r} is the same objective as {seen[term.objective]!r}")
        seen[term.objective] = term.label
