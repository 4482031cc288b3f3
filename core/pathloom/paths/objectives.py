"""The kernel's own objectives on paths. All are minimised."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import compiled
from pathloom.kernel.component import NonNegative, Positive
from pathloom.kernel.evaluation import Floats, Objective
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.additive import STEP_LENGTHS, Prices, price_of_turns
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class Length(Objective):
    """Euclidean length, in cells."""

    works_on: ClassVar[str] = "cells"

    def measure(self, population: Population, problem: Problem) -> Floats:
        return np.asarray(compiled.measures.lengths(population, path_problem(problem).context.cols))

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices(step=STEP_LENGTHS)


@dataclass(frozen=True, kw_only=True)
class UnsafeCells(Objective):
    """Number of cells with an obstacle among their 8 neighbours whose inside the path crosses, ends included."""

    works_on: ClassVar[str] = "cells"

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem).context
        return np.asarray(compiled.measures.flagged_cells(population, it.unsafe, it.cols))

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices.of_visiting(problem.context.unsafe, problem)


@dataclass(frozen=True, kw_only=True)
class ObstaclesBeside(Objective):
    """Number of distinct obstacles among the 8 neighbours of the path, each charged once; ends included.

    Not additive: what a cell costs depends on the cells before.
    """

    works_on: ClassVar[str] = "cells"

    base: NonNegative = 0.0
    """What a path costs that passes no obstacle."""
    each: Positive = 1.0
    """What each obstacle adds."""
    of: Literal["nodes", "cells"] = "nodes"
    """Whose neighbours count: those of the path's nodes, or of every cell whose inside it crosses."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem).context
        if self.of == "cells":
            population = compiled.reshaping.cell_by_cell(population, it.cols)
        found = compiled.measures.obstacles_beside(population, it.beside, it.cols)
        return np.asarray(self.base + self.each * found)


@dataclass(frozen=True, kw_only=True)
class Turns(Objective):
    """Number of changes of direction, compared as exact integer directions."""

    works_on: ClassVar[str] = "cells"

    def measure(self, population: Population, problem: Problem) -> Floats:
        return np.asarray(compiled.measures.turns(population, path_problem(problem).context.cols)[:, 0])

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices(turn=price_of_turns(lambda paths, cols: compiled.measures.turns(paths, cols)[:, 0]))


@dataclass(frozen=True, kw_only=True)
class TurnAngle(Objective):
    """Sum of all changes of direction, in radians; going straight back is π."""

    works_on: ClassVar[str] = "cells"

    def measure(self, population: Population, problem: Problem) -> Floats:
        return np.asarray(compiled.measures.turns(population, path_problem(problem).context.cols)[:, 1])

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices(turn=price_of_turns(lambda paths, cols: compiled.measures.turns(paths, cols)[:, 1]))


@dataclass(frozen=True, kw_only=True)
class Clearance(Objective):
    """Minus the least distance from the path to an obstacle cell's border, in cells.

    On a map without obstacles it is minus the length of the map's diagonal.
    """

    works_on: ClassVar[str] = "cells"
    negated: ClassVar[bool] = True

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem).context
        found = compiled.measures.clearances(population, it.blocked, it.distance, it.rows, it.cols)
        return np.asarray(-np.minimum(found, np.hypot(it.rows, it.cols)))
