"""Sections 5.2 and 5.4: HGA-ACO, a genetic algorithm that lays the first pheromone of an ant colony."""

import time
from dataclasses import KW_ONLY, dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from pathloom import (
    Colony,
    ColonyState,
    Deme,
    Evolution,
    Fidelity,
    Outcome,
    Planner,
    Problem,
    Share,
    State,
    Termination,
    Terms,
)
from pathloom.kernel.counting import counting, total
from pathloom.kernel.state import generator
from pathloom.kernel.termination import MaxGenerations
from pathloom_hga_aco.deadlock import DeadAngleTable
from pathloom_hga_aco.pheromone import TwoBest
from pathloom_hga_aco.planner import ANTS, BIBTEX, GENETIC, SONG, GaHgaAco
from pathloom_hga_aco.seeding import GaPheromoneSeed


@dataclass(frozen=True)
class HybridState(State):
    """Where both phases stand. Population and fitness are those of the phase under way, by the colony's measure."""

    _: KW_ONLY
    genetic: State
    """The genetic algorithm's last state."""
    colony: ColonyState | None = None
    """The colony's last state; ``None`` until it sets out."""


@dataclass(frozen=True, kw_only=True)
class HgaAco(Planner):
    """HGA-ACO, the hybrid of a genetic algorithm and an ant colony.

    Generations, evaluations and history count both phases, one after the other;
    fitness is the colony's throughout, so that there is one measure.
    """

    name: ClassVar[str] = "hga-aco"
    reference: ClassVar[str] = SONG
    bibtex: ClassVar[str] = BIBTEX
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        *GENETIC,
        *ANTS,
        "The constant phi (28) is 1, and the fittest fifth of the last generation is laid; where their paths share a "
        "step the shortest counts. All other steps bear the least that the limits allow.",
        "Each of the two best paths leaves its own part of (32) on its own steps; A is the number of iterations done.",
        "The limits of the MAX-MIN ant system, which the paper names without numbers, are those of Stuetzle and Hoos.",
        "An ant that finds no way on takes a step back. Once ten ants were stuck in a cell, and none of the same march "
        "came through, it is in the dead-angle table, unless no way were left. The penalty coefficient (35) is 0.5.",
        "The answer is the shortest path of both phases.",
    )

    genetic: Evolution = GaHgaAco()
    """The first phase, until its own termination."""
    colony: Colony = Colony(
        ants=50,  # M
        alpha=1.0,
        beta=7.0,
        initial=GaPheromoneSeed(),
        pheromone=TwoBest(rho=0.3),
        deadlock=DeadAngleTable(),
        termination=(MaxGenerations(limit=100),),  # N_c
    )
    """The second phase, until its own termination."""
    answer: Literal["both", "colony"] = "both"
    """Which phases the answer may come from. Once the colony sets out, ``colony`` forgets what was found before."""
    share: Share = 0.5
    """Share of the budget in ``termination`` after which the first phase ends at the latest."""
    termination: tuple[Termination, ...] = ()
    """Conditions on both phases together, besides those of each."""

    @property
    def terms(self) -> Terms:
        return self.colony.terms

    def fitness_of(self, row: np.ndarray, problem: Problem) -> tuple[dict[str, float], float | None]:
        return self.colony.fitness_of(row, problem)

    def start(self, problem: Problem, rng: np.random.Generator) -> HybridState:
        began = time.perf_counter()
        self.colony.check_representation(problem)
        nothing = State(problem, rng.bit_generator.state, generation=-1)
        return self._reached(nothing, self.genetic.start(problem, rng), None, began)

    def step(self, state: State) -> HybridState:
        assert isinstance(state, HybridState), "a state of this planner"
        began = time.perf_counter()
        if state.colony is not None:
            return self._reached(state, state.genetic, self.colony.step(state.colony), began)
        if not self.genetic.done(state.genetic) and super().progress(state) < self.share:
            return self._reached(state, self.genetic.step(state.genetic), None, began)
        colony = self.colony.start_from(self._known(state.genetic), state.problem, generator(state.random))
        before = replace(state, best=None) if self.answer == "colony" else state
        return self._reached(before, state.genetic, colony, began)

    def done(self, state: State) -> bool:
        assert isinstance(state, HybridState), "a state of this planner"
        return super().done(state) or (state.colony is not None and self.colony.done(state.colony))

    def progress(self, state: State) -> float:
        assert isinstance(state, HybridState), "a state of this planner"
        if state.colony is None:
            phases = self.genetic.progress(state.genetic) / 2
        else:
            phases = (1.0 + self.colony.progress(state.colony)) / 2
        return max(phases, super().progress(state))

    def result(self, state: State) -> Outcome:
        assert isinstance(state, HybridState), "a state of this planner"
        if state.answer is None:
            return self.genetic.result(state.genetic) if state.colony is None else self.colony.result(state.colony)
        return self.colony.result(state)

    def _known(self, genetic: State) -> Deme:
        """Return the last generation, its fittest individuals first, by the colony's measure."""
        population, fitness = genetic.population, genetic.fitness
        for deme in genetic.demes[1:]:
            population = genetic.problem.representation.stack(population, deme.population)
            fitness = np.concatenate((fitness, deme.fitness))
        with counting():  # these paths were counted when the genetic algorithm measured them
            return self.colony.evaluate(population[np.argsort(-fitness, kind="stable")], genetic.problem)

    def _judged(self, deme: Deme, problem: Problem) -> Deme:
        """Return a population of the genetic algorithm by the colony's measure."""
        measured = list(self.genetic.objectives.objectives())
        wanted = list(self.colony.objectives.objectives())
        if not all(objective in measured for objective in wanted):
            with counting():
                return self.colony.evaluate(deme.population, problem)
        values = deme.values[:, [measured.index(objective) for objective in wanted]]
        return Deme(deme.population, values, self.colony.fitness.combine(values, self.colony.weights(problem)))

    def _reached(self, before: State, genetic: State, colony: ColonyState | None, began: float) -> HybridState:
        problem, generation = before.problem, before.generation + 1
        if colony is None:
            here, demes = genetic, tuple(self._judged(deme, problem) for deme in genetic.demes)
        else:
            here, demes = colony, colony.demes
        best = before.best
        for deme in demes:
            best = self.colony.fittest(best, deme, generation)
        fitness, history = demes[0].fitness, before.history
        evaluations = genetic.evaluations + (colony.evaluations if colony is not None else 0)
        if best is not None:
            top, mean = float(fitness.max(initial=0.0)), float(fitness.sum()) / max(len(fitness), 1)
            diversity = here.history.diversity[-1] if len(fitness) else 0.0
            history = history.extended(evaluations, best.fitness, top, mean, diversity)
        return HybridState(
            problem,
            here.random,
            generation,
            evaluations,
            demes,
            best,
            best,
            history,
            genetic.counts if colony is None else total(genetic.counts, colony.counts),
            before.seconds + time.perf_counter() - began,
            genetic=genetic,
            colony=colony,
        )
