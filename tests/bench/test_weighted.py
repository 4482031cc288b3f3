"""Gaps of weighted sums to the exact optimum over cell paths."""

import pytest

from pathloom import ConfigError, compose
from pathloom.bench.weighted import HEADS, rows, terms_of

CELLS_ONLY = '{use = "loom", control = "memetic"}'
"""Nothing is learned, so that all paths keep to single steps; the exact optimum is among the first."""


def measured(planners, objectives, maps="random-10:15%:x3"):
    return [list(line) for line in rows(maps, planners, terms_of(objectives), "allow", range(2))]


def test_a_planner_that_begins_with_the_optimum_has_no_gap():
    (row,) = measured(CELLS_ONLY, "{length = 1, unsafe-cells = 1, turns = 1}")
    assert row[2:6] == ["6 of 6", "0.00 %", "0.00 %", "100 %"]
    assert len(row) == len(HEADS)


def test_no_path_of_single_steps_is_below_the_optimum():
    (row,) = measured('{use = "imga", population = 4, termination = [{use = "max-generations", limit = 1}]}', "imga")
    assert float(row[3].removesuffix(" %")) > 0.0


def test_a_path_at_any_angle_may_be():
    (row,) = measured("loom", "{length = 1}")
    assert float(row[3].removesuffix(" %")) < 0.0


def test_objectives_are_those_of_a_planner_or_a_table():
    assert terms_of("imga") == compose("imga").terms
    assert terms_of("{length = 2, turns = 1}").labels == ("length", "turns")


@pytest.mark.parametrize(
    ("planners", "objectives", "says"),
    [
        ("nsga2", "imga", "'nsga2' weighs no objectives"),
        ("imga", "{length = 1, clearance = 1}", "not additive"),
        ("imga", "{length = ", "--objectives: "),
        ("imga", "nobody", "nobody"),
    ],
)
def test_what_has_no_exact_optimum_is_refused(planners, objectives, says):
    with pytest.raises(ConfigError, match=says):
        measured(planners, objectives)


def test_what_is_not_found_is_said():
    (row,) = rows("maze-41:1:s1", "imga", terms_of("imga"), "strict", range(1))
    assert row[2:7] == ("0 of 1", *["–"] * 4)
