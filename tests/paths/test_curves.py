"""Smoothers make curves that keep their path's corner policy, and say what they are like."""

import math
import pickle
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from naive import POLICIES
from scipy.interpolate import BSpline as Spline

import pathloom as pl
from pathloom.exact.curves import validate_curve
from pathloom.paths.curves import BSpline, CubicBezier

SMOOTHERS = [BSpline(), BSpline(degree=2), CubicBezier(), CubicBezier(reach=1.5)]
each = pytest.mark.parametrize("smoother", SMOOTHERS, ids=["b-spline", "b-spline 2", "cubic-bezier", "wide"])


def empty(size=30, start=(0, 0), goal=(0, 1)):
    return pl.PathProblem(np.zeros((size, size), bool), start=start, goal=goal)


def along(path, size=30):
    """Return the problem that a path (k, 2) on an empty map solves."""
    return empty(size, tuple(map(int, path[0])), tuple(map(int, path[-1])))


def dense(points, spacing=0.01):
    """Return points on a polyline, as close together as that."""
    parts = [points[:1]]
    for a, b in pairwise(points):
        n = max(1, math.ceil(np.hypot(*(b - a)) / spacing))
        parts.append(a + (b - a) * (np.arange(1, n + 1) / n)[:, np.newaxis])
    return np.concatenate(parts)


def collision(curve, problem):
    """Say what is wrong with a curve, by looking at many of its points: nothing of ours is asked."""
    points = dense(curve.points)
    if points[0].tolist() != list(problem.start) or points[-1].tolist() != list(problem.goal):
        return "it leads elsewhere"
    blocked = np.pad(problem.grid.occupied, 1, constant_values=True)
    for corner in np.ndindex(2, 2):  # of the four cells about each point, only the one that holds it can be entered
        cell = np.floor(points).astype(int) + corner
        away = np.abs(points - cell).max(axis=1) - 0.5
        hit = blocked[tuple(cell.T + 1)]
        if (away[hit] < -1e-9).any():
            return "it enters an obstacle"
        if problem.corners == "strict" and (away[hit] <= 0.0).any():
            return "it touches an obstacle"
    if problem.corners == "no-squeeze":
        corner = np.floor(points).astype(int)  # (r + ½, c + ½), with the four cells about it
        at_it = np.abs(points - corner - 0.5).max(axis=1) < 1e-10
        about = {step: blocked[tuple((corner + step).T + 1)] for step in np.ndindex(2, 2)}
        if (at_it & ((about[0, 0] & about[1, 1]) | (about[0, 1] & about[1, 0]))).any():
            return "it squeezes"
    return None


def random_problems(count):
    """Yield random maps with a shortest path under each corner policy, which hugs the corners, or a random one."""
    rng = np.random.default_rng(11)
    for seed in range(count):
        size, share = int(rng.integers(4, 16)), int(rng.integers(5, 36))
        for corners in POLICIES:
            grid = pl.load_map(f"random-{size}:{share}%:s{seed}", corners=corners)
            problem = pl.PathProblem(grid, corners=corners)
            find = (pl.any_angle_path, pl.octile_path)[seed % 2]
            yield problem, find(problem)[1]


def test_no_curve_ever_collides():
    touching = 0
    for problem, path in random_problems(100):
        for smoother in SMOOTHERS[::2]:
            curve = smoother.smooth(path, problem)
            assert collision(curve, problem) is None
            assert not curve.fallback
            touching += curve.min_clearance == 0.0
    assert touching > 15  # among them curves that graze corners where they may


@pytest.mark.parametrize("smoother", [BSpline(halvings=0), CubicBezier(halvings=0), BSpline(degree=5, halvings=1)])
def test_where_inserted_points_do_not_help_the_curve_keeps_to_the_segments(smoother):
    kept = 0
    for problem, path in random_problems(60):
        curve = smoother.smooth(path, problem)
        assert collision(curve, problem) is None
        kept += curve.fallback
        if curve.fallback:
            assert curve.max_curvature == math.inf or curve.length == pytest.approx(math.dist(path[0], path[-1]))
        assert smoother.halvings or not curve.inserted
    assert kept > 20


@each
def test_the_validator_finds_nothing_against_them(smoother):
    for problem, path in random_problems(40):
        assert validate_curve(smoother.smooth(path, problem).points, problem) is None


