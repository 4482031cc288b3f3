"""Section 2.1, eqs. (2) to (4) and fig. 2: the libraries of nodes."""

import numpy as np

from pathloom.paths.context import Cells, Context


def libraries(it: Context) -> list[Cells]:
    """Return the free cells of each pair of neighbouring diagonals strictly between start and goal, in order.

    The diagonals lie across the way from start to goal, whichever its direction,
    and go on beyond the rectangle of the two. From corner to corner there are
    N = rows + cols − 3 of them, eq. (2), and so k = ⌈N / 2⌉ libraries, eq. (3).
    Where start and goal share a row, columns take their place, and rows where
    they share a column: diagonals would lead away from the goal.
    """
    (r0, c0), (r1, c1) = divmod(it.start, it.cols), divmod(it.goal, it.cols)
    row, col = np.indices(it.occupied.shape)
    passed = (np.sign(r1 - r0) * (row - r0) + np.sign(c1 - c0) * (col - c0)).ravel()  # steps along both axes
    N = abs(r1 - r0) + abs(c1 - c0) - 1
    between = np.flatnonzero((it.blocked == 0) & (passed >= 1) & (passed <= N))
    library = (passed[between] - 1) // 2
    order = np.argsort(library, kind="stable")
    ends = np.searchsorted(library[order], np.arange(1, -(-N // 2)))
    return np.split(between[order].astype(np.int32), ends) if N > 0 else []
