"""Smooth curves as chains of Bézier pieces: made from control points, held against obstacles, sampled and measured.

A piece lies in the convex hull of its control points, so it departs from its
chord by no more than the farthest of them. While that is not enough to tell, the
piece is cut in two: the bound falls to about a quarter each time.
"""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part

GRAZE = 1e-9
"""Cells: what is nearer than this counts as touching, what is no deeper than this as not entering."""
FINEST = 1e-10
"""Cells: bound below which a piece is not cut any more; what is not clear by then collides."""
DEPTH = 48
"""How often a piece is cut in two at most."""
KINK = 1e-6
"""Radians: a turn from one piece to the next that is sharper is a corner."""
BACK = 3.1
"""Radians: a turn within a piece that is sharper means that the curve turns back on the spot."""
NEAR = math.sqrt(0.5)
"""Cells: half the diagonal of one."""


@kernel("f8[:, :, ::1](f8[:, ::1], i8)")
def spline_pieces(control, degree):
    """Return the Bézier pieces (n − degree, degree + 1, 2) of a B-spline with clamped uniform knots.

    Control point j of the piece over [u, v] is the spline's polar form of
    degree − j times u and j times v: de Boor's algorithm with one of the two in
    each of its rounds (Ramshaw 1989). Knots are 0, …, n − degree, the first and the
    last of them degree + 1 times.
    """
    spans = control.shape[0] - degree
    pieces = np.empty((spans, degree + 1, 2))
    d = np.empty((degree + 1, 2))
    for i in range(spans):
        for j in range(degree + 1):
            for k in range(degree + 1):
                d[k, 0], d[k, 1] = control[i + k, 0], control[i + k, 1]
            for level in range(1, degree + 1):
                at = i + 1.0 if level <= j else i + 0.0
                for k in range(degree, level - 1, -1):
                    low = max(i + k - degree, 0)
                    high = min(i + k - level + 1, spans)
                    share = (at - low) / (high - low)
                    for x in range(2):
                        d[k, x] = (1.0 - share) * d[k - 1, x] + share * d[k, x]
            pieces[i, j, 0], pieces[i, j, 1] = d[degree, 0], d[degree, 1]
    return pieces


@part("f8(f8, f8)")
def _norm(x, y):
    """Return the length of a vector."""
    return math.sqrt(x * x + y * y)


@part("b1(u1[::1], i8, i8, i8, i8, b1)")
def _closed(blocked, rows, cols, r, c, corner):
    """Say whether a cell is an obstacle, as all outside the map is; or its lower right corner between two of them."""
    if corner:
        if r < 0 or r + 1 >= rows or c < 0 or c + 1 >= cols:
            return False
        at = r * cols + c
        return (blocked[at] and blocked[at + cols + 1]) or (blocked[at + 1] and blocked[at + cols])
    return r < 0 or r >= rows or c < 0 or c >= cols or blocked[r * cols + c] != 0


@part("b1(u1[::1], i8, i8, f8, f8, f8, f8, f8, b1)")
def _apart(blocked, rows, cols, ar, ac, br, bc, half, corner):
    """Say whether a segment misses the squares of that half side about all obstacles, or all squeezed corners."""
    if corner:  # between the centres of cells
        ar, ac, br, bc = ar - 0.5, ac - 0.5, br - 0.5, bc - 0.5
    dr, dc = br - ar, bc - ac
    limit = half * (abs(dr) + abs(dc))
    left, right = min(ac, bc), max(ac, bc)
    for r in range(math.ceil(min(ar, br) - half), math.floor(max(ar, br) + half) + 1):
        first, last = left, right
        if dr != 0.0:  # the columns that it has while it is in reach of this row
            s = min(1.0, max(0.0, (r - half - ar) / dr))
            t = min(1.0, max(0.0, (r + half - ar) / dr))
            first, last = min(ac + s * dc, ac + t * dc), max(ac + s * dc, ac + t * dc)
        for c in range(math.ceil(first - half), math.floor(last + half) + 1):
            if _closed(blocked, rows, cols, r, c, corner) and (
                abs(dr * (c - ac) - dc * (r - ar)) < limit or limit == 0.0
            ):
                return False
    return True


@part("b1(u1[::1], i8, i8, f8, f8, f8, f8, i8, f8)")
def _clear(blocked, rows, cols, ar, ac, br, bc, policy, margin):
    """Say whether all within ``margin`` of a segment obeys the corner policy."""
    graze = GRAZE if policy == 2 else -GRAZE
    if not _apart(blocked, rows, cols, ar, ac, br, bc, 0.5 + graze + margin, False):
        return False
    return policy != 1 or _apart(blocked, rows, cols, ar, ac, br, bc, GRAZE + margin, True)


