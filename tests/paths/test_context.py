"""Masks and tables of a map, against brute force."""

import math

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, examples

import pathloom as pl


def mask_of(problem: pl.PathProblem, corners: str) -> list[int]:
    blocked = problem.context.occupied
    cells = [divmod(k, blocked.shape[1]) for k in range(blocked.size)]
    return [sum(1 << d for d, _ in naive.legal_steps(blocked, cell, corners)) for cell in cells]


@given(problem=naive.problems())
@examples(60)
def test_moves_are_the_single_steps_that_are_free(problem: pl.PathProblem) -> None:
    assert problem.context.moves.tolist() == mask_of(problem, problem.corners)


@given(problem=naive.problems())
@examples(40)
def test_loose_moves_are_those_of_allow(problem: pl.PathProblem) -> None:
    assert problem.context.loose_moves.tolist() == mask_of(problem, "allow")


@pytest.mark.parametrize(
    ("corners", "steps"),
    [("allow", {1, 2, 3, 4, 5, 7}), ("no-squeeze", {1, 2, 3, 4, 5}), ("strict", {2, 3, 4})],
)
def test_a_diagonal_step_needs_none_one_or_both_cells_beside_it(corners: str, steps: set[int]) -> None:
    grid = [[0, 1, 0], [1, 0, 0], [0, 0, 0]]  # from the middle, up left squeezes; up right and down left graze
    moves = int(pl.PathProblem(grid, start=(1, 1), goal=(2, 2), corners=corners).context.moves[4])
    assert {d for d in range(8) if moves >> d & 1} == steps


@given(problem=naive.problems(), reach=st.sampled_from([4, 8]), border=st.booleans())
@examples(60)
def test_neighbours_are_counted_one_by_one(problem: pl.PathProblem, reach: int, border: bool) -> None:
    blocked = problem.context.occupied
    height, width = blocked.shape
    expected = []
    for r in range(height):
        for c in range(width):
            around = [(r + dr, c + dc) for dr, dc in naive.STEPS[:: 8 // reach]]
            inside = [cell for cell in around if 0 <= cell[0] < height and 0 <= cell[1] < width]
            expected.append(sum(bool(blocked[cell]) for cell in inside) + border * (len(around) - len(inside)))
    assert problem.context.neighbours(reach, border).tolist() == expected


@given(problem=naive.problems())
@examples(40)
def test_unsafe_is_what_has_an_obstacle_near(problem: pl.PathProblem) -> None:
    it = problem.context
    assert it.obstacles_near.tolist() == it.neighbours(8).tolist()
    assert it.unsafe.tolist() == [int(near > 0) for near in it.obstacles_near.tolist()]


@given(problem=naive.problems())
@examples(60)
def test_distances_are_to_the_nearest_obstacle(problem: pl.PathProblem) -> None:
    it = problem.context
    obstacles = np.argwhere(it.occupied).tolist()
    cells = [divmod(k, it.cols) for k in range(it.blocked.size)]
    expected = [min((math.dist(cell, obstacle) for obstacle in obstacles), default=math.inf) for cell in cells]
    assert it.distance.tolist() == pytest.approx(expected)


@given(problem=naive.problems())
@examples(80)
def test_what_can_be_reached_is_what_single_steps_reach(problem: pl.PathProblem) -> None:
    it = problem.context
    reached = naive.octile_distances(it.occupied, problem.start, problem.corners)
    assert {tuple(cell) for cell in np.argwhere(it.component).tolist()} == set(reached)
    assert it.reachable == (problem.goal in reached)
    others = sorted(r * it.cols + c for r, c in set(reached) - set(problem.ends))
    assert it.reachable_cells.tolist() == others
    assert it.reachable_cells.dtype == np.int32


@pytest.mark.parametrize("corners", POLICIES)
def test_what_segments_reach_single_steps_reach_too(corners: str) -> None:
    for seed in range(10):
        blocked = np.random.default_rng(seed).random((6, 6)) < 0.4
        blocked[0, 0] = False
        problem = pl.PathProblem(blocked, start=(0, 0), goal=(0, 0), corners=corners)
        reached = naive.any_angle_distances(blocked, (0, 0), corners)
        assert {tuple(cell) for cell in np.argwhere(problem.context.component).tolist()} == set(reached)


@pytest.mark.parametrize(
    ("start", "goal", "signs"),
    [
        ((0, 0), (2, 2), (1, 1)),
        ((2, 2), (0, 0), (-1, -1)),
        ((2, 0), (0, 2), (-1, 1)),
        ((1, 0), (1, 2), (-1, 1)),
        ((0, 1), (2, 1), (1, 1)),
        ((1, 1), (1, 1), (-1, 1)),
    ],
)
def test_signs_point_from_start_to_goal(start, goal, signs) -> None:
    assert pl.PathProblem(np.zeros((3, 3), bool), start=start, goal=goal).context.signs == signs


def test_tables_stand_row_after_row() -> None:
    problem = pl.PathProblem([[0, 1, 0], [0, 0, 0]], start=(1, 0), goal=(0, 2))
    it = problem.context
    assert (it.rows, it.cols, it.start, it.goal, it.policy) == (2, 3, 3, 2, 2)
    assert it.blocked.tolist() == [0, 1, 0, 0, 0, 0]
    assert {table.dtype for table in (it.blocked, it.moves, it.unsafe)} == {np.dtype(np.uint8)}


def test_obstacles_of_the_context_are_grown_by_the_radius() -> None:
    grid = np.zeros((5, 5), bool)
    grid[2, 2] = True
    grown = pl.PathProblem(grid, radius=0.6).context.occupied
    assert np.argwhere(grown).tolist() == [[1, 2], [2, 1], [2, 2], [2, 3], [3, 2]]
    assert pl.PathProblem(grid).context.occupied.sum() == 1
