"""Seeds from trees over cells and headings, priced by the objectives."""

import naive
import numpy as np
import pytest
from exact.headings import cheapest_walk, simple_paths
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, examples

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.paths.additive import Prices, additive_terms, weighted
from pathloom.paths.objectives import Clearance, Length, ObstaclesBeside, Turns, UnsafeCells
from pathloom.paths.priced_trees import PricedTrees
from pathloom.paths.tree_seeding import PerturbedTrees

TERMS = pl.Terms({"length": Length(), "unsafe": (UnsafeCells(), 2.0), "turns": (Turns(), 0.5)})


def sum_of(terms: pl.Terms, problem: pl.PathProblem) -> Prices:
    prices = additive_terms(terms, problem)
    assert prices is not None
    return weighted(prices, terms.weights)


@given(problem=naive.problems(max_side=7), seed=st.integers(0, 9), detour=st.sampled_from([1.0, 1.4, 3.0]))
@examples(80)
def test_without_perturbation_no_path_costs_more_than_its_detour(problem, seed: int, detour: float) -> None:
    prices = sum_of(TERMS, problem)
    sampling = PricedTrees(objectives=TERMS, spread=0.0, detour=detour)
    found = sampling.sample(problem, 6, np.random.default_rng(seed))
    assert len(found) == (6 if problem.reachable else 0)
    if len(found):
        # detours are measured without what every path pays
        best = cheapest_walk(problem, prices) - prices.constant
        cost = prices.along(found, problem) - prices.constant
        assert (cost <= detour * best + 1e-9).all()
        assert detour > 1.0 or cost == pytest.approx(best)


@pytest.mark.parametrize("corners", POLICIES)
def test_through_some_state_every_cheap_way_is_drawn(corners: str) -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool), start=(2, 0), goal=(0, 2), corners=corners)
    length = pl.Terms({"length": Length()})
    found = PricedTrees(objectives=length, spread=0.0, detour=1.25).sample(problem, 400, np.random.default_rng(0))
    drawn = set(naive.unpacked(found, 3))
    assert drawn <= {
        path for path in simple_paths(problem) if naive.length(path) <= 1.25 * naive.length(((2, 0), (0, 2)))
    }
    assert {cell for path in drawn for cell in path} == {(2, 0), (1, 1), (0, 2), (1, 0), (2, 1), (0, 1), (1, 2)}


@given(problem=naive.problems(max_side=8), seed=st.integers(0, 9), spread=st.sampled_from([0.1, 1.0, 50.0]))
@examples(60)
def test_paths_are_legal_and_free_of_loops(problem: pl.PathProblem, seed: int, spread: float) -> None:
    found = PricedTrees(spread=spread, detour=2.0).sample(problem, 6, np.random.default_rng(seed))
    assert len(found) == (6 if problem.reachable else 0)
    assert found.dtype == np.int32
    for path in naive.unpacked(found, problem.context.cols):
        assert pl.validate(path, problem) is None
        assert naive.steps_singly(path)
        assert len(set(path)) == len(path)


def test_they_cost_less_than_those_along_short_ways() -> None:
    problem = pl.PathProblem(pl.load_map("random-50:20%"))
    prices = sum_of(TERMS, problem)
    priced = PricedTrees(objectives=TERMS).sample(problem, 60, np.random.default_rng(0))
    short = PerturbedTrees().sample(problem, 60, np.random.default_rng(0))
    assert prices.along(priced, problem).mean() < 0.95 * prices.along(short, problem).mean()


def test_the_objectives_are_the_planners_unless_named() -> None:
    assert PricedTrees().serving(TERMS).objectives == TERMS
    named = PricedTrees(objectives=pl.Terms({"turns": Turns()}))
    assert named.serving(TERMS) == named


@pytest.mark.parametrize("sampling", [PricedTrees(cells=400), PricedTrees(objectives=pl.Terms({"c": Clearance()}))])
def test_large_maps_and_other_objectives_are_left_to_the_rest(sampling: PricedTrees) -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75"))
    with counting() as counts:
        found = sampling.sample(problem, 9, np.random.default_rng(4))
    assert counts["samples by fallback"] == 9
    assert found.tobytes() == PerturbedTrees().sample(problem, 9, np.random.default_rng(4)).tobytes()


def test_what_is_not_additive_is_left_out_and_counted() -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75"))
    with counting() as counts:
        terms = pl.Terms({"length": Length(), "beside": ObstaclesBeside()})
        found = PricedTrees(objectives=terms).sample(problem, 9, np.random.default_rng(4))
    assert counts == {"objectives not additive": 1}
    only = PricedTrees(objectives=pl.Terms({"length": Length()})).sample(problem, 9, np.random.default_rng(4))
    assert found.tobytes() == only.tobytes()
