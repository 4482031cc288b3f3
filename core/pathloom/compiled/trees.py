"""Random trees between cells, and what straightens their branches.

Points stand on a lattice of `UNIT` steps a cell with (0, 0) at the centre of cell
(0, 0), so that every test is exact in integers. `UNIT` is odd: no point lies on
the border of a cell, and a segment meets an obstacle either inside or in one
corner, just as a segment between the centres of cells does.
"""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import uniform
from pathloom.compiled.rows import blank, length_of, row_of, trimmed, with_room
from pathloom.compiled.segments import segment_free

UNIT = 4095
"""Steps of the lattice to a cell."""
HALF = 2047
"""The last step on either side of a cell's centre that is still within the cell."""
FEW = 32
"""Nodes up to which one bucket holds the whole tree."""


@part("i8(i8)")
def _cell(x):
    """Return the row, or the column, in which a coordinate lies."""
    return (x + HALF) // UNIT


@part("b1(u1[::1], i8, i8, i8, i8, i8, i8)")
def open_segment_free(blocked, cols, ar, ac, br, bc, policy):
    """Say whether the segment between two points of the lattice is free under a corner policy.

    With a cell's centre at offset e from a, it crosses the cell iff
    ``2 |d × e| < UNIT (|dr| + |dc|)`` (separating axes; the cell's row and column
    overlap, for only cells between those of the two ends are looked at), and
    touches it in one corner iff the two sides are equal.
    """
    dr, dc = br - ar, bc - ac
    limit = UNIT * (abs(dr) + abs(dc))
    left, right = _cell(min(ac, bc)), _cell(max(ac, bc))
    for r in range(_cell(min(ar, br)), _cell(max(ar, br)) + 1):
        first, last = left, right
        if dr != 0 and right - left > 2:  # the columns that it has within this row, and one more on each side
            slope = np.float64(dc) / dr
            c0 = ac + slope * (max(r * UNIT - HALF, min(ar, br)) - ar)
            c1 = ac + slope * (min(r * UNIT + HALF, max(ar, br)) - ar)
            first = max(left, np.int64(math.floor(min(c0, c1) / UNIT)) - 1)
            last = min(right, np.int64(math.ceil(max(c0, c1) / UNIT)) + 1)
        for c in range(first, last + 1):
            if blocked[r * cols + c] == 0:
                continue
            side = 2 * (dr * (c * UNIT - ac) - dc * (r * UNIT - ar))
            if abs(side) < limit or limit == 0:
                return False
            if abs(side) == limit and policy != 0:
                # It passes through the corner of this cell that lies towards it; the cell beyond lies across.
                toward = 1 if side > 0 else -1
                beyond_r = r + (toward if dc > 0 else -toward)
                beyond_c = c - (toward if dr > 0 else -toward)
                if policy == 2 or blocked[beyond_r * cols + beyond_c]:
                    return False
    return True


@kernel("b1[::1](u1[::1], i8, i8[:, ::1], i8[:, ::1], i8)")
def open_segments_free(blocked, cols, first, second, policy):
    """Test many segments: first[k] to second[k], rows and columns on the lattice."""
    free = np.empty(first.shape[0], np.bool_)
    for k in range(first.shape[0]):
        free[k] = open_segment_free(
            blocked, cols, first[k, 0], first[k, 1], second[k, 0], second[k, 1], policy
        )  # fmt: skip
    return free


@part("void(i8[:, ::1], i8, i8, i8, i4[::1], i4[::1])")
def _fill(nodes, count, side, across, head, following):
    """Put the nodes into square buckets, each a chain from ``head``."""
    for b in range(head.shape[0]):
        head[b] = -1
    for k in range(count):
        b = (nodes[k, 0] + HALF) // side * across + (nodes[k, 1] + HALF) // side
        following[k] = head[b]
        head[b] = k


