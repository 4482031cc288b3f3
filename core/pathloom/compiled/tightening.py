"""Tightening: paths made shorter on their own side of the obstacles."""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import blank, copy, length_between, length_of, path_to, row_of, trimmed, unpack, with_room
from pathloom.compiled.segments import drop_points, segment_free

SLACK = 1e-9
"""What a path must get shorter by, so that rounding keeps nobody busy."""


@part("b1(u1[::1], i8, i8, i8, i8, f8)")
def _sees(blocked, cols, a, b, policy, per_row):
    """Say whether two cells see each other."""
    dr = row_of(b, per_row) - row_of(a, per_row)
    return segment_free(blocked, cols, a, dr, b - a - dr * cols, policy)


@part("f8(i8, i8, i8, i8)")
def _apart(r0, c0, r1, c1):
    return math.sqrt((r1 - r0) * (r1 - r0) + (c1 - c0) * (c1 - c0))


@part("i8(i8, i8, i8, u1[::1], i8, i8)")
def _pulled_point(before, cell, after, blocked, cols, policy):
    """Return the cell to which a point slides, step by step, between the one before it and the one after."""
    rows = blocked.shape[0] // cols
    per_row = 1.0 / cols
    ra, rb = row_of(before, per_row), row_of(after, per_row)
    ca, cb = before - ra * cols, after - rb * cols
    while True:
        r = row_of(cell, per_row)
        c = cell - r * cols
        least = _apart(ra, ca, r, c) + _apart(r, c, rb, cb) - SLACK
        best = cell
        for y in range(max(0, r - 1), min(rows, r + 2)):
            for x in range(max(0, c - 1), min(cols, c + 2)):
                one = y * cols + x
                if blocked[one]:
                    continue
                far = _apart(ra, ca, y, x) + _apart(y, x, rb, cb)
                if (
                    far < least
                    and _sees(blocked, cols, before, one, policy, per_row)
                    and _sees(blocked, cols, one, after, policy, per_row)
                ):
                    least, best = far, one
        if best == cell:
            return cell
        cell = best


@kernel("i4[:, ::1](i4[:, ::1], u1[::1], i8, i8, i8)")
def pulled(population, blocked, cols, policy, sweeps):
    """Pull each path taut: drop points, and let the others slide to where the path is shortest, one after the other.

    Ends when a sweep over all points moves none, or after ``sweeps``.
    """
    n, width = population.shape
    out = blank(n, width)
    for k in range(n):
        path = out[k]
        full = length_of(population[k])
        copy(path, 0, population[k], 0, full)
        count = drop_points(path, full, blocked, cols, policy, 0)
        for _ in range(sweeps):
            moved = False
            for i in range(1, count - 1):
                cell = _pulled_point(path[i - 1], path[i], path[i + 1], blocked, cols, policy)
                moved = moved or cell != path[i]
                path[i] = cell
            if not moved:
                break
            count = drop_points(path, count, blocked, cols, policy, 0)
        for i in range(count, full):
            path[i] = -1
    return trimmed(out)


@part("i4[::1](i4[::1], i8, u1[::1], i8, i8, i8)")
def _through_band(path, count, blocked, cols, policy, radius):
    """Return the shortest path through cells near the points of a path; empty where it is not shorter.

    A layer is what is free within ``radius`` rows and columns of a point. The
    path goes from cell to cell of the same layer, the next or the next but one.
    """
    rows = blocked.shape[0] // cols
    per_row = 1.0 / cols
    if count < 3:
        return path[:0]
    side = 2 * radius + 1
    room = (count - 2) * side * side + 2
    cell = np.empty(room, np.int32)
    row, col = np.empty(room), np.empty(room)
    begin = np.empty(count + 2, np.int64)
    size = 0
    for layer in range(count):
        begin[layer] = size
        reach = 0 if layer == 0 or layer == count - 1 else radius
        r0 = row_of(path[layer], per_row)
        c0 = path[layer] - r0 * cols
        for r in range(max(0, r0 - reach), min(rows, r0 + reach + 1)):
            for c in range(max(0, c0 - reach), min(cols, c0 + reach + 1)):
                if not blocked[r * cols + c]:
                    cell[size], row[size], col[size] = r * cols + c, r, c
                    size += 1
    begin[count] = begin[count + 1] = size
    distance = np.empty(size)
    parent = np.empty(size, np.int32)
    done = np.empty(size, np.bool_)
    for i in range(size):
        distance[i], parent[i], done[i] = np.inf, -1, False
    distance[0] = 0.0
    goal_r, goal_c = row[size - 1], col[size - 1]
    limit = length_between(path, 0, count - 1, cols) - SLACK
    for layer in range(count - 1):
        end = begin[min(layer + 3, count)]
        for _ in range(begin[layer], begin[layer + 1]):
            here = -1
            near = np.inf
            for i in range(begin[layer], begin[layer + 1]):
                if not done[i] and distance[i] < near:
                    here, near = i, distance[i]
            if here < 0:
                break
            done[here] = True
            dr, dc = goal_r - row[here], goal_c - col[here]
            if near + math.sqrt(dr * dr + dc * dc) >= limit:
                continue
            for there in range(begin[layer], end):
                if done[there]:
                    continue
                dr, dc = row[there] - row[here], col[there] - col[here]
                far = near + math.sqrt(dr * dr + dc * dc)
                if (
                    far < distance[there]
                    and far < limit
                    and segment_free(blocked, cols, cell[here], np.int64(dr), np.int64(dc), policy)
                ):
                    distance[there], parent[there] = far, here
    if not distance[size - 1] < limit:
        return path[:0]
    return path_to(size - 1, parent, cell)


@kernel("i4[:, ::1](i4[:, ::1], u1[::1], i8, i8, i8, i8)")
def through_band(population, blocked, cols, policy, radius, rounds):
    """Shorten each path: drop points, and move the others within their neighbourhoods, all at once, round after round.

    Ends when a round makes the path no shorter, or after ``rounds``.
    """
    n = population.shape[0]
    flat = np.empty(4096, np.int32)
    begin = np.zeros(n + 1, np.int64)
    for k in range(n):
        path = population[k].copy()
        count = drop_points(path, length_of(path), blocked, cols, policy, 0)
        for _ in range(rounds):
            found = _through_band(path, count, blocked, cols, policy, radius)
            if found.shape[0] == 0:
                break
            path = found
            count = drop_points(path, path.shape[0], blocked, cols, policy, 0)
        flat = with_room(flat, begin[k], count)
        copy(flat, begin[k], path, 0, count)
        begin[k + 1] = begin[k] + count
    return unpack(flat, begin, n)
