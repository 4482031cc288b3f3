"""Sight: the cells whose centres a straight segment reaches from a cell, by cones of rays row by row.

Coordinates are doubled: a cell's centre is odd, its borders are even. A ray is
(across, along) with ``along`` ≥ 0 counted away from its root, so rays are
compared exactly, in integers.
"""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part

HOPE = 2.0 + 1e-6
"""Cells beyond a limit at which there is no hope to get back below it along a segment."""
ROOM = 64
"""Rows that a buffer has at first."""


@part("void(u1[::1], i8, i4[::1], i4[::1])")
def find_runs(blocked, cols, first, beyond):
    """Write for each cell where the run of equal cells of its row begins, and where the next one does."""
    for row in range(0, blocked.shape[0], cols):
        begin = 0
        for c in range(cols):
            if c + 1 == cols or blocked[row + c + 1] != blocked[row + c]:
                for k in range(begin, c + 1):
                    first[row + k] = begin
                    beyond[row + k] = c + 1
                begin = c + 1


@part("b1(i8, i8, i8, i8)")
def left_of(x, d, across, along):
    """Say whether the ray (x, d) points further left than the ray (across, along)."""
    return x * along < across * d


@part("i8(i8, i8)")
def floor(n, d):
    """Return n / d, d > 0, rounded down: exact below 2**50, and faster than a division of integers."""
    return np.int64(math.floor(np.float64(n) / np.float64(d)))


@part("i8(i8, i8)")
def ceiling(n, d):
    """Return n / d, d > 0, rounded up."""
    return -floor(-n, d)


@part("i8[:, ::1](i8[:, ::1], i8)")
def with_row(rows, used):
    """Return the buffer itself if it has another row, else a copy with twice as many."""
    if used < rows.shape[0]:
        return rows
    more = np.empty((2 * used, rows.shape[1]), np.int64)
    for i in range(used):
        for j in range(rows.shape[1]):
            more[i, j] = rows[i, j]
    return more


@part("void(i8[:, ::1], i8, i8, i8, i8, i8, i8, i8, i8, i8)")
def put(rows, k, row, d, lx, ld, rx, rd, a, b):
    """Write a cone: its row, where it leaves that, its rays, and the borders of the run of cells that it leaves."""
    rows[k, 0], rows[k, 1] = row, d
    rows[k, 2], rows[k, 3] = lx, ld
    rows[k, 4], rows[k, 5] = rx, rd
    rows[k, 6], rows[k, 7] = a, b


@part("f8(f8[::1], i8, i8, i8, i8)")
def _onward(after, cell, dr, c, source_c):
    """Return the length from a root to a cell and on from there."""
    return math.sqrt(np.float64(dr * dr + (c - source_c) * (c - source_c))) + after[cell]


@part("Tuple((i8, i8[:, ::1], i8[:, ::1]))(u1[::1], i8, i4[::1], i4[::1], i8, i8, f8[::1], f8, i8[:, ::1], i8[:, ::1])")
def look(blocked, cols, first, beyond, source, policy, after, limit, seen, stack):
    """Write what a free cell sees, as stretches (row, first column, last column); return how many, and both buffers.

    Left out are, at the ends of stretches, cells over which it is farther than
    ``limit``, ``after`` being the way on from each (that of neighbours differs by
    one at most). Where it is farther by more than two over all cells of a cone in a
    row, nothing in the cone behind that row is any nearer: a segment there passes
    the row within one cell of one of them.

    In a run of free cells that a cone enters, it sees what lies between its rays,
    and then narrows to the run's width at its far side. Under ``strict`` the rays
    themselves touch obstacles and are no part of a cone; else they are, and a cone
    may be a single ray. Runs of two rows that share a point only are parted by two
    obstacles with that corner: a squeeze.
    """
    rows = blocked.shape[0] // cols
    strict = policy == 2
    home, home_c = source // cols, source % cols
    x = 2 * home_c + 1
    seen[0, 0], seen[0, 1], seen[0, 2] = home, first[source], beyond[source] - 1
    count = 1
    for s in (-1, 1):
        left, right = 2 * np.int64(first[source]), 2 * np.int64(beyond[source])
        put(stack, 0, home, 1, left - x, 1, right - x, 1, left, right)
        depth = 1
        while depth > 0:
            depth -= 1
            row, d = stack[depth, 0] + s, stack[depth, 1]
            if row < 0 or row >= rows:
                continue
            lx, ld, rx, rd = stack[depth, 2], stack[depth, 3], stack[depth, 4], stack[depth, 5]
            left, right = stack[depth, 6], stack[depth, 7]
            base = row * cols
            c = max(ceiling(x * ld + lx * d, 2 * ld) - 1, 0)
            end = min(floor(x * rd + rx * d, 2 * rd), cols - 1)
            while c <= end:
                cell = base + c
                c = np.int64(beyond[cell])
                if blocked[cell]:
                    continue
                a, b = 2 * np.int64(first[cell]), 2 * c
                if policy != 0 and (a >= right or b <= left):
                    continue
                nlx, nld, nrx, nrd = lx, ld, rx, rd
                if left_of(nlx, nld, a - x, d):
                    nlx, nld = a - x, d
                if left_of(b - x, d, nrx, nrd):
                    nrx, nrd = b - x, d
                if left_of(nrx, nrd, nlx, nld) or (strict and not left_of(nlx, nld, nrx, nrd)):
                    continue
                m = d + 1
                low = x + (floor(nlx * m, nld) + 1 if strict else ceiling(nlx * m, nld))
                high = x + (ceiling(nrx * m, nrd) - 1 if strict else floor(nrx * m, nrd))
                low, high = max(low, a + 1) // 2, (min(high, b - 1) - 1) // 2
                hopeless = low <= high
                dr = row - home
                while low <= high:
                    far = _onward(after, base + low, dr, low, home_c)
                    hopeless = hopeless and far > limit + HOPE
                    if far <= limit:
                        break
                    low += 1
                if hopeless:
                    continue
                while low <= high and _onward(after, base + high, dr, high, home_c) > limit:
                    high -= 1
                if low <= high:
                    seen = with_row(seen, count)
                    seen[count, 0], seen[count, 1], seen[count, 2] = row, low, high
                    count += 1
                m = d + 2
                if left_of(nlx, nld, a - x, m):
                    nlx, nld = a - x, m
                if left_of(b - x, m, nrx, nrd):
                    nrx, nrd = b - x, m
                if left_of(nrx, nrd, nlx, nld) or (strict and not left_of(nlx, nld, nrx, nrd)):
                    continue
                stack = with_row(stack, depth)
                put(stack, depth, row, m, nlx, nld, nrx, nrd, a, b)
                depth += 1
    return count, seen, stack


@kernel("i4[::1](u1[::1], i8, i8, i8)")
def cells_in_sight(blocked, cols, source, policy):
    """Return the cells that a free cell sees, itself included, in no particular order."""
    cells = blocked.shape[0]
    first, beyond = np.empty(cells, np.int32), np.empty(cells, np.int32)
    find_runs(blocked, cols, first, beyond)
    seen, stack = np.empty((ROOM, 3), np.int64), np.empty((ROOM, 8), np.int64)
    count, seen, stack = look(blocked, cols, first, beyond, source, policy, np.zeros(cells), np.inf, seen, stack)
    found = np.empty(cells, np.int32)
    total = 0
    for k in range(count):
        for c in range(seen[k, 1], seen[k, 2] + 1):
            found[total] = seen[k, 0] * cols + c
            total += 1
    return found[:total].copy()
