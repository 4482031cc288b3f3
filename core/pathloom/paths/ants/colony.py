"""Colony: ants that walk from start to goal and leave pheromone for those that come after them.

    initial pheromone → [ march → evaluation → pheromone update → deadlock ] until termination

A paper's ant colony is this one with its slots filled.
"""

import time
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Count, NonNegative
from pathloom.kernel.counting import count, counting, total
from pathloom.kernel.evaluation import Floats, Terms
from pathloom.kernel.problem import Problem
from pathloom.kernel.search import Search
from pathloom.kernel.state import Deme, State, generator
from pathloom.paths.ants.ant_system import AntSystem, GoalDistance, Retreat, Uniform
from pathloom.paths.ants.pheromone import ColonyState, Deadlock, Heuristic, InitialPheromone, PheromoneUpdate
from pathloom.paths.objectives import Length
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class Colony(Search):
    """The generic ant colony.

    Each ant goes from cell to cell along legal steps, to none twice, with
    probability P_ij = τ_ij^α η_ij^β / Σ τ_il^α η_il^β. The first march is
    generation 0, as the first population of an evolution is.
    """

    name: ClassVar[str] = "colony"

    ants: Count = 50
    """Number of ants in each iteration."""
    alpha: NonNegative = 1.0
    """α, how much pheromone counts."""
    beta: NonNegative = 5.0
    """β, how much the heuristic counts."""
    objectives: Terms = Terms({"length": Length()})
    heuristic: Heuristic = GoalDistance()
    """η, what makes a step desirable."""
    initial: InitialPheromone = Uniform()
    """τ, as the first ants find it."""
    pheromone: PheromoneUpdate = AntSystem()
    """Evaporation and deposit."""
    deadlock: Deadlock = Retreat()
    """What becomes of an ant that finds no cell to go to."""

    def start(self, problem: Problem, rng: np.random.Generator) -> ColonyState:
        nobody = Deme(np.empty((0, 1), np.int32), np.empty((0, len(self.objectives))), np.empty(0))
        return self.start_from(nobody, problem, rng)

    def start_from(self, known: Deme, problem: Problem, rng: np.random.Generator) -> ColonyState:
        """Return the first state of a colony that is told of paths which somebody found before, if it cares.

        ``known``: those paths, best first by whatever he went by, with the colony's own fitness.
        """
        self.check_representation(problem)
        began = time.perf_counter()
        it = path_problem(problem)
        before = ColonyState(
            problem,
            rng.bit_generator.state,
            pheromone=self.initial.lay(self, it, known),
            desire=self._desire(it),
            table=np.zeros(it.context.blocked.size, np.int32),
        )
        return self._marched(before, 0, rng, began)

    def step(self, state: State) -> ColonyState:
        assert isinstance(state, ColonyState), "a state of this planner"
        began = time.perf_counter()
        return self._marched(state, state.generation + 1, generator(state.random), began)

    def nothing(self, state: State) -> str:
        return f"none of {state.counts.get('ants lost', 0)} ants arrived: each came to a cell with no way on"

    def _desire(self, problem: PathProblem) -> Floats:
        """Return η^β, as a share of the largest finite one at its cell, by which no probability is changed."""
        legal = (problem.context.moves[:, np.newaxis] >> np.arange(8, dtype=np.uint8) & 1).astype(bool)
        eta = np.where(legal, self.heuristic.desirability(problem), 0.0)
        largest = np.where(np.isfinite(eta), eta, 0.0).max(axis=1, keepdims=True)
        largest[largest <= 0.0] = 1.0
        return np.asarray((eta / largest) ** self.beta)

    def _marched(self, before: ColonyState, generation: int, rng: np.random.Generator, began: float) -> ColonyState:
        it = path_problem(before.problem).context
        with counting() as counts:
            paths, stuck = compiled.ants.march(
                self.ants, before.pheromone, before.desire, self.alpha, it.moves, self.deadlock.closed(before.table),
                it.cols, it.start, it.goal, self.deadlock.retreats, rng.bit_generator.random_raw(4),
            )  # fmt: skip
            deme = self.evaluate(paths, before.problem)
            count("ants lost", self.ants - len(deme))
            best = self.fittest(before.best, deme, generation)
            state = ColonyState(
                **self.recorded(before, deme, best, generation, rng, counts, began),
                pheromone=before.pheromone,
                desire=before.desire,
                stuck=stuck,
                table=before.table,
            )
            renewed = self.pheromone.update(state, self.progress(state))
            table, pheromone = self.deadlock.learn(state, renewed)
        spent = before.seconds + time.perf_counter() - began
        counted = total(before.counts, counts) if counts else before.counts  # those of the update among them
        return replace(state, pheromone=pheromone, table=table, counts=counted, seconds=spent)
