"""Lines of cells across the way from start to goal, from each of which several papers draw one cell."""

from typing import Literal

import numpy as np

from pathloom.paths.context import Cells, Context


def lines_between(it: Context, lines: Literal["longer", "rows"] = "longer") -> list[Cells]:
    """Return the free cells of each row strictly between start and goal, in the order of the way.

    ``longer``: of columns where start and goal lie further apart in columns than in rows.
    """
    (r0, c0), (r1, c1) = divmod(it.start, it.cols), divmod(it.goal, it.cols)
    table = np.where(it.occupied, -1, np.arange(it.occupied.size).reshape(it.occupied.shape))
    first, last = r0, r1
    if lines == "longer" and abs(c1 - c0) > abs(r1 - r0):
        table, first, last = table.T, c0, c1
    step = 1 if last > first else -1
    return [line[line >= 0].astype(np.int32) for line in table[first:last:step][1:]]
