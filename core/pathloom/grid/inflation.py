"""Grow obstacles by the radius of a round robot, so that its centre may be a point."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ProblemError

NOISE = 1e-9
"""Relative excess of a squared radius that counts as rounding: 3.45 m / 0.3 m must be 11.5 cells."""


def inflate(occupied: NDArray[np.bool_], radius: float) -> NDArray[np.bool_]:
    """Return the cells on whose centre a disc cannot stand.

    A cell is blocked when the distance from its centre to the nearest obstacle cell, a
    closed unit square, is less than the radius; a disc that only touches is free. For a
    cell dr rows and dc columns away that is

        max(2|dr| - 1, 0)**2 + max(2|dc| - 1, 0)**2 < 4 radius**2,

    in whole numbers on the left. The outside of the map inflates nothing.

    Parameters
    ----------
    occupied
        (H, W), left as it is.
    radius
        In cells, 0 or more; 0 blocks the obstacles alone.

    Returns
    -------
    (H, W), a new array.

    Raises
    ------
    ProblemError
        If the radius is negative or not finite.
    """
    if not (math.isfinite(radius) and radius >= 0.0):
        raise ProblemError(f"radius: found {radius}, allowed a finite number of cells, 0 or more")
    blocked = np.array(occupied, dtype=np.bool_, order="C")
    height, width = blocked.shape
    reach = min(float(radius), float(height + width))  # beyond it every cell is within
    largest = math.ceil(4.0 * reach * reach * (1.0 - NOISE)) - 1  # of the left side, to be blocked
    if largest < 1 or not blocked.any():  # even the cell next to an obstacle stays free
        return blocked

    # In the rows dr away from an obstacle, cells up to spans[dr] columns aside are blocked.
    rows = min((math.isqrt(largest) + 1) // 2, height - 1)
    spans = [_span(largest, dr) for dr in range(rows + 1)]
    aside = _columns_to_obstacle(blocked, spans[0])
    blocked |= aside <= spans[0]
    for dr in range(1, rows + 1):
        near = aside <= spans[dr]
        blocked[dr:] |= near[:-dr]
        blocked[:-dr] |= near[dr:]
    return blocked


def _span(largest: int, dr: int) -> int:
    """Return the greatest |dc| that is blocked together with |dr|."""
    return (math.isqrt(largest - max(2 * dr - 1, 0) ** 2) + 1) // 2


def _columns_to_obstacle(occupied: NDArray[np.bool_], limit: int) -> NDArray[np.integer[Any]]:
    """Return each cell's distance to the nearest obstacle of its row, at most `limit` + 1."""
    width = occupied.shape[1]
    cols = np.arange(width, dtype=np.int32)
    never = width + limit + 1
    left = np.maximum.accumulate(np.where(occupied, cols, np.int32(-never)), axis=1)
    right = np.minimum.accumulate(np.where(occupied, cols, np.int32(2 * never))[:, ::-1], axis=1)[:, ::-1]
    distance = np.minimum(cols - left, right - cols)
    # Short integers: the comparisons that follow, one for each row offset, read less memory.
    return np.minimum(distance, limit + 1).astype(np.min_scalar_type(limit + 1))
