"""Evolution: the generic evolutionary planner, a set of slots and the order in which they act.

    sampling → evaluation → [ selection → pairing → crossover → mutation → repair
             → evaluation → survival → migration ] until termination → refinement

A paper's planner is this one with its slots filled. New control flow is a
component of kind *control* or *migration*, never a branch in this loop.
"""

import time
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from pathloom.errors import ConfigError
from pathloom.kernel.archive import Archive
from pathloom.kernel.component import Component, Count
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.operators import (
    Crossover,
    Indices,
    Migration,
    Mutation,
    Pairing,
    Repair,
    Sampling,
    Selection,
    Survival,
)
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.kernel.search import Search
from pathloom.kernel.selection import RandomPairs, Roulette
from pathloom.kernel.state import Deme, State, generator
from pathloom.kernel.survival import Replacement
from pathloom.kernel.variation import Variation


@dataclass(frozen=True, kw_only=True)
class Control(Component, ABC):
    """How one population becomes its next generation out of the planner's operators."""

    kind: ClassVar[str] = "control"

    @abstractmethod
    def advance(self, planner: "Evolution", state: State, which: int, rng: np.random.Generator) -> Deme:
        """Return the next generation of the population ``state.demes[which]``.

        ``planner`` holds the operators, and `Evolution.vary` and
        `Evolution.evaluate` put them to work.
        """


@dataclass(frozen=True, kw_only=True)
class Generational(Control):
    """Select, vary, evaluate, survive: once a generation."""

    def advance(self, planner: "Evolution", state: State, which: int, rng: np.random.Generator) -> Deme:
        deme, problem = state.demes[which], state.problem
        parents = planner.selection.select(deme.fitness, len(deme), rng)
        progress = planner.progress(state)
        children = planner.vary(deme.population.take(parents, 0), deme.fitness.take(parents), problem, progress, rng)
        return planner.survival.survive(deme, planner.evaluate(children, problem), problem, rng)


@dataclass(frozen=True, kw_only=True)
class Evolution(Search):
    """The generic evolutionary planner."""

    name: ClassVar[str] = "evolution"

    population: Count = 100
    """Number of individuals in each population."""
    sampling: Sampling
    """Makes the first population."""
    selection: Selection = Roulette()
    """Chooses the parents."""
    pairing: Pairing = RandomPairs()
    """Puts them in pairs."""
    crossover: Crossover | None = None
    """Mixes the pairs."""
    mutation: Mutation | None = None
    """Changes single individuals."""
    repair: Repair | None = None
    """Mends or improves every individual of every generation."""
    survival: Survival = Replacement()
    """Decides who makes up the next generation."""
    control: Control = Generational()
    """The order of the operators within a generation."""
    migration: Migration | None = None
    """Exchange between several populations."""
    archive: Archive | None = None
    """Keeps the answer; empty: the fittest individual ever seen is the answer."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_requirements(self.sampling, self.crossover, self.mutation, self.repair)

    def start(self, problem: Problem, rng: np.random.Generator) -> State:
        self.check_representation(problem)
        began = time.perf_counter()
        with counting() as counts:
            demes = []
            sampling = self.sampling.serving(self.weighed(problem))
            for _ in range(self.migration.demes if self.migration else 1):
                population = sampling.sample(problem, self.population, rng)
                demes.append(self.evaluate(population, problem))
            return self._reached(State(problem, rng.bit_generator.state), tuple(demes), 0, rng, counts, began)

    def step(self, state: State) -> State:
        began = time.perf_counter()
        rng = generator(state.random)
        with counting() as counts:
            demes = tuple(self.control.advance(self, state, which, rng) for which in range(len(state.demes)))
            if self.migration is not None:
                demes = self.migration.exchange(demes, state, rng)
            return self._reached(state, demes, state.generation + 1, rng, counts, began)

    def done(self, state: State) -> bool:
        return any(len(deme) == 0 for deme in state.demes) or super().done(state)

    def nothing(self, state: State) -> str:
        return f"{self.sampling.name!r} found no first individual in {state.counts.get('samples failed', 0)} tries"

    def vary(
        self,
        population: Population,
        fitness: Floats,
        problem: Problem,
        progress: float,
        rng: np.random.Generator,
    ) -> Population:
        """Return the offspring of selected parents; ``fitness`` (n,) is the parents'."""
        return self._variation.offspring(
            population, fitness, lambda: self.pairing.pair(fitness, rng), problem, progress, rng
        )

    @cached_property
    def _variation(self) -> Variation:
        return Variation(self.crossover, self.mutation, self.repair).serving(self.objectives)

    def _reached(
        self, before: State, demes: tuple[Deme, ...], generation: int, rng: np.random.Generator,
        counts: dict[str, int], began: float,
    ) -> State:  # fmt: skip
        best, answer = before.best, before.answer
        for index, deme in enumerate(demes):
            best = self.fittest(best, deme, generation)
            if self.archive is not None and len(deme):
                new = self._newcomers(deme, before.demes[index] if before.demes else None, before.problem)
                answer = self.archive.update(answer, deme, new, generation, before.problem, self.refinement, rng)
        state = self.recorded(before, demes[0], best, generation, rng, counts, began)
        state |= {"demes": demes, "answer": best if self.archive is None else answer}
        return State(**state)

    @staticmethod
    def _distinct(deme: Deme, problem: Problem) -> Indices:
        """Return the indices of the distinct individuals, which a deme put together by a migration does not know."""
        return problem.representation.distinct(deme.population)[0] if deme.distinct is None else deme.distinct

    def _newcomers(self, deme: Deme, before: Deme | None, problem: Problem) -> Indices:
        """Return the indices of the distinct individuals that the generation before did not have."""
        distinct = self._distinct(deme, problem)
        if before is None:
            return distinct
        was = before.population[self._distinct(before, problem)]
        return distinct[problem.representation.newcomers(deme.population[distinct], was)]


def check_requirements(sampling: Sampling, *operators: Crossover | Mutation | Repair | None) -> None:
    """Refuse operators that need what the sampling and the operators of the loop do not keep.

    Raises
    ------
    ConfigError
        Which one needs what, and which one does not leave it.
    """
    in_the_loop = [one for one in operators if one is not None]
    kept = sampling.gives - frozenset().union(*(one.breaks for one in in_the_loop))
    for component in in_the_loop:
        if missing := component.needs - kept:
            lost = [one.name for one in in_the_loop if one.breaks & missing] or [sampling.name]
            raise ConfigError(
                f"{component.kind} {component.name!r} needs {', '.join(sorted(missing))} individuals, "
                f"which {', '.join(map(repr, lost))} does not leave"
            )
