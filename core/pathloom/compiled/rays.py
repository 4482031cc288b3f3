"""Rays in the plane of a map: how far a robot sees, how near it is to something, and who else walks about.

Points are (x, y) in cells: x to the right from the left border, y downwards from the
upper one, so that cell (r, c) covers [c, c + 1] × [r, r + 1]. What lies outside the map
is an obstacle. Discs are rows (x, y, radius) of things that the map does not show.
"""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import uniform


@part("f8(u1[::1], i8, i8, f8, f8, f8, f8, f8)")
def to_wall(blocked, rows, cols, x, y, dx, dy, reach):
    """Return how far a ray along the unit vector (dx, dy) goes until it enters an obstacle cell; at most reach.

    Source: J. Amanatides, A. Woo (1987), A fast voxel traversal algorithm, Eurographics.
    """
    col, row = math.floor(x), math.floor(y)
    if row < 0 or row >= rows or col < 0 or col >= cols or blocked[row * cols + col]:
        return 0.0
    step_x, step_y = (1 if dx > 0.0 else -1), (1 if dy > 0.0 else -1)
    each_x = math.inf if dx == 0.0 else abs(1.0 / dx)
    each_y = math.inf if dy == 0.0 else abs(1.0 / dy)
    next_x = math.inf if dx == 0.0 else ((col + 1 - x) if dx > 0.0 else (x - col)) * each_x
    next_y = math.inf if dy == 0.0 else ((row + 1 - y) if dy > 0.0 else (y - row)) * each_y
    while True:
        if next_x < next_y:
            gone = next_x
            next_x += each_x
            col += step_x
        else:
            gone = next_y
            next_y += each_y
            row += step_y
        if gone >= reach:
            return reach
        if row < 0 or row >= rows or col < 0 or col >= cols or blocked[row * cols + col]:
            return gone


@part("f8(f8, f8, f8, f8, f8[:, ::1], f8)")
def to_disc(x, y, dx, dy, discs, reach):
    """Return how far a ray goes until it enters a disc; at most reach."""
    nearest = reach
    for k in range(discs.shape[0]):
        ox, oy, radius = x - discs[k, 0], y - discs[k, 1], discs[k, 2]
        outside = ox * ox + oy * oy - radius * radius
        if outside <= 0.0:
            return 0.0
        toward = -(ox * dx + oy * dy)
        root = toward * toward - outside
        if toward > 0.0 and root >= 0.0:
            nearest = min(nearest, toward - math.sqrt(root))
    return nearest


@kernel("f8[:, ::1](u1[::1], i8, i8, f8[:, ::1], f8[::1], f8[:, ::1], f8)")
def cast(blocked, rows, cols, poses, angles, discs, reach):
    """Return for poses (n, 3) how far each of k rays goes: (n, k), at most reach.

    A pose is (x, y, heading), angles (k,) are counted from the heading; both are in
    radians, counter-clockwise as one sees the map.
    """
    seen = np.empty((poses.shape[0], angles.shape[0]))
    for n in range(poses.shape[0]):
        x, y = poses[n, 0], poses[n, 1]
        for k in range(angles.shape[0]):
            dx, dy = math.cos(poses[n, 2] + angles[k]), -math.sin(poses[n, 2] + angles[k])
            far = to_wall(blocked, rows, cols, x, y, dx, dy, reach)
            seen[n, k] = to_disc(x, y, dx, dy, discs, far)
    return seen


@kernel("f8(u1[::1], i8, i8, f8, f8, f8[:, ::1], f8)")
def clearance(blocked, rows, cols, x, y, discs, reach):
    """Return the distance from a point to the nearest obstacle cell, disc or border of the map; at most reach."""
    nearest = min(reach, x, y, cols - x, rows - y)
    if nearest <= 0.0:
        return 0.0
    for row in range(max(0, math.floor(y - nearest)), min(rows - 1, math.floor(y + nearest)) + 1):
        for col in range(max(0, math.floor(x - nearest)), min(cols - 1, math.floor(x + nearest)) + 1):
            if blocked[row * cols + col]:
                across = max(col - x, 0.0, x - col - 1.0)
                down = max(row - y, 0.0, y - row - 1.0)
                nearest = min(nearest, math.sqrt(across * across + down * down))
    for k in range(discs.shape[0]):
        ox, oy = x - discs[k, 0], y - discs[k, 1]
        nearest = min(nearest, max(math.sqrt(ox * ox + oy * oy) - discs[k, 2], 0.0))
    return nearest


@kernel("void(u1[::1], i8, i8, f8[:, ::1], f8[:, ::1], f8[:, ::1], f8, f8, f8, f8, u8[::1])")
def wander(blocked, rows, cols, movers, velocities, still, x, y, radius, seconds, words):
    """Let movers (m, 3), discs with velocities (m, 2), walk on for a time, in place.

    Whoever would walk into an obstacle, a disc that stands still or the robot, a disc at
    (x, y), stays where it is and turns to a direction drawn at random.
    """
    for k in range(movers.shape[0]):
        ahead_x = movers[k, 0] + velocities[k, 0] * seconds
        ahead_y = movers[k, 1] + velocities[k, 1] * seconds
        size = movers[k, 2]
        apart = math.sqrt((ahead_x - x) * (ahead_x - x) + (ahead_y - y) * (ahead_y - y))
        before = math.sqrt((movers[k, 0] - x) * (movers[k, 0] - x) + (movers[k, 1] - y) * (movers[k, 1] - y))
        into_robot = apart < size + radius and apart < before
        if into_robot or clearance(blocked, rows, cols, ahead_x, ahead_y, still, size) < size:
            speed = math.sqrt(velocities[k, 0] * velocities[k, 0] + velocities[k, 1] * velocities[k, 1])
            angle = 2.0 * math.pi * uniform(words)
            velocities[k, 0], velocities[k, 1] = speed * math.cos(angle), speed * math.sin(angle)
            continue
        movers[k, 0], movers[k, 1] = ahead_x, ahead_y


@kernel("f8[::1](f8[:, :, ::1], f8[:, ::1])")
def nearest_on_ways(places, points):
    """Return how near each of n ways, of s places (n, s, 2), comes to points (m, 2): (n,); inf where there are none."""
    nearest = np.empty(places.shape[0])
    for n in range(places.shape[0]):
        least = math.inf
        for s in range(places.shape[1]):
            for k in range(points.shape[0]):
                across, along = places[n, s, 0] - points[k, 0], places[n, s, 1] - points[k, 1]
                least = min(least, across * across + along * along)
        nearest[n] = math.sqrt(least)
    return nearest
