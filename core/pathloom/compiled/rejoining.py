"""Rejoining: a stretch cut out of a path and made anew by median insertion."""

import numpy as np

from pathloom.compiled.insertion import connect
from pathloom.compiled.jit import kernel
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, length_of, remove_loops, with_changed, with_room


@kernel(
    "Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[::1], i8, i8, u1[::1], u1[::1], i8, i8, i8, i8, i8, i8, b1, b1, u8[::1])"
)
def mutate_between(
    population, chosen, least, tries, blocked, moves, rows, cols, sign_r, sign_c, reach, cap, guarded, loops, state
):
    """Cut at random ``least`` or more cells in a row out of each chosen path, and join the ends by median insertion.

    Every such stretch of interior cells is as likely; where there are fewer, all
    are cut. A stretch that cannot be joined is drawn again, ``tries`` times in
    all. Returns the population and the number of failures, which keep the parent.
    """
    width = population.shape[1]
    mark = np.zeros(rows * cols, np.int32)
    stack = np.empty(cap + 2, np.int64)
    path = np.empty(width + cap + 8, np.int32)
    flat = np.empty(chosen.shape[0] * (width + 8) + path.shape[0], np.int32)
    begin = np.zeros(chosen.shape[0] + 1, np.int64)
    failed = 0
    for q in range(chosen.shape[0]):
        row = population[chosen[q]]
        count = length_of(row)
        gap = min(least, count - 2)
        made = -1
        for _ in range(tries if gap > 0 else 0):
            # two different numbers, and then as many more between them as must be cut
            i, j = below(state, count - gap), below(state, count - gap - 1)
            if j >= i:
                j += 1
            first, last = min(i, j), max(i, j) + gap
            copy(path, 0, row, 0, first + 1)
            made = connect(
                row[first], row[last], blocked, moves, rows, cols, sign_r, sign_c, reach,
                cap, guarded, path, first + 1, stack, state,
            )  # fmt: skip
            if made >= 0:
                copy(path, made, row, last + 1, count - last - 1)
                made += count - last - 1
                if not loops:
                    made = remove_loops(path, made, mark)
                break
        if made < 0:
            failed += 1
            made = 0
        flat = with_room(flat, begin[q], made)
        copy(flat, begin[q], path, 0, made)
        begin[q + 1] = begin[q] + made
    return with_changed(population, chosen, flat, begin), failed
