"""Planners that raise, hang, lie, die or take all memory are recorded as such, and the study goes on."""

import pytest

import pathloom as pl
from pathloom.study import Workers, carry_out
from pathloom.study.budget import Budget
from pathloom.study.design import Design, comparison
from pathloom.study.instances import instances_of
from study.conftest import timeless
from study.faulty import Dying, Hanging, Insatiable, Leaving, Raising, Straight

PLANNERS = {
    "good": "dijkstra",
    "raises": Raising(),
    "leaves": Leaving(),
    "hangs": Hanging(),
    "dies": Dying(always=True),
    "takes all": Insatiable(),
    "collides": Straight(),
}


def carried_out(planners, grid, *, runs=1, out=None, time_limit=None, **workers):
    design = Design("compare", comparison(planners), instances_of([grid]), runs, 0, Budget("own"), time_limit)
    return carry_out(design, out, workers=Workers(**{"count": 1, "memory": 3 << 30, **workers}))


@pytest.fixture(scope="module")
def study():
    import numpy as np

    cells = np.zeros((6, 6), bool)
    cells[2:4, 2:4] = True
    with carried_out(PLANNERS, pl.OccupancyGrid(cells, name="block"), longest=8.0) as done:
        yield done


@pytest.mark.parametrize(
    ("variant", "status", "error"),
    [
        ("good", "found", None),
        ("raises", "failed", "ValueError: no idea what to do"),
        ("leaves", "failed", "SystemExit: goodbye"),
        ("hangs", "timeout", "it did not stop when its time was over, and was ended"),
        ("dies", "crashed", "the planner's process ended without an answer, 2 times"),
        ("takes all", "failed", "MemoryError"),
        ("collides", "not-found", "the best path of the search crosses an obstacle"),
    ],
)
def test_what_became_of_a_planner_is_recorded(study, variant, status, error):
    row = next(row for row in study.each() if row.variant == variant)
    assert row.status == status
    assert (row.error or "").startswith(error or "")
    assert (row.length is not None) == (status == "found")
    assert "\n" not in (row.error or "")


def test_only_lost_workers_are_tried_again(study):
    found = dict(study._store.reading("SELECT v.name, attempts FROM runs r JOIN variants v ON v.id = r.variant"))
    assert found == {name: 2 if name == "dies" else 1 for name in PLANNERS}


def test_a_colliding_path_has_neither_length_nor_gap(study):
    row = next(row for row in study.each() if row.variant == "collides")
    assert (row.length, row.gap_any_angle, row.gap_grid, study.path(row)) == (None, None, None, None)


def test_a_run_that_kills_its_process_costs_no_other_run(grid):
    with carried_out({"dies": Dying(), "good": "dijkstra"}, grid, runs=3, count=2) as study:
        good = [row for row in study.each() if row.variant == "good"]
        other = [row.status for row in study.each() if row.variant == "dies"]
    assert [row.status for row in good] == ["found"] * 3
    assert set(other) == {"crashed", "not-found"}


def test_the_budget_of_a_planner_that_fails_is_asked_for(grid):
    with pytest.raises(pl.ConfigError, match="give a number: --budget evaluations=5000"):
        pl.compare({"raises": Raising()}, maps=grid, runs=1, workers=1)


def test_a_time_limit_lets_a_planner_answer_with_its_best(grid, tmp_path):
    slow = {"use": "imga", "termination": [{"use": "max-generations", "limit": 10**9}]}
    with carried_out({"slow": slow}, grid, time_limit=0.2, out=tmp_path / "s.db") as study:
        row = timeless(study.rows()[0])
    assert row["status"] == "found"
    assert row["generations"] < 10**6


def test_a_script_without_a_guard_is_told_so(grid, monkeypatch):
    monkeypatch.setattr("pathloom.study.lanes.prepare", _die)
    with pytest.raises(pl.PathloomError, match="__main__"):
        carried_out({"good": "dijkstra"}, grid)


def _die(memory):
    import os

    os._exit(1)


def test_a_goal_that_cannot_be_reached_is_no_failure(grid):
    wall = pl.OccupancyGrid([[0, 1, 0]] * 3, name="wall")
    with carried_out({"good": "dijkstra"}, wall) as study:
        row = study.rows()[0]
        assert study.instances["wall"].reachable is False
    assert (row.status, row.length, row.gap_grid) == ("unreachable", None, None)
    assert "cannot be reached" in row.error
    with pytest.raises(pl.ConfigError, match="none on which the goal can be reached"):
        pl.compare(["imga"], maps=wall, workers=1)
