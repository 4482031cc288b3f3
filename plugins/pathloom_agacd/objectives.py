"""Section 4.4: smoothness and safety. The length, eq. (9), is the kernel's own."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Floats, NonNegative, Population, Positive, Problem
from pathloom.paths.objectives import ObstaclesBeside, TurnAngle
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class TurnAngleSum(TurnAngle):
    """Smoothness, eq. (10): the sum of all angles by which the path turns, in radians.

    Eq. (13) prints its second case garbled; equal finite slopes must be meant.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.4, eqs. (10)-(17)"

    reading: Literal["vectors", "slopes"] = "vectors"
    """``slopes``: as printed, whatever goes on along the same line has not turned, be it straight back;
    ``vectors``: going straight back is a turn of π."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        angles = super().measure(population, problem)
        if self.reading == "vectors":
            return angles
        return angles - np.pi * _reversals(population, path_problem(problem).context.cols)


def _reversals(population: Population, cols: int) -> Floats:
    """Return how often each path goes straight back."""
    row, col = np.divmod(population.astype(np.int64), cols)
    dr, dc = np.diff(row), np.diff(col)
    cross = dr[:, :-1] * dc[:, 1:] - dc[:, :-1] * dr[:, 1:]
    dot = dr[:, :-1] * dr[:, 1:] + dc[:, :-1] * dc[:, 1:]
    back = (cross == 0) & (dot < 0) & (population[:, 2:] >= 0)
    return np.asarray(back.sum(axis=1), np.float64)


@dataclass(frozen=True, kw_only=True)
class NeighbourPenaltyOnce(ObstaclesBeside):
    """Safety, eqs. (18)-(20): 1, and 0.1 for each obstacle among the 8 neighbours of the path's points, but once.

    Points alone count, so that a path becomes safer by points that are deleted,
    even where the straight segment then runs along the same obstacles.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.4, eqs. (18)-(20)"

    base: NonNegative = 1.0
    each: Positive = 0.1