@part("b1(u1[::1], i8, i8, f8, f8)")
def _inside(blocked, rows, cols, r, c):
    """Say whether a point lies inside an obstacle, or outside the map."""
    row, col = math.floor(r + 0.5), math.floor(c + 0.5)
    deep = max(abs(r - row), abs(c - col)) < 0.5 - GRAZE
    return deep and _closed(blocked, rows, cols, row, col, False)


@part("f8(f8, f8, f8, f8, f8, f8)")
def _from_segment(pr, pc, ar, ac, br, bc):
    """Return the distance of a point from a segment."""
    dr, dc = br - ar, bc - ac
    squared = dr * dr + dc * dc
    t = 0.0 if squared == 0.0 else ((pr - ar) * dr + (pc - ac) * dc) / squared
    t = min(1.0, max(0.0, t))
    return _norm(pr - ar - t * dr, pc - ac - t * dc)


@part("f8(f8[:, :, ::1], i8)")
def _bound(stack, top):
    """Return how far a piece departs from its chord at most."""
    last = stack.shape[1] - 1
    most = 0.0
    for k in range(1, last):
        most = max(
            most,
            _from_segment(
                stack[top, k, 0], stack[top, k, 1], stack[top, 0, 0], stack[top, 0, 1],
                stack[top, last, 0], stack[top, last, 1],
            ),
        )  # fmt: skip
    return most


@part("void(f8[:, :, ::1], i8)")
def _halve(stack, top):
    """Cut the piece on top in two (de Casteljau), its first half on top of the second."""
    last = stack.shape[1] - 1
    for x in range(2):
        for level in range(last + 1):
            stack[top + 1, level, x] = stack[top, 0, x]
            for k in range(last - level):
                stack[top, k, x] = 0.5 * (stack[top, k, x] + stack[top, k + 1, x])


@part("f8(f8[:, :, ::1], i8, i8, i8)")
def _curvature(stack, top, end, inwards):
    """Return the curvature of a piece at one of its ends."""
    last = stack.shape[1] - 1
    if last < 2:
        return 0.0
    dr = stack[top, end + inwards, 0] - stack[top, end, 0]
    dc = stack[top, end + inwards, 1] - stack[top, end, 1]
    er = stack[top, end + 2 * inwards, 0] - stack[top, end + inwards, 0]
    ec = stack[top, end + 2 * inwards, 1] - stack[top, end + inwards, 1]
    cross, speed = abs(dr * ec - dc * er), _norm(dr, dc)
    return 0.0 if speed < GRAZE else (last - 1.0) / last * cross / (speed * speed * speed)


@part("f8(f8[:, :, ::1], i8)")
def _length(stack, top):
    """Return the length of a piece, from its chord and its control polygon (Gravesen 1997)."""
    last = stack.shape[1] - 1
    legs = 0.0
    for k in range(last):
        legs += _norm(stack[top, k + 1, 0] - stack[top, k, 0], stack[top, k + 1, 1] - stack[top, k, 1])
    chord = _norm(stack[top, last, 0] - stack[top, 0, 0], stack[top, last, 1] - stack[top, 0, 1])
    return (2.0 * chord + (last - 1.0) * legs) / (last + 1.0)


@part("void(f8[:, :, ::1], i8, f8[::1])")
def _measure(stack, top, seen):
    """Add a piece that is almost straight to ``seen``: length, greatest curvature, and its last direction."""
    last = stack.shape[1] - 1
    allowed = KINK
    for k in range(last):
        dr, dc = stack[top, k + 1, 0] - stack[top, k, 0], stack[top, k + 1, 1] - stack[top, k, 1]
        if _norm(dr, dc) < GRAZE:  # rounding gives it its direction
            continue
        turn = math.atan2(abs(seen[2] * dc - seen[3] * dr), seen[2] * dr + seen[3] * dc)
        if turn > allowed:
            seen[1] = np.inf
        allowed = BACK
        seen[2], seen[3] = dr, dc
    seen[1] = max(seen[1], _curvature(stack, top, 0, 1), _curvature(stack, top, last, -1))
    _halve(stack, top)
    seen[0] += _length(stack, top) + _length(stack, top + 1)
    seen[1] = max(seen[1], _curvature(stack, top, 0, 1))


