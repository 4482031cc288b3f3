"""Kernels that make paths through one random cell of each of several libraries."""

import numpy as np

from pathloom.compiled.insertion import connect
from pathloom.compiled.jit import kernel
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, remove_loops, row_of, unpack, with_room


@kernel(
    "Tuple((i4[:, ::1], i8))(i8, i8, i8, i8, b1, i8, i8, i4[::1], i8[::1], u1[::1], u1[::1], i8, i8, i8, i8, i8, i8,"
    " b1, b1, u8[::1])"
)
def sample_from_libraries(
    n, tries, redraws, step, to_goal, start, goal, cells, begin, blocked, moves, rows, cols, sign_r, sign_c,
    reach, cap, guarded, loops, state,
):  # fmt: skip
    """Draw n paths start – a random cell of each library – goal, joined by median insertion.

    Library l is ``cells[begin[l]:begin[l + 1]]``. ``step``: a cell lies less than
    so many rows and columns from the one before; it is drawn up to ``redraws``
    times; 0: anywhere. ``to_goal``: the step to the goal is limited as well.
    Stops after ``tries`` failures in a row. Returns the paths and the number of
    failed tries.
    """
    per_row = 1.0 / cols
    libraries = begin.shape[0] - 1
    drawn = np.empty(libraries + 2, np.int64)
    room = (libraries + 2) * (cap + 2) + 8
    path = np.empty(room, np.int32)
    stack = np.empty(cap + 2, np.int64)
    mark = np.zeros(rows * cols, np.int32)
    flat = np.empty(n * 2 * (rows + cols) + room, np.int32)
    start_of = np.zeros(n + 1, np.int64)
    found = failed = in_a_row = 0
    while found < n and in_a_row < tries:
        in_a_row += 1
        drawn[0] = start
        nodes = 1
        complete = True
        for library in range(libraries + 1):
            last = library == libraries
            r = row_of(drawn[nodes - 1], per_row)
            c = drawn[nodes - 1] - r * cols
            size = 1 if last else begin[library + 1] - begin[library]
            good = False
            for _ in range(1 if last else redraws):
                cell = goal if last else np.int64(cells[begin[library] + below(state, size)])
                rr = row_of(cell, per_row)
                cc = cell - rr * cols
                good = step == 0 or (last and not to_goal) or max(abs(rr - r), abs(cc - c)) < step
                if good:
                    drawn[nodes] = cell
                    break
            if not good:
                complete = False
                break
            nodes += 1
        count = -1
        if complete:
            path[0] = start
            count = 1
            for k in range(1, nodes):
                if drawn[k] == drawn[k - 1]:
                    continue
                count = connect(
                    drawn[k - 1], drawn[k], blocked, moves, rows, cols, sign_r, sign_c, reach,
                    cap, guarded, path, count, stack, state,
                )  # fmt: skip
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
    return unpack(flat, start_of, found), failed
