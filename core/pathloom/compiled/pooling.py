"""Pooling: one path recombined of the points of many."""

import math

import numpy as np

from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import length_between, length_of, path_to, row_of
from pathloom.compiled.sight import ROOM, find_runs, look

SLACK = 1e-9
"""What a way must be shorter by, so that rounding decides nothing."""


@part("i8(i4[::1], i8, b1[::1], u1[::1], i8, i8, i4[::1], i8)")
def _add_near(path, count, mark, blocked, cols, halo, cell, size):
    """Put the unmarked free cells near a path's points into the pool while it has room; return its new size."""
    rows = blocked.shape[0] // cols
    per_row = 1.0 / cols
    for i in range(count):
        r0 = row_of(path[i], per_row)
        c0 = path[i] - r0 * cols
        for r in range(max(0, r0 - halo), min(rows, r0 + halo + 1)):
            for c in range(max(0, c0 - halo), min(cols, c0 + halo + 1)):
                one = r * cols + c
                if not mark[one] and not blocked[one] and size < cell.shape[0]:
                    mark[one] = True
                    cell[size] = one
                    size += 1
    return size


@part("i4[::1](i4[::1], b1[::1], u1[::1], i8, i8, f8)")
def _shortest_over(pool, inside, blocked, cols, policy, limit):
    """Return the shortest path over the cells of a pool, empty where none is below the limit (A*, Hart et al. 1968).

    The first two cells are start and goal; ``inside`` marks all of them.
    """
    cells = blocked.shape[0]
    start, goal = np.int64(pool[0]), np.int64(pool[1])
    goal_r, goal_c = goal // cols, goal % cols
    after = np.empty(cells)
    for r in range(cells // cols):
        for c in range(cols):
            after[r * cols + c] = math.sqrt(np.float64((r - goal_r) ** 2 + (c - goal_c) ** 2))
    first, beyond = np.empty(cells, np.int32), np.empty(cells, np.int32)
    find_runs(blocked, cols, first, beyond)
    slot = np.empty(cells, np.int32)  # only those of the pool are read
    for i in range(pool.shape[0]):
        slot[pool[i]] = i
    distance, key = np.full(pool.shape[0], np.inf), np.full(pool.shape[0], np.inf)
    parent = np.full(pool.shape[0], np.int32(-1), np.int32)
    heap, place = np.empty(pool.shape[0], np.int32), np.full(pool.shape[0], np.int32(-1), np.int32)
    seen, stack = np.empty((ROOM, 3), np.int64), np.empty((ROOM, 8), np.int64)
    distance[0] = 0.0
    key[0] = after[start]
    size = push(heap, place, key, 0, 0)
    while size > 0:
        here = pop(heap, place, key, size)
        size -= 1
        if here == 1:
            return path_to(1, parent, pool)
        cell, far_here = np.int64(pool[here]), distance[here]
        r, c = cell // cols, cell % cols
        stretches, seen, stack = look(blocked, cols, first, beyond, cell, policy, after, limit - far_here, seen, stack)
        for k in range(stretches):
            dr, base = seen[k, 0] - r, seen[k, 0] * cols
            for j in range(seen[k, 1], seen[k, 2] + 1):
                if not inside[base + j]:
                    continue
                there = slot[base + j]
                far = far_here + math.sqrt(np.float64(dr * dr + (j - c) * (j - c)))
                if far < distance[there] and far + after[base + j] < limit:
                    distance[there], parent[there] = far, here
                    key[there] = far + after[base + j]
                    size = push(heap, place, key, size, there)
    return np.empty(0, np.int32)


@kernel("i4[::1](i4[:, ::1], i8[::1], u1[::1], i8, i8, i8, i8)")
def pooled(population, order, blocked, cols, policy, halo, room):
    """Return the shortest any-angle path over the points of all paths and the cells near them.

    The pool: the points of every path first, then what lies within ``halo`` rows
    and columns of those of one path after the other, in the given order, until it
    holds ``room`` cells. Where it has no shorter path, the first one of the order.
    """
    best = population[order[0]]
    start, goal = best[0], best[length_of(best) - 1]
    if start == goal:
        return best[:1].copy()
    inside = np.zeros(blocked.shape[0], np.bool_)
    pool = np.empty(room, np.int32)
    pool[0], pool[1] = start, goal
    inside[start] = inside[goal] = True
    size = 2
    for k in order:
        size = _add_near(population[k], length_of(population[k]), inside, blocked, cols, 0, pool, size)
    if halo > 0:
        for k in order:
            size = _add_near(population[k], length_of(population[k]), inside, blocked, cols, halo, pool, size)
    limit = length_between(best, 0, length_of(best) - 1, cols) - SLACK
    path = _shortest_over(pool[:size], inside, blocked, cols, policy, limit)
    return path if path.shape[0] > 0 else best.copy()
