"""Section 4.2: safety and energy. The length, eq. (5), is the kernel's own."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import msgspec
import numpy as np

from pathloom import Floats, NonNegative, Objective, PathProblem, Population, Problem, compiled
from pathloom.paths.additive import HEADINGS, Prices
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class UnsafeNode(Objective):
    """S, eq. (6): a penalty for every node but the last that has an obstacle among its 8 neighbours."""

    source: ClassVar[str] = "Li et al. 2021, section 4.2, eq. (6)"
    works_on: ClassVar[str] = "cells"

    penalty: NonNegative = 5.0
    """What the value is increased by."""
    per: Literal["node", "obstacle"] = "node"
    """The text says that the value "is increased by 5": once for the node, or for each obstacle beside it."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        # eq. (6) sums to n - 1: the last node is left out
        found = compiled.measures.sum_over_nodes(population, self._table(path_problem(problem)), 0, 1)
        return np.asarray(self.penalty * found)

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices.of_leaving(self.penalty * self._table(problem), problem)

    def _table(self, problem: PathProblem) -> np.ndarray:
        it = problem.context
        return it.unsafe if self.per == "node" else it.obstacles_near


Price = Annotated[tuple[float, float, float], msgspec.Meta(description="a price for each of three classes")]


@dataclass(frozen=True, kw_only=True)
class QuadrantEnergy(Objective):
    """E, eq. (7) and fig. 3: a penalty for every turn, by the quadrant of the direction that it takes.

    The paper's quadrants suppose a goal at the upper right; here the axes point
    from start to goal, and a direction along an axis belongs to the quadrant of the
    goal if it goes that way, to the opposite one if it goes back.
    Eq. (7) sums to n, but at the last node there is no direction to take.
    """

    source: ClassVar[str] = "Li et al. 2021, section 4.2, eq. (7), fig. 3"
    works_on: ClassVar[str] = "cells"

    price: Price = (1.0, 3.0, 10.0)
    """For the quadrant of the goal, the two beside it, and the opposite one."""
    by_angle: Literal["on-an-axis", "always"] = "on-an-axis"
    """When classes are angles between direction and goal (up to 45°, up to 135°, beyond) instead of quadrants:
    where start and goal share a row or column, so that quadrants do not tell, or always."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem).context
        by_angle = it.aligned or self.by_angle == "always"
        return np.asarray(
            compiled.measures.quadrant_energy(population, it.cols, it.goal, *it.signs, np.array(self.price), by_angle)
        )

    def prices(self, problem: PathProblem) -> Prices | None:
        """Return prices of turns by their new direction, ``None`` if one is negative.

        Classes by angle depend on where the goal lies: cells that see it in the same octant make a zone.
        """
        if min(self.price) < 0.0:
            return None
        it = problem.context
        changed = 1.0 - np.eye(8)
        if not (it.aligned or self.by_angle == "always"):
            forward = HEADINGS * it.signs
            which = np.where((forward >= 0).all(axis=1), 0, np.where((forward <= 0).all(axis=1), 2, 1))
            return Prices(turn=changed * np.array(self.price)[which])
        row, col = np.divmod(np.arange(it.blocked.size), it.cols)
        to_r, to_c = it.goal // it.cols - row[:, np.newaxis], it.goal % it.cols - col[:, np.newaxis]
        cross = np.abs(HEADINGS[:, 0] * to_c - HEADINGS[:, 1] * to_r)
        dot = HEADINGS[:, 0] * to_r + HEADINGS[:, 1] * to_c
        which = np.where(dot >= cross, 0, np.where(-dot <= cross, 1, 2))  # (cells, 8)
        _, first, zone = np.unique(which @ 3 ** np.arange(8), return_index=True, return_inverse=True)
        return Prices(turn=changed * np.array(self.price)[which[first]][:, np.newaxis], zone=zone)
