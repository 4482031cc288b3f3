"""The shortest path over cell centres at any angle: A* over what cells see."""

import math

import numpy as np

from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.sight import ROOM, find_runs, look

SLACK = 1e-9
"""Cells by which lengths may differ and count as equal."""


@part("i4[::1](i4[::1], i4[::1], i8, i8)")
def _back(parent, ids, source, target):
    """Return the cells from source to target, along the parents."""
    steps = 1
    here = target
    while here != source:
        here = parent[here]
        steps += 1
    path = np.empty(steps, np.int32)
    for s in range(steps - 1, -1, -1):
        path[s] = ids[target]
        target = parent[target]
    return path


@kernel("Tuple((i4[::1], f8, i8))(u1[::1], i8, i8, i8, i8, f8[::1], f8[::1], f8, i8)")
def any_angle_path(blocked, cols, start, goal, policy, before, after, upper, work):
    """Return a shortest path over the centres of free cells, a lower bound of its length, and the work done.

    The path is empty where none is as short as ``upper``, or where ``work`` cells
    seen were not enough. The bound holds in any case.

    A* over the visibility graph. ``before`` and ``after`` are lower bounds of each
    cell's distance to start and goal which change along a free segment by its
    length at most (so ``after`` is consistent): distances in the plane. Whatever
    point a path of length ``upper`` passes, they sum up to ``upper`` at most, and
    at the centre of its cell, √½ away at most, to ``upper + √2``. No segment of
    such a path leaves the cells where they do: the others are taken for obstacles.
    """
    cells = blocked.shape[0]
    closed, slot = np.empty(cells, np.uint8), np.full(cells, np.int32(-1), np.int32)
    count = 0
    for cell in range(cells):
        least = before[cell] + after[cell]
        closed[cell] = blocked[cell] != 0 or not least <= upper + math.sqrt(2.0) + SLACK
        if blocked[cell] == 0 and least <= upper + SLACK:
            slot[cell] = count
            count += 1
    nothing = np.empty(0, np.int32)
    if slot[start] < 0 or slot[goal] < 0:
        return nothing, upper, 0
    ids = np.empty(count, np.int32)
    for cell in range(cells):
        if slot[cell] >= 0:
            ids[slot[cell]] = cell
    first, beyond = np.empty(cells, np.int32), np.empty(cells, np.int32)
    find_runs(closed, cols, first, beyond)
    distance, key = np.full(count, np.inf), np.full(count, np.inf)
    parent = np.full(count, np.int32(-1), np.int32)
    heap, place = np.empty(count, np.int32), np.full(count, np.int32(-1), np.int32)
    seen, stack = np.empty((ROOM, 3), np.int64), np.empty((ROOM, 8), np.int64)
    target = slot[goal]
    distance[slot[start]] = 0.0
    key[slot[start]] = after[start]
    size = push(heap, place, key, 0, slot[start])
    known, done = upper, 0
    while size > 0:
        here = pop(heap, place, key, size)
        size -= 1
        if here == target:
            return _back(parent, ids, slot[start], target), distance[target], done
        if done > work:
            return nothing, min(key[here], upper), done
        r, c, g = ids[here] // cols, ids[here] % cols, distance[here]
        rest = known - g + SLACK
        stretches, seen, stack = look(closed, cols, first, beyond, ids[here], policy, after, rest, seen, stack)
        for k in range(stretches):
            dr, base = seen[k, 0] - r, seen[k, 0] * cols
            done += seen[k, 2] - seen[k, 1] + 1
            for j in range(seen[k, 1], seen[k, 2] + 1):
                there = slot[base + j]
                if there < 0 or distance[there] <= g:
                    continue
                far = g + math.sqrt(np.float64(dr * dr + (j - c) * (j - c)))
                if far < distance[there] - SLACK and far + after[base + j] <= known + SLACK:
                    distance[there] = far
                    parent[there] = here
                    key[there] = far + after[base + j]
                    size = push(heap, place, key, size, there)
                    if there == target:
                        known = min(known, far)
    return nothing, upper, done
