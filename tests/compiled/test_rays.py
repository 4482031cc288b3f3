"""Rays, clearances and walkers against what the definitions say, cell by cell."""

import math

import numpy as np
import pytest

from pathloom import compiled

REACH = 6.0


def boxes(blocked):
    """Obstacle cells as (x, y) boxes, and what lies around the map."""
    rows, cols = blocked.shape
    yield from ((c, c + 1, r, r + 1) for r, c in np.argwhere(blocked).tolist())
    far = 100
    yield from ((-far, 0, -far, far), (cols, far, -far, far), (-far, far, -far, 0), (-far, far, rows, far))


def ray_to_box(x, y, dx, dy, box):
    enter, leave = 0.0, math.inf
    for at, d, low, high in ((x, dx, *box[:2]), (y, dy, *box[2:])):
        if d == 0.0:
            if not low < at < high:
                return math.inf
            continue
        near, far = sorted(((low - at) / d, (high - at) / d))
        enter, leave = max(enter, near), min(leave, far)
    return enter if enter < leave else math.inf


def ray_to_disc(x, y, dx, dy, disc):
    """March along the ray; exact to a thousandth."""
    for gone in np.arange(0.0, REACH, 0.001):
        if math.hypot(x + gone * dx - disc[0], y + gone * dy - disc[1]) <= disc[2]:
            return float(gone)
    return math.inf


@pytest.mark.parametrize("seed", range(6))
def test_rays_end_where_they_enter_the_first_obstacle_disc_or_border(seed):
    rng = np.random.default_rng(seed)
    blocked = rng.random((7, 9)) < 0.2
    discs = np.array([[2.3, 3.1, 0.4], [7.0, 5.5, 0.3]])
    angles = np.linspace(-3.0, 3.0, 11)
    poses = np.column_stack((rng.uniform(0, 9, 5), rng.uniform(0, 7, 5), rng.uniform(-3, 3, 5)))
    seen = compiled.rays.cast(blocked.astype(np.uint8).ravel(), 7, 9, poses, angles, discs, REACH)
    for (x, y, heading), row in zip(poses, seen, strict=True):
        for angle, far in zip(angles, row, strict=True):
            dx, dy = math.cos(heading + angle), -math.sin(heading + angle)
            walls = min(ray_to_box(x, y, dx, dy, box) for box in boxes(blocked))
            hidden = min(ray_to_disc(x, y, dx, dy, disc) for disc in discs)
            assert far == pytest.approx(min(walls, hidden, REACH), abs=2e-3)


@pytest.mark.parametrize("seed", range(6))
def test_clearance_is_the_distance_to_the_nearest_box_or_disc(seed):
    rng = np.random.default_rng(seed)
    blocked = rng.random((7, 9)) < 0.1
    discs = np.array([[2.3, 3.1, 0.4], [7.0, 5.5, 0.3]])
    for x, y in zip(rng.uniform(-1, 10, 20), rng.uniform(-1, 8, 20), strict=True):
        near = [math.hypot(max(a - x, 0, x - b), max(c - y, 0, y - d)) for a, b, c, d in boxes(blocked)]
        near += [max(math.hypot(x - u, y - v) - r, 0.0) for u, v, r in discs]
        found = compiled.rays.clearance(blocked.astype(np.uint8).ravel(), 7, 9, x, y, discs, 2.0)
        assert found == pytest.approx(min(*near, 2.0), abs=1e-12)


def test_whoever_walks_stays_out_of_walls_discs_and_the_robot():
    rng = np.random.default_rng(0)
    blocked = np.zeros((8, 8), np.uint8)
    blocked[3, 3:5] = 1
    movers = np.array([[1.0, 1.0, 0.3], [6.0, 6.0, 0.2], [1.0, 6.0, 0.25]])
    velocities = rng.uniform(-1, 1, (3, 2))
    still, words = np.array([[6.0, 2.0, 0.5]]), np.array([1, 2, 3, 4], np.uint64)
    before = movers.copy()
    for _ in range(2000):
        compiled.rays.wander(blocked.ravel(), 8, 8, movers, velocities, still, 2.0, 4.0, 0.3, 0.1, words)
        for x, y, size in movers:
            assert compiled.rays.clearance(blocked.ravel(), 8, 8, x, y, still, 1.0) >= size
            assert math.hypot(x - 2.0, y - 4.0) >= size + 0.3
    assert (np.abs(movers - before)[:, :2].max(axis=1) > 0.05).all()


def test_ways_come_as_near_to_points_as_their_nearest_place():
    rng = np.random.default_rng(0)
    places, points = rng.random((4, 3, 2)), rng.random((5, 2))
    apart = np.linalg.norm(places[:, :, None] - points, axis=3).min(axis=(1, 2))
    assert compiled.rays.nearest_on_ways(places, points) == pytest.approx(apart)
    assert np.isinf(compiled.rays.nearest_on_ways(places, np.empty((0, 2)))).all()
