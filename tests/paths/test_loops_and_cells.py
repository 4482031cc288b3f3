"""Paths without loops and cell by cell stay legal; what obstacles beside a path cost; neighbours of each cell."""

import math

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, Cells, examples

import pathloom as pl
from pathloom import compiled
from pathloom.paths.loops import LoopRemoval
from pathloom.paths.objectives import ObstaclesBeside

RNG = np.random.default_rng(0)


def problem_on(blocked: np.ndarray, corners: str = "strict") -> pl.PathProblem:
    """Return a problem whose ends do not matter."""
    start = tuple(np.argwhere(~blocked)[0])
    return pl.PathProblem(blocked, start=start, goal=start, corners=corners)


@st.composite
def legal_paths(draw: st.DrawFn, max_side: int = 7) -> tuple[np.ndarray, str, list[Cells]]:
    """Draw a map, a corner policy and paths whose segments are free under it."""
    blocked, corners = draw(naive.maps(max_side)), draw(st.sampled_from(POLICIES))
    blocked.flat[draw(st.integers(0, blocked.size - 1))] = False
    free = naive.free_cells(blocked)
    paths = []
    for _ in range(3):
        path = [draw(st.sampled_from(free))]
        for _ in range(draw(st.integers(0, 4))):
            seen = [c for c in free if c != path[-1] and naive.segment_free(blocked, path[-1], c, corners)]
            if seen:
                path.append(draw(st.sampled_from(seen)))
        paths.append(tuple(path))
    return blocked, corners, paths


# Loops and cells --------------------------------------------------------------------------------


@given(drawn=legal_paths(max_side=4))
@examples(60)
def test_removal_of_loops_keeps_segments_that_were_there(drawn) -> None:
    blocked, corners, paths = drawn
    population = naive.packed(paths, blocked.shape[1], 2)
    cut = LoopRemoval().apply(population, problem_on(blocked, corners), RNG)
    assert naive.unpacked(cut, blocked.shape[1]) == [naive.without_loops(path) for path in paths]
    assert all(naive.path_free(blocked, path, corners) for path in naive.unpacked(cut, blocked.shape[1]))


@given(drawn=legal_paths())
@examples(120)
def test_cell_by_cell_a_legal_path_stays_legal_under_its_corner_policy(drawn) -> None:
    blocked, corners, paths = drawn
    cols = blocked.shape[1]
    for cells in naive.unpacked(compiled.reshaping.cell_by_cell(naive.packed(paths, cols), cols), cols):
        assert naive.path_free(blocked, cells, corners)


# Beside a path ----------------------------------------------------------------------------------


@given(drawn=legal_paths(), base=st.sampled_from([0.0, 1.0]), each=st.sampled_from([0.1, 1.0, 3.0]))
@examples(80)
def test_the_objective_charges_each_obstacle_beside_nodes_or_cells_once(drawn, base: float, each: float) -> None:
    blocked, corners, paths = drawn
    problem, population = problem_on(blocked, corners), naive.packed(paths, blocked.shape[1], 1)
    for of, cells in (("nodes", paths), ("cells", [naive.cell_by_cell(path) for path in paths])):
        measured = ObstaclesBeside(base=base, each=each, of=of).measure(population, problem)
        assert measured.dtype == np.float64
        expected = [base + each * len(naive.obstacles_beside(blocked, on)) for on in cells]
        assert measured == pytest.approx(expected, abs=1e-12)


def test_an_obstacle_beside_several_nodes_is_charged_once_and_both_ends_count() -> None:
    # S . . . G
    # # . # . #
    problem = pl.PathProblem([[0, 0, 0, 0, 0], [1, 0, 1, 0, 1]], start=(0, 0), goal=(0, 4))
    row = naive.packed([tuple((0, c) for c in range(5)), ((0, 0), (0, 4))], 5)
    assert ObstaclesBeside().measure(row, problem).tolist() == [3.0, 2.0]
    assert ObstaclesBeside(of="cells").measure(row, problem).tolist() == [3.0, 3.0]
    assert ObstaclesBeside(base=1.0, each=0.1).measure(row, problem) == pytest.approx([1.3, 1.2])


def test_the_border_of_the_map_is_no_obstacle() -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool))
    assert ObstaclesBeside(base=1.0, each=0.1).measure(np.array([[6, 0, 2]], np.int32), problem).tolist() == [1.0]


def test_nobody_passes_nothing() -> None:
    problem = pl.PathProblem(np.eye(3, dtype=bool), start=(2, 0), goal=(2, 0))
    for of in ("nodes", "cells"):
        assert ObstaclesBeside(of=of).measure(np.empty((0, 1), np.int32), problem).shape == (0,)


@pytest.mark.parametrize("bad", [{"base": -1.0}, {"each": 0.0}, {"each": math.nan}, {"of": "segments"}])
def test_what_an_obstacle_costs_is_a_number_above_zero(bad: dict) -> None:
    with pytest.raises(pl.ConfigError, match=f"obstacles-beside: {next(iter(bad))} is "):
        ObstaclesBeside(**bad)


@pytest.mark.parametrize("reach", [4, 8])
@pytest.mark.parametrize("border", [False, True])
def test_neighbours_are_counted_once_for_a_map(reach: int, border: bool) -> None:
    it = problem_on(np.random.default_rng(1).random((5, 7)) < 0.3).context
    padded = np.pad(it.occupied, 1, constant_values=border)
    around = [(r, c) for r in (0, 1, 2) for c in (0, 1, 2) if (r, c) != (1, 1) and (reach == 8 or 1 in (r, c))]
    expected = sum(padded[r : r + 5, c : c + 7].astype(int) for r, c in around)
    counted = it.neighbours(reach, border)
    assert counted.reshape(5, 7).tolist() == expected.tolist()
    assert it.neighbours(reach, border=border) is counted
    assert (it.neighbours() is counted) == (it.obstacles_near is counted) == (reach == 8 and not border)


def test_neighbours_of_another_radius_are_counted_anew() -> None:
    blocked = np.zeros((5, 5), bool)
    blocked[2, 2] = True
    point, disc = (pl.PathProblem(blocked, radius=radius).context.neighbours(8) for radius in (0.0, 0.6))
    assert (point.sum(), disc.sum()) == (8, 40)
