"""Search step by step: octile optima."""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel

SQRT2 = math.sqrt(2.0)


@kernel("i4[::1](u1[::1], i8, i8, i8)")
def octile_path(moves, cols, start, goal):
    """Return the cells of a shortest 8-connected path (A*, Hart et al. 1968); empty where there is none."""
    cells = moves.shape[0]
    distance = np.full(cells, np.inf)
    key = np.full(cells, np.inf)
    parent = np.full(cells, np.int32(-1), np.int32)
    heap = np.empty(cells, np.int32)
    place = np.full(cells, np.int32(-1), np.int32)
    closed = np.zeros(cells, np.bool_)
    goal_r, goal_c = goal // cols, goal % cols
    distance[start] = key[start] = 0.0
    size = push(heap, place, key, 0, start)
    while size > 0:
        here = pop(heap, place, key, size)
        size -= 1
        closed[here] = True
        if here == goal:
            count = 1
            while here != start:
                here = parent[here]
                count += 1
            path = np.empty(count, np.int32)
            here = goal
            for i in range(count - 1, -1, -1):
                path[i] = here
                here = parent[here]
            return path
        for d in range(8):
            if moves[here] >> d & 1:
                there = here + DR[d] * cols + DC[d]
                if closed[there]:
                    continue
                far = distance[here] + (SQRT2 if d % 2 == 1 else 1.0)
                if far < distance[there] - 1e-9:
                    distance[there] = far
                    parent[there] = here
                    dr, dc = abs(there // cols - goal_r), abs(there % cols - goal_c)
                    key[there] = far + max(dr, dc) + (SQRT2 - 1.0) * min(dr, dc)
                    size = push(heap, place, key, size, there)
    return np.empty(0, np.int32)
