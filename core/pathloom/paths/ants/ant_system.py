"""The parts of Ant System and of MAX-MIN Ant System on a grid: what ant colonies begin with."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Distance, NonNegative, Positive
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.representation import Population
from pathloom.kernel.state import Deme
from pathloom.paths.ants.pheromone import ColonyState, Deadlock, Heuristic, InitialPheromone, PheromoneUpdate
from pathloom.paths.context import STEPS
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem

DORIGO = "Dorigo, Maniezzo, Colorni 1996"
STUETZLE = "Stützle and Hoos 2000"

Least = Literal["cells", "chance"]


def beyond(problem: PathProblem) -> Floats:
    """Return the distance (cells, 8) to the goal from where each step leads."""
    it = problem.context
    row, col = np.divmod(np.arange(it.blocked.size), it.cols)
    steps = np.array(STEPS)
    dr = row[:, np.newaxis] + steps[:, 0] - it.goal // it.cols
    dc = col[:, np.newaxis] + steps[:, 1] - it.goal % it.cols
    return np.asarray(np.sqrt(dr * dr + dc * dc))


@dataclass(frozen=True, kw_only=True)
class GoalDistance(Heuristic):
    """η = 1 / (d + ε), d being the distance from the next cell to the goal."""

    source: ClassVar[str] = "common practice on grids"

    epsilon: NonNegative = 0.0
    """ε; 0: whoever stands beside the goal goes there."""

    def desirability(self, problem: PathProblem) -> Floats:
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / (beyond(problem) + self.epsilon))


@dataclass(frozen=True, kw_only=True)
class Uniform(InitialPheromone):
    """The same on every step."""

    source: ClassVar[str] = DORIGO

    level: Positive = 1.0
    """τ_0."""

    def lay(self, colony: object, problem: PathProblem, known: Deme) -> Floats:
        return np.full((problem.context.blocked.size, 8), self.level)


@dataclass(frozen=True, kw_only=True)
class AntSystem(PheromoneUpdate):
    """Every ant that arrived leaves Q · F on each step of its path: Q / L where fitness is one over the length."""

    source: ClassVar[str] = f"{DORIGO}, ant-cycle"

    q: Distance = 1.0
    """Q, in cells."""

    def deposits(self, state: ColonyState, progress: float) -> tuple[Population, Floats]:
        return state.population, self.q * state.fitness


@dataclass(frozen=True, kw_only=True)
class MaxMin(PheromoneUpdate):
    """Only the best ant leaves Q · F, and no step bears less than τ_min or more than τ_max = Q · F_best / ρ."""

    source: ClassVar[str] = STUETZLE

    q: Distance = 1.0
    """Q, in cells."""
    who: Literal["iteration", "ever"] = "iteration"
    """Whether the best of the iteration or the best so far leaves pheromone."""
    least: Least = "cells"
    """τ_min: ``cells``, τ_max over twice the number of cells; ``chance``, such that a colony which has converged
    finds its best path with a probability of 0.05."""

    def deposits(self, state: ColonyState, progress: float) -> tuple[Population, Floats]:
        best, deme = state.best, state.demes[0]
        if self.who == "ever" and best is not None:
            return best.row[np.newaxis], np.array([self.q * best.fitness])
        top = [deme.best()] if len(deme) else []
        return deme.population[top], self.q * deme.fitness[top]

    def limits(self, state: ColonyState) -> tuple[float, float]:
        return max_min_limits(state, self.q / self.rho, self.least)


def max_min_limits(state: ColonyState, scale: float, least: Least) -> tuple[float, float]:
    """Return τ_min and τ_max = scale · F, F being the fitness of the best path; no limits until there is one."""
    if state.best is None:
        return 0.0, np.inf
    most = scale * state.best.fitness
    return most * share_of_least(path_problem(state.problem), int((state.best.row >= 0).sum()) - 1, least), most


def share_of_least(problem: PathProblem, steps: int, least: Least) -> float:
    """Return τ_min / τ_max, where the best path has so many steps.

    By chance: (1 - r) / ((c - 1) r), r being the root of 0.05 of the order
    ``steps``, and c how many steps an ant can choose from: those of a cell, on
    average, but the one that it came by.
    """
    moves = problem.context.moves
    if least == "cells" or steps == 0:
        return 1.0 / (2 * len(moves))
    root = 0.05 ** (1.0 / steps)
    others = max(compiled.ants.mean_steps(moves) - 2.0, 1.0)
    return float(min((1.0 - root) / (others * root), 1.0))


@dataclass(frozen=True, kw_only=True)
class Die(Deadlock):
    """The ant dies, and its path is forgotten."""

    source: ClassVar[str] = "common practice on grids"

    @property
    def retreats(self) -> bool:
        return False


@dataclass(frozen=True, kw_only=True)
class Retreat(Deadlock):
    """The ant takes one step back, as often as it must, and does not enter the cell again on this march."""

    source: ClassVar[str] = "common practice on grids"

    @property
    def retreats(self) -> bool:
        return True
