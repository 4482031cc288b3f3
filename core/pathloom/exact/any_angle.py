"""The shortest path over the centres of free cells, at any angle.

Every free cell can be a turning point: to allow only cells beside obstacles is
up to 0.67 % too long, since a centre can rarely lie on the tangent of a corner.
"""

import math
from dataclasses import dataclass

import numpy as np

from pathloom import compiled
from pathloom.exact.octile import octile_path
from pathloom.exact.taut import ROUNDING, taut_distances
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem

WORK = 1_000_000_000
"""Cells seen before giving up: some ten seconds."""
GUESSES = (0.25, 1.0)
"""Shares of the way from the lower to the upper bound within which the optimum is looked for, in turn."""


@dataclass(frozen=True)
class Known:
    """What is known of the any-angle optimum."""

    length: float
    """Length in cells of the path; inf without one."""
    path: Path | None
    """(k, 2), the shortest path known."""
    bound: float
    """No path is shorter; the length itself where the path is proven to be the shortest."""

    @property
    def proven(self) -> bool:
        """Whether nothing is left to find out."""
        return self.bound == self.length


def any_angle_path(problem: PathProblem, *, work: int = WORK) -> tuple[float, Path | None]:
    """Return the any-angle optimum, in cells, and a path (k, 2) of that length.

    Segments obey the problem's corner policy. Exact up to the rounding of sums
    of square roots: every pruning bound is admissible, every test in integers.

    Parameters
    ----------
    work
        Limit of the search. Past it, and where there is no path, the answer is
        inf and ``None``.
    """
    found = any_angle_search(problem, work=work)
    return (found.length, found.path) if found.proven else (math.inf, None)


def any_angle_search(problem: PathProblem, *, work: int = WORK) -> Known:
    """Return the shortest path that so much work finds, and how much shorter one could be.

    Notes
    -----
    The octile optimum with points deleted gives an upper bound, the shortest way
    in the plane a lower one. A* then looks for a path within a guess between the
    two: few cells lie on ways so short. If there is none, the guess is a better
    lower bound and a longer one is tried.
    """
    it = problem.context
    if it.start == it.goal:
        return Known(0.0, np.array([problem.ends[0]], np.int64), 0.0)
    _, steps = octile_path(problem)
    if steps is None:
        return Known(math.inf, None, math.inf)
    upper, path = _shortened(problem, steps)
    before, after = taut_distances(problem, upper + math.sqrt(2.0) + 1e-6)
    taut = float(before[it.goal])
    bound = taut * (1.0 - ROUNDING)
    if bound >= upper * (1.0 - 2.0 * ROUNDING):  # in sight of each other
        return Known(upper, path, upper)
    for share in GUESSES:
        guess = upper + ROUNDING if share == 1.0 else taut + share * (upper - taut)
        cells, least, done = compiled.any_angle.any_angle_path(
            it.blocked, it.cols, it.start, it.goal, it.policy, before, after, guess, work
        )
        if len(cells):
            length = float(compiled.measures.lengths(cells[np.newaxis], it.cols)[0])
            return Known(length, problem.representation.decode(cells), length)
        bound = max(bound, least * (1.0 - ROUNDING))
        work -= done
        if work < 0:
            break
    return Known(upper, path, bound)


def _shortened(problem: PathProblem, path: Path) -> tuple[float, Path]:
    """Return the shorter of a path after deletion of points from its start on and from its goal on."""
    it = problem.context
    row = problem.representation.encode([path])
    both = [
        compiled.segments.delete_points(np.ascontiguousarray(way), it.blocked, it.cols, it.policy, 0)
        for way in (row, row[:, ::-1])
    ]
    lengths = [float(compiled.measures.lengths(way, it.cols)[0]) for way in both]
    best = int(np.argmin(lengths))
    shortest = problem.representation.decode(both[best][0])
    return lengths[best], shortest[:: 1 - 2 * best]