def test_a_spline_of_degree_2_cuts_a_corner_by_3_54():
    path = np.array([(0, 0), (0, 10), (10, 10)])
    curve = BSpline(degree=2).smooth(path, along(path))
    assert np.hypot(*(dense(curve.points) - (0, 10)).T).min() == pytest.approx(math.sqrt(12.5), abs=1e-3)
    assert BSpline(degree=3).smooth(path, along(path)).points.tolist() == curve.points.tolist()  # three points: 2


def test_an_obstacle_in_that_corner_pulls_the_curve_around_it():
    path = np.array([(0, 0), (0, 10), (10, 10)])
    for obstacle in ((2, 8), (3, 7), (2, 7)):
        grid = np.zeros((11, 11), bool)
        grid[obstacle] = True
        problem = pl.PathProblem(grid, start=(0, 0), goal=(10, 10))
        curve = BSpline(degree=2).smooth(path, problem)
        assert collision(curve, problem) is None
        assert curve.inserted > 0
        assert not curve.fallback
        assert 0 < curve.min_clearance < 3


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5, 9])
def test_a_spline_is_scipy_s_with_the_path_as_control_points_and_no_higher_degree_than_they_allow(degree):
    rng = np.random.default_rng(degree)
    for n in (2, 3, 5, 12):
        path = rng.integers(0, 30, (n, 2))
        path[1:] += path[1:] == path[:-1]
        curve = BSpline(degree=degree).smooth(path, along(path, 40))
        k = min(degree, n - 1)
        spline = Spline(np.concatenate((np.zeros(k), np.arange(n - k + 1), np.full(k, n - k))), path.astype(float), k)
        exact = spline(np.linspace(0, n - k, 300 * (n - k) + 1))
        assert np.hypot(*(exact[::9, None] - dense(curve.points)[None]).T).min(axis=0).max() < 0.01
        assert curve.length == pytest.approx(np.hypot(*np.diff(exact, axis=0).T).sum(), rel=1e-4)
        assert curve.points[[0, -1]].tolist() == path[[0, -1]].tolist()


def test_a_bezier_chain_passes_through_the_path_s_points_without_a_bend():
    path = np.array([(0, 0), (4, 6), (5, 12), (14, 13), (15, 2), (29, 0)])
    curve = CubicBezier().smooth(path, along(path))
    for point in path:
        assert np.hypot(*(curve.points - point).T).min() == 0.0
    assert curve.max_curvature < 5
    direction = np.diff(curve.points, axis=0)
    turned = np.abs(np.diff(np.unwrap(np.arctan2(*direction.T))))
    assert turned.max() < 0.5


def test_the_tangents_of_a_bezier_chain_are_those_of_parabolas_through_three_points():
    path = np.array([(0, 0), (4, 6), (5, 12), (14, 13), (15, 2)], float)
    chain = CubicBezier().chain(path, np.zeros(5, bool))
    at = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))))
    for k in (1, 2, 3):
        tangent = [np.polyder(np.polyfit(at[k - 1 : k + 2] - at[k], path[k - 1 : k + 2, x], 2))[-1] for x in range(2)]
        np.testing.assert_allclose(chain.pieces[k, 1] - path[k], np.array(tangent) * (at[k + 1] - at[k]) / 3)
        np.testing.assert_allclose(path[k] - chain.pieces[k - 1, 2], np.array(tangent) * (at[k] - at[k - 1]) / 3)


def test_the_curvature_of_an_arc_is_one_over_its_radius():
    angle = np.linspace(0, math.pi / 2, 13)
    arc = 20 * np.stack((np.sin(angle), np.cos(angle)), axis=1)
    problem = empty(30, (0, 20), (20, 0))
    inner = BSpline().smooth(arc, problem)
    assert inner.length == pytest.approx(20 * math.pi / 2, rel=0.01)
    assert 1 / 20 < inner.max_curvature < 1.3 / 20  # near its clamped ends a spline bends a little more
    through = CubicBezier().smooth(arc, problem)
    assert np.abs(np.hypot(*through.points.T) - 20).max() < 0.03
    assert 1 / 20 < through.max_curvature < 2.1 / 20  # it leaves along the first segment, at half an angle to the arc


