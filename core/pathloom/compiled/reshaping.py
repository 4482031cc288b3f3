"""Other ways to write down the same path: without loops, or cell by cell."""

import numpy as np

from pathloom.compiled.jit import kernel
from pathloom.compiled.rows import blank, copy, length_of, remove_loops, row_of, trimmed, unpack, widest, with_room
from pathloom.compiled.segments import cells_crossed


@kernel("i4[:, ::1](i4[:, ::1], i8)")
def without_loops(population, cells):
    """Cut out of each path whatever lies between two visits of one cell."""
    n = population.shape[0]
    mark = np.zeros(cells, np.int32)
    out = blank(n, population.shape[1])
    for k in range(n):
        count = length_of(population[k])
        copy(out[k], 0, population[k], 0, count)
        for i in range(remove_loops(out[k], count, mark), count):
            out[k, i] = -1
    return trimmed(out)


@kernel("i4[:, ::1](i4[:, ::1], i8[::1], i4[:, ::1])")
def replaced(population, places, rows):
    """Return the population with other paths in some of its places, no wider than the longest of them all."""
    n = population.shape[0]
    instead = np.full(n, np.int64(-1))
    for q in range(places.shape[0]):
        instead[places[q]] = q
    most = widest(rows)
    for k in range(n):
        if instead[k] < 0:
            most = max(most, length_of(population[k]))
    out = blank(n, most)
    for k in range(n):
        if instead[k] < 0:
            copy(out[k], 0, population[k], 0, length_of(population[k]))
        else:
            copy(out[k], 0, rows[instead[k]], 0, length_of(rows[instead[k]]))
    return out


@kernel("i4[:, ::1](i4[:, ::1], i8)")
def cell_by_cell(population, cols):
    """Name every cell whose inside a path crosses: what comes out is 8-connected, and free where the path was."""
    n = population.shape[0]
    per_row = 1.0 / cols
    flat = np.empty(4 * n * population.shape[1] + 64, np.int32)
    begin = np.zeros(n + 1, np.int64)
    at = 0
    for k in range(n):
        count = length_of(population[k])
        flat = with_room(flat, at, 1)
        flat[at] = population[k, 0]
        at += min(count, 1)
        for i in range(1, count):
            a, b = population[k, i - 1], population[k, i]
            dr = row_of(b, per_row) - row_of(a, per_row)
            dc = b - a - dr * cols
            flat = with_room(flat, at, abs(dr) + abs(dc) + 1)
            at += cells_crossed(a, dr, dc, cols, flat[at - 1 :]) - 1  # the first one stands there already
        begin[k + 1] = at
    return unpack(flat, begin, n)
