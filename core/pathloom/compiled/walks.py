"""Kernels that walk at random."""

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel
from pathloom.compiled.random import below, uniform
from pathloom.compiled.rows import copy, remove_loops, unpack, with_room


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


@kernel("Tuple((i4[:, ::1], i8))(i8, i8, i8, f8, b1, i8, i8, i4[::1], u1[::1], i8, u8[::1])")
def sample_by_greedy_walks(n, steps, tries, bias, loops, start, goal, free, moves, cols, state):
    """Draw n walks from start to goal, each step to the neighbour nearest to a target that is drawn for it.

    The target is the goal with probability ``bias``, else one of the cells
    ``free``; of equally near neighbours each has the same chance. A walk longer
    than ``steps`` has failed, and after ``tries`` failures in a row no more are
    begun. ``loops``: keep what lies between two visits of one cell. Returns the
    paths and the number of failures.
    """
    cells = moves.shape[0]
    mark = np.zeros(cells, np.int32)
    path = np.empty(256, np.int32)
    flat = np.empty(n * 64, np.int32)
    begin = np.zeros(n + 1, np.int64)
    found = failed = in_a_row = 0
    while found < n and in_a_row < tries:
        here = start
        path[0] = start
        count = 1
        while here != goal and count <= steps:
            target = goal if uniform(state) < bias else np.int64(free[below(state, free.shape[0])])
            r, c = here // cols, here % cols
            to_r, to_c = target // cols - r, target % cols - c
            nearest = np.int64(-1)
            ties = chosen = 0
            for d in range(8):
                if moves[here] >> d & 1:
                    far = (to_r - DR[d]) ** 2 + (to_c - DC[d]) ** 2
                    if nearest < 0 or far < nearest:
                        nearest = far
                        ties = 0
                    if far == nearest:
                        ties += 1
                        if ties == 1 or below(state, ties) == 0:
                            chosen = d
            if nearest < 0:
                break
            here += DR[chosen] * cols + DC[chosen]
            path = with_room(path, count, 1)
            path[count] = here
            count += 1
        if here != goal:
            failed += 1
            in_a_row += 1
            continue
        in_a_row = 0
        if not loops:
            count = remove_loops(path, count, mark)
        flat = with_room(flat, begin[found], count)
        copy(flat, begin[found], path, 0, count)
        begin[found + 1] = begin[found] + count
        found += 1
    return unpack(flat, begin, found), failed
