"""Constraints as texts and as bounds."""

import numpy as np
import pytest

import pathloom as pl
from pathloom.exact.octile import octile_path
from pathloom.kernel.compose import build, freeze
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.registry import default_registry
from pathloom.paths.constraints import Bound, check_constraints, least, parse_constraint
from pathloom.paths.objectives import Clearance, Length, Turns, UnsafeCells
from pathloom.paths.tree_seeding import PerturbedTrees

PROBLEM = pl.PathProblem(pl.load_map("random-12:20:s1"))


@pytest.fixture(scope="module")
def population():
    return PerturbedTrees().sample(PROBLEM, 40, np.random.default_rng(0))


@pytest.mark.parametrize(
    ("text", "bound"),
    [
        ("clearance>=0.3", Bound(objective=Clearance(), at_least=0.3)),
        ("clearance ≥ .3", Bound(objective=Clearance(), at_least=0.3)),
        (" length <= 1.2 x optimum ", Bound(objective=Length(), at_most=1.2, relative_to_optimum=True)),
        ("length<=1.2×optimum", Bound(objective=Length(), at_most=1.2, relative_to_optimum=True)),
        ("length ≤ 12*optimum", Bound(objective=Length(), at_most=12, relative_to_optimum=True)),
        ("unsafe-cells<=1e1", Bound(objective=UnsafeCells(), at_most=10)),
    ],
)
def test_a_text_names_a_bound(text, bound):
    assert parse_constraint(text) == bound


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("length", "allowed 'OBJECTIVE <= NUMBER'"),
        ("length < 3", "allowed 'OBJECTIVE <= NUMBER'"),
        ("length <= many", "allowed 'OBJECTIVE <= NUMBER'"),
        ("length <= 1.2.3", "'1.2.3' is no number"),
        ("lenght <= 3", "did you mean 'length'"),
        ("turns <= nan", "allowed"),
    ],
)
def test_a_text_that_names_none_is_refused_in_one_line(text, words):
    with pytest.raises(pl.ConfigError, match=".") as error:
        parse_constraint(text)
    assert words in str(error.value)
    assert text.strip() in str(error.value)
    assert "\n" not in str(error.value)


def test_a_violation_is_the_share_by_which_a_limit_is_overstepped(population):
    lengths = Length().measure(population, PROBLEM)
    limit = float(np.median(lengths))
    found = Bound(objective=Length(), at_most=limit).violation(population, PROBLEM)
    for value, violation in zip(lengths.tolist(), found.tolist(), strict=True):
        assert violation == pytest.approx(max(0.0, value - limit) / limit)
    assert (found > 0).any()
    assert (found == 0).any()


def test_a_clearance_of_at_least_is_meant_as_people_say_it(population):
    clearances = -Clearance().measure(population, PROBLEM)
    limit = float(clearances.max())
    found = parse_constraint(f"clearance >= {limit!r}").violation(population, PROBLEM)
    assert ((found == 0.0) == (clearances >= limit)).all()
    assert (parse_constraint("clearance >= 9").violation(population, PROBLEM) > 0).all()


def test_both_limits_count(population):
    turns = Turns().measure(population, PROBLEM)
    bound = Bound(objective=Turns(), at_least=5, at_most=7)
    assert ((bound.violation(population, PROBLEM) == 0.0) == ((turns >= 5) & (turns <= 7))).all()


def test_the_optimum_is_the_exact_one_of_cell_paths():
    assert least(Length(), PROBLEM) == pytest.approx(octile_path(PROBLEM)[0])
    shortest = octile_path(PROBLEM)[1]
    tight = parse_constraint("length <= 1 x optimum")
    assert tight.violation(PROBLEM.representation.encode([shortest]), PROBLEM).tolist() == [0.0]


def test_the_optimum_of_what_is_not_additive_is_not_known(population):
    with pytest.raises(pl.ConfigError, match="no exact optimum of 'clearance' is known"):
        parse_constraint("clearance >= 0.5 x optimum").violation(population, PROBLEM)


CONTRADICTIONS = [
    ["length >= 12", "length <= 11"],
    ["length <= 11", "length <= 30", "length >= 12"],
    ["length >= 1.3 x optimum", "length <= 1.2 x optimum"],
    ["length <= 0.9 x optimum"],
]


@pytest.mark.parametrize("texts", CONTRADICTIONS)
def test_contradictory_constraints_are_refused(texts):
    with pytest.raises(pl.ConfigError, match="contradict each other|no path is better than the optimum"):
        check_constraints([parse_constraint(text) for text in texts])


def test_other_constraints_go_together():
    texts = ["length <= 0", "turns >= 0", "length >= -1", "unsafe-cells <= 3", "length <= 2 x optimum"]
    check_constraints([parse_constraint(text) for text in texts])


@pytest.mark.parametrize("limits", [{}, {"at_most": np.inf}, {"at_least": 3, "at_most": 2}])
def test_a_bound_without_sense_is_refused(limits):
    with pytest.raises(pl.ConfigError):
        Bound(objective=Length(), **limits)


def test_a_bound_is_rebuilt_from_its_table():
    bound = parse_constraint("length <= 1.2 x optimum")
    assert build(Constraint, freeze(bound), default_registry(), "") == bound
    assert bound.text == "length <= 1.2 x optimum"
