"""What a path is like: length, turns, what it passes, how close it comes to obstacles."""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import length_between, length_of, row_of
from pathloom.compiled.segments import cells_crossed


@kernel("f8[::1](i4[:, ::1], i8)")
def lengths(population, cols):
    """Return the Euclidean length of each path, in cells."""
    found = np.zeros(population.shape[0])
    for k in range(population.shape[0]):
        found[k] = length_between(population[k], 0, length_of(population[k]) - 1, cols)
    return found


@kernel("f8[::1](i4[:, ::1], u1[::1], i8, i8)")
def sum_over_nodes(population, table, skip_first, skip_last):
    """Add up a table's entries over the nodes of each path, without some at its ends."""
    found = np.zeros(population.shape[0])
    for k in range(population.shape[0]):
        count = length_of(population[k])
        total = 0
        for i in range(skip_first, count - skip_last):
            total += table[population[k, i]]
        found[k] = total
    return found


@kernel("f8[::1](i4[:, ::1], u1[::1], i8)")
def obstacles_beside(population, beside, cols):
    """Count for each path the distinct obstacles among the 8 neighbours of its nodes, both ends included.

    ``beside``: bit d is set where the neighbour in direction d is an obstacle.
    """
    found = np.zeros(population.shape[0])
    seen = np.zeros(beside.shape[0], np.int32)
    for k in range(population.shape[0]):
        total = 0
        for i in range(population.shape[1]):
            cell = population[k, i]
            if cell < 0:
                break
            bits = np.int64(beside[cell])
            d = 0
            while bits > 0:
                if bits & 1:
                    obstacle = cell + DR[d] * cols + DC[d]
                    if seen[obstacle] != k + 1:
                        seen[obstacle] = k + 1
                        total += 1
                bits >>= 1
                d += 1
        found[k] = total
    return found


@kernel("f8[:, ::1](i4[:, ::1], i8)")
def turns(population, cols):
    """Return for each path the number of its turns and the sum of their angles in radians.

    Directions are compared as integers; going straight back is a turn of π.
    """
    per_row = 1.0 / cols
    found = np.zeros((population.shape[0], 2))
    for k in range(population.shape[0]):
        r0 = c0 = dr0 = dc0 = 0
        for i in range(population.shape[1]):
            cell = population[k, i]
            if cell < 0:
                break
            r = row_of(cell, per_row)
            c = cell - r * cols
            dr, dc = r - r0, c - c0
            if i > 1 and (dr != dr0 or dc != dc0):
                cross, dot = dr0 * dc - dc0 * dr, dr0 * dr + dc0 * dc
                if cross != 0 or dot < 0:
                    found[k, 0] += 1.0
                    found[k, 1] += math.atan2(abs(cross), dot)
            r0, c0, dr0, dc0 = r, c, dr, dc
    return found


@kernel("f8[::1](i4[:, ::1], i8, i8, i8, i8, f8[::1], b1)")
def quadrant_energy(population, cols, goal, sign_r, sign_c, price, by_angle):
    """Charge each turn by the quadrant of the direction that it takes: price[0] towards the goal, price[2] away.

    Quadrants are those of axes that point from start to goal; along an axis,
    towards the goal counts as its quadrant, away as the opposite one. ``by_angle``: by the angle between the
    direction and the goal instead, up to 45°, up to 135°, beyond.
    """
    per_row = 1.0 / cols
    goal_r = goal // cols
    goal_c = goal - goal_r * cols
    found = np.zeros(population.shape[0])
    for k in range(population.shape[0]):
        r0 = c0 = dr0 = dc0 = 0
        for i in range(population.shape[1]):
            cell = population[k, i]
            if cell < 0:
                break
            r = row_of(cell, per_row)
            c = cell - r * cols
            dr, dc = r - r0, c - c0
            if i > 1 and (dr != dr0 or dc != dc0) and (dr0 * dc != dc0 * dr or dr0 * dr + dc0 * dc < 0):
                if by_angle:
                    to_r, to_c = goal_r - r0, goal_c - c0
                    cross, dot = abs(dr * to_c - dc * to_r), dr * to_r + dc * to_c
                    which = 0 if dot >= cross else (1 if -dot <= cross else 2)
                else:
                    forward_r, forward_c = sign_r * dr, sign_c * dc
                    if forward_r >= 0 and forward_c >= 0:
                        which = 0
                    elif forward_r <= 0 and forward_c <= 0:
                        which = 2
                    else:
                        which = 1
                found[k] += price[which]
            r0, c0, dr0, dc0 = r, c, dr, dc
    return found


