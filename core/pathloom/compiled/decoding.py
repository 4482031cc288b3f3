"""Real vectors as paths, how far a path lies in obstacles, and the cells along a curve."""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import blank, length_of, row_of, unpack, with_room
from pathloom.compiled.segments import segment_free

SAME = 1e-9
"""Share of a chord: borders that it crosses within less are crossed at once, in the corner that they share."""


@part("i8(f8, i8)")
def _step_of(gene, steps):
    """Return in which of so many equal parts of [0, 1] a gene lies; genes beyond belong to the outer parts."""
    return min(max(np.int64(math.floor(gene * steps)), 0), steps - 1)


@kernel("i4[:, ::1](f8[:, ::1], i8, i8, i8, i8, b1)")
def through_lines(genes, start, goal, rows, cols, by_rows):
    """Decode one gene for each row, or else column, strictly between start and goal: where the path crosses it."""
    n, d = genes.shape
    out = blank(n, d + 1 if start == goal else d + 2)
    first = start // cols if by_rows else start % cols
    last = goal // cols if by_rows else goal % cols
    step = 1 if last > first else -1
    for k in range(n):
        out[k, 0] = start
        for i in range(d):
            line = first + (i + 1) * step
            if by_rows:
                out[k, i + 1] = line * cols + _step_of(genes[k, i], cols)
            else:
                out[k, i + 1] = _step_of(genes[k, i], rows) * cols + line
        if start != goal:
            out[k, d + 1] = goal
    return out


@kernel("i4[:, ::1](f8[:, ::1], i8, i8, i8, i8)")
def through_points(genes, start, goal, rows, cols):
    """Decode pairs of genes, row and column of one point each; points in the cell of the one before are passed over."""
    n, points = genes.shape[0], genes.shape[1] // 2
    out = blank(n, points + 2)
    for k in range(n):
        out[k, 0] = start
        if start == goal:
            continue
        kept = 1
        for i in range(points + 1):
            cell = goal
            if i < points:
                cell = _step_of(genes[k, 2 * i], rows) * cols + _step_of(genes[k, 2 * i + 1], cols)
            if cell != out[k, kept - 1]:
                out[k, kept] = cell
                kept += 1
    return out


@part("f8(u1[::1], i8, i8, i8, i8)")
def _length_inside(blocked, cols, a, dr, dc):
    """Return how long the segment from cell a over (dr, dc) runs inside obstacles.

    Along the longer axis, of extent n ≥ m, the segment is at t = 0 … 1 over
    (n t, m t). It is inside the cell (i, j) for (i ± ½) / n and (j ± ½) / m
    between 0 and 1; times 2 n m these are integers, and their sum is exact.
    """
    step_r = cols if dr > 0 else -cols
    step_c = 1 if dc > 0 else -1
    if abs(dc) >= abs(dr):
        n, m, along, across = abs(dc), abs(dr), step_c, step_r
    else:
        n, m, along, across = abs(dr), abs(dc), step_r, step_c
    if n == 0:
        return 0.0
    if m == 0:
        inside = np.int64(blocked[a]) + np.int64(blocked[a + n * along])  # half a cell at each end
        for i in range(1, n):
            inside += 2 * blocked[a + i * along]
        return 0.5 * inside
    cell, i, j = a, 0, 0
    entered, inside, end = 0, 0, 2 * n * m
    while entered < end:
        next_i, next_j = (2 * i + 1) * m, (2 * j + 1) * n  # where the cell is left on either axis
        left = min(next_i, next_j, end)
        if blocked[cell]:
            inside += left - entered
        if next_i == left:
            i += 1
            cell += along
        if next_j == left:
            j += 1
            cell += across
        entered = left
    return inside / end * math.sqrt(n * n + m * m)


@kernel("f8[::1](i4[:, ::1], u1[::1], i8, i8)")
def violations(population, blocked, cols, policy):
    """Return for each path its length inside obstacles plus the number of its segments that are not free.

    It is 0 where the path is free under the corner policy, and nowhere else:
    segments that only break the rule about corners count, too.
    """
    per_row = 1.0 / cols
    found = np.zeros(population.shape[0])
    for k in range(population.shape[0]):
        total = 0.0
        for i in range(length_of(population[k]) - 1):
            a, b = np.int64(population[k, i]), np.int64(population[k, i + 1])
            dr = row_of(b, per_row) - row_of(a, per_row)
            dc = b - a - dr * cols
            inside = _length_inside(blocked, cols, a, dr, dc)
            if inside > 0.0 or (policy != 0 and not segment_free(blocked, cols, a, dr, dc, policy)):
                total += inside + 1.0
        found[k] = total
    return found


