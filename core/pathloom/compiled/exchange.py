"""Exchange of tails between paths."""

import numpy as np

from pathloom.compiled.jit import kernel
from pathloom.compiled.random import below
from pathloom.compiled.rows import blank, copy, length_of, remove_loops, widest


@kernel("i4[:, ::1](i4[:, ::1], i8[:, ::1], i8[:, ::1], b1[:, ::1], i8, b1)")
def splice(population, pairs, at, wanted, cells, loops):
    """Let pairs exchange their tails, for each of the two children that is wanted.

    The first child of pair p is its first parent up to ``at[p, 0]`` and then the
    second from ``at[p, 1] + 1``; the second child the other way round.
    """
    n = population.shape[0]
    mark = np.zeros(cells, np.int32)
    counts = np.empty(n, np.int64)
    most = widest(population)
    for k in range(n):
        counts[k] = length_of(population[k])
    for p in range(pairs.shape[0]):
        for side in range(2):
            if wanted[p, side]:
                most = max(most, at[p, side] + counts[pairs[p, 1 - side]] - at[p, 1 - side])
    out = blank(n, most)
    for k in range(n):
        copy(out[k], 0, population[k], 0, counts[k])
    for p in range(pairs.shape[0]):
        for side in range(2):
            if not wanted[p, side]:
                continue
            x, y = pairs[p, side], pairs[p, 1 - side]
            head, tail = at[p, side] + 1, counts[y] - at[p, 1 - side] - 1
            row = out[x]
            copy(row, head, population[y], at[p, 1 - side] + 1, tail)
            count = head + tail
            if not loops:
                count = remove_loops(row, count, mark)
            for i in range(count, most):
                row[i] = -1
    return out


@kernel("Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[:, ::1], i8, b1, u8[::1])")
def exchange_tails(population, pairs, cells, loops, state):
    """Let each pair exchange what comes after a random cell that both visit, ends apart.

    Returns the population with the children in their parents' rows, and the
    number of pairs without a common cell, which stay as they are.
    """
    n = population.shape[0]
    mark = np.zeros(cells, np.int32)
    counts = np.empty(n, np.int64)
    for k in range(n):
        counts[k] = length_of(population[k])
    at = np.zeros((pairs.shape[0], 2), np.int64)
    wanted = np.zeros((pairs.shape[0], 2), np.bool_)
    failed = 0
    for p in range(pairs.shape[0]):
        x, y = pairs[p, 0], pairs[p, 1]
        for i in range(1, counts[x] - 1):
            mark[population[x, i]] = i
        common = 0
        for j in range(1, counts[y] - 1):
            if mark[population[y, j]] > 0:
                common += 1
        if common > 0:
            pick = below(state, common)
            for j in range(1, counts[y] - 1):
                if mark[population[y, j]] > 0:
                    if pick == 0:
                        at[p, 0] = mark[population[y, j]]
                        at[p, 1] = j
                        break
                    pick -= 1
            wanted[p, 0] = wanted[p, 1] = True
        else:
            failed += 1
        for i in range(1, counts[x] - 1):
            mark[population[x, i]] = 0
    return splice(population, pairs, at, wanted, cells, loops), failed
