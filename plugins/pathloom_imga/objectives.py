"""Section 4.2: safety and energy. The length, eq. (5), is the kernel's own."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import msgspec
import numpy as np

from pathloom import Floats, NonNegative, Objective, Population, Problem, compiled
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class UnsafeNode(Objective):
    """S, eq. (6): a penalty for every node but the last that has an obstacle among its 8 neighbours."""

    source: ClassVar[str] = "Li et al. 2021, section 4.2, eq. (6)"
    works_on: ClassVar[str] = "cells"

    penalty: NonNegative = 5.0
    per: Literal["node", "obstacle"] = "node"
    """The text says that the value "is increased by 5": once for the node, or for each obstacle beside it."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        it = path_problem(problem).context
        table = it.unsafe if self.per == "node" else it.obstacles_near
        # eq. (6) sums to n - 1: the last node is left out
        return np.asarray(self.penalty * compiled.measures.sum_over_nodes(population, table, 0, 1))


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
