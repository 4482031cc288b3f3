"""Additive objectives: what they are said to charge adds up to what they measure."""

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import naive
import numpy as np
import pytest
from exact.headings import priced
from hypothesis import given
from hypothesis import strategies as st
from naive import Cells, examples

import pathloom as pl
from pathloom.kernel.component import parameters
from pathloom.kernel.registry import default_registry
from pathloom.paths.additive import HEADINGS, STEP_LENGTHS, Prices, additive_terms, price_of_turns, prices_of, weighted
from pathloom.paths.objectives import Clearance, Length, Turns, UnsafeCells
from pathloom.paths.tree_seeding import PerturbedTrees
from pathloom_hga_aco.objectives import AngleTablePenalty
from pathloom_imga.objectives import QuadrantEnergy, UnsafeNode

MAPS = ("iga-map1", "blocks-12:20%:s3", "random-20:75", "maze-15:2", "empty-5")
REGISTERED = [
    entry.component()
    for entry in default_registry().all_entries()
    if issubclass(entry.component, pl.Objective) and not any(p.required for p in parameters(entry.component))
]
VARIANTS = [
    AngleTablePenalty(reading="as-printed", base=2.0),
    UnsafeNode(per="obstacle", penalty=1.5),
    QuadrantEnergy(by_angle="always"),
]
SMALL = pl.PathProblem(np.zeros((3, 3), bool))


def test_the_additive_objectives_are_these() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"))
    found = {o.name for o in REGISTERED if type(o).__module__.startswith("pathloom") and prices_of(o, problem)}
    assert found == {
        "length", "unsafe-cells", "turns", "turn-angle", "turn-angle-sum", "unsafe-node", "quadrant-energy",
        "d4-obstacle-count", "turn-count", "angle-table-penalty", "smoothness-penalty", "smooth-d2-legacy",
    }  # fmt: skip


@pytest.mark.parametrize("corners", naive.POLICIES)
@pytest.mark.parametrize("objective", [*REGISTERED, *VARIANTS], ids=lambda o: o.name)
def test_prices_along_a_path_add_up_to_its_value(objective: pl.Objective, corners: str) -> None:
    for name in MAPS:
        for aligned in (False, True):
            problem = pl.PathProblem(pl.load_map(name, corners=corners), corners=corners)
            if aligned and name == "empty-5":
                problem = pl.PathProblem(problem.grid, start=(2, 0), goal=(2, 4), corners=corners)
            prices = prices_of(objective, problem)
            if prices is None:
                return
            population = PerturbedTrees(spread=9.0, detour=3.0).sample(problem, 40, np.random.default_rng(3))
            np.testing.assert_allclose(
                prices.along(population, problem), objective.measure(population, problem), rtol=1e-12, atol=1e-9
            )


def walk(problem: pl.PathProblem, rng: np.random.Generator) -> Cells:
    """Return a walk at random to wherever it gets, without loops, and make that the goal."""
    path = [problem.start]
    for _ in range(12):
        onward = [c for _, c in naive.legal_steps(problem.context.occupied, path[-1], problem.corners) if c not in path]
        if not onward:
            break
        path.append(onward[rng.integers(len(onward))])
    return tuple(path)


@given(problem=naive.problems(max_side=6), seed=st.integers(0, 99))
@examples(60)
def test_prices_along_walks_anywhere_add_up_too(problem: pl.PathProblem, seed: int) -> None:
    path = walk(problem, np.random.default_rng(seed))
    there = pl.PathProblem(problem.grid, start=path[0], goal=path[-1], corners=problem.corners)
    population = naive.packed([path], there.context.cols)
    for objective in (*REGISTERED, *VARIANTS):
        prices = prices_of(objective, there)
        if prices is not None:
            value = objective.measure(population, there)[0]
            assert prices.along(population, there)[0] == pytest.approx(value, abs=1e-9), objective.name
            assert priced(prices, path, there.context.cols) == pytest.approx(value, abs=1e-9), objective.name


def test_another_step_than_a_single_one_has_no_price() -> None:
    problem = pl.PathProblem(np.zeros((3, 9), bool))
    paths = np.array([[0, 2, -1], [0, 10, 8], [0, 0, 1], [0, 1, 2]], np.int32)
    assert np.isnan(Prices(step=STEP_LENGTHS).along(paths, problem)).tolist() == [True, True, True, False]


@st.composite
def any_prices(draw: st.DrawFn, cells: int) -> Prices:
    """Draw prices of every shape."""
    rng = np.random.default_rng(draw(st.integers(0, 999)))
    zones, by_cell, some = draw(st.integers(1, 3)), draw(st.booleans()), draw(st.booleans())
    return Prices(
        constant=float(rng.integers(-3, 4)),
        step=rng.integers(0, 4, (cells if by_cell else 1, 8)),
        cell=rng.integers(0, 4, cells if some else 0),
        turn=rng.integers(0, 4, (zones, 8, 8)),
        zone=rng.integers(0, zones, cells if zones > 1 else 0),
    )


