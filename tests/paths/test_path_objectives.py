"""Objectives and metrics through their classes, against their twins."""

import math

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import Cells, examples

import pathloom as pl
from pathloom.paths.metrics import metrics
from pathloom.paths.objectives import Clearance, Length, TurnAngle, Turns, UnsafeCells
from pathloom_imga.objectives import QuadrantEnergy, UnsafeNode


def obstacles_near(blocked: np.ndarray, cell) -> int:
    r, c = cell
    return int(blocked[max(r - 1, 0) : r + 2, max(c - 1, 0) : c + 2].sum() - blocked[cell])


def unsafe_cells(problem: pl.PathProblem, path: Cells) -> int:
    blocked = problem.context.occupied
    return sum(obstacles_near(blocked, cell) > 0 for cell in naive.crossed(blocked.shape, path))


def clearance(problem: pl.PathProblem, path: Cells) -> float:
    return -min(naive.clearance(problem.context.occupied, path), math.hypot(*problem.context.occupied.shape))


def energy(problem: pl.PathProblem, path: Cells, by_angle: bool) -> float:
    return naive.quadrant_energy(path, problem.goal, problem.context.signs, (1.0, 3.0, 10.0), by_angle)


def quadrants(problem: pl.PathProblem, path: Cells) -> float:
    (r0, c0), (r1, c1) = problem.ends
    return energy(problem, path, r0 == r1 or c0 == c1)


TWINS = {
    Length(): lambda problem, path: naive.length(path),
    Turns(): lambda problem, path: naive.turns(path),
    TurnAngle(): lambda problem, path: naive.turn_angle(path),
    UnsafeCells(): unsafe_cells,
    Clearance(): clearance,
    UnsafeNode(): lambda problem, path: 5 * sum(obstacles_near(problem.context.occupied, c) > 0 for c in path[:-1]),
    UnsafeNode(per="obstacle", penalty=2): lambda problem, path: (
        2 * sum(obstacles_near(problem.context.occupied, c) for c in path[:-1])
    ),
    QuadrantEnergy(): quadrants,
    QuadrantEnergy(by_angle="always"): lambda problem, path: energy(problem, path, True),
}


@pytest.mark.parametrize("objective", TWINS, ids=str)
def test_an_objective_measures_what_its_twin_measures(objective: pl.Objective) -> None:
    @given(data=st.data(), problem=naive.problems(max_side=6))
    @examples(40)
    def check(data: st.DataObject, problem: pl.PathProblem) -> None:
        between = data.draw(st.lists(naive.paths_on(problem.grid.shape, 5), min_size=1, max_size=3))
        cols = problem.context.cols
        population = naive.packed(between, cols, data.draw(st.integers(0, 3)))
        expected = [TWINS[objective](problem, path) for path in between]
        measured = objective.measure(population, problem)
        assert measured.dtype == np.float64
        assert measured == pytest.approx(expected, abs=1e-12)

    check()


@pytest.mark.parametrize("objective", TWINS, ids=str)
def test_a_start_that_is_the_goal_can_be_measured(objective: pl.Objective) -> None:
    problem = pl.PathProblem(np.eye(4, dtype=bool)[::-1], start=(1, 1), goal=(1, 1))
    (value,) = objective.measure(np.array([[5]], np.int32), problem)
    assert value == pytest.approx(TWINS[objective](problem, ((1, 1),)))


@pytest.mark.parametrize("objective", TWINS, ids=str)
def test_nobody_is_measured_as_nothing(objective: pl.Objective) -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool))
    assert objective.measure(np.empty((0, 1), np.int32), problem).shape == (0,)


def test_clearance_without_obstacles_is_the_maps_diagonal() -> None:
    problem = pl.PathProblem(np.zeros((3, 4), bool))
    assert Clearance().measure(np.array([[8, 3]], np.int32), problem).tolist() == [-5.0]


def test_unsafe_cells_do_not_count_the_border_of_the_map() -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool))
    assert UnsafeCells().measure(np.array([[6, 2]], np.int32), problem).tolist() == [0.0]


def test_metrics_are_those_of_the_path_as_drawn() -> None:
    # . . . g      from s two columns right and one row up, then straight up and right; the obstacle is #
    # . # . .
    # s . . .
    grid = pl.OccupancyGrid([[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]], resolution=0.5, origin=(0, 0, 0))
    found = metrics(np.array([(2, 0), (2, 2), (0, 3)]), pl.PathProblem(grid))
    assert found == {
        "length": 2 + math.sqrt(5),
        "nodes": 3,
        "turns": 1,
        "turn_angle": math.atan2(2, 1),
        "min_clearance": 0.5,
        "unsafe_nodes": 2,
        "length_m": 1 + math.sqrt(5) / 2,
    }


def test_metrics_on_an_empty_map_know_no_clearance_and_no_metres() -> None:
    found = metrics(np.array([(1, 0), (0, 1)]), pl.PathProblem(np.zeros((2, 2), bool)))
    assert found["min_clearance"] is None
    assert "length_m" not in found
