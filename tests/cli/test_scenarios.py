"""Moving AI scenarios: a case sets map, start and goal, and its stated optimum is held against ours."""

from pathlib import Path

import pytest

from .conftest import write


@pytest.fixture
def cases(folder: Path, ring) -> str:
    """Two cases around the obstacle; the first states its optimum, 4, and the second a wrong one."""
    lines = "0\tring.map\t3\t3\t0\t2\t2\t0\t4\n", "0\told/place/ring.map\t3\t3\t0\t0\t2\t2\t3.41421\n"
    return write(folder / "ring.map.scen", "version 1\n" + "".join(lines)).name


def test_a_case_sets_map_start_and_goal(cli, cases) -> None:
    problem = cli("plan", "--scenario", cases, "--case", 1, "--json").document["problem"]
    assert problem["map"] == "ring.map"
    assert (problem["start"], problem["goal"]) == ([0, 0], [2, 2])
    assert problem["scenario"].items() >= {"file": cases, "case": 1, "stated_optimum": 3.41421}.items()


def test_without_case_the_first_is_meant(cli, cases) -> None:
    assert cli("plan", "--scenario", cases, "--json").document["problem"]["scenario"]["case"] == 0


def test_a_stated_optimum_that_holds_needs_no_note(cli, cases) -> None:
    done = cli("plan", "--scenario", cases, "--case", 0, "--optimum", "--json")
    assert done.err == ""
    assert done.document["optimum"]["grid"] == 4.0


def test_a_stated_optimum_that_is_wrong_is_noted_beside_the_document(cli, cases) -> None:
    done = cli("plan", "--scenario", cases, "--case", 1, "--optimum", "--json")
    assert done.document["optimum"]["grid"] == 4.0
    assert done.err == (
        "pathloom: the scenario states an optimum of 3.41421; the exact one under 'strict' is 4.00000000\n"
    )


def test_nothing_is_noted_without_the_exact_optimum_or_when_quiet(cli, cases) -> None:
    assert cli("plan", "--scenario", cases, "--case", 1).err == ""
    assert cli("plan", "--scenario", cases, "--case", 1, "--optimum", "--quiet").err == ""


@pytest.mark.parametrize("case", [-1, 2])
def test_a_case_that_is_not_there_is_refused_with_those_that_are(refused, cases, case) -> None:
    assert refused("plan", "--scenario", cases, "--case", case) == f"{cases}: found case {case}, allowed 0 to 1"


@pytest.mark.parametrize("option", ["--map", "--start", "--goal"])
def test_what_a_scenario_sets_cannot_be_given_as_well(refused, cases, option) -> None:
    assert refused("plan", "--scenario", cases, option, "0,0").endswith(f"leave {option} away")


def test_a_missing_scenario_is_refused_with_the_one_probably_meant(refused, cases) -> None:
    assert "did you mean 'ring.map.scen'?" in refused("plan", "--scenario", "rnig.map.scen")


def test_a_case_that_starts_in_an_obstacle_is_refused_with_file_and_case(refused, cases, folder: Path) -> None:
    write(folder / cases, "version 1\n0\tring.map\t3\t3\t1\t1\t2\t0\t4\n")
    assert refused("plan", "--scenario", cases).startswith(f"{cases}: case 0: start: cell 1,1 is an obstacle")


def test_a_case_can_be_frozen(cli, cases, folder: Path) -> None:
    write(folder / "frozen.toml", cli("plan", "--scenario", cases, "--case", 1, "--freeze").out)
    problem = cli("plan", "frozen.toml", "--json").document["problem"]
    assert (problem["start"], problem["goal"]) == ([0, 0], [2, 2])


@pytest.mark.data
def test_a_real_case_whose_stated_optimum_is_wrong_is_noted(cli, data: Path) -> None:
    # A start and a goal whose stated length, 295.34, is that of no 8-connected path.
    scenario = data / "movingai" / "wc3" / "battleground.map.scen"
    quick = ("--set", "sampling=perturbed-trees", "--set", "termination.max-generations.limit=1")
    done = cli("plan", "--scenario", scenario, "--case", 10, "--optimum", *quick, "--set", "population=4", "--json")
    assert done.document["problem"]["scenario"]["stated_optimum"] == 295.34
    assert done.document["optimum"]["grid"] == pytest.approx(295.92388)
    assert "the scenario states an optimum of 295.34; the exact one under 'strict' is 295.92388155" in done.err