@part("i8(i8[:, ::1], i4[::1], i4[::1], i8, i8, i8, i8)")
def _nearest(nodes, head, following, side, across, r, c):
    """Return the node nearest to a point, the oldest of several: ring by ring of buckets about the point."""
    down = head.shape[0] // across
    r, c = r + HALF, c + HALF
    br, bc = r // side, c // side
    best, found = np.int64(2**62), np.int64(-1)
    for ring in range(max(down, across)):
        # Whatever lies in this ring is at least so far away.
        apart = min(
            r - (br - ring + 1) * side + 1, (br + ring) * side - r,
            c - (bc - ring + 1) * side + 1, (bc + ring) * side - c,
        )  # fmt: skip
        if found >= 0 and apart > 0 and apart * apart > best:
            break
        for row in range(max(br - ring, 0), min(br + ring, down - 1) + 1):
            stride = 1 if abs(row - br) == ring else 2 * ring
            for col in range(bc - ring, bc + ring + 1, max(stride, 1)):
                if col < 0 or col >= across:
                    continue
                k = head[row * across + col]
                while k >= 0:
                    dr, dc = nodes[k, 0] + HALF - r, nodes[k, 1] + HALF - c
                    squared = dr * dr + dc * dc
                    if squared < best or (squared == best and k < found):
                        best, found = squared, np.int64(k)
                    k = following[k]
    return found


@part("i8(i8, i8)")
def _side(count, area):
    """Return the side of buckets of which there are about half as many as nodes."""
    if count <= FEW:
        return np.int64(2**40)
    return np.int64(math.ceil(math.sqrt(2.0 * area / count) * UNIT))


