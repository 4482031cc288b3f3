"""IMGA with perturbed trees finds a valid path in every reachable case of every Moving AI scenario.

The first three cases of each; `PATHLOOM_CASES=20` tries as many as one likes.
"""

import os
from pathlib import Path

import pytest

import pathloom as pl
from pathloom.grid import read_map, read_scenario

CASES = int(os.environ.get("PATHLOOM_CASES", "3"))
ROOT = Path(os.environ.get("PATHLOOM_DATA", "unset")) / "movingai"
SCENARIOS = sorted(ROOT.glob("*/*.scen"))
UNREACHABLE = {("rmtst01.map.scen", 4), ("rmtst01.map.scen", 9)}  # stated as 0


@pytest.mark.data
@pytest.mark.parametrize("file", SCENARIOS or [ROOT / "any.scen"], ids=lambda file: file.name)
def test_a_valid_path_is_found_in_every_reachable_case(data, file):  # without data it is skipped, and says so
    planner = pl.compose("imga", sampling="perturbed-trees")
    scenario = read_scenario(file)
    grid = read_map(scenario.map_path(scenario.cases[0]))
    for number, case in enumerate(scenario.cases[:CASES]):
        problem = pl.PathProblem(grid, start=case.start, goal=case.goal)
        result = pl.plan(problem, planner)
        if (file.name, number) in UNREACHABLE:
            assert result.status == "unreachable"
            continue
        assert result.found, number
        assert pl.validate(result.path, problem) is None