@part("void(f8[:, :, ::1], i8, f8, f8[:, ::1])")
def _point_at(pieces, which, t, work):
    """Put the point of a Bézier piece at t into work[0], by de Casteljau's algorithm."""
    last = pieces.shape[1] - 1
    for k in range(last + 1):
        work[k, 0], work[k, 1] = pieces[which, k, 0], pieces[which, k, 1]
    for level in range(last, 0, -1):
        for k in range(level):
            for x in range(2):
                work[k, x] += t * (work[k + 1, x] - work[k, x])


@part("i8(f8[:, :, ::1], i8, f8)")
def _parts(pieces, which, step):
    """Return into how many equal parts of t a Bézier piece is cut so that none is longer than a step.

    The speed is at most the degree times the longest leg of the control polygon.
    """
    last = pieces.shape[1] - 1
    longest = 0.0
    for k in range(last):
        longest = max(
            longest,
            math.hypot(pieces[which, k + 1, 0] - pieces[which, k, 0], pieces[which, k + 1, 1] - pieces[which, k, 1]),
        )
    return max(np.int64(math.ceil(last * longest / step)), 1)


@kernel("f8[:, ::1](f8[:, :, ::1], f8)")
def sample_curve(pieces, step):
    """Return points (m, 2) on a chain of Bézier pieces (s, degree + 1, 2), no further apart than a step.

    Points on a border between cells are left out, so that each lies in one cell;
    then two may be up to two steps apart.
    """
    count = 1
    for p in range(pieces.shape[0]):
        count += _parts(pieces, p, step)
    points = np.empty((count, 2))
    work = np.empty((pieces.shape[1], 2))
    points[0, 0], points[0, 1] = pieces[0, 0, 0], pieces[0, 0, 1]
    n = 1
    for p in range(pieces.shape[0]):
        parts = _parts(pieces, p, step)
        for i in range(1, parts + 1):
            _point_at(pieces, p, i / parts, work)
            r, c = work[0, 0], work[0, 1]
            if r - math.floor(r) != 0.5 and c - math.floor(c) != 0.5:
                points[n, 0], points[n, 1] = r, c
                n += 1
    trimmed = np.empty((n, 2))
    for k in range(n):
        trimmed[k, 0], trimmed[k, 1] = points[k, 0], points[k, 1]
    return trimmed


@kernel("Tuple((i4[:, ::1], f8[::1], f8[::1]))(f8[:, :, :, ::1], i8, f8, f8[::1], f8)")
def along_curves(pieces, cols, step, distance, safe):
    """Follow curves, chains of Bézier pieces (n, s, degree + 1, 2), from cell to cell.

    Returns the cells that the chords between the points of `sample_curve` cross,
    in order, one step of eight apart, with a diagonal step where a chord passes
    through a corner; the chords' length; and how far, on average over the points, the
    distance of their cells (``distance``, by cell) falls short of a safe one, as
    a share of that.
    """
    n = pieces.shape[0]
    flat = np.empty(64 * n + 64, np.int32)
    begin = np.zeros(n + 1, np.int64)
    lengths, shortage = np.zeros(n), np.zeros(n)
    at = 0
    for k in range(n):
        points = sample_curve(pieces[k], step)
        m = points.shape[0]
        r = c = 0
        for i in range(m):
            to_r, to_c = np.int64(math.floor(points[i, 0] + 0.5)), np.int64(math.floor(points[i, 1] + 0.5))
            shortage[k] += max(0.0, safe - distance[to_r * cols + to_c]) / (safe * m)
            flat = with_room(flat, at, 2)
            if i > 0:
                dr, dc = points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1]
                lengths[k] += math.hypot(dr, dc)
                if to_r != r and to_c != c:
                    over_r = (0.5 * (r + to_r) - points[i - 1, 0]) / dr  # where on the chord the row is left
                    over_c = (0.5 * (c + to_c) - points[i - 1, 1]) / dc
                    if abs(over_r - over_c) > SAME:
                        flat[at] = to_r * cols + c if over_r < over_c else r * cols + to_c
                        at += 1
            if i == 0 or to_r != r or to_c != c:
                flat[at] = to_r * cols + to_c
                at += 1
            r, c = to_r, to_c
        begin[k + 1] = at
    return unpack(flat, begin, n), lengths, shortage
