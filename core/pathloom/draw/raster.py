"""Maps and paths at the size of a picture: blocks of cells, and the cells that a path crosses."""

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]
Path = NDArray[np.int64]
"""(k, 2), cells (row, column) from start to goal."""


def coarse(mask: Mask, rows: int, cols: int) -> Mask:
    """Return a map at another size: which blocks of cells show as set.

    A block shows as set when half of its cells are set, or when they are half as many as a
    wall of one cell needs to cross it: thin walls stay, stray cells go. At the
    map's own size, and larger, every cell shows as it is.

    Parameters
    ----------
    mask
        (height, width), the map.
    rows, cols
        Size wanted, at least 1 each.
    """
    height, width = mask.shape
    top, bottom = _edges(height, rows)
    left, right = _edges(width, cols)
    total = np.zeros((height + 1, width + 1), np.int64)
    total[1:, 1:] = mask.cumsum(axis=0, dtype=np.int64).cumsum(axis=1)
    inside = (
        total[np.ix_(bottom, right)]
        - total[np.ix_(top, right)]
        - total[np.ix_(bottom, left)]
        + total[np.ix_(top, left)]
    )
    # n of h x w cells, with n / (h w) >= 1 / (2 max(h, w)), which 1/2 implies
    shorter = np.minimum((bottom - top)[:, np.newaxis], (right - left)[np.newaxis, :])
    shown: Mask = (inside > 0) & (2 * inside >= shorter)
    return shown


def crossed(path: Path) -> Path:
    """Return, in their order, the cells (m, 2) whose interior a path crosses.

    Exact: where a segment runs through a corner of cells, only the two that it
    leaves and enters count.
    """
    if len(path) == 0:
        return np.empty((0, 2), np.int64)
    parts = [path[:1].astype(np.int64)]
    for a, b in zip(path[:-1].astype(np.int64), path[1:].astype(np.int64), strict=True):
        parts.append(_segment(a, b)[1:])
    return np.concatenate(parts)


def _edges(length: int, count: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return first cell, and first cell after, of each of ``count`` blocks along a side."""
    first = np.arange(count, dtype=np.int64) * length // count
    after = np.arange(1, count + 1, dtype=np.int64) * length // count
    return first, np.maximum(after, first + 1)


def _segment(a: NDArray[np.int64], b: NDArray[np.int64]) -> Path:
    steps = np.abs(b - a)
    if not steps.any():
        return a[np.newaxis]
    rows, cols = (int(n) for n in np.maximum(steps, 1))
    whole = 2 * rows * cols  # length in units that make every border between cells an integer
    across_rows = (2 * np.arange(steps[0]) + 1) * cols
    across_cols = (2 * np.arange(steps[1]) + 1) * rows
    borders = np.unique(np.concatenate([[0], across_rows, across_cols, [whole]]))
    middle = (borders[:-1] + borders[1:])[:, np.newaxis]  # twice the middle of each piece within one cell
    cells: Path = a + np.sign(b - a) * ((middle * steps + whole) // (2 * whole))
    return cells
