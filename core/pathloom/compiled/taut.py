"""Taut paths: shortest ways in the plane around the obstacle squares, from corner to corner.

A shortest way of a point is straight but at corners of obstacles, about which it
bends. Behind each corner that it may reach, what comes into sight is swept row by
row in cones of rays, much as the intervals of Anya (Harabor, Grastien, Öz and
Aksakalli 2016); the corners that cones meet wait in a heap for their turn. Cones
and coordinates are those of `sight`: doubled, exact integers. Only lengths are
floating-point.
"""

import math

import numpy as np

from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.sight import ROOM, ceiling, find_runs, floor, left_of, put, with_row

SLACK = 1e-9
"""Half cells by which lengths may differ and count as equal."""
TO_COLUMN, TO_ROW = 0, 1
"""How a way bends at a corner: towards the vertical, or towards the horizontal."""


@part("i8(u1[::1], i8, i8)")
def _around(blocked, cols, cell):
    """Return how many obstacles have the lower right corner of a cell."""
    return np.int64(blocked[cell]) + blocked[cell + 1] + blocked[cell + cols] + blocked[cell + cols + 1]


@part("i8(u1[::1], i8, i8, i4[::1])")
def _number_bends(blocked, cols, policy, bends):
    """Give the ways to bend at the lower right corner of each cell a number, or −1; return how many there are.

    At the corner of one obstacle there are two, towards the vertical and towards
    the horizontal. Between two that share it diagonally, where the policy lets
    a way through, there are two in each vertical sense.
    """
    count = 0
    for cell in range(blocked.shape[0]):
        bends[cell] = -1
        if cell % cols == cols - 1 or cell + cols >= blocked.shape[0]:
            continue
        around = _around(blocked, cols, cell)
        if around == 1 or (around == 2 and blocked[cell] == blocked[cell + cols + 1] and policy == 0):
            bends[cell] = count
            count += 2 * around
    return count


@part("f8(i8, i8, i8, f8, f8)")
def _over(along, across, d, left, right):
    """Return the least length from a root at 0 over the points [left, right] at distance d to (along, across).

    A target on this side of them is mirrored: it is as far from each.
    """
    ahead = max(along, 2 * d - along)
    x = min(max(across * d / ahead, left), right)
    return math.hypot(x, np.float64(d)) + math.hypot(across - x, np.float64(ahead - d))


@part("void(i8[:, ::1], i8, i8, i8, i8, i8, i8)")
def _note(met, k, y, x, kind, sense, side):
    """Write a corner that was met, and the quadrant (sense, side) into which a way may bend there."""
    met[k, 0], met[k, 1], met[k, 2], met[k, 3], met[k, 4] = y, x, kind, sense, side


