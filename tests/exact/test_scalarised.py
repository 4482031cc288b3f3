"""Seeds from scalarised exact searches."""

import naive
import numpy as np
import pytest

import pathloom as pl
from pathloom.exact.additive import additive_path
from pathloom.exact.front import exact_front
from pathloom.exact.scalarised import Scalarised, _lattice
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import measure
from pathloom.paths.additive import additive_terms, weighted
from pathloom.paths.objectives import Clearance, Length, Turns, UnsafeCells
from pathloom.paths.tree_seeding import PerturbedTrees

TERMS = pl.Terms({"length": (Length(), 1.0), "unsafe": (UnsafeCells(), 0.5), "turns": (Turns(), 2.0)})
PROBLEM = pl.PathProblem(pl.load_map("random-20:75"))


def values(population: np.ndarray, problem: pl.PathProblem = PROBLEM, terms: pl.Terms = TERMS) -> np.ndarray:
    return measure(list(terms.objectives()), population, problem)


def test_what_is_found_stands_on_the_exact_front() -> None:
    with counting() as counts:
        found = Scalarised(objectives=TERMS).sample(PROBLEM, 40, np.random.default_rng(0))
    optima = found[: 40 - counts["samples by fallback"]]
    front = np.round(exact_front(PROBLEM, TERMS).values, 6).tolist()
    assert len(optima) >= 8
    assert all(value in front for value in np.round(values(optima), 6).tolist())


def test_the_ends_of_the_front_are_among_them() -> None:
    found = values(Scalarised(objectives=TERMS).sample(PROBLEM, 40, np.random.default_rng(0)))
    assert found.min(axis=0) == pytest.approx(exact_front(PROBLEM, TERMS).values.min(axis=0))


def test_one_weighting_is_that_of_the_objectives_themselves() -> None:
    with counting() as counts:
        found = Scalarised(objectives=TERMS, vectors=1).sample(PROBLEM, 10, np.random.default_rng(0))
    best = additive_path(PROBLEM, weighted(additive_terms(TERMS, PROBLEM), TERMS.weights))
    assert (values(found) @ TERMS.weights)[0] == pytest.approx(best.cost)
    assert counts == {"samples by fallback": 9}
    assert len(found) == 10


def test_optima_come_once_each() -> None:
    with counting() as counts:
        found = Scalarised(objectives=TERMS).sample(PROBLEM, 40, np.random.default_rng(3))
    optima = found[: 40 - counts["samples by fallback"]]
    assert len(set(naive.unpacked(optima, 20))) == len(optima)


def test_what_is_not_additive_is_left_out_and_counted() -> None:
    terms = pl.Terms({"length": Length(), "clearance": Clearance()})
    with counting() as counts:
        found = Scalarised(objectives=terms, vectors=1).sample(PROBLEM, 2, np.random.default_rng(0))
    assert counts == {"objectives not additive": 1, "samples by fallback": 1}
    assert values(found, terms=terms)[0, 0] == pytest.approx(pl.octile_path(PROBLEM)[0])


@pytest.mark.parametrize("sampling", [Scalarised(work=399), Scalarised(objectives=pl.Terms({"c": Clearance()}))])
def test_on_large_maps_and_without_additive_objectives_the_rest_makes_all(sampling: Scalarised) -> None:
    with counting() as counts:
        found = sampling.sample(PROBLEM, 7, np.random.default_rng(5))
    assert counts["samples by fallback"] == 7
    assert len(found) == 7


def test_the_rest_is_made_by_whom_one_likes() -> None:
    wide = Scalarised(work=1, rest=PerturbedTrees(spread=9.0)).sample(PROBLEM, 7, np.random.default_rng(5))
    assert wide.shape[0] == 7


def test_no_way_no_sample() -> None:
    assert len(Scalarised().sample(pl.PathProblem([[0, 1, 0]]), 5, np.random.default_rng(0))) == 0


@pytest.mark.parametrize(("m", "most"), [(2, 66), (3, 66), (3, 7), (4, 66), (5, 100)])
def test_the_lattice_has_shares_that_add_up_to_one(m: int, most: int) -> None:
    shares = _lattice(m, most)
    assert 0 < len(shares) <= most
    assert shares.sum(axis=1) == pytest.approx(1.0)
    assert len(np.unique(shares.round(9), axis=0)) == len(shares)
    assert (shares.max(axis=1) < 1.0).all()


def test_too_few_weightings_have_no_lattice() -> None:
    assert _lattice(5, 3).shape == (0, 5)
    with counting() as counts:
        Scalarised(objectives=TERMS, vectors=5).sample(PROBLEM, 9, np.random.default_rng(0))
    assert counts["samples by fallback"] >= 4
