"""Rejoining: kernels that join cells by median insertion, and draw again what cannot be joined."""

import numpy as np

from pathloom.compiled.insertion import connect
from pathloom.compiled.jit import kernel
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, length_of, remove_loops, unpack, with_changed, with_room


@kernel(
    "Tuple((i4[:, ::1], i8, i8))(i8, i8, i8, i8, i8, i4[::1], i8[::1], u1[::1], u1[::1], i8, i8, i8, i8, i8, i8,"
    " b1, b1, u8[::1])"
)
def sample_through(
    n, tries, redraws, start, goal, cells, begin, blocked, moves, rows, cols, sign_r, sign_c,
    reach, cap, guarded, loops, state,
):  # fmt: skip
    """Draw n paths start – a random cell of each library – goal, and join each cell as it is drawn.

    Library l is ``cells[begin[l]:begin[l + 1]]``. A cell that cannot be joined to
    the one before is drawn again, ``redraws`` times in all. Stops after ``tries``
    failures in a row. Returns the paths, the number of failed tries, and the
    number of cells drawn again.
    """
    libraries = begin.shape[0] - 1
    room = (libraries + 2) * (cap + 2) + 8
    path = np.empty(room, np.int32)
    stack = np.empty(cap + 2, np.int64)
    mark = np.zeros(rows * cols, np.int32)
    flat = np.empty(n * 2 * (rows + cols) + room, np.int32)
    start_of = np.zeros(n + 1, np.int64)
    found = failed = again = in_a_row = 0
    while found < n and in_a_row < tries:
        in_a_row += 1
        path[0] = here = start
        count = 1
        for library in range(libraries + 1):
            joined = -1
            for attempt in range(redraws if library < libraries else 1):
                cell = goal
                if library < libraries:
                    cell = np.int64(cells[begin[library] + below(state, begin[library + 1] - begin[library])])
                again += attempt > 0
                joined = count
                if cell != here:
                    joined = connect(
                        here, cell, blocked, moves, rows, cols, sign_r, sign_c, reach,
                        cap, guarded, path, count, stack, state,
                    )  # fmt: skip
                if joined >= 0:
                    here = cell
                    break
            count = joined
            if count < 0:
                break
        if count < 0:
            failed += 1
            continue
        if not loops:
            count = remove_loops(path, count, mark)
        flat = with_room(flat, start_of[found], count)
        copy(flat, start_of[found], path, 0, count)
        start_of[found + 1] = start_of[found] + count
        found += 1
        in_a_row = 0
    return unpack(flat, start_of, found), failed, again


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
