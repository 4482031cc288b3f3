"""Swarms: vectors in [0, 1] that a decoder reads as paths, moved as birds, wolves or fish are said to move."""

from abc import ABC
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.kernel.component import NonNegative
from pathloom.kernel.evaluation import Floats, Terms, measure
from pathloom.kernel.planner import Outcome
from pathloom.kernel.problem import Problem
from pathloom.kernel.search import Search
from pathloom.kernel.state import State
from pathloom.kernel.termination import MaxGenerations, Termination
from pathloom.paths.objectives import Length
from pathloom.paths.problem import PathProblem
from pathloom.paths.vectors.decoding import Decoder, Waypoints, violations
from pathloom.paths.vectors.planner import VectorPlanner, Vectors, VectorState


@dataclass(frozen=True, kw_only=True)
class Swarm(VectorPlanner, Search, ABC):
    """A planner that moves vectors in [0, 1], by a rule that makes up the method: `move`."""

    decoder: Decoder = Waypoints()
    """Reads them as paths."""
    objectives: Terms = Terms({"length": Length()})
    handling: Literal["feasible-first", "occupied-nodes"] = "feasible-first"
    """``feasible-first``: Deb's rules, with the length inside obstacles plus the number of refused segments as
    violation; ``occupied-nodes``, as common programs have it: a path of which k nodes stand on obstacles costs
    height · width · k, and whatever its segments cross costs nothing. The answer is legal in either case."""
    penalty: NonNegative = 10.0
    """Times height plus width: what one unit of violation adds to the cost, where a method calculates with it."""
    spread: Literal["line", "uniform"] = "line"
    """How the first vectors are drawn: around the straight way from start to goal, or anywhere."""
    noise: NonNegative = 0.1
    """Standard deviation of the genes about the straight way."""
    termination: tuple[Termination, ...] = (MaxGenerations(limit=500),)

    def start(self, problem: Problem, rng: np.random.Generator) -> VectorState:
        self.check_representation(problem)
        return super().start(problem, rng)

    def result(self, state: State) -> Outcome:
        return Search.result(self, state)

    def nothing(self, state: State) -> str:
        return f"{super().nothing(state)}{self.decoder.limits}"

    def evaluate_genes(self, genes: Floats, problem: PathProblem) -> tuple[Vectors, NDArray[np.bool_]]:
        paths = self.decoder.decode(genes, problem)
        distinct, which = problem.representation.distinct(paths)
        different = paths[distinct]
        weights = self.weights(problem)
        values = measure([term.objective for term in self.objectives], different, problem)
        fitness, costs, wrong = self.fitness.combine(values, weights), values @ weights, violations(different, problem)
        legal = wrong == 0.0
        it = problem.context
        if self.handling == "occupied-nodes":
            inside = compiled.measures.sum_over_nodes(different, it.blocked, 0, 0)
            costs = np.where(inside > 0, it.rows * it.cols * inside, costs)
            fitness = np.where(inside > 0, 1.0 / np.maximum(costs, 1.0), fitness)
            wrong = np.zeros(len(different))
        else:
            costs = costs + self.penalty * (it.rows + it.cols) * wrong
            fitness = np.where(legal, fitness, -wrong)
        return Vectors(genes, paths, values[which], wrong[which], fitness[which], costs[which]), legal[which]

    def first_genes(self, problem: PathProblem, rng: np.random.Generator) -> Floats:
        straight = self.decoder.straight(problem)
        shape = self.population, len(straight)
        if self.spread == "uniform":
            return rng.random(shape)
        return np.clip(straight + self.noise * rng.standard_normal(shape), 0.0, 1.0)
