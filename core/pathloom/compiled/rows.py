"""Rows of a population inside kernels: lengths, copies, packing.

Loops instead of slices: they run as fast, and compile many times faster.
"""

import math

import numpy as np

from pathloom.compiled.jit import part


@part("i8(i8, f8)")
def row_of(cell, per_row):
    """Return the row of a cell, given 1 / cols: exact below 2**50 cells, and faster than a division."""
    return np.int64((cell + 0.5) * per_row)


@part("i8(i4[::1])")
def length_of(row):
    """Return how many cells a padded row holds: the first −1, by bisection."""
    low, high = 0, row.shape[0]
    while low < high:
        middle = (low + high) // 2
        if row[middle] < 0:
            high = middle
        else:
            low = middle + 1
    return low


@part("i4[:, ::1](i8, i8)")
def blank(n, width):
    """Return a population of n empty rows."""
    out = np.empty((n, width), np.int32)
    for k in range(n):
        for i in range(width):
            out[k, i] = -1
    return out


@part("void(i4[::1], i8, i4[::1], i8, i8)")
def copy(to, at, of, begin, count):
    """Copy ``count`` cells from ``of[begin:]`` to ``to[at:]``."""
    for i in range(count):
        to[np.uint64(at + i)] = of[np.uint64(begin + i)]  # unsigned: no test for negative indices


@part("i8(i4[:, ::1])")
def widest(population):
    """Return the greatest number of cells in a row, at least 1."""
    most = 1
    for k in range(population.shape[0]):
        most = max(most, length_of(population[k]))
    return most


@part("i4[::1](i4[::1], i8, i8)")
def with_room(flat, used, more):
    """Return the array itself if ``more`` cells fit behind the used ones, else a larger copy."""
    if used + more <= flat.shape[0]:
        return flat
    larger = np.empty(2 * flat.shape[0] + more, np.int32)
    copy(larger, 0, flat, 0, used)
    return larger


@part("i4[:, ::1](i4[::1], i8[::1], i8)")
def unpack(flat, begin, n):
    """Return n paths that stand one after the other as the rows of a padded array."""
    most = 1
    for k in range(n):
        most = max(most, begin[k + 1] - begin[k])
    out = blank(n, most)
    for k in range(n):
        copy(out[k], 0, flat, begin[k], begin[k + 1] - begin[k])
    return out


@part("i4[:, ::1](i4[:, ::1], i8[::1], i4[::1], i8[::1])")
def with_changed(population, where, flat, begin):
    """Return the population with path q of those that stand one after the other in row ``where[q]``.

    An empty path leaves its row as it is. The array is as wide as the longest path.
    """
    n = population.shape[0]
    most = widest(population)
    for q in range(where.shape[0]):
        most = max(most, begin[q + 1] - begin[q])
    out = blank(n, most)
    for k in range(n):
        copy(out[k], 0, population[k], 0, length_of(population[k]))
    for q in range(where.shape[0]):
        made = begin[q + 1] - begin[q]
        if made > 0:
            row = out[where[q]]
            copy(row, 0, flat, begin[q], made)
            for i in range(made, most):
                row[i] = -1
    return out


@part("i4[:, ::1](i4[:, ::1])")
def trimmed(population):
    """Return the population in an array as wide as its longest path."""
    n, most = population.shape[0], widest(population)
    out = blank(n, most)
    for k in range(n):
        copy(out[k], 0, population[k], 0, most)
    return out


@part("f8(i4[::1], i8, i8, i8)")
def length_between(path, first, last, cols):
    """Return the Euclidean length of a path from one of its positions to another, in cells.

    Single steps are counted, so that paths of them have the same length in any order.
    """
    per_row = 1.0 / cols
    straight = diagonal = 0
    total = 0.0
    r0 = row_of(path[first], per_row)
    for i in range(first + 1, last + 1):
        r = row_of(path[i], per_row)
        dr = r - r0
        dc = path[i] - path[i - 1] - dr * cols
        squared = dr * dr + dc * dc
        if squared == 1:
            straight += 1
        elif squared == 2:
            diagonal += 1
        else:
            total += math.sqrt(squared)
        r0 = r
    return straight + diagonal * math.sqrt(2.0) + total


@part("i4[::1](i8, i4[::1], i4[::1])")
def path_to(last, parent, cell):
    """Return the path to node ``last`` of a tree, root first; ``parent`` of the root is −1, ``cell`` is each node's."""
    count = 0
    i = last
    while i >= 0:
        i = parent[i]
        count += 1
    path = np.empty(count, np.int32)
    i = last
    for k in range(count - 1, -1, -1):
        path[k] = cell[i]
        i = parent[i]
    return path


@part("u8(i4[::1], i8)")
def hash_of(path, count):
    """Return a 64-bit hash of a path: FNV-1a in two lanes, which the processor works off side by side, then mixed."""
    prime = np.uint64(1099511628211)
    even = np.uint64(14695981039346656037)
    odd = np.uint64(count) * prime
    for i in range(0, count - 1, 2):
        even = (even ^ np.uint64(path[i])) * prime
        odd = (odd ^ np.uint64(path[i + 1])) * prime
    if count % 2 == 1:
        even = (even ^ np.uint64(path[count - 1])) * prime
    value = even ^ (odd << np.uint64(31) | odd >> np.uint64(33))
    value = (value ^ value >> np.uint64(32)) * np.uint64(0x9E3779B97F4A7C15)
    return value ^ value >> np.uint64(29)


@part("i8(i4[::1], i8, i4[::1])")
def remove_loops(path, count, mark):
    """Cut out, in place, whatever lies between two visits of one cell; return the new count.

    ``mark`` (one entry a cell) is all zero before and after.
    """
    kept = 0
    for i in range(count):
        cell = path[i]
        if mark[cell] > 0:
            back = mark[cell]
            for j in range(back, kept):
                mark[path[j]] = 0
            kept = back
        else:
            path[kept] = cell
            kept += 1
            mark[cell] = kept
    for j in range(kept):
        mark[path[j]] = 0
    return kept
