"""Section 5.5.1: what makes a step desirable."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Floats, Heuristic, PathProblem
from pathloom.paths.context import STEPS


@dataclass(frozen=True, kw_only=True)
class EdgeLength(Heuristic):
    """η = 1 / d_ij, eq. (30) to the letter: the shorter the step, the better.

    On a grid this knows two values. With β = 7 a step along an axis is taken 11
    times as often as the diagonal, and the goal draws nobody; the planner goes by
    ``goal-distance`` instead. The constant Q in eq. (30) cancels in eq. (29).
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.5.1, eq. (30)"

    def desirability(self, problem: PathProblem) -> Floats:
        return np.tile([1.0 / np.hypot(dr, dc) for dr, dc in STEPS], (problem.context.blocked.size, 1))
