"""The tables of ``python -m pathloom.multiobjective``."""

import sys

import numpy as np
import pytest

import pathloom as pl
from pathloom.fronts.indicators import non_dominated
from pathloom.multiobjective.quality import markdown, quality
from pathloom.multiobjective.sweep import OBJECTIVES, far_apart, swept

SCENARIO = """version 1
0\troom.map\t40\t40\t1\t1\t3\t3\t2.82842712
1\troom.map\t40\t40\t5\t5\t34\t34\t250
1\troom.map\t40\t40\t1\t1\t38\t38\t300
"""


@pytest.fixture
def room(tmp_path):
    grid = np.full((40, 40), ".")
    grid[12:20, 8:30] = "@"
    (tmp_path / "room.map").write_text(
        "type octile\nheight 40\nwidth 40\nmap\n" + "\n".join("".join(row) for row in grid) + "\n"
    )
    (tmp_path / "room.map.scen").write_text(SCENARIO)
    return tmp_path


def test_quality_tells_what_was_found_of_the_exact_front():
    row = next(quality(["random-20:75:s1"], {"use": "nsga2", "population": 30}, seconds=0.02, runs=2))
    front = pl.exact_front(pl.PathProblem(pl.load_map("random-20:75:s1")), pl.compose("nsga2").objectives)
    assert row.exact == len(front)
    assert len(row.ratios) == len(row.shares) == 2
    assert 0.9 < min(row.ratios) <= max(row.ratios) <= 1.0 + 1e-12
    assert "random-20:75:s1" in markdown([row])


def test_of_a_scenario_the_long_case_with_the_freest_ends_is_taken(room):
    problem = far_apart(str(room / "room.map.scen"))
    assert problem.ends == ((1, 1), (38, 38))


def test_of_a_map_the_widest_spot_is_one_end(room):
    problem = far_apart(str(room / "room.map"))
    it = problem.context
    assert it.distance[it.start] == it.distance.max()
    assert it.distance[it.goal] >= 0.5 * it.distance.max()
    assert problem.reachable


def test_the_sweep_finds_the_shortest_and_the_widest_paths(room):
    problem = far_apart(str(room / "room.map.scen"))
    found = swept(problem, (11, 6))
    assert found.tobytes() == non_dominated(found).tobytes()
    assert found[:, 0].min() == pytest.approx(pl.octile_path(problem)[0])
    assert found[:, 1].min() < -3.0
    assert found.shape[1] == len(OBJECTIVES)


def test_a_table_is_printed(room, monkeypatch, capsys):
    from pathloom.multiobjective.__main__ import main

    monkeypatch.setattr(sys, "argv", ["multiobjective", "sweep", "--runs", "1", str(room / "room.map.scen")])
    main()
    assert capsys.readouterr().out.count("\n| room.map |") == 1


def test_a_map_that_nobody_has_is_told_in_one_line(monkeypatch, capsys):
    from pathloom.multiobjective import __main__ as command

    monkeypatch.setattr("sys.argv", ["tables", "sweep", "no-such.map"])
    with pytest.raises(SystemExit) as ended:
        command.main()
    told = capsys.readouterr().err
    assert ended.value.code == 2
    assert "no-such.map" in told
    assert told.count("\n") == 1
