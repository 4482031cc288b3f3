"""Kernels that make paths through one random cell of each of several libraries."""

import numpy as np

from pathloom.compiled.insertion import connect
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, remove_loops, row_of, unpack, with_room


@part("i8(i8[::1], i8, i8, b1, i8, i8, i4[::1], i8[::1], f8, i8, u8[::1])")
def _draw(drawn, redraws, step, to_goal, start, goal, cells, begin, per_row, cols, state):
    """Draw start, a cell of each library and goal, each in reach of the one before; return how many, or −1."""
    libraries = begin.shape[0] - 1
    drawn[0] = start
    for library in range(libraries + 1):
        last = library == libraries
        r = row_of(drawn[library], per_row)
        c = drawn[library] - r * cols
        size = 1 if last else begin[library + 1] - begin[library]
        good = False
        for _ in range(1 if last else redraws):
            cell = goal if last else np.int64(cells[begin[library] + below(state, size)])
            rr = row_of(cell, per_row)
            cc = cell - rr * cols
            good = step == 0 or (last and not to_goal) or max(abs(rr - r), abs(cc - c)) < step
            if good:
                drawn[library + 1] = cell
                break
        if not good:
            return -1
    return libraries + 2


@part("i4[::1](i4[::1], i8[::1], i8, i4[::1], i8, b1, i4[::1])")
def _added(flat, begin, found, path, count, loops, mark):
    """Put a path behind those found, without its loops unless they are to stay; return the array, larger if need be."""
    if not loops:
        count = remove_loops(path, count, mark)
    flat = with_room(flat, begin[found], count)
    copy(flat, begin[found], path, 0, count)
    begin[found + 1] = begin[found] + count
    return flat


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
        nodes = _draw(drawn, redraws, step, to_goal, start, goal, cells, begin, per_row, cols, state)
        path[0] = start
        count = 1 if nodes > 0 else -1
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
        flat = _added(flat, start_of, found, path, count, loops, mark)
        found += 1
        in_a_row = 0
    return unpack(flat, start_of, found), failed


@kernel(
    "Tuple((i4[:, ::1], i8, i8))(i8, i8, i8, i8, i8, i4[::1], i8[::1], u1[::1], u1[::1], i8, i8, i8, i8, i8, i8,"
    " b1, b1, u8[::1])"
)
def sample_in_turn(
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
        flat = _added(flat, start_of, found, path, count, loops, mark)
        found += 1
        in_a_row = 0
    return unpack(flat, start_of, found), failed, again
