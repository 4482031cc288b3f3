"""Merging: one path of the shorter parts of two."""

import numpy as np

from pathloom.compiled.jit import kernel
from pathloom.compiled.rows import blank, copy, length_between, length_of, remove_loops, trimmed, widest


@kernel("Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[:, ::1], i8, i8)")
def merge(population, pairs, cells, cols):
    """Let each pair have one child, which from each common cell to the next goes the way of the parent who is quicker.

    Common cells count as far as they follow each other in both parents. Loops
    are cut out. The child takes the place of the longer parent, where it is
    shorter. Returns the population and the number of children that are not.
    """
    n, width = population.shape
    place = np.zeros(cells, np.int32)
    mark = np.zeros(cells, np.int32)
    child = np.empty(2 * width, np.int32)
    out = blank(n, 2 * widest(population))
    for k in range(n):
        copy(out[k], 0, population[k], 0, length_of(population[k]))
    failed = 0
    for p in range(pairs.shape[0]):
        first, second = population[pairs[p, 0]], population[pairs[p, 1]]
        m, k = length_of(first), length_of(second)
        for i in range(m):
            place[first[i]] = i + 1
        child[0] = first[0]
        count = 1
        i = j = 0
        for there in range(1, k):
            here = place[second[there]] - 1
            if here > i:
                if length_between(first, i, here, cols) <= length_between(second, j, there, cols):
                    copy(child, count, first, i + 1, here - i)
                    count += here - i
                else:
                    copy(child, count, second, j + 1, there - j)
                    count += there - j
                i, j = here, there
        for i in range(m):
            place[first[i]] = 0
        count = remove_loops(child, count, mark)
        one, other = length_between(first, 0, m - 1, cols), length_between(second, 0, k - 1, cols)
        worse = pairs[p, 0] if one > other else pairs[p, 1]
        if length_between(child, 0, count - 1, cols) < max(one, other):
            copy(out[worse], 0, child, 0, count)
            for i in range(count, out.shape[1]):
                out[worse, i] = -1
        else:
            failed += 1
    return trimmed(out), failed
