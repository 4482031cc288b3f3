"""Octile and any-angle optima, against Dijkstra's algorithm on dictionaries and the papers' numbers."""

import math
from pathlib import Path

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, examples

import pathloom as pl


@given(problem=naive.problems(max_side=9))
@examples(50)
def test_the_octile_optimum_is_its_twins(problem: pl.PathProblem) -> None:
    blocked = problem.context.occupied
    best = naive.octile_distances(blocked, problem.start, problem.corners).get(problem.goal, math.inf)
    length, path = pl.octile_path(problem)
    assert length == pytest.approx(best, abs=1e-9)
    assert (path is None) == (best == math.inf)
    assert path is None or (naive.steps_singly(path) and pl.validate(path, problem) is None)


@given(problem=naive.problems(max_side=9))
@examples(60)
def test_the_any_angle_optimum_is_its_twins(problem: pl.PathProblem) -> None:
    blocked = problem.context.occupied
    best = naive.any_angle_distances(blocked, problem.start, problem.corners).get(problem.goal, math.inf)
    length, path = pl.any_angle_path(problem)
    assert length == pytest.approx(best, abs=1e-9)
    assert (path is None) == (best == math.inf)
    assert path is None or pl.validate(path, problem) is None


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("seed", range(6))
def test_the_any_angle_optimum_of_a_full_map_is_its_twins(seed: int, corners: str) -> None:
    blocked = np.random.default_rng(seed).random((9, 9)) < 0.3
    blocked[8, 0] = blocked[0, 8] = False
    problem = pl.PathProblem(blocked, corners=corners)
    best = naive.any_angle_distances(blocked, (8, 0), corners).get((0, 8), math.inf)
    assert pl.any_angle_path(problem)[0] == pytest.approx(best, abs=1e-9)


@given(data=st.data(), problem=naive.problems(max_side=9))
@examples(60)
def test_freer_policies_are_never_longer_and_any_angle_never_longer_than_octile(data, problem) -> None:
    grid, (start, goal) = problem.grid, problem.ends
    under = [pl.PathProblem(grid, start=start, goal=goal, corners=corners) for corners in POLICIES]
    octile, any_angle = ([of(p)[0] for p in under] for of in (pl.octile_path, pl.any_angle_path))
    assert octile == sorted(octile)
    assert any_angle == sorted(any_angle)
    assert all(a <= o for a, o in zip(any_angle, octile, strict=True))


@pytest.mark.parametrize("reference", [pl.octile_path, pl.any_angle_path])
def test_a_start_that_is_the_goal_is_a_path_of_length_zero(reference) -> None:
    length, path = reference(pl.PathProblem(np.zeros((3, 3), bool), start=(1, 2), goal=(1, 2)))
    assert length == 0.0
    assert path.tolist() == [[1, 2]]


@pytest.mark.parametrize("reference", [pl.octile_path, pl.any_angle_path])
def test_a_goal_out_of_reach_is_infinitely_far(reference) -> None:
    assert reference(pl.PathProblem([[0, 1, 0]])) == (math.inf, None)


@pytest.mark.parametrize("reference", [pl.octile_path, pl.any_angle_path])
def test_a_radius_grows_the_obstacles_of_a_reference(reference) -> None:
    grid = np.zeros((5, 9), bool)
    grid[0:4, 4] = True
    free = pl.PathProblem(grid, start=(0, 0), goal=(0, 8))
    assert math.isfinite(reference(free)[0])
    assert reference(pl.PathProblem(grid, start=(0, 0), goal=(0, 8), radius=1.2)) == (math.inf, None)


def test_an_empty_map_is_crossed_in_one_segment() -> None:
    length, path = pl.any_angle_path(pl.PathProblem(np.zeros((30, 70), bool)))
    assert length == math.hypot(29, 69)
    assert path.tolist() == [[29, 0], [0, 69]]


def test_too_little_work_finds_nothing() -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75:s3"))
    assert pl.any_angle_path(problem, work=100) == (math.inf, None)


def test_a_point_between_two_obstacles_that_share_a_corner_is_passed_under_allow_only() -> None:
    grid = [[0, 1], [1, 0]]
    ends = {"start": (0, 0), "goal": (1, 1)}
    lengths = [pl.any_angle_path(pl.PathProblem(grid, corners=corners, **ends))[0] for corners in POLICIES]
    assert lengths == [math.sqrt(2), math.inf, math.inf]


def test_a_lone_corner_is_grazed_unless_strict() -> None:
    grid = [[0, 0], [1, 0]]
    ends = {"start": (0, 0), "goal": (1, 1)}
    lengths = [pl.octile_path(pl.PathProblem(grid, corners=corners, **ends))[0] for corners in POLICIES]
    assert lengths == [math.sqrt(2), math.sqrt(2), 2.0]


ROOT = math.sqrt(2)

# octile and any-angle optima: name, ends, then (corners allowed, strict) of each
PRINTED = [
    ("imaga-fig1", "bottom-left", "top-right", (2 + 8 * ROOT, 6 + 6 * ROOT), (12.8300, 13.1113)),
    ("iga-map1", "bottom-left", "top-right", (6 + 6 * ROOT, 12 + 3 * ROOT), (13.7901, 14.6393)),
    ("iga-map1", (9, 0), (2, 9), (4 + 6 * ROOT, 10 + 3 * ROOT), (11.8639, None)),
]
MEASURED = [
    ("ssa_20x20", "bottom-left", "top-right", (28.6274, 31.5563), (27.5155, 29.0661)),
    ("ga_smooth_20x20", "top-left", "bottom-right", (30.9706, 31.5563), (29.6065, 30.6828)),
]


def assert_optima(grid: pl.OccupancyGrid, start, goal, octile, any_angle) -> None:
    for corners, steps, straight in zip(("allow", "strict"), octile, any_angle, strict=True):
        problem = pl.PathProblem(grid, start=start, goal=goal, corners=corners)
        assert pl.octile_path(problem)[0] == pytest.approx(steps, abs=5e-5)
        if straight is not None:
            assert pl.any_angle_path(problem)[0] == pytest.approx(straight, abs=5e-5)


@pytest.mark.parametrize(("name", "start", "goal", "octile", "any_angle"), PRINTED)
def test_optima_of_printed_maps_are_those_worked_out_from_the_papers(name, start, goal, octile, any_angle) -> None:
    assert_optima(pl.load_map(name), start, goal, octile, any_angle)


@pytest.mark.data
@pytest.mark.parametrize(("name", "start", "goal", "octile", "any_angle"), MEASURED)
def test_optima_of_collected_maps_are_those_that_the_papers_report(
    data: Path, name, start, goal, octile, any_angle
) -> None:
    assert_optima(pl.load_map(data / "ga_grids" / f"{name}.csv"), start, goal, octile, any_angle)


def test_the_any_angle_optimum_of_iga_map_1_has_its_known_turns() -> None:
    _, path = pl.any_angle_path(pl.PathProblem(pl.load_map("iga-map1"), corners="allow"))
    assert path.tolist() == [[9, 0], [7, 2], [5, 7], [4, 8], [1, 9], [0, 9]]
