"""Seeding: diverse paths along shortest trees over randomly priced cells."""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below, uniform
from pathloom.compiled.rows import copy, remove_loops, unpack, with_room

SQRT2 = math.sqrt(2.0)


@part("f8(u1[::1], f4[::1], i8, i8, i8, f8, f8, f8[::1], i4[::1])")
def flood(moves, price, cols, root, target, most, stretch, distance, parent):
    """Grow a shortest tree from the root until past ``stretch`` times the target's distance; return that distance.

    A step costs its length times the mean price of its two cells, each in
    [1, most]. Cells wait in buckets one unit wide (Dial 1969): no step is
    shorter, so that whatever stands in the nearest bucket is final. Cells that
    the tree did not reach are left at inf, those at its rim not final but beyond
    the limit.
    """
    cells = moves.shape[0]
    ring = np.int64(math.ceil(most * SQRT2)) + 2
    first = np.full(ring, np.int32(-1), np.int32)
    after = np.empty(cells, np.int32)
    before = np.empty(cells, np.int32)
    for cell in range(cells):
        distance[cell] = np.inf
        parent[cell] = -1
    distance[root] = 0.0
    first[0] = root
    after[root] = before[root] = -1
    waiting = 1
    level = 0
    limit = np.inf
    while waiting > 0 and level <= limit:
        slot = level % ring
        while first[slot] >= 0:
            here = np.int64(first[slot])
            first[slot] = after[here]
            if after[here] >= 0:
                before[after[here]] = -1
            waiting -= 1
            if here == target:
                limit = stretch * distance[here]
            for d in range(8):
                if moves[here] >> d & 1:
                    there = here + DR[d] * cols + DC[d]
                    step = (SQRT2 if d % 2 == 1 else 1.0) * (0.5 * (price[here] + price[there]))
                    far = distance[here] + step
                    if far < distance[there]:
                        if distance[there] < np.inf:  # out of the bucket where it stood
                            old = np.int64(distance[there]) % ring
                            if before[there] >= 0:
                                after[before[there]] = after[there]
                            else:
                                first[old] = after[there]
                            if after[there] >= 0:
                                before[after[there]] = before[there]
                            waiting -= 1
                        distance[there] = far
                        parent[there] = here
                        new = np.int64(far) % ring
                        before[there] = -1
                        after[there] = first[new]
                        if first[new] >= 0:
                            before[first[new]] = there
                        first[new] = there
                        waiting += 1
        level += 1
    return distance[target]


@kernel("i4[:, ::1](i8, i8, u1[::1], i8, i8, i8, i4[::1], f8, f8, u8[::1])")
def sample_from_trees(n, pairs, moves, cols, start, goal, reachable, spread, detour, state):
    """Draw n paths through random way-points, along pairs of shortest trees, from start and from goal.

    Every cell's price is uniform in [1, 1 + spread], anew for every tree. A
    way-point's detour through both trees is at most ``detour`` times the direct
    way. The n paths are shared out evenly among the pairs.
    """
    cells = moves.shape[0]
    price = np.ones(cells, np.float32)
    from_start, from_goal = np.empty(cells), np.empty(cells)
    back, onward = np.empty(cells, np.int32), np.empty(cells, np.int32)
    near = np.empty(reachable.shape[0], np.int32)
    mark = np.zeros(cells, np.int32)
    path = np.empty(256, np.int32)
    flat = np.empty(4096, np.int32)
    begin = np.zeros(n + 1, np.int64)
    done = 0
    for pair in range(pairs):
        for cell in range(cells):
            price[cell] = 1.0 + spread * uniform(state)
        there = flood(moves, price, cols, start, goal, 1.0 + spread, detour, from_start, back)
        for cell in range(cells):
            price[cell] = 1.0 + spread * uniform(state)
        again = flood(moves, price, cols, goal, start, 1.0 + spread, detour, from_goal, onward)
        limit = detour * min(there, again)
        count = 0
        for i in range(reachable.shape[0]):
            if from_start[reachable[i]] + from_goal[reachable[i]] <= limit:
                near[count] = reachable[i]
                count += 1
        last = n * (pair + 1) // pairs
        while done < last:
            through = goal if count == 0 else near[below(state, count)]
            half = 0
            cell = through
            while cell != start:
                half += 1
                cell = back[cell]
            rest = 0
            cell = through
            while cell != goal:
                rest += 1
                cell = onward[cell]
            size = half + rest + 1
            if size > path.shape[0]:
                path = np.empty(2 * size, np.int32)
            cell = through
            for i in range(half, -1, -1):
                path[i] = cell
                cell = back[cell]
            cell = through
            for i in range(half + 1, size):
                cell = onward[cell]
                path[i] = cell
            size = remove_loops(path, size, mark)
            flat = with_room(flat, begin[done], size)
            copy(flat, begin[done], path, 0, size)
            begin[done + 1] = begin[done] + size
            done += 1
    return unpack(flat, begin, n)