@part("f8(f8, f8, f8, f8, f8, f8)")
def _point_to_segment(px, py, ax, ay, bx, by):
    dx, dy = bx - ax, by - ay
    squared = dx * dx + dy * dy
    t = 0.0 if squared == 0.0 else ((px - ax) * dx + (py - ay) * dy) / squared
    t = min(1.0, max(0.0, t))
    return math.hypot(px - ax - t * dx, py - ay - t * dy)


@part("f8(i8, i8, i8, i8, i8, i8)")
def _segment_to_cell(ar, ac, br, bc, r, c):
    """Return the distance between a segment and the unit square of a cell; 0 where they meet."""
    dr, dc = br - ar, bc - ac
    inside = min(ar, br) <= r <= max(ar, br) and min(ac, bc) <= c <= max(ac, bc)
    if inside and 2 * abs(dc * (r - ar) - dr * (c - ac)) <= abs(dr) + abs(dc):
        return 0.0
    best = np.inf
    for k in range(4):
        corner_r, corner_c = r + (k // 2) - 0.5, c + (k % 2) - 0.5
        best = min(best, _point_to_segment(corner_r, corner_c, ar, ac, br, bc))
    for k in range(2):
        end_r, end_c = (ar, ac) if k == 0 else (br, bc)
        best = min(best, math.hypot(max(abs(end_r - r) - 0.5, 0.0), max(abs(end_c - c) - 0.5, 0.0)))
    return best


@kernel("f8[::1](i4[:, ::1], u1[::1], f8[::1], i8, i8)")
def clearances(population, blocked, distance, rows, cols):
    """Return each path's least distance to the border of an obstacle cell; inf where there is none.

    ``distance`` holds for each cell the distance of its centre to the nearest
    obstacle's centre. A point in a cell lies within √½ of the centre and so does
    a border, so only cells within √2 of the least distance can hold the closest
    point of the path.
    """
    n = population.shape[0]
    found = np.full(n, np.inf)
    for k in range(n):
        count = length_of(population[k])
        best = np.inf
        for i in range(count):
            best = min(best, distance[population[k, i]])
        if best == np.inf:
            continue
        for i in range(max(count - 1, 1)):
            a = population[k, i]
            b = population[k, min(i + 1, count - 1)]
            ar, ac, br, bc = a // cols, a % cols, b // cols, b % cols
            steps = max(abs(br - ar), abs(bc - ac), 1)
            for s in range(steps + 1):
                r = round(ar + (br - ar) * s / steps)
                c = round(ac + (bc - ac) * s / steps)
                # the sample lies within 1 of every point of its stretch of the segment
                if distance[r * cols + c] > best + 2.5:
                    continue
                reach = math.ceil(best + 2.0)
                for rr in range(max(r - reach, 0), min(r + reach, rows - 1) + 1):
                    for cc in range(max(c - reach, 0), min(c + reach, cols - 1) + 1):
                        if blocked[rr * cols + cc]:
                            best = min(best, _segment_to_cell(ar, ac, br, bc, rr, cc))
        found[k] = best
    return found


@kernel("f8[::1](i4[:, ::1], u1[::1], i8)")
def flagged_cells(population, flag, cols):
    """Count for each path the distinct cells with a flag whose inside it crosses, both ends included."""
    n = population.shape[0]
    per_row = 1.0 / cols
    found = np.zeros(n)
    seen = np.zeros(flag.shape[0], np.int32)
    cells = np.empty(cols + flag.shape[0] // cols, np.int32)
    for k in range(n):
        count = length_of(population[k])
        total = 0
        for i in range(max(count - 1, 1)):
            a = population[k, i]
            b = population[k, min(i + 1, count - 1)]
            dr = row_of(b, per_row) - row_of(a, per_row)
            for c in range(cells_crossed(a, dr, b - a - dr * cols, cols, cells)):
                if seen[cells[c]] != k + 1:
                    seen[cells[c]] = k + 1
                    total += flag[cells[c]]
        found[k] = total
    return found