@kernel("Tuple((b1[::1], f8[:, ::1], f8, f8))(f8[:, :, ::1], b1[::1], u1[::1], i8, i8, i8, f8)")
def sampled(pieces, straight, blocked, rows, cols, policy, tolerance):
    """Hold the pieces (m, degree + 1, 2) of a curve against the obstacles, and sample it.

    A piece that counts as free is proven so: all its chords are clear by more than
    it departs from them. Pieces that are ``straight`` are known to be free. The
    chords depart from the curve by no more than ``tolerance``.

    Returns for each piece whether it is free; the ends of the chords (n, 2); the
    curve's length and its greatest curvature, inf where it has a corner. Where not
    all pieces are free the rest means nothing.
    """
    last = pieces.shape[1] - 1
    free = np.ones(pieces.shape[0], np.bool_)
    points = np.empty((64, 2))
    points[0, 0], points[0, 1] = pieces[0, 0, 0], pieces[0, 0, 1]
    n = 1
    stack = np.empty((DEPTH + 2, last + 1, 2))
    depth = np.empty(DEPTH + 2, np.int64)
    seen = np.zeros(4)
    for m in range(pieces.shape[0]):
        for k in range(last + 1):
            stack[0, k, 0], stack[0, k, 1] = pieces[m, k, 0], pieces[m, k, 1]
        depth[0] = 0
        top = 0
        while top >= 0:
            bound = _bound(stack, top)
            clear = straight[m] or _clear(
                blocked, rows, cols, stack[top, 0, 0], stack[top, 0, 1],
                stack[top, last, 0], stack[top, last, 1], policy, bound,
            )  # fmt: skip
            done = depth[top] == DEPTH
            if clear and (bound <= tolerance or done):
                if n == points.shape[0]:
                    more = np.empty((2 * n, 2))
                    for k in range(n):
                        more[k, 0], more[k, 1] = points[k, 0], points[k, 1]
                    points = more
                points[n, 0], points[n, 1] = stack[top, last, 0], stack[top, last, 1]
                n += 1
                _measure(stack, top, seen)
                top -= 1
                continue
            if not clear and (
                bound <= FINEST or done or _inside(blocked, rows, cols, stack[top, 0, 0], stack[top, 0, 1])
            ):
                free[m] = False
                break
            _halve(stack, top)
            depth[top] += 1
            depth[top + 1] = depth[top]
            top += 1
    trimmed = np.empty((n, 2))
    for k in range(n):
        trimmed[k, 0], trimmed[k, 1] = points[k, 0], points[k, 1]
    return free, trimmed, seen[0], seen[1]


@part("f8(f8, f8, f8, f8, i8, i8)")
def _from_cell(ar, ac, br, bc, r, c):
    """Return the distance of a segment from a cell, 0 where they meet."""
    dr, dc = br - ar, bc - ac
    beside = max(min(ar, br) - r, r - max(ar, br), min(ac, bc) - c, c - max(ac, bc))  # of the projections on the axes
    if beside <= 0.5 and abs(dr * (c - ac) - dc * (r - ar)) <= 0.5 * (abs(dr) + abs(dc)):
        return 0.0
    best = np.inf
    for k in range(4):
        best = min(best, _from_segment(r + (k // 2) - 0.5, c + (k % 2) - 0.5, ar, ac, br, bc))
    for k in range(2):
        end_r, end_c = (ar, ac) if k == 0 else (br, bc)
        best = min(best, _norm(max(abs(end_r - r) - 0.5, 0.0), max(abs(end_c - c) - 0.5, 0.0)))
    return best


@part("i8(f8, i8)")
def _cell(x, count):
    """Return the row, or the column, in which a coordinate lies, or the nearest of the map."""
    return min(max(math.floor(x + 0.5), 0), count - 1)


@kernel("f8(f8[:, ::1], u1[::1], f8[::1], i8, i8)")
def clearance(points, blocked, distance, rows, cols):
    """Return the least distance of a polyline (n, 2) to the border of an obstacle cell; inf where there is none.

    ``distance`` holds for each cell the distance of its centre to the nearest
    obstacle's centre. The polyline is looked at in stretches of a cell at most: a
    point of one is within ½ of its middle, that within √½ of its cell's centre, and
    so is an obstacle's border of the obstacle's centre.
    """
    best = np.inf
    for k in range(points.shape[0]):
        best = min(best, distance[_cell(points[k, 0], rows) * cols + _cell(points[k, 1], cols)] + NEAR)
    if best == np.inf:
        return best
    for k in range(max(points.shape[0] - 1, 1)):
        ahead = min(k + 1, points.shape[0] - 1)
        dr, dc = points[ahead, 0] - points[k, 0], points[ahead, 1] - points[k, 1]
        parts = max(math.ceil(_norm(dr, dc)), 1)
        for s in range(parts):
            ar, ac = points[k, 0] + dr * s / parts, points[k, 1] + dc * s / parts
            br, bc = points[k, 0] + dr * (s + 1) / parts, points[k, 1] + dc * (s + 1) / parts
            r, c = _cell(0.5 * (ar + br), rows), _cell(0.5 * (ac + bc), cols)
            if distance[r * cols + c] > best + 0.5 + 2.0 * NEAR:
                continue
            reach = math.ceil(best + 1.0 + NEAR)
            for rr in range(max(r - reach, 0), min(r + reach, rows - 1) + 1):
                for cc in range(max(c - reach, 0), min(c + reach, cols - 1) + 1):
                    if blocked[rr * cols + cc]:
                        best = min(best, _from_cell(ar, ac, br, bc, rr, cc))
    return best
