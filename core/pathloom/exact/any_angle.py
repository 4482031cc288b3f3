"""The shortest path over the centres of free cells, at any angle.

Every free cell can be a turning point: to allow only cells beside obstacles is
up to 0.67 % too long, since a centre can rarely lie on the tangent of a corner.
"""

import math

import numpy as np

from pathloom import compiled
from pathloom.exact.octile import octile_path
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem

DETOUR = math.sqrt(4.0 - 2.0 * math.sqrt(2.0))
"""Greatest ratio, 1.0824, of octile to Euclidean distance: that at 22.5°."""

WORK = 6_000_000_000
"""Pairs of cells looked at, a segment test counting for ten, before giving up: some ten seconds."""


def any_angle_path(problem: PathProblem, *, work: int = WORK) -> tuple[float, Path | None]:
    """Return the any-angle optimum, in cells, and a path (k, 2) of that length.

    Segments obey the problem's corner policy. Exact up to the rounding of sums
    of square roots: every pruning bound is admissible, every test in integers.

    Parameters
    ----------
    work
        Limit of the search. Past it, and where there is no path, the answer is
        inf and ``None``.

    Notes
    -----
    A* over the visibility graph. A cell's distance to an end is bounded from
    below by the Euclidean distance, and by its octile distance with corners
    ignored divided by 1.0824: along a free segment lies a path of single steps
    that is at most so much longer.
    """
    it = problem.context
    if it.start == it.goal:
        return 0.0, np.array([problem.ends[0]], np.int64)
    _, path = octile_path(problem)
    if path is None:
        return math.inf, None
    row, col = np.divmod(np.arange(it.blocked.size), it.cols)
    bounds = []
    for end in (it.start, it.goal):
        steps, _ = compiled.search.tree(it.loose_moves, np.empty(0, np.float32), it.cols, end)
        straight = np.hypot(row - end // it.cols, col - end % it.cols)
        bounds.append(np.maximum(straight, steps / DETOUR))
    upper = _taut_length(problem, path)
    cells, _ = compiled.search.any_angle_path(
        it.blocked, it.cols, it.start, it.goal, it.policy, bounds[0], bounds[1], upper, work
    )
    if len(cells) == 0:
        return math.inf, None
    length = float(compiled.measures.lengths(cells[np.newaxis], it.cols)[0])
    return length, problem.representation.decode(cells)


def _taut_length(problem: PathProblem, path: Path) -> float:
    """Return the length of a path after deletion of points: an upper bound of the optimum."""
    it = problem.context
    row = problem.representation.encode([path])
    shorter = compiled.segments.delete_points(row, it.blocked, it.cols, it.policy, 0)
    backwards = np.ascontiguousarray(row[:, ::-1])
    other = compiled.segments.delete_points(backwards, it.blocked, it.cols, it.policy, 0)
    return float(min(compiled.measures.lengths(p, it.cols)[0] for p in (shorter, other)))