@each
def test_paths_of_one_and_two_points_are_their_own_curves(smoother):
    one = smoother.smooth([(3, 4)], empty(9, (3, 4), (3, 4)))
    assert (one.points.tolist(), one.length, one.max_curvature, one.fallback) == ([[3.0, 4.0]], 0.0, 0.0, False)
    two = smoother.smooth([(0, 0), (6, 8)], empty(9, (0, 0), (6, 8)))
    assert (two.points.tolist(), two.length) == ([[0.0, 0.0], [6.0, 8.0]], 10.0)
    assert two.max_curvature == pytest.approx(0.0, abs=1e-12)
    assert two.min_clearance is None


@each
def test_points_named_twice_count_once(smoother):
    path = np.array([(0, 0), (0, 0), (3, 9), (3, 9), (9, 1), (9, 1)])
    twice, once = smoother.smooth(path, along(path)), smoother.smooth(path[::2], along(path))
    assert twice.points.tolist() == once.points.tolist()


@each
def test_a_way_that_turns_back_is_a_curve_with_a_corner_in_it(smoother):
    path = np.array([(5, 0), (5, 9), (5, 2), (9, 2)])
    curve = smoother.smooth(path, along(path))
    assert np.isfinite(curve.points).all()
    assert curve.max_curvature == math.inf or curve.max_curvature > 10


@each
@pytest.mark.parametrize("corners", POLICIES)
def test_a_curve_is_the_same_from_every_side(smoother, corners):
    grid = pl.load_map("random-13:30:s4", corners=corners)
    problem = pl.PathProblem(grid, corners=corners)
    path = pl.any_angle_path(problem)[1]
    curve = smoother.smooth(path, problem)
    mirrored = pl.PathProblem(grid.occupied[::-1], start=(0, 0), goal=(12, 12), corners=corners)
    turned = pl.PathProblem(grid.occupied.T, start=(0, 12), goal=(12, 0), corners=corners)
    back = pl.PathProblem(grid, start=problem.goal, goal=problem.start, corners=corners)
    for other, cells, undo in (
        (mirrored, path * (-1, 1) + (12, 0), lambda p: p * (-1, 1) + (12, 0)),
        (turned, path[:, ::-1], lambda p: p[:, ::-1]),
        (back, path[::-1], lambda p: p[::-1]),
    ):
        there = smoother.smooth(cells, other)
        np.testing.assert_allclose(undo(there.points), curve.points, atol=1e-9)
        assert there.length == pytest.approx(curve.length, abs=1e-9)
        assert there.min_clearance == pytest.approx(curve.min_clearance, abs=1e-9)


def test_a_curve_on_its_way_past_obstacles_keeps_its_distance_as_it_says():
    problem = pl.PathProblem(pl.load_map("blocks-20:20%"))
    curve = BSpline().smooth(pl.any_angle_path(problem)[1], problem)
    beyond = np.maximum(np.abs(dense(curve.points)[:, None] - np.argwhere(problem.grid.occupied)[None]) - 0.5, 0)
    assert curve.min_clearance == pytest.approx(np.hypot(*beyond.T).min(), abs=1e-3)


def test_the_robot_s_radius_keeps_the_curve_away_as_well():
    grid = np.zeros((9, 9), bool)
    grid[4, 4] = True
    problem = pl.PathProblem(grid, start=(8, 0), goal=(0, 8), radius=1.0)
    curve = pl.plan(problem, "imga", smooth="b-spline").curve
    assert np.hypot(*np.maximum(np.abs(dense(curve.points) - 4) - 0.5, 0).T).min() > 0.9


# In a plan --------------------------------------------------------------------------------------


def test_a_plan_makes_a_curve_where_one_is_asked_for():
    problem = pl.PathProblem(pl.load_map("blocks-20:20%"))
    plain = pl.plan(problem, "imga", seed=2)
    assert plain.curve is None
    assert plain.to_dict()["curve"] is None
    for smooth in ("b-spline", {"use": "b-spline"}, BSpline()):
        result = pl.plan(problem, "imga", seed=2, smooth=smooth)
        assert isinstance(result.curve, pl.Curve)
        assert result.path.tolist() == plain.path.tolist()
        assert result.metrics == plain.metrics
        assert collision(result.curve, problem) is None
        assert result.config["run"]["smooth"]["use"] == "b-spline"
        assert result.budget["seconds"] == pytest.approx(
            sum(v for k, v in result.budget["phases"].items() if k != "loading")
        )
    with pytest.raises(pl.ConfigError, match="smooth: no smoother is called 'b-splin'; did you mean 'b-spline'?"):
        pl.plan(problem, "imga", smooth="b-splin")


