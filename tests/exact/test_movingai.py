"""Octile optima under ``strict`` against what Moving AI scenarios state."""

import math
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import pathloom as pl
from pathloom import compiled
from pathloom.grid import Case, Scenario, read_map, read_scenario
from pathloom.paths.context import Context

pytestmark = pytest.mark.data

WHOLE = [
    "mapf/random-32-32-10-even-10",
    "mapf/room-32-32-4-even-10",
    "mapf/maze-32-32-2-even-10",
    "mapf/den312d-even-10",
]
SMALL = 600
"""Scenarios with no more cases than this are run whole, of larger ones 100 cases spread evenly."""
WITH_FAULTS = ["gppc/rmtst01", "wc3/gardenofwar", "wc3/battleground"]


class Distances:
    """Octile optima of one map, whose tables are made once."""

    def __init__(self, scenario: Scenario) -> None:
        path = scenario.map_path(scenario.cases[0])
        self.grid = read_map(path)
        self.glyphs = path.read_text().splitlines()[4:]
        self.moves = Context(self.grid.occupied, "strict", 0, 0).moves

    def __call__(self, case: Case) -> float:
        width = self.grid.width
        start, goal = (r * width + c for r, c in (case.start, case.goal))
        cells = compiled.search.octile_path(self.moves, width, start, goal)
        return compiled.measures.lengths(cells[np.newaxis], width)[0] if len(cells) else math.inf


def differing(scenario: Scenario, cases: list[Case]) -> list[tuple[Case, float]]:
    """Return the cases whose optimum is not the stated one, with what it is."""
    distances = Distances(scenario)
    found = [(case, distances(case)) for case in cases]
    return [(case, length) for case, length in found if not abs(length - case.optimum) <= case.tolerance]


def scenario_of(data: Path, name: str) -> Scenario:
    (file,) = (data / "movingai").glob(f"{name}.*scen")
    return read_scenario(file)


@pytest.mark.parametrize("name", WHOLE)
def test_every_stated_optimum_is_ours(data: Path, name: str) -> None:
    scenario = scenario_of(data, name)
    assert differing(scenario, list(scenario.cases)) == []


def test_stated_optima_of_all_other_maps_are_ours(data: Path) -> None:
    names = {str(file.relative_to(data / "movingai")).split(".")[0] for file in data.glob("movingai/*/*.scen")}
    others = names.difference(WHOLE, WITH_FAULTS)
    assert len(others) == 31
    wrong = {}
    for name in sorted(others):
        scenario = scenario_of(data, name)
        cases = scenario.cases
        if len(cases) > SMALL:
            cases = [cases[k] for k in np.linspace(0, len(cases) - 1, 100).astype(int)]
        if faults := differing(scenario, cases):
            wrong[name] = faults
    assert wrong == {}


@pytest.mark.parametrize(("name", "index"), [(WHOLE[0], 0), (WHOLE[1], 64), (WHOLE[2], 259), (WHOLE[3], 100)])
def test_a_stated_optimum_is_ours_through_the_front_door(data: Path, name: str, index: int) -> None:
    scenario = scenario_of(data, name)
    case = scenario.case(index)
    problem = pl.PathProblem(pl.load_map(scenario.map_path(case)), start=case.start, goal=case.goal, corners="strict")
    length, path = pl.octile_path(problem)
    assert length == pytest.approx(case.optimum, abs=case.tolerance)
    assert pl.validate(path, problem) is None


def test_a_case_whose_start_is_its_goal_is_zero_long(data: Path) -> None:
    scenario = scenario_of(data, "mapf/random-32-32-10-even-10")
    case = scenario.case(2)
    assert case.start == case.goal
    assert case.optimum == 0.0
    problem = pl.PathProblem(pl.load_map(scenario.map_path(case)), start=case.start, goal=case.goal)
    assert pl.octile_path(problem)[0] == 0.0


def test_the_two_cases_stated_as_zero_between_different_cells_are_out_of_reach(data: Path) -> None:
    scenario = scenario_of(data, "gppc/rmtst01")
    wrong = differing(scenario, list(scenario.cases))
    grid = pl.load_map(scenario.map_path(scenario.cases[0]))
    assert [(case.start, case.goal, case.optimum) for case, _ in wrong] == [
        ((33, 10), (16, 108), 0.0),
        ((14, 100), (10, 84), 0.0),
    ]
    for case, _ in wrong:
        problem = pl.PathProblem(grid, start=case.start, goal=case.goal)
        assert not problem.reachable
        assert pl.octile_path(problem) == (math.inf, None)


def test_the_six_cases_inside_trees_are_no_problems_of_ours(data: Path) -> None:
    scenario = scenario_of(data, "wc3/gardenofwar")
    wrong = differing(scenario, list(scenario.cases))
    distances = Distances(scenario)
    assert len(wrong) == 6
    for case, _ in wrong:
        assert [distances.glyphs[r][c] for r, c in (case.start, case.goal)] == ["T", "T"]
        with pytest.raises(pl.ProblemError, match="start: cell .* is an obstacle"):
            pl.PathProblem(distances.grid, start=case.start, goal=case.goal)


def test_battleground_states_lengths_of_a_map_with_a_few_other_cells(data: Path) -> None:
    scenario = scenario_of(data, "wc3/battleground")
    wrong = differing(scenario, list(scenario.cases))
    distances = Distances(scenario)
    excess = Counter()
    for case, length in wrong:
        on = {distances.glyphs[r][c] for r, c in (case.start, case.goal)}
        if length == math.inf:
            assert on & set("@TW")
            with pytest.raises(pl.ProblemError, match="is an obstacle"):
                pl.PathProblem(distances.grid, start=case.start, goal=case.goal)
            excess["closed"] += 1
            continue
        assert on <= set(".S")
        known = {"one corner": 2 - math.sqrt(2), "two steps": 2 * math.sqrt(2) - 2, "a diagonal": math.sqrt(2)}
        near = {name: abs(length - case.optimum - more) for name, more in known.items()}
        best = min(near, key=near.get)
        assert near[best] <= case.tolerance + 1e-9
        excess[best] += 1
    assert excess == {"closed": 15, "one corner": 52, "two steps": 2, "a diagonal": 1}
