"""The independent validator: every path that is reported has passed it.

It shares no code with the planners' collision tests: obstacle by obstacle, by
separating axes in Python's and numpy's integers, straight from the definition.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.paths.problem import PathProblem


@dataclass(frozen=True)
class Contacts:
    """How a path meets obstacles."""

    crossed: int = 0
    """Obstacle cells whose inside the path crosses."""
    touches: int = 0
    """Corners of obstacles that the path passes through without entering: tangencies."""
    squeezes: int = 0
    """Those of them that two diagonally opposite obstacles share."""


def validate(path: ArrayLike, problem: PathProblem) -> str | None:
    """Return why a path is not valid, or ``None`` if it is.

    Valid is a path (k, 2) of cells on the map that leads from start to goal and
    whose segments obey the problem's corner policy exactly.
    """
    cells = np.asarray(path)
    if cells.ndim != 2 or cells.shape[0] == 0 or cells.shape[1] != 2 or cells.dtype.kind not in "iu":
        return f"a path is an integer array of shape (k, 2); got {cells.dtype} {cells.shape}"
    start, goal = (list(end) for end in problem.ends)
    if cells[0].tolist() != start or cells[-1].tolist() != goal:
        return f"leads from {cells[0].tolist()} to {cells[-1].tolist()}, not from {start} to {goal}"
    occupied = problem.context.occupied
    for cell in cells.tolist():
        if not (0 <= cell[0] < occupied.shape[0] and 0 <= cell[1] < occupied.shape[1]):
            return f"leaves the map at {cell}"
        if occupied[tuple(cell)]:
            return f"stands on an obstacle at {cell}"
    for a, b in pairwise(cells.tolist()):
        met = _meet(a, b, occupied)
        where = f"between {a} and {b}"
        if met.crossed:
            return f"crosses an obstacle {where}"
        if problem.corners != "allow" and met.squeezes:
            return f"squeezes between two obstacles {where}"
        if problem.corners == "strict" and met.touches:
            return f"touches an obstacle {where}"
    return None


def contacts(path: ArrayLike, problem: PathProblem) -> Contacts:
    """Return how often a path (k, 2) crosses, touches and squeezes between obstacles."""
    cells = np.asarray(path).tolist()
    met = [_meet(a, b, problem.context.occupied) for a, b in pairwise(cells)]
    return Contacts(sum(m.crossed for m in met), sum(m.touches for m in met), sum(m.squeezes for m in met))


def _meet(a: list[int], b: list[int], occupied: NDArray[np.bool_]) -> Contacts:
    """Hold one segment against every obstacle cell in its bounding box.

    Unit squares and the segment overlap iff their projections on both axes and
    on the segment's normal do. Centres are integers, so a cell overlaps on the
    axes iff its centre lies in the bounding box; on the normal iff
    2 |d × (c − a)| < |dr| + |dc|. With equality the segment passes through a corner.
    """
    top, bottom = sorted((a[0], b[0]))
    left, right = sorted((a[1], b[1]))
    box = occupied[top : bottom + 1, left : right + 1]
    if not box.any():
        return Contacts()
    obstacles: NDArray[Any] = np.argwhere(box) + np.array([top, left])
    dr, dc = b[0] - a[0], b[1] - a[1]
    twice = 2 * (dr * (obstacles[:, 1] - a[1]) - dc * (obstacles[:, 0] - a[0]))
    reach = abs(dr) + abs(dc)
    touched: dict[tuple[int, int], int] = {}
    for cell in obstacles[np.abs(twice) == reach].tolist():
        for corner in ((2 * cell[0] + s, 2 * cell[1] + t) for s in (-1, 1) for t in (-1, 1)):
            if dr * (corner[1] - 2 * a[1]) == dc * (corner[0] - 2 * a[0]):  # doubled, so that corners are integers
                touched[corner] = touched.get(corner, 0) + 1
    crossed = int((np.abs(twice) < reach).sum())
    return Contacts(crossed, len(touched), sum(times > 1 for times in touched.values()))
