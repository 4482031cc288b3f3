"""The shortest way of a point in the plane, among obstacle squares: no path over cells is shorter."""

import math

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.paths.problem import PathProblem

ROUNDING = 1e-9
"""Relative allowance for rounding: lengths of ways are exact to 1e-9 half cells for each corner on them."""

Floats = NDArray[np.float64]


def taut_length(problem: PathProblem) -> float:
    """Return a lower bound of the any-angle optimum, in cells: the length of the shortest way in the plane.

    The way may bend anywhere and touch obstacles; it passes between two that
    share a corner under ``allow`` only. A path over cell centres is such a way
    (under ``strict`` one that touches nothing), so it is no shorter. Rounded down
    by `ROUNDING`. Without any way: inf.
    """
    return taut_way(problem)[0] * (1.0 - ROUNDING)


def taut_way(problem: PathProblem) -> tuple[float, Floats | None]:
    """Return the length of the shortest way in the plane, in cells, and its turns.

    The points (k, 2) are rows and columns with cell centres at integers: start,
    corners of obstacles, goal.
    """
    it = problem.context
    far, corners = compiled.taut.distances(
        it.blocked, it.cols, it.start, it.goal, it.policy, math.inf, False
    )  # fmt: skip
    length = 0.5 * float(far[it.goal])
    if not math.isfinite(length):
        return math.inf, None
    start, goal = problem.ends
    between = np.stack(np.divmod(corners, it.cols), axis=1) + 0.5
    return length, np.concatenate(([start], between, [goal])).astype(np.float64)


def taut_distances(problem: PathProblem, upper: float = math.inf) -> tuple[Floats, Floats]:
    """Return each cell's distance in the plane from the start and to the goal, in cells.

    Both are flat. Of cells over which every way is longer than ``upper`` either
    may be inf.
    """
    it = problem.context
    found = []
    for source, target in ((it.start, it.goal), (it.goal, it.start)):
        far, _ = compiled.taut.distances(it.blocked, it.cols, source, target, it.policy, 2.0 * upper, True)
        far *= 0.5
        found.append(far)
    return found[0], found[1]