def test_a_curve_survives_its_json_corners_and_all():
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    for smooth in (BSpline(), BSpline(halvings=0)):
        result = pl.plan(problem, "imga", seed=3, smooth=smooth)
        table = result.to_dict()["curve"]
        assert set(table) == {"points", "length", "min_clearance", "max_curvature", "fallback", "inserted"}
        again = pl.Result.from_json(result.to_json())
        assert again.to_json() == result.to_json()
        assert again.curve.points.tolist() == result.curve.points.tolist()
        assert again.curve.max_curvature == result.curve.max_curvature
        assert pickle.loads(pickle.dumps(result.curve)).length == result.curve.length
    assert (table["max_curvature"], table["fallback"]) == (None, True)


@dataclass(frozen=True, kw_only=True)
class ThroughTheWall(pl.Smoother):
    """Straight from start to goal, whatever is between."""

    def smooth(self, path, problem):
        ends = np.asarray(path, float)[[0, -1]]
        return pl.Curve(ends, math.dist(*ends), 0.0, 0.0, fallback=False)


def test_a_curve_that_collides_is_dropped_and_that_is_said():
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    result = pl.plan(problem, "imga", seed=1, smooth=ThroughTheWall())
    assert result.found
    assert result.curve is None
    assert "the curve of 'through-the-wall' crosses an obstacle near" in result.reason


def test_without_a_path_there_is_no_curve():
    assert pl.plan(pl.PathProblem([[0, 1, 0]]), "imga", smooth="b-spline").curve is None
    lost = pl.plan(pl.PathProblem(pl.load_map("maze-21:1:s1")), "imga", smooth="b-spline")
    assert (lost.found, lost.curve) == (False, None)


def test_the_picture_of_a_result_with_a_curve_names_it():
    result = pl.plan(pl.PathProblem(pl.load_map("blocks-20:20%")), "imga", smooth="b-spline")
    for dark in (False, True):
        figure = result.plot(dark=dark)
        legend = [text.get_text() for text in figure.legends[0].get_texts()]
        assert legend == ["obstacle", "curve", "path", "before refinement"]
        line = next(line for line in figure.axes[0].get_lines() if line.get_label() == "curve")
        assert line.get_xydata().tolist() == result.curve.points[:, ::-1].tolist()
        assert any(f"curve {result.curve.length:.4f}" in text.get_text() for text in figure.texts)


# The validator ----------------------------------------------------------------------------------


def fault(points, corners="strict"):
    grid = np.zeros((5, 5), bool)
    grid[2, 2] = grid[3, 3] = True
    problem = pl.PathProblem(grid, start=(4, 0), goal=(0, 4), corners=corners)
    return validate_curve(np.array(points, float), problem)


def test_the_validator_tells_touching_from_crossing_and_squeezing():
    around = [(4, 0), (0, 0), (0, 4)]
    assert [fault(around, corners) for corners in POLICIES] == [None, None, None]
    corner = [(4, 0), (1.5, 1.5), (0, 4)]  # a corner of an obstacle
    assert fault(corner) == "touches an obstacle near 1.9167,1.2500"
    assert fault(corner, "no-squeeze") is None
    assert fault(corner, "allow") is None
    between = [(4, 0), (4, 1), (2.5, 2.5), (1, 4), (0, 4)]  # the corner that two obstacles share
    assert fault(between).startswith("touches an obstacle")
    assert fault(between, "no-squeeze").startswith("squeezes between two obstacles near")
    assert fault(between, "allow") is None
    for corners in POLICIES:
        assert "an obstacle near" in fault([(4, 0), (1.5 + 1e-6, 1.5 + 1e-6), (0, 4)], corners)


def test_the_validator_wants_numbers_on_the_map_from_start_to_goal():
    assert fault([(4, 0), (0, 3)]) == "leads from 4.0000,0.0000 to 0.0000,3.0000, not from start to goal"
    assert fault([(4, 0), (-0.6, 0), (0, 4)]) == "leaves the map at -0.6000,0.0000"
    assert fault([(4, 0), (math.nan, 0), (0, 4)]) == "has points that are no numbers"
    assert fault([4, 0]).startswith("is a float array of shape (m, 2)")
    one = pl.PathProblem(np.zeros((2, 2), bool), start=(1, 1), goal=(1, 1))
    assert validate_curve(np.array([[1.0, 1.0]]), one) is None
