"""Other ways to write down the same path: without loops, or cell by cell."""

import numpy as np

from pathloom.compiled.jit import kernel
from pathloom.compiled.rows import blank, copy, length_of, remove_loops, row_of, unpack, widest, with_room


@kernel("i4[:, ::1](i4[:, ::1], i8)")
def without_loops(population, cells):
    """Cut out of each path whatever lies between two visits of one cell."""
    n = population.shape[0]
    mark = np.zeros(cells, np.int32)
    out = blank(n, population.shape[1])
    most = 1
    for k in range(n):
        count = length_of(population[k])
        copy(out[k], 0, population[k], 0, count)
        kept = remove_loops(out[k], count, mark)
        for i in range(kept, count):
            out[k, i] = -1
        most = max(most, kept)
    trimmed = blank(n, most)
    for k in range(n):
        copy(trimmed[k], 0, out[k], 0, most)
    return trimmed


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
        for i in range(count):
            flat = with_room(flat, at, 1)
            flat[at] = population[k, i]
            at += 1
            if i == count - 1:
                break
            a, b = population[k, i], population[k, i + 1]
            dr = row_of(b, per_row) - row_of(a, per_row)
            dc = b - a - dr * cols
            flat = with_room(flat, at, abs(dr) + abs(dc))
            step_r = cols if dr > 0 else -cols
            step_c = 1 if dc > 0 else -1
            if abs(dc) >= abs(dr):
                extent, m, along, across = abs(dc), abs(dr), step_c, step_r
            else:
                extent, m, along, across = abs(dr), abs(dc), step_r, step_c
            limit = extent + m
            low = side = 0
            here = np.int64(a)
            for _ in range(extent + 1):
                while limit > 0 and side <= -limit:
                    low += 1
                    side += 2 * extent
                    here += across
                j, value, cell = low, side, here
                while j <= m and value < limit:
                    if cell not in (a, b):
                        flat[at] = cell
                        at += 1
                    j += 1
                    value += 2 * extent
                    cell += across
                side -= 2 * m
                here += along
        begin[k + 1] = at
    return unpack(flat, begin, n)
