"""``pl.pareto``: what it returns, what it refuses, and that nothing of it goes unverified."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

import pathloom as pl
from pathloom.exact import validate
from pathloom.fronts import verified
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.front import Front
from pathloom.paths.objectives import Length, Turns, UnsafeCells

from .archive import RandomArchive, exhaustive


@pytest.fixture(scope="module")
def problem() -> pl.PathProblem:
    return pl.PathProblem(pl.load_map("random-20:75:s1"), corners="allow")


@pytest.fixture(scope="module")
def found(problem) -> pl.ParetoResult:
    return pl.pareto(problem, RandomArchive(), against=["imga"], prefer={"turns": 1}, exact=True)


def test_every_path_is_valid_and_none_dominates_another(problem, found):
    assert found.found
    assert len(found) == len(found.paths) == len(found.front) > 1
    assert all(validate(path, problem) is None for path in found.paths)
    assert exhaustive(found.values) == list(range(len(found)))
    assert found.values.tolist() == sorted(found.values.tolist())


def test_values_are_those_of_the_paths(problem, found):
    population = problem.representation.encode(list(found.paths))
    for column, objective in zip(found.values.T, (Length(), UnsafeCells(), Turns()), strict=True):
        np.testing.assert_array_equal(column, objective.measure(population, problem))


def test_indicators_are_held_against_the_exact_front(found):
    assert len(found.exact) == found.indicators["exact_size"]
    assert 0.5 < found.indicators["hypervolume_ratio"] <= 1.0
    assert found.indicators["igd_plus"] >= 0.0


def test_the_preferred_member_is_the_best_at_what_was_asked_for(found):
    assert found.values[found.choice.preferred, 2] == found.values[:, 2].min()
    assert found.choice.preference == {"length": 0.0, "unsafe-cells": 0.0, "turns": 1.0}


def test_json_and_back_is_the_same(found):
    again = pl.ParetoResult.from_json(found.to_json())
    assert again.to_json() == found.to_json()
    np.testing.assert_array_equal(again.values, found.values)
    assert [p.tolist() for p in again.paths] == [p.tolist() for p in found.paths]
    assert again.against == found.against
    assert again.choice == found.choice


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"schema": "pathloom.plan/1"}', '{"schema": "pathloom.pareto/1"}'])
def test_what_is_no_front_is_refused_as_json(text):
    with pytest.raises(pl.PathloomError, match="pathloom.pareto/1"):
        pl.ParetoResult.from_json(text)


def test_the_same_seed_gives_the_same_front(problem, found):
    again = pl.pareto(problem, RandomArchive(), against=["imga"], prefer={"turns": 1}, exact=True)
    assert again.to_dict()["front"] == found.to_dict()["front"]
    assert again.to_dict()["against"] == found.to_dict()["against"]
    assert again.indicators == found.indicators
    other = pl.pareto(problem, RandomArchive(each=3), seed=1)
    assert other.to_dict()["front"] != found.to_dict()["front"]


def test_a_rival_runs_with_as_many_seeds_as_are_asked_for(problem):
    placed = pl.pareto(problem, RandomArchive(), seed=4, against=["imga", "ga-imga"], runs=2).against
    assert [(rival.planner, rival.seed) for rival in placed] == [
        ("imga", 4), ("imga", 5), ("ga-imga", 4), ("ga-imga", 5)
    ]  # fmt: skip


def test_weights_beside_the_objectives_are_a_preference(problem):
    weighted = pl.pareto(problem, RandomArchive(), objectives={"length": 3, "turns": 1})
    assert weighted.choice.preference == {"length": 0.75, "turns": 0.25}
    assert pl.pareto(problem, RandomArchive()).choice.preferred is None


def test_a_weighting_of_a_paper_serves_as_preference(problem):
    ratio = {"use": "agacd/delphi-ratio", "ratios": [2.0, 1.0]}
    assert list(pl.pareto(problem, RandomArchive(), prefer=ratio).choice.preference.values()) == [0.5, 0.25, 0.25]
    with pytest.raises(pl.ConfigError, match="one number fewer"):
        pl.pareto(problem, RandomArchive(), objectives=["length", "turns"], prefer=ratio)


def test_the_reference_point_may_be_given(problem):
    result = pl.pareto(problem, RandomArchive(), reference=(100, 100, 100))
    assert result.indicators["reference_point"] == [100.0, 100.0, 100.0]


REFUSED = {
    "one objective": ({"objectives": ["length"]}, "found 1 (length), allowed 2 to 5"),
    "none": ({"objectives": []}, "found 0, allowed 2 to 5"),
    "six": (
        {"objectives": ["length", "turns", "turn-angle", "clearance", "unsafe-cells", "imga/unsafe-node"]},
        "found 6",
    ),
    "an unknown one": ({"objectives": ["length", "trns"]}, "did you mean 'turns'?"),
    "one twice": ({"objectives": ["length", "length"]}, "found 'length' twice"),
    "one under two labels": (
        {"objectives": {"a": {"use": "length"}, "b": {"use": "length"}}},
        "'a' and 'b' are the same",
    ),
    "a name for a list": ({"objectives": "length,turns"}, "allowed a list of 2 to 5 names"),
    "a weight that is none": ({"objectives": {"length": {"weight": "x"}, "turns": 1}}, "weight is a number"),
    "a preference for something else": ({"prefer": {"lenght": 1}}, "did you mean 'length'?"),
    "a preference below 0": ({"prefer": {"length": -1}}, "allowed weights from 0 on"),
    "no preference at all": ({"prefer": {"length": 0}}, "not all of them 0"),
    "a preference that is no number": ({"prefer": {"length": "x"}}, "allowed a number"),
    "an unknown rival": ({"against": ["imgaa"]}, "did you mean 'imga/imga'?"),
    "no run": ({"runs": 0}, "allowed an integer from 1 on"),
    "a short reference point": ({"reference": (1, 2)}, "found 2 numbers for 3 objectives"),
    "a negative seed": ({"seed": -1}, "seed"),
    "no time": ({"time_limit": 0}, "seconds above 0"),
}


@pytest.mark.parametrize(("options", "says"), REFUSED.values(), ids=REFUSED)
def test_bad_input_is_refused_in_one_line(problem, options, says):
    with pytest.raises(pl.ConfigError) as refusal:
        pl.pareto(problem, RandomArchive(), **options)
    assert says in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_planner_of_one_path_is_refused(problem):
    for planner in ("imga", {"use": "imga"}, pl.compose("imga")):
        with pytest.raises(pl.ConfigError, match="answers with one path, not with a front"):
            pl.pareto(problem, planner)


def test_an_unreachable_goal_is_said_before_any_search():
    wall = pl.PathProblem(np.array([[0, 1, 0]] * 3))
    result = pl.pareto(wall, RandomArchive(), against=["imga"], exact=True)
    assert (result.status, len(result), result.budget) == ("unreachable", 0, {})
    assert "cannot be reached" in result.reason
    assert pl.ParetoResult.from_json(result.to_json()).to_json() == result.to_json()
    with pytest.raises(pl.PathloomError, match="no front to draw"):
        result.plot()


@dataclass(frozen=True, kw_only=True)
class Nothing(pl.Sampling):
    """Finds nothing."""

    def sample(self, problem, n, rng):
        return np.empty((0, 1), np.int32)


def test_a_search_that_finds_nothing_says_so(problem):
    result = pl.pareto(problem, RandomArchive(sampling=Nothing()), against=["imga"])
    assert (result.status, result.reason, result.choice) == ("not-found", "nothing was sampled", None)
    assert result.budget["generations"] == 50


@dataclass(frozen=True, kw_only=True)
class Liar(RandomArchive):
    """Adds a path through a wall, and says that all its paths are shorter than they are."""

    name: ClassVar[str] = "liar"

    def front(self, state):
        honest = state.front
        representation = state.problem.representation
        wall = representation.encode([np.array(state.problem.ends)])
        return Front(representation.stack(honest.population, wall), np.vstack([honest.values - 1, [[0.0, 0.0, 0.0]]]))


def test_a_path_that_collides_is_dropped_and_counted_and_values_are_measured(problem, found):
    result = pl.pareto(problem, Liar())
    np.testing.assert_array_equal(result.values, found.values)
    assert result.budget["counts"]["invalid paths dropped"] == 1
    assert result.budget["counts"]["values corrected"] == len(found)
    assert "1 of" in result.reason
    assert "crosses an obstacle" in result.reason


@dataclass(frozen=True, kw_only=True)
class Forbidden(pl.PathObjective):
    """Infinite for half of the paths."""

    def measure_one(self, path, problem):
        return np.inf if len(path) % 2 else 1.0


def test_what_is_infinite_or_dominated_is_not_reported():
    terms = pl.Terms({"length": Length(), "forbidden": Forbidden()})
    small = pl.PathProblem(np.zeros((3, 3)))
    ways = [
        np.array([(2, 0), (1, 1), (0, 2)]),
        np.array([(2, 0), (1, 0), (0, 1), (0, 2)]),
        np.array([(2, 0), (1, 0), (1, 1), (0, 1), (0, 2), (0, 1), (0, 2), (0, 2)]),
    ]
    front = Front(small.representation.encode(ways), np.zeros((3, 2)))
    kept = verified(front, small, terms)
    assert [path.tolist() for path in kept.paths] == [ways[1].tolist()]
    assert kept.counts["infinite values dropped"] == 1
    assert kept.counts["dominated paths dropped"] == 1


@dataclass(frozen=True, kw_only=True)
class Broken(pl.PathObjective):
    """Returns no number."""

    def measure_one(self, path, problem):
        return float("nan")


def test_an_objective_that_returns_nan_is_named_with_the_path(problem):
    with pytest.raises(pl.PluginError, match=r"'broken'.*NaN.*19,\s+0"):
        pl.pareto(problem, RandomArchive(), objectives=["length", Broken()])


def test_an_interrupt_keeps_what_is_there(problem, found):
    def press(state):
        if state.generation == 3:
            raise KeyboardInterrupt

    result = pl.pareto(problem, RandomArchive(), watch=press)
    assert result.interrupted
    assert result.found
    assert result.budget["generations"] == 3


def test_an_interrupt_of_the_rivals_keeps_the_front(problem, found, monkeypatch):
    def press(*args, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr("pathloom.multiobjective.running.plan", press)
    result = pl.pareto(problem, RandomArchive(), against=["imga"])
    assert result.interrupted
    np.testing.assert_array_equal(result.values, found.values)


def test_objectives_that_are_not_additive_have_no_exact_front(problem):
    result = pl.pareto(problem, RandomArchive(), objectives=["length", "clearance"], exact=True)
    assert result.exact is None
    assert "hypervolume_ratio" not in result.indicators
    assert "no exact front" in result.reason


def test_a_map_with_a_place_in_the_world_gives_paths_in_metres():
    grid = pl.OccupancyGrid(np.zeros((4, 4), bool), resolution=0.5, origin=(1.0, 2.0, 0.0))
    result = pl.pareto(pl.PathProblem(grid), RandomArchive(), objectives=["length", "turns"])
    assert len(result.world) == len(result)
    np.testing.assert_allclose(result.world[0][0], (1.25, 2.25))
    again = pl.ParetoResult.from_json(result.to_json())
    assert again.to_json() == result.to_json()


def test_start_and_goal_in_one_cell_is_a_front_of_one():
    problem = pl.PathProblem(np.zeros((3, 3)), start=(1, 1), goal=(1, 1))
    result = pl.pareto(problem, RandomArchive(), against=["imga"], exact=True)
    assert result.values.tolist() == [[0.0, 0.0, 0.0]]
    assert result.against[0].verdict("refined") == "on the front"
    assert result.indicators["hypervolume_ratio"] == 1.0


def test_the_config_of_a_result_runs_again(problem, found):
    from pathloom.fronts import Asked

    assert Asked.read(found.config["front"]).frozen() == found.config["front"]
    assert found.config["front"]["against"] == ["imga"]
    assert replace(found).config["planner"]["objectives"].keys() == {"length", "unsafe-cells", "turns"}


@dataclass(frozen=True, kw_only=True)
class Constrained(RandomArchive):
    """Knows constraints, but leaves it to others to heed them."""

    name: ClassVar[str] = "constrained"
    constraints: tuple[Constraint, ...] = ()


def test_a_path_that_breaks_a_constraint_is_dropped(problem, found):
    result = pl.pareto(problem, Constrained(), constraints=["turns<=4"], exact=True)
    kept = found.values[:, 2] <= 4
    assert 0 < kept.sum() < len(kept)
    np.testing.assert_array_equal(result.values, found.values[kept])
    assert result.budget["counts"]["infeasible paths dropped"] == (~kept).sum()


def test_the_exact_front_under_an_upper_limit_is_the_part_that_keeps_to_it(problem, found):
    result = pl.pareto(problem, Constrained(), constraints=["turns<=4"], exact=True)
    np.testing.assert_array_equal(result.exact, found.exact[found.exact[:, 2] <= 4])
    for other in ("turns>=1", "clearance>=0"):  # what dominates need not keep to these
        result = pl.pareto(problem, Constrained(), constraints=[other], exact=True)
        assert result.exact is None
        assert "only upper limits" in result.reason


@pytest.mark.parametrize(
    ("constraints", "says"),
    [(["lenght<=3"], "did you mean 'length'?"), (["length<="], "allowed"), (["length<=3", "length>=4"], "contradict")],
)
def test_bad_constraints_are_refused(problem, constraints, says):
    with pytest.raises(pl.ConfigError, match=says.replace("?", r"\?")):
        pl.pareto(problem, "nsga2", constraints=constraints)


def test_the_table_of_dominance_counts_every_run():
    from pathloom.multiobjective import dominance
    from pathloom.multiobjective.dominance import markdown

    standings = list(dominance(["iga-map1"], ["imga", "ga-imga"], algorithm=RandomArchive(), runs=3))
    assert [(s.planner, s.which) for s in standings] == [
        ("imga", "unrefined"), ("imga", "refined"), ("ga-imga", "unrefined"), ("ga-imga", "refined")
    ]  # fmt: skip
    for standing in standings:
        assert standing.runs == 3
        assert standing.found == standing.dominated + standing.on_the_front + standing.beats + standing.beside
    assert markdown(standings).count("\n") == 2 + len(standings)