@given(data=st.data(), seed=st.integers(0, 99))
@examples(80)
def test_the_prices_of_a_weighted_sum_are_the_weighted_sum_of_prices(data: st.DataObject, seed: int) -> None:
    problem = pl.PathProblem(np.zeros((3, 4), bool))
    parts = [data.draw(any_prices(12)) for _ in range(3)]
    path = walk(problem, np.random.default_rng(seed))
    population = naive.packed([path], 4)
    one_by_one = [prices.along(population, problem)[0] for prices in parts]
    assert weighted(parts, [1.0, 0.5, 2.0]).along(population, problem)[0] == pytest.approx(
        one_by_one[0] + 0.5 * one_by_one[1] + 2.0 * one_by_one[2]
    )
    assert one_by_one == pytest.approx([priced(prices, path, 4) for prices in parts])


def test_loops_pay_where_a_sharp_turn_costs_more_than_easy_ones_to_the_same_heading() -> None:
    angle = np.array([[min(abs(a - b), 8 - abs(a - b)) for b in range(8)] for a in range(8)])
    assert Prices(turn=angle).loops_never_pay
    assert Prices(turn=angle > 0).loops_never_pay
    assert not Prices(turn=angle**2).loops_never_pay
    assert Prices(turn=np.where(angle > 0, np.arange(8.0), 0.0)).loops_never_pay
    assert Prices(turn=[angle, angle], zone=np.zeros(9)).loops_never_pay
    assert not Prices(turn=[angle, 3 * angle], zone=np.zeros(9)).loops_never_pay


@given(seed=st.integers(0, 999))
@examples(60)
def test_where_loops_never_pay_no_sequence_of_turns_is_cheaper_than_one(seed: int) -> None:
    turn = np.random.default_rng(seed).integers(2, 6, (8, 8)).astype(float)
    prices = Prices(turn=turn)
    table = prices.turn[0]
    cheaper = any(
        table[a, b] + table[b, c] < table[a, c] and (a - c) % 8 != 4
        for a in range(8) for b in range(8) for c in range(8)
    )  # fmt: skip
    # with prices of 2 and more three turns cost 6: two are enough to undercut one of 5
    assert prices.loops_never_pay == (not cheaper)


def test_the_table_of_turns_is_asked_for_by_paths_of_three_cells() -> None:
    def measured(paths: np.ndarray, cols: int) -> np.ndarray:
        steps = np.diff(np.stack(np.divmod(paths, cols), axis=-1), axis=1)
        return np.array([100 * HEADINGS.tolist().index(a) + HEADINGS.tolist().index(b) for a, b in steps.tolist()])

    assert price_of_turns(measured).tolist() == [[100 * a + b for b in range(8)] for a in range(8)]


@pytest.mark.parametrize(
    ("bad", "said"),
    [
        ({"step": np.ones(4)}, "step"),
        ({"turn": np.ones((8, 7))}, "turn"),
        ({"cell": np.ones((3, 3))}, "cell"),
        ({"zone": [0, 1]}, "zone"),
        ({"zone": [-1, 0]}, "zone"),
        ({"cell": [-1.0]}, "zero or more"),
        ({"step": np.full(8, np.nan)}, "finite"),
        ({"turn": np.full((8, 8), np.inf)}, "finite"),
    ],
)
def test_prices_of_the_wrong_shape_or_below_zero_are_refused(bad: dict, said: str) -> None:
    with pytest.raises(pl.PluginError, match=said):
        Prices(**bad)


@dataclass(frozen=True, kw_only=True)
class Toll(pl.Objective):
    """A third party's objective, priced for another map."""

    works_on: ClassVar[str] = "cells"

    def measure(self, population, problem):
        return np.zeros(len(population))

    def prices(self, problem):
        return Prices(cell=np.ones(5))


def test_prices_for_another_number_of_cells_name_the_objective() -> None:
    with pytest.raises(pl.PluginError, match=r"objective 'toll': wanted one price for each of 9 cells"):
        prices_of(Toll(), SMALL)


def test_terms_are_additive_together_or_not_at_all() -> None:
    assert len(additive_terms(pl.Terms({"a": Length(), "b": UnsafeCells(), "c": Turns()}), SMALL) or ()) == 3
    assert additive_terms(pl.Terms({"a": Length(), "b": Clearance()}), SMALL) is None
    assert prices_of(QuadrantEnergy(price=(1.0, 2.0, -1.0)), SMALL) is None


def test_straight_back_costs_as_much_as_the_dearest_turn() -> None:
    found = Prices(turn=np.arange(64.0).reshape(8, 8)).turn[0]
    assert {found[h, (h + 4) % 8] for h in range(8)} == {63.0}
    assert all(a != b for a, b in pairwise(np.delete(found[0], 4).tolist()))
