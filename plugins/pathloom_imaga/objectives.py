"""Section 2.2: safety, turns and energy. The length, eq. (13), is the kernel's own."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Floats, NonNegative, Objective, PathProblem, Population, Problem, compiled
from pathloom.paths.additive import Prices
from pathloom.paths.objectives import Turns
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class D4ObstacleCount(Objective):
    """S, eq. (14): the obstacles among the 4 neighbours of every node but the last, added up."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.2, eq. (14), fig. 4"
    works_on: ClassVar[str] = "cells"

    border: bool = True
    """Count the outside of the map as obstacles: section 1.1 puts a wall around it."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        table = path_problem(problem).context.neighbours(4, self.border)
        # eq. (14) sums to k - 1: the last node is left out
        return np.asarray(compiled.measures.sum_over_nodes(population, table, 0, 1))

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices.of_leaving(problem.context.neighbours(4, self.border), problem)


@dataclass(frozen=True, kw_only=True)
class TurnCount(Turns):
    """T, eq. (15): the number of changes of direction."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.2, eq. (15)"


@dataclass(frozen=True, kw_only=True)
class EnergyPerLength(Objective):
    """E, eq. (16): turns and length, weighted, per unit of length.

    The weights are printed as 1 − ω and ω. No ω in [0, 1] gives the energies of
    tables 1 and 2; (T + D) / D does, to the third decimal, and is the default.
    Not additive: it is a ratio.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.2, eq. (16)"
    works_on: ClassVar[str] = "cells"

    turn: NonNegative = 1.0
    """What a turn costs; 1 − ω in the form as printed."""
    length: NonNegative = 1.0
    """What a cell of length costs; ω in the form as printed."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem).context
        D = compiled.measures.lengths(population, it.cols)
        # a turn costs the same in every quadrant; its angle, which `turns` would work out too, is not needed
        price = np.full(3, self.turn)
        T = compiled.measures.quadrant_energy(population, it.cols, it.goal, *it.signs, price, False)
        return np.asarray(T / np.maximum(D, 1.0) + self.length)  # the least D with a turn is 2, without length D is 0
