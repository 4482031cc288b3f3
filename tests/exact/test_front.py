"""Exact fronts, against all paths of small maps, and against whole lists of values on larger ones."""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, STEPS, Cell, examples, packed, problems

import pathloom as pl
from exact.headings import front_of, not_dominated, simple_paths
from exact.test_additive import JUNCTION
from pathloom.exact.front import exact_front
from pathloom.kernel.evaluation import measure
from pathloom.paths.additive import Prices, additive_terms
from pathloom.paths.objectives import Clearance, Length, TurnAngle, Turns, UnsafeCells
from pathloom_hga_aco.objectives import AngleTablePenalty
from pathloom_imaga.objectives import D4ObstacleCount
from pathloom_imga.objectives import QuadrantEnergy, UnsafeNode


@dataclass(frozen=True, kw_only=True)
class Slope(pl.PathObjective):
    """A third party's objective: metres climbed over hills that it knows, one path at a time."""

    works_on: ClassVar[str] = "cells"

    def measure_one(self, path, problem):
        heights = self._heights(problem)[tuple(path.T)]
        return float(np.maximum(np.diff(heights), 0).sum())

    def prices(self, problem):
        height = self._heights(problem)
        row, col = np.indices(height.shape)
        step = np.zeros((height.size, 8))
        for d, (dr, dc) in enumerate(STEPS):
            r, c = np.clip(row + dr, 0, len(height) - 1), np.clip(col + dc, 0, height.shape[1] - 1)
            step[:, d] = np.maximum(height[r, c] - height, 0).ravel()
        return Prices(step=step)

    @staticmethod
    def _heights(problem):
        return np.random.default_rng(1).random(problem.grid.shape)


SETS = (
    {"length": Length(), "unsafe": UnsafeCells()},
    {"length": Length(), "unsafe": UnsafeCells(), "turns": Turns()},
    {"turns": Turns(), "angle": TurnAngle(), "length": Length()},
    {"length": Length(), "slope": Slope()},
    {"slope": Slope(), "turns": Turns(), "beside": D4ObstacleCount(), "length": Length()},
    {"length": Length(), "node": UnsafeNode(per="obstacle"), "energy": QuadrantEnergy()},
    {"angle": TurnAngle(), "slope": Slope(), "unsafe": UnsafeCells(), "length": Length(), "turns": Turns()},
)


def rounded(values: np.ndarray) -> set[tuple[float, ...]]:
    return set(map(tuple, (np.round(values, 6) + 0.0).tolist()))


def assert_a_front(front, problem: pl.PathProblem, terms: pl.Terms) -> None:
    """Check what stands on a front: paths without loops, with their values, in order."""
    for row in front.population:
        path = problem.representation.decode(row)
        assert pl.validate(path, problem) is None
        assert len(set(map(tuple, path.tolist()))) == len(path)
    assert front.population.dtype == np.int32
    assert front.population.flags.c_contiguous
    assert (measure(list(terms.objectives()), front.population, problem) == front.values).all()
    assert front.values.tolist() == sorted(front.values.tolist())


@given(problem=problems(max_side=4), objectives=st.sampled_from(SETS))
@examples(150)
def test_the_front_is_that_of_all_paths(problem: pl.PathProblem, objectives: dict) -> None:
    terms = pl.Terms(objectives)
    front = exact_front(problem, terms)
    if front is None:
        assert not all(prices.loops_never_pay for prices in additive_terms(terms, problem))
        return
    paths = list(simple_paths(problem))
    if not paths:
        assert len(front) == 0
        assert front.values.shape == (0, len(terms))
        return
    values = measure(list(terms.objectives()), packed(paths, problem.context.cols), problem)
    assert rounded(front.values) == not_dominated(rounded(values))
    assert len(front) == len(rounded(front.values))
    assert_a_front(front, problem, terms)


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("objectives", SETS, ids="-".join)
def test_the_front_of_a_map_of_25_cells_is_that_of_all_paths(objectives: dict, corners: str) -> None:
    blocked = np.random.default_rng(7).random((5, 5)) < 0.45
    blocked[4, 0] = blocked[0, 4] = blocked[3, 0] = blocked[0, 3] = blocked[2, 2] = False
    problem = pl.PathProblem(blocked, corners=corners)
    terms = pl.Terms(objectives)
    front = exact_front(problem, terms)
    paths = list(simple_paths(problem))
    values = measure(list(terms.objectives()), packed(paths, 5), problem) if paths else np.empty((0, len(terms)))
    assert front is not None
    assert rounded(front.values) == not_dominated(rounded(values))


def add_length_unsafe_turns(unsafe: np.ndarray):
    """Return how (length, unsafe cells, turns) grow by a step; lengths in whole 2⁻³⁰ of a cell."""

    def add(value, heading: int, here: Cell, d: int, there: Cell):
        length, cells, turns = value
        turned = heading >= 0 and heading != d
        return length + round(2**30 * math.sqrt(1 + d % 2)), cells + int(unsafe[there]), turns + turned

    return add


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("name", ["iga-map1", "random-9:10:s1"])
def test_the_front_of_a_larger_map_is_its_twins(name: str, corners: str) -> None:
    problem = pl.PathProblem(pl.load_map(name, corners=corners), corners=corners)
    terms = pl.Terms({"length": Length(), "unsafe": UnsafeCells(), "turns": Turns()})
    it = problem.context
    unsafe = it.unsafe.reshape(it.rows, it.cols)
    values = front_of(problem, add_length_unsafe_turns(unsafe), 3)
    wanted = {(round(length / 2**30, 6), float(u + unsafe[problem.start]), float(t)) for length, u, t in values}
    front = exact_front(problem, terms)
    assert front is not None
    assert rounded(front.values) == wanted
    assert_a_front(front, problem, terms)


def test_the_order_of_objectives_does_not_matter() -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75"))
    one = exact_front(problem, pl.Terms({"a": Length(), "b": UnsafeCells(), "c": Turns()}))
    other = exact_front(problem, pl.Terms({"c": Turns(), "b": UnsafeCells(), "a": Length()}))
    assert rounded(one.values) == rounded(other.values[:, ::-1])


def test_past_the_limit_of_labels_there_is_no_front() -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75"))
    terms = pl.Terms({"a": Length(), "b": UnsafeCells()})
    assert exact_front(problem, terms, labels=10) is None
    assert exact_front(problem, terms) is not None


def test_objectives_that_are_not_additive_have_no_exact_front() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"))
    assert exact_front(problem, pl.Terms({"a": Length(), "b": Clearance()})) is None


def test_where_a_loop_pays_there_is_no_proof_and_no_front() -> None:
    grid = np.array([[glyph == "#" for glyph in line] for line in JUNCTION.split()])
    problem = pl.PathProblem(grid, start=(3, 0), goal=(0, 2))
    assert exact_front(problem, pl.Terms({"a": Length(), "b": AngleTablePenalty()})) is None


def test_a_start_that_is_the_goal_and_a_goal_out_of_reach() -> None:
    terms = pl.Terms({"a": Length(), "b": UnsafeCells()})
    front = exact_front(pl.PathProblem([[0, 1]], start=(0, 0), goal=(0, 0)), terms)
    assert front.values.tolist() == [[0.0, 1.0]]
    assert front.population.tolist() == [[0]]
    nothing = exact_front(pl.PathProblem([[0, 1, 0]]), terms)
    assert len(nothing) == 0
