"""Kernels that walk at random."""

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, unpack, with_room


@kernel("Tuple((i4[:, ::1], i8))(i8, i8, i8, i8, u1[::1], i8, u8[::1])")
def sample_by_walking(n, steps, start, goal, moves, cols, state):
    """Draw n random walks from start to goal, loops cut out on the way.

    A walk longer than ``steps`` is given up; after n such failures nothing more
    is tried. Returns the paths and the number of failures.
    """
    cells = moves.shape[0]
    mark = np.zeros(cells, np.int32)
    path = np.empty(cells, np.int32)
    flat = np.empty(n * 64 + cells, np.int32)
    begin = np.zeros(n + 1, np.int64)
    found = failed = 0
    while found < n and failed < n:
        here = start
        path[0] = start
        count = 1
        mark[start] = 1
        walked = 0
        while here != goal and walked < steps:
            walked += 1
            legal = 0
            chosen = -1
            for d in range(8):
                if moves[here] >> d & 1:
                    legal += 1
                    if below(state, legal) == 0:
                        chosen = d
            if chosen < 0:
                break
            here += DR[chosen] * cols + DC[chosen]
            if mark[here] > 0:  # met the path again: forget the loop
                for i in range(mark[here], count):
                    mark[path[i]] = 0
                count = mark[here]
            else:
                path[count] = here
                count += 1
                mark[here] = count
        for i in range(count):
            mark[path[i]] = 0
        if here != goal:
            failed += 1
            continue
        flat = with_room(flat, begin[found], count)
        copy(flat, begin[found], path, 0, count)
        begin[found + 1] = begin[found] + count
        found += 1
    return unpack(flat, begin, found), failed
