"""The exact searches as planners, and what is known where the search is given up."""

import math

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, examples

import pathloom as pl
from pathloom.exact import any_angle_search
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("name", ["iga-map1", "rooms-40:5", "maze-31:2", "random-30:30%"])
def test_the_exact_planners_give_the_optima(name: str, corners: str) -> None:
    problem = pl.PathProblem(pl.load_map(name, corners=corners), corners=corners)
    steps, straight = (pl.plan(problem, planner, optimum=True) for planner in ("dijkstra", "any-angle"))
    assert steps.gap["grid"] == 0.0
    assert straight.gap["any_angle"] == straight.gap["any_angle_bound"] == 0.0
    assert straight.length <= steps.length
    assert steps.budget["generations"] == straight.budget["generations"] == 0
    assert steps.objectives == {"length": steps.length}


def test_a_state_is_where_it_stays() -> None:
    planner = compose("any-angle")
    state = run(pl.PathProblem(pl.load_map("iga-map1")), planner, 0).state
    assert planner.step(state) is state
    assert planner.progress(state) == 1.0


@pytest.mark.parametrize("name", ["dijkstra", "any-angle"])
def test_an_exact_planner_says_that_there_is_no_way(name: str) -> None:
    outcome = run(pl.PathProblem([[0, 1, 0]]), compose(name), 0).outcome
    assert outcome.solution is None
    assert outcome.reason == "the goal cannot be reached"


def test_a_path_that_is_not_proven_says_so() -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75:s3"))
    result = pl.plan(problem, {"use": "any-angle", "work": 100}, optimum=True)
    assert result.found
    assert pl.validate(result.path, problem) is None
    assert result.reason.startswith("not proven to be the shortest path: the search was given up after 100 cells seen")
    assert pl.plan(problem, "any-angle").reason == ""


@given(problem=naive.problems(max_side=9), work=st.integers(0, 400))
@examples(80)
def test_what_is_known_after_little_work_lies_on_both_sides_of_the_optimum(problem: pl.PathProblem, work: int) -> None:
    blocked = problem.context.occupied
    best = naive.any_angle_distances(blocked, problem.start, problem.corners).get(problem.goal, math.inf)
    known = any_angle_search(problem, work=work)
    assert known.bound - 1e-9 <= best <= known.length + 1e-9
    assert known.bound <= known.length
    assert known.path is None or pl.validate(known.path, problem) is None
    assert known.path is None or naive.length(known.path.tolist()) == pytest.approx(known.length)
    if known.proven:
        assert known.length == pytest.approx(best)


def test_a_result_without_the_optimum_still_has_a_proven_gap(monkeypatch: pytest.MonkeyPatch) -> None:
    from pathloom import planning
    from pathloom.cli.report import _rows

    monkeypatch.setattr(planning, "any_angle_search", lambda problem: any_angle_search(problem, work=100))
    result = pl.plan(pl.PathProblem(pl.load_map("random-20:75:s3")), "dijkstra", optimum=True)
    assert result.optimum["any_angle"] is None
    assert result.gap["any_angle"] is None
    best, bound = 28.3179041481008, result.optimum["any_angle_bound"]
    assert 0.95 * best < bound < best
    assert result.gap["any_angle_bound"] == pytest.approx(result.length / bound - 1.0)
    said = dict(_rows(result))["any-angle optimum"]
    assert said.startswith(f"at least {bound:.4f} cells, gap at most ")


@pytest.mark.data
@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize(("name", "case"), [("rooms512/16room_000", 300), ("starcraft/IceFloes", 200)])
def test_optima_of_large_maps_are_proven(data, name: str, case: int, corners: str) -> None:
    from pathloom.grid.scenario import read_scenario

    scenario = read_scenario(data / "movingai" / f"{name}.map.scen")
    said = scenario.case(case)
    problem = pl.PathProblem(pl.load_map(scenario.map_path(said)), start=said.start, goal=said.goal, corners=corners)
    known = any_angle_search(problem)
    assert known.proven
    assert pl.validate(known.path, problem) is None
    assert 0.95 * known.length < pl.exact.taut_length(problem) <= known.length
    assert np.hypot(*np.diff(known.path, axis=0).T).sum() == pytest.approx(known.length)