@part("Tuple((i8, i8[:, ::1]))(u1[::1], i8, i4[::1], i4[::1], i8, i8, i8, i8, i8, i8[:, ::1])")
def _along_wall(blocked, cols, first, beyond, y, x, sense, side, end, met):
    """Write the corners on the line y from x to the end where obstacles on the other side of it stop."""
    base = (y // 2 - (1 if sense > 0 else 0)) * cols
    ahead = 0 if side > 0 else -1  # which of the two cells at a corner lies ahead
    count = 0
    while x != end:
        cell = base + x // 2 + ahead
        x = 2 * np.int64(beyond[cell] if side > 0 else first[cell])
        if (x - end) * side > 0 or x == 0 or x == 2 * cols:
            break
        if blocked[cell] and not blocked[base + x // 2 + ahead]:
            met = with_row(met, count)
            _note(met, count, y, x, TO_COLUMN, -sense, side)
            count += 1
    return count, met


@part("void(f8[::1], i8, i8, i8, f8, i8, i8)")
def _measure(distance, base, x, d, g, low, high):
    """Lower the distance of the cells low to high of a row at distance d from the root to that through the root."""
    for c in range(low, high + 1):
        far = g + math.sqrt(np.float64((2 * c + 1 - x) ** 2 + d * d))
        distance[base + c] = min(distance[base + c], far)


@part(
    "Tuple((i8, i8[:, ::1], i8[:, ::1]))"
    "(u1[::1], i8, i4[::1], i4[::1], i8, i8, i8, f8, i8, i8, f8, f8[::1], i8, i8[:, ::1], i8[:, ::1])"
)
def _sweep(blocked, cols, first, beyond, y, x, s, g, ty, tx, upper, distance, count, met, stack):
    """Follow the cone on the stack, row by row; measure the cells in it, and add the corners that it meets.

    Where a cone leaves a row it meets the near ends of the next row's runs, and
    the far ends of its own run behind which the next row goes on. Those are all
    corners at which a way from its root can bend. Cones over which the target is
    farther than ``upper`` are dropped.
    """
    rows = blocked.shape[0] // cols
    depth = 1
    while depth > 0:
        depth -= 1
        row, d = stack[depth, 0] + s, stack[depth, 1]
        lx, ld, rx, rd = stack[depth, 2], stack[depth, 3], stack[depth, 4], stack[depth, 5]
        left, right = stack[depth, 6], stack[depth, 7]
        if row < 0 or row >= rows or g + _over(s * (ty - y), tx - x, d, lx * d / ld, rx * d / rd) > upper + SLACK:
            continue
        line, base = y + s * d, row * cols
        met = with_row(met, count + 1)
        if 0 < left <= x and lx * d == (left - x) * ld and not blocked[base + left // 2 - 1]:
            _note(met, count, line, left, TO_ROW, s, -1)
            count += 1
        if x <= right < 2 * cols and rx * d == (right - x) * rd and not blocked[base + right // 2]:
            _note(met, count, line, right, TO_ROW, s, 1)
            count += 1
        c = max(ceiling(x * ld + lx * d, 2 * ld) - 1, 0)
        end = min(floor(x * rd + rx * d, 2 * rd), cols - 1)
        while c <= end:
            cell = base + c
            c = np.int64(beyond[cell])
            if blocked[cell]:
                continue
            a, b = 2 * np.int64(first[cell]), 2 * c
            met = with_row(met, count + 1)
            if a > x and not left_of(a - x, d, lx, ld) and not left_of(rx, rd, a - x, d):
                _note(met, count, line, a, TO_COLUMN, s, 1)
                count += 1
            if b < x and not left_of(b - x, d, lx, ld) and not left_of(rx, rd, b - x, d):
                _note(met, count, line, b, TO_COLUMN, s, -1)
                count += 1
            nlx, nld, nrx, nrd = lx, ld, rx, rd
            if left_of(nlx, nld, a - x, d):
                nlx, nld = a - x, d
            if left_of(b - x, d, nrx, nrd):
                nrx, nrd = b - x, d
            if not left_of(nlx, nld, nrx, nrd):
                continue  # no more than a ray: what it leads to is behind a corner on it
            m = d + 1
            low = max(x + ceiling(nlx * m, nld), a + 1) // 2
            _measure(distance, base, x, m, g, low, (min(x + floor(nrx * m, nrd), b - 1) - 1) // 2)
            m = d + 2
            if left_of(nlx, nld, a - x, m):
                nlx, nld = a - x, m
            if left_of(b - x, m, nrx, nrd):
                nrx, nrd = b - x, m
            if not left_of(nrx, nrd, nlx, nld):
                stack = with_row(stack, depth)
                put(stack, depth, row, m, nlx, nld, nrx, nrd, a, b)
                depth += 1
    return count, met, stack


@kernel("Tuple((f8[::1], i4[::1]))(u1[::1], i8, i8, i8, i8, f8, b1)")
def distances(blocked, cols, source, target, policy, upper, everywhere):
    """Return the shortest ways from the source to all cells, and the corners on that to the target; in half cells.

    A corner is the lower right one of the cell of that number. Cells over which a
    way to the target is longer than ``upper`` may be inf instead. Unless
    ``everywhere``, the search ends with the target (A*, by the straight line).
    """
    cells = blocked.shape[0]
    first, beyond = np.empty(cells, np.int32), np.empty(cells, np.int32)
    find_runs(blocked, cols, first, beyond)
    bends = np.empty(cells, np.int32)
    n = _number_bends(blocked, cols, policy, bends)
    # Of each bend: the way to its corner, that and on to the target, the bend before, the corner,
    # the ray on which the way comes in, and how it bends: sense, side and kind.
    far, key = np.full(n, np.inf), np.full(n, np.inf)
    parent, corner = np.full(n, np.int32(-1), np.int32), np.empty(n, np.int32)
    in_y, in_x = np.empty(n, np.int32), np.empty(n, np.int32)
    sense, side, kind = np.empty(n, np.int8), np.empty(n, np.int8), np.empty(n, np.int8)
    heap, place = np.empty(n, np.int32), np.full(n, np.int32(-1), np.int32)
    size = 0
    distance = np.full(cells, np.inf)
    stack, met = np.empty((ROOM, 8), np.int64), np.empty((ROOM, 5), np.int64)
    ty, tx = 2 * (target // cols) + 1, 2 * (target % cols) + 1
    last = np.int64(-1)
    here = np.int64(-1)  # no bend: the source
    while True:
        count = 0
        reached = distance[target]
        if here < 0:
            y, x, g = 2 * (source // cols) + 1, 2 * (source % cols) + 1, 0.0
            a, b = np.int64(first[source]), np.int64(beyond[source])
            _measure(distance, y // 2 * cols, x, 0, g, a, b - 1)
            for s in (-1, 1):
                put(stack, 0, y // 2, 1, 2 * a - x, 1, 2 * b - x, 1, 2 * a, 2 * b)
                count, met, stack = _sweep(
                    blocked, cols, first, beyond, y, x, s, g, ty, tx, upper, distance, count, met, stack
                )
        else:
            y, x, g = 2 * (corner[here] // cols) + 2, 2 * (corner[here] % cols) + 2, far[here]
            s = np.int64(sense[here])
            row = y // 2 - (1 if s < 0 else 0)
            cell = row * cols + x // 2 - (1 if side[here] < 0 else 0)
            a, b = 2 * np.int64(first[cell]), 2 * np.int64(beyond[cell])
            if kind[here] == TO_ROW or in_y[here] == 0:
                wall = b if side[here] > 0 else a
                count, met = _along_wall(blocked, cols, first, beyond, y, x, s, np.int64(side[here]), wall, met)
            # The cone lies between the ray that comes in and the horizontal, or the vertical.
            ix, id_ = np.int64(in_x[here]), np.int64(abs(in_y[here]))
            lx, ld, rx, rd = ix, id_, ix, id_
            if side[here] > 0 and kind[here] == TO_ROW:
                rx, rd = 1, 0
            elif side[here] > 0:
                lx, ld = 0, 1
            elif kind[here] == TO_ROW:
                lx, ld = -1, 0
            else:
                rx, rd = 0, 1
            low, high = a // 2, b // 2 - 1
            if ld > 0:
                low = max(low, (x + ceiling(lx, ld)) // 2)
            if rd > 0:
                high = min(high, (x + floor(rx, rd) - 1) // 2)
            _measure(distance, row * cols, x, 1, g, low, high)
            if left_of(lx, ld, a - x, 2):
                lx, ld = a - x, 2
            if left_of(b - x, 2, rx, rd):
                rx, rd = b - x, 2
            if not left_of(rx, rd, lx, ld):
                put(stack, 0, row, 2, lx, ld, rx, rd, a, b)
                count, met, stack = _sweep(
                    blocked, cols, first, beyond, y, x, s, g, ty, tx, upper, distance, count, met, stack
                )
        if distance[target] < reached:
            last = here
        for k in range(count):
            py, px, bent, s = met[k, 0], met[k, 1], met[k, 2], met[k, 3]
            at = (py // 2 - 1) * cols + px // 2 - 1
            if bends[at] < 0:
                continue
            i = bends[at] + bent + (2 if s > 0 and _around(blocked, cols, at) == 2 else 0)
            vy, vx = py - y, px - x
            length = g + math.sqrt(np.float64(vy * vy + vx * vx))
            onward = math.sqrt(np.float64((py - ty) ** 2 + (px - tx) ** 2))
            # Of two ways as long either will do: where only the one can bend, the other is shorter without the corner.
            if length >= far[i] - SLACK or length + onward > upper + SLACK:
                continue
            far[i], key[i] = length, length + onward
            parent[i], corner[i] = here, at
            in_y[i], in_x[i] = vy, vx
            sense[i], side[i], kind[i] = s, met[k, 4], bent
            size = push(heap, place, key, size, i)
        if size == 0:
            break
        here = np.int64(pop(heap, place, key, size))
        size -= 1
        if not everywhere and key[here] >= distance[target]:
            break
    count = 0
    here = last
    while here >= 0:
        count += 1
        here = np.int64(parent[here])
    path = np.empty(count, np.int32)
    for k in range(count - 1, -1, -1):
        path[k] = corner[last]
        last = np.int64(parent[last])
    return distance, path
