"""The cheapest path for additive objectives, against every path and against a search without bounds."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, examples, length, problems
from paths.test_additive import any_prices

import pathloom as pl
from exact.headings import cheapest_walk, priced, simple_paths
from pathloom.exact.additive import additive_optimum, additive_path
from pathloom.paths.additive import Prices, additive_terms, prices_of, weighted
from pathloom.paths.objectives import Clearance, Length, TurnAngle, Turns, UnsafeCells
from pathloom.paths.tree_seeding import PerturbedTrees
from pathloom_agacd.planner import Agacd
from pathloom_hga_aco.objectives import AngleTablePenalty
from pathloom_imga.objectives import QuadrantEnergy, UnsafeNode
from pathloom_imga.planner import Imga

SETS = (
    {"length": Length()},
    {"turns": Turns()},
    {"length": (Length(), 0.3), "unsafe": (UnsafeCells(), 2.0), "turns": (Turns(), 1.0)},
    {"length": (Length(), 1.0), "angle": (TurnAngle(), 4.0), "unsafe": (UnsafeNode(), 0.1)},
    {"length": (Length(), 0.1), "energy": (QuadrantEnergy(), 1.0)},
)


def sum_of(terms: pl.Terms, problem: pl.PathProblem) -> Prices:
    prices = additive_terms(terms, problem)
    assert prices is not None
    return weighted(prices, terms.weights)


def assert_a_path(path: np.ndarray, problem: pl.PathProblem) -> None:
    assert pl.validate(path, problem) is None
    assert len({tuple(cell) for cell in path.tolist()}) == len(path)
    assert (np.abs(np.diff(path, axis=0)).max(axis=1, initial=0) <= 1).all()


@given(problem=problems(max_side=4), terms=st.sampled_from(SETS))
@examples(120)
def test_no_path_of_a_small_map_is_cheaper(problem: pl.PathProblem, terms: dict) -> None:
    prices = sum_of(pl.Terms(terms), problem)
    best = min((priced(prices, path, problem.context.cols) for path in simple_paths(problem)), default=math.inf)
    found = additive_path(problem, prices)
    assert (found.path is None) == (best == math.inf)
    assert found.bound <= best + 1e-9
    if prices.loops_never_pay:
        assert found.cost == pytest.approx(best, abs=1e-9)
        assert found.proven
    if found.path is not None:
        assert_a_path(found.path, problem)
        assert found.cost == pytest.approx(priced(prices, tuple(map(tuple, found.path.tolist())), problem.context.cols))


@given(data=st.data(), problem=problems(max_side=7))
@examples(100)
def test_the_bound_is_the_cheapest_walk_under_any_prices(data: st.DataObject, problem: pl.PathProblem) -> None:
    prices = data.draw(any_prices(problem.context.blocked.size))
    found = additive_path(problem, prices)
    assert found.bound == pytest.approx(cheapest_walk(problem, prices))
    assert found.cost >= found.bound - 1e-9
    if found.path is not None:
        assert_a_path(found.path, problem)


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("name", ["iga-map1", "random-20:75", "maze-15:2"])
def test_length_alone_gives_the_octile_optimum(name: str, corners: str) -> None:
    problem = pl.PathProblem(pl.load_map(name, corners=corners), corners=corners)
    found = additive_path(problem, sum_of(pl.Terms({"length": Length()}), problem))
    assert found.cost == pytest.approx(pl.octile_path(problem)[0])
    assert found.cost == pytest.approx(length(tuple(map(tuple, found.path.tolist()))))


def test_a_start_that_is_the_goal_costs_the_constant() -> None:
    found = additive_path(pl.PathProblem(np.zeros((3, 3), bool), start=(1, 1), goal=(1, 1)), Prices(constant=2.5))
    assert found.cost == found.bound == 2.5
    assert found.path.tolist() == [[1, 1]]


def test_a_goal_out_of_reach_costs_inf() -> None:
    assert additive_path(pl.PathProblem([[0, 1, 0]]), Prices()) == (math.inf, None, math.inf)


# From the corridor at the left into the one at the top: a right angle, unless one drives a loop through the room.
JUNCTION = """
##.#####
##.#####
##.#####
........
##......
##......
##......
"""


def test_where_a_loop_pays_the_path_has_none_and_the_bound_tells() -> None:
    grid = [[glyph == "#" for glyph in line] for line in JUNCTION.split()]
    problem = pl.PathProblem(np.array(grid), start=(3, 0), goal=(0, 2))
    prices = prices_of(AngleTablePenalty(), problem)
    assert prices is not None
    found = additive_path(problem, prices)
    assert (found.bound, found.cost, found.proven) == (60.0, 100.0, False)  # 6 turns by 45°, or 1 by 90°
    assert_a_path(found.path, problem)


def test_the_optimum_of_a_planner_is_below_whatever_it_can_find() -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75"))
    planner = Imga()
    best = additive_optimum(problem, planner)
    assert best is not None
    assert best.proven
    seeds = PerturbedTrees().sample(problem, 300, np.random.default_rng(0))
    values = planner.evaluate(seeds, problem).values @ planner.weights(problem)
    assert values.min() >= best.cost - 1e-9
    row = problem.representation.encode([best.path])
    assert (planner.evaluate(row, problem).values @ planner.weights(problem))[0] == pytest.approx(best.cost)


def test_planners_with_other_objectives_have_no_such_optimum() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"))
    assert additive_optimum(problem, Agacd()) is None
    assert additive_optimum(problem, pl.compose("pymoo/nsga2")) is None


def test_what_has_no_weight_need_not_be_additive() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"))
    terms = pl.Terms({"length": Length(), "clearance": (Clearance(), 0.0)})
    best = additive_optimum(problem, Imga(objectives=terms))
    assert best is not None
    assert best.cost == pytest.approx(pl.octile_path(problem)[0])