@kernel("i8[::1](i8[:, ::1], i8[:, ::1], i8, i8)")
def nearest_nodes(nodes, points, rows, cols):
    """Return for each point (k, 2) the index of the nearest of the nodes (n, 2), the first of several."""
    side = _side(nodes.shape[0], rows * cols)
    across = (cols * UNIT - 1) // side + 1
    head = np.empty(((rows * UNIT - 1) // side + 1) * across, np.int32)
    following = np.empty(nodes.shape[0], np.int32)
    _fill(nodes, nodes.shape[0], side, across, head, following)
    found = np.empty(points.shape[0], np.int64)
    for k in range(points.shape[0]):
        found[k] = _nearest(nodes, head, following, side, across, points[k, 0], points[k, 1])
    return found


@part("i8(i8, i8, f8)")
def _steered(near, target, share):
    """Return the coordinate that lies a share of the way from one to another, rounded alike in both directions."""
    way = (target - near) * share
    return near + (np.int64(way + 0.5) if way >= 0.0 else -np.int64(0.5 - way))


@kernel("Tuple((i8, i8, i8))(u1[::1], i8, i8, i8, i8, i8, f8, f8, f8, b1, i8[:, ::1], i4[::1], i8, i8, u8[::1])")
def grow(
    blocked, rows, cols, policy, goal_r, goal_c, step, reach, bias, by_sample, nodes, parents, count, samples, state
):
    """Grow a tree by some samples, or until it reaches the goal.

    A sample is a point of the whole map or, with probability ``bias``, the goal.
    The nearest node grows towards it by ``step``, and from there on to the goal if
    that is within ``reach``; both in steps of the lattice. ``by_sample``: the node
    that grows is the nearest to the random point even where the goal is the target.

    ``nodes`` (n, 2) and ``parents`` hold ``count`` nodes and have room for
    ``samples + 1`` more. Returns the new count, the samples that were drawn, and
    the index of the goal, −1 where it was not reached.
    """
    following = np.empty(nodes.shape[0], np.int32)
    head = np.empty(0, np.int32)
    side = across = limit = np.int64(0)
    closest, least, stuck = np.int64(0), np.int64(2**62), np.int64(-1)
    for k in range(count):
        dr, dc = nodes[k, 0] - goal_r, nodes[k, 1] - goal_c
        if dr * dr + dc * dc < least:
            closest, least = np.int64(k), dr * dr + dc * dc
    for drawn in range(1, samples + 1):
        if count >= limit:  # the tree has doubled: smaller buckets
            side, limit = _side(count, rows * cols), max(2 * count, FEW)
            across = (cols * UNIT - 1) // side + 1
            head = np.empty(((rows * UNIT - 1) // side + 1) * across, np.int32)
            _fill(nodes, count, side, across, head, following)
        r = np.int64(uniform(state) * (rows * UNIT)) - HALF
        c = np.int64(uniform(state) * (cols * UNIT)) - HALF
        to_goal = uniform(state) < bias
        if to_goal and not by_sample:
            if stuck == closest:  # it has been tried
                continue
            near = closest
        else:
            near = _nearest(nodes, head, following, side, across, r, c)
        if to_goal:
            r, c = goal_r, goal_c
        near_r, near_c = nodes[near, 0], nodes[near, 1]
        far = math.sqrt((r - near_r) * (r - near_r) + (c - near_c) * (c - near_c))
        if far > step:
            r, c = _steered(near_r, r, step / far), _steered(near_c, c, step / far)
        if (r == near_r and c == near_c) or not open_segment_free(blocked, cols, near_r, near_c, r, c, policy):
            if to_goal and near == closest:
                stuck = closest
            continue
        nodes[count, 0], nodes[count, 1], parents[count] = r, c, near
        b = (r + HALF) // side * across + (c + HALF) // side
        following[count], head[b] = head[b], count
        count += 1
        dr, dc = goal_r - r, goal_c - c
        squared = dr * dr + dc * dc
        if squared == 0:
            return count, drawn, count - 1
        if squared <= reach * reach and open_segment_free(blocked, cols, r, c, goal_r, goal_c, policy):
            nodes[count, 0], nodes[count, 1], parents[count] = goal_r, goal_c, count - 1
            return count + 1, drawn, count
        if squared < least:
            closest, least = count - 1, squared
    return count, samples, -1


@kernel("i8[:, ::1](i8[:, ::1], u1[::1], i8, i8)")
def straightened(points, blocked, cols, policy):
    """Go from the first point to the last point in sight, from there to the last in sight again, and so on."""
    count = points.shape[0]
    kept = np.empty(points.shape, np.int64)
    at = n = 0
    while True:
        kept[n, 0], kept[n, 1] = points[at, 0], points[at, 1]
        n += 1
        if at == count - 1:
            return kept[:n].copy()
        ahead = count - 1
        while ahead > at + 1 and not open_segment_free(
            blocked, cols, points[at, 0], points[at, 1], points[ahead, 0], points[ahead, 1], policy
        ):
            ahead -= 1
        at = ahead


@kernel("i4[:, ::1](i4[:, ::1], u1[::1], i8, i8)")
def straightened_paths(population, blocked, cols, policy):
    """Do the same for paths over cells."""
    n, width = population.shape
    per_row = 1.0 / cols
    out = blank(n, width)
    for k in range(n):
        count = length_of(population[k])
        at = kept = 0
        while at < count:
            here = population[k, at]
            out[k, kept] = here
            kept += 1
            r = row_of(here, per_row)
            ahead = count - 1
            while ahead > at + 1:
                there = population[k, ahead]
                dr = row_of(there, per_row) - r
                if segment_free(blocked, cols, here, dr, there - here - dr * cols, policy):
                    break
                ahead -= 1
            at = max(ahead, at + 1)
    return trimmed(out)


@kernel("i4[::1](i8[:, ::1], u1[::1], i8, i8)")
def cells_of_points(points, blocked, cols, policy):
    """Return a path over cells for a free polyline: through the centres of its points' cells.

    Where the segment between two of them is not free, the cells whose inside the
    polyline crosses stand in for it.
    """
    flat = np.empty(2 * points.shape[0] + 16, np.int32)
    r, c = _cell(points[0, 0]), _cell(points[0, 1])
    flat[0] = r * cols + c
    n = np.int64(1)
    for k in range(1, points.shape[0]):
        ar, ac, br, bc = points[k - 1, 0], points[k - 1, 1], points[k, 0], points[k, 1]
        to_r, to_c = _cell(br), _cell(bc)
        flat = with_room(flat, n, abs(to_r - r) + abs(to_c - c) + 1)
        if segment_free(blocked, cols, r * cols + c, to_r - r, to_c - c, policy):
            if r != to_r or c != to_c:
                flat[n] = to_r * cols + to_c
                n += 1
            r, c = to_r, to_c
            continue
        step_r, step_c = (1 if br > ar else -1), (1 if bc > ac else -1)
        while r != to_r or c != to_c:
            # Which border comes first, that of the row or that of the column? Both at once: through the corner.
            row_border = abs((2 * r + step_r) * UNIT - 2 * ar) * abs(bc - ac)
            col_border = abs((2 * c + step_c) * UNIT - 2 * ac) * abs(br - ar)
            if row_border <= col_border:
                r += step_r
            if col_border <= row_border:
                c += step_c
            flat[n] = r * cols + c
            n += 1
    return flat[:n].copy()
