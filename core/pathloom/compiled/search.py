"""Kernels that search: shortest trees, octile and any-angle optima, seeds from perturbed trees."""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below, uniform
from pathloom.compiled.rows import copy, remove_loops, unpack, with_room
from pathloom.compiled.segments import segment_free

SQRT2 = math.sqrt(2.0)


@part("i8(i4[::1], i4[::1], f8[::1], i8, i8)")
def _push(heap, place, key, size, item):
    """Put an item into the heap, or move it up after its key fell; return the size."""
    i = place[item]
    if i < 0:
        i = size
        size += 1
    while i > 0:
        up = (i - 1) // 2
        if key[heap[up]] <= key[item]:
            break
        heap[i] = heap[up]
        place[heap[i]] = i
        i = up
    heap[i] = item
    place[item] = i
    return size


@part("i8(i4[::1], i4[::1], f8[::1], i8)")
def _pop(heap, place, key, size):
    """Take the item with the least key out of the heap of this size; place[item] becomes −1."""
    least = heap[0]
    place[least] = -1
    last = heap[size - 1]
    size -= 1
    i = 0
    while size > 0:
        down = 2 * i + 1
        if down >= size:
            break
        if down + 1 < size and key[heap[down + 1]] < key[heap[down]]:
            down += 1
        if key[heap[down]] >= key[last]:
            break
        heap[i] = heap[down]
        place[heap[i]] = i
        i = down
    if size > 0:
        heap[i] = last
        place[last] = i
    return least


@kernel("Tuple((f8[::1], i4[::1]))(u1[::1], f4[::1], i8, i8)")
def tree(moves, price, cols, root):
    """Return distances from the root to every cell and the tree's parents (Dijkstra 1959).

    A step costs its length times the mean price of its two cells; the distance
    of a cell that cannot be reached is inf and its parent −1. An empty ``price``
    stands for ones.
    """
    cells = moves.shape[0]
    distance = np.full(cells, np.inf)
    parent = np.full(cells, np.int32(-1), np.int32)
    heap = np.empty(cells, np.int32)
    place = np.full(cells, np.int32(-1), np.int32)
    plain = price.shape[0] == 0
    distance[root] = 0.0
    size = _push(heap, place, distance, 0, root)
    while size > 0:
        here = _pop(heap, place, distance, size)
        size -= 1
        for d in range(8):
            if moves[here] >> d & 1:
                there = here + DR[d] * cols + DC[d]
                step = SQRT2 if d % 2 == 1 else 1.0
                if not plain:
                    step *= 0.5 * (price[here] + price[there])
                if distance[here] + step < distance[there]:
                    distance[there] = distance[here] + step
                    parent[there] = here
                    size = _push(heap, place, distance, size, there)
    return distance, parent


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
    size = _push(heap, place, key, 0, start)
    while size > 0:
        here = _pop(heap, place, key, size)
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
                    size = _push(heap, place, key, size, there)
    return np.empty(0, np.int32)


@kernel("i4[:, ::1](i8, u1[::1], i8, i8, i8, i4[::1], f8, f8, u8[::1])")
def sample_from_trees(n, moves, cols, start, goal, reachable, spread, detour, state):
    """Draw n paths through random way-points, along two shortest trees over randomly priced cells.

    Every cell's price is uniform in [1, 1 + spread]. A way-point's detour
    through both trees is at most ``detour`` times the direct way.
    """
    cells = moves.shape[0]
    price = np.ones(cells, np.float32)
    for cell in range(cells):
        price[cell] = 1.0 + spread * uniform(state)
    from_start, back = tree(moves, price, cols, start)
    for cell in range(cells):
        price[cell] = 1.0 + spread * uniform(state)
    from_goal, onward = tree(moves, price, cols, goal)
    limit = detour * min(from_start[goal], from_goal[start])
    near = np.empty(reachable.shape[0], np.int32)
    count = 0
    for i in range(reachable.shape[0]):
        if from_start[reachable[i]] + from_goal[reachable[i]] <= limit:
            near[count] = reachable[i]
            count += 1
    mark = np.zeros(cells, np.int32)
    path = np.empty(256, np.int32)
    flat = np.empty(4096, np.int32)
    begin = np.zeros(n + 1, np.int64)
    for k in range(n):
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
        flat = with_room(flat, begin[k], size)
        copy(flat, begin[k], path, 0, size)
        begin[k + 1] = begin[k] + size
    return unpack(flat, begin, n)


@kernel("Tuple((i4[::1], i8))(u1[::1], i8, i8, i8, i8, f8[::1], f8[::1], f8, i8)")
def any_angle_path(blocked, cols, start, goal, policy, before, after, upper, work):
    """Return a shortest path over the centres of all free cells, and the work that it took.

    A* over the visibility graph of all cells, whose edges are tested only where
    they would shorten a known way. ``before`` and ``after`` are lower bounds of
    each cell's distance to start and goal, ``after`` consistent; ``upper`` is
    the length of some path. Gives an empty path when ``work`` pairs of cells
    were not enough.
    """
    slack = 1e-9
    cells = blocked.shape[0]
    count = 0
    for cell in range(cells):
        if not blocked[cell] and before[cell] + after[cell] <= upper + slack:
            count += 1
    ids = np.empty(count, np.int32)
    slot = np.full(cells, np.int32(-1), np.int32)
    k = 0
    for cell in range(cells):
        if not blocked[cell] and before[cell] + after[cell] <= upper + slack:
            ids[k] = cell
            slot[cell] = k
            k += 1
    row, col, bound = np.empty(count), np.empty(count), np.empty(count)
    for i in range(count):
        row[i], col[i], bound[i] = ids[i] // cols, ids[i] % cols, after[ids[i]]
    distance = np.full(count, np.inf)
    key = np.full(count, np.inf)
    parent = np.full(count, np.int32(-1), np.int32)
    heap = np.empty(count, np.int32)
    place = np.full(count, np.int32(-1), np.int32)
    # The cells still open stand in front of the list, so that the scan shortens as the search goes on.
    waiting = np.arange(count).astype(np.int32)
    where = np.arange(count).astype(np.int32)
    left = count
    source, target = slot[start], slot[goal]
    distance[source] = 0.0
    key[source] = bound[source]
    size = _push(heap, place, key, 0, source)
    done = 0
    while size > 0:
        here = _pop(heap, place, key, size)
        size -= 1
        if here == target:
            steps = 1
            i = here
            while i != source:
                i = parent[i]
                steps += 1
            path = np.empty(steps, np.int32)
            i = here
            for s in range(steps - 1, -1, -1):
                path[s] = ids[i]
                i = parent[i]
            return path, done
        left -= 1
        swapped = waiting[left]
        waiting[where[here]] = swapped
        where[swapped] = where[here]
        done += left
        if done > work:
            break
        r, c, g = row[here], col[here], distance[here]
        for w in range(left):
            there = waiting[w]
            dr, dc = row[there] - r, col[there] - c
            far = g + math.sqrt(dr * dr + dc * dc)
            if far < distance[there] - slack and far + bound[there] <= upper + slack:
                done += 10
                if segment_free(blocked, cols, ids[here], np.int64(dr), np.int64(dc), policy):
                    distance[there] = far
                    parent[there] = here
                    key[there] = far + bound[there]
                    size = _push(heap, place, key, size, there)
                    if there == target:
                        upper = min(upper, far)
    return np.empty(0, np.int32), done
