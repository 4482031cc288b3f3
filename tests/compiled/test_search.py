"""Kernels that search, against Dijkstra's algorithm on dictionaries; seeds from trees by what they must be."""

import math

import naive
import numpy as np
import pytest
from hypothesis import given
from naive import POLICIES, examples

from pathloom import PathProblem, compiled


@given(problem=naive.problems())
@examples(80)
def test_the_octile_path_is_legal_and_as_short_as_its_twin(problem: PathProblem) -> None:
    it = problem.context
    cells = compiled.search.octile_path(it.moves, it.cols, it.start, it.goal)
    best = naive.octile_distances(it.occupied, problem.start, problem.corners).get(problem.goal)
    if best is None:
        assert len(cells) == 0
        return
    path = tuple(divmod(cell, it.cols) for cell in cells.tolist())
    assert (path[0], path[-1]) == problem.ends
    assert naive.steps_singly(path)
    assert naive.path_free(it.occupied, path, problem.corners)
    assert naive.length(path) == pytest.approx(best, abs=1e-9)


def from_trees(problem: PathProblem, n: int, state: list[int], spread: float = 1.0, detour: float = 1.5) -> np.ndarray:
    it = problem.context
    return compiled.seeding.sample_from_trees(
        n, 1, it.moves, it.cols, it.start, it.goal, it.reachable_cells, spread, detour, np.array(state, np.uint64)
    )


@given(problem=naive.problems(), state=naive.words)
@examples(60)
def test_seeds_from_trees_are_legal_and_free_of_loops(problem: PathProblem, state: list[int]) -> None:
    it = problem.context
    if not it.reachable:
        return
    found = from_trees(problem, 5, state)
    assert found.tobytes() == from_trees(problem, 5, state).tobytes()
    paths = naive.unpacked(found, it.cols)
    assert len(paths) == 5
    for path in paths:
        assert (path[0], path[-1]) == problem.ends
        assert naive.steps_singly(path)
        assert naive.path_free(it.occupied, path, problem.corners)
        assert len(set(path)) == len(path)


@pytest.mark.parametrize("corners", POLICIES)
def test_seeds_of_even_prices_and_no_detour_are_shortest(corners: str) -> None:
    problem = PathProblem(np.zeros((12, 9), bool), corners=corners)
    found = from_trees(problem, 20, [1, 2, 3, 4], spread=0.0, detour=1.0)
    assert compiled.measures.lengths(found, 9) == pytest.approx([3 + 8 * math.sqrt(2)] * 20)


def test_seeds_in_a_corridor_are_the_corridor() -> None:
    problem = PathProblem(np.zeros((1, 6), bool), start=(0, 5), goal=(0, 0))
    assert from_trees(problem, 2, [1, 2, 3, 4]).tolist() == [[5, 4, 3, 2, 1, 0]] * 2


def test_seeds_of_a_start_that_is_the_goal_are_that_cell() -> None:
    problem = PathProblem(np.zeros((4, 4), bool), start=(2, 1), goal=(2, 1))
    assert from_trees(problem, 3, [1, 2, 3, 4]).tolist() == [[9]] * 3


def test_long_seeds_fit_however_much_room_was_guessed() -> None:
    serpentine = np.zeros((61, 40), bool)
    serpentine[1::4, :-1] = serpentine[3::4, 1:] = True
    problem = PathProblem(serpentine, start=(60, 0), goal=(0, 0))
    found = from_trees(problem, 30, [1, 2, 3, 4], detour=2.0)
    assert found.shape[1] > 1000
    for path in naive.unpacked(found, 40):
        assert naive.steps_singly(path)
        assert (path[0], path[-1]) == problem.ends
