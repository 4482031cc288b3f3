"""What the tables say of runs, held against numbers worked out by hand."""

import json
import math

import numpy as np
import pytest

import pathloom as pl
from pathloom.bench import measure
from pathloom.bench.measure import Limits, Run, compare, fault_of, length_of, reference
from pathloom.bench.peer import Peer
from pathloom.bench.suite import named
from pathloom.bench.table import cells, document, markdown, methods, rows_of, table

WALL = pl.OccupancyGrid(np.array([[0, 0, 0], [0, 1, 0], [0, 0, 0]], bool))


@pytest.fixture
def around():
    """From the lower left to the upper right, about one obstacle: 4 straight steps under strict."""
    return pl.PathProblem(WALL, corners="strict")


class Scripted(Peer):
    """Answers what it is told to, seed by seed."""

    distribution = "pathloom"
    about = "a test"

    def __init__(self, name, *answers):
        self.name, self.answers = name, answers

    def prepare(self, problem):
        def solve(seed, *_):
            answer = self.answers[seed]
            if isinstance(answer, Exception):
                raise answer
            return None if answer is None else np.array(answer)

        return solve


class Missing(Scripted):
    distribution = "pathloom-of-a-time-to-come"


class Anytime(Scripted):
    anytime = True


DIRECT = [(2, 0), (0, 2)]
STEPS = [(2, 0), (0, 0), (0, 2)]
BENT = [(2.0, 0.0), (0.25, 0.25), (0.0, 2.0)]


def run(gap=None, fault="", **others):
    usual = {
        "group": "g", "task": "t", "who": "w", "seed": 0, "seconds": 0.002, "cpu": 0.001, "prepared": 0.0,
        "length": None if gap is None else 1 + gap, "exact": True,
        "over_plane": None if gap is None else gap + 0.01,
    }  # fmt: skip
    return Run(**(usual | {"gap": gap, "fault": fault} | others))


def compared(problem, *peers, seeds=2, target=None, monkeypatch=None):
    task = named("empty-3", "allow")[0]
    vars(task)["problem"] = problem  # what it would load
    return list(compare([task], peers[:1], peers[1:], Limits(seeds, 1.0, target), "allow"))


def test_medians_means_and_worst_are_those_worked_out_by_hand():
    runs = [run(0.0, cpu=0.001), run(0.03, cpu=0.002), run(0.06, cpu=0.009), run(fault="found none", cpu=0.004)]
    (row,) = rows_of(runs)
    assert (row.runs, row.found) == (4, 3)
    assert row.mean_gap == pytest.approx(0.03)
    assert row.worst_gap == 0.06
    assert row.cpu == pytest.approx(0.003)
    assert cells(row) == ("g", "w", "3 of 4", "3.00", "6.00", "4.00", "3", "2", "0", "1 × found none")


def test_gaps_to_a_bound_are_said_to_be_at_most_that():
    (row,) = rows_of([run(0.01), run(0.03, exact=False)])
    assert cells(row)[3:5] == ("≤ 2.00", "≤ 3.00")


def test_a_gap_that_is_only_rounding_has_no_sign():
    assert cells(rows_of([run(-1e-12)])[0])[3:5] == ("0.00", "0.00")


def test_rows_of_a_group_stand_together_and_keep_their_order():
    runs = [run(0.0, group=g, who=w) for g, w in (("a", "x"), ("b", "x"), ("a", "y"), ("b", "y"))]
    assert [(row.group, row.who) for row in rows_of(runs)] == [("a", "x"), ("a", "y"), ("b", "x"), ("b", "y")]
    assert [[*column.cells] for column in table(rows_of(runs)).columns][:2] == [["a", "", "b", ""], ["x", "y"] * 2]


def test_paths_are_judged_and_measured_by_us(around):
    assert fault_of(np.array(STEPS), around) == ""
    assert length_of(np.array(STEPS)) == 4.0
    assert fault_of(np.array(DIRECT), around).startswith("crosses an obstacle")
    assert fault_of(np.array(BENT), around) == ""
    assert length_of(np.array(BENT)) == pytest.approx(2 * math.hypot(1.75, 0.25))
    assert fault_of(np.array([(2.0, 0.0), (0.0, 2.0)]), around).startswith("touches an obstacle")
    assert fault_of(None, around) == "found none"


def test_the_reference_is_the_any_angle_optimum(around):
    assert reference(around) == measure.Reference(4.0, exact=True, plane=pytest.approx(10**0.5))


@pytest.mark.parametrize("corners", ["allow", "no-squeeze", "strict"])
@pytest.mark.parametrize("name", ["random-20:25%:s2", "maze-15", "empty-9"])
def test_where_the_search_gives_up_a_bound_takes_its_place_that_no_path_goes_below(monkeypatch, name, corners):
    (task,) = named(name, corners)
    optimum, _ = pl.any_angle_path(task.problem)
    search = measure.exact.any_angle_search
    monkeypatch.setattr(measure.exact, "any_angle_search", lambda problem: search(problem, work=1))
    found = reference(task.problem)
    assert found.exact == (found.length == pytest.approx(optimum, rel=1e-12))
    assert 0.75 * optimum < found.length <= optimum + 1e-9
    assert found.plane <= optimum + 1e-9


def test_whatever_happens_to_a_run_is_in_the_table(around):
    good = Scripted("good", STEPS, STEPS)
    bad = Scripted("bad", DIRECT, ValueError("no such luck"))
    none = Scripted("none", None, BENT)
    rows = rows_of(compared(around, good, bad, none))
    assert [(row.who, row.found, row.runs) for row in rows] == [("good", 2, 2), ("bad", 0, 2), ("none", 1, 2)]
    assert rows[1].faults == {"crosses an obstacle": 1, "raised ValueError: no such luck": 1}
    assert rows[2].faults == {"found none": 1}
    assert rows[0].worst_gap == pytest.approx(0.0)
    assert rows[2].mean_gap == pytest.approx(2 * math.hypot(1.75, 0.25) / 4 - 1)


def test_a_method_that_cannot_even_begin_is_in_the_table_too(around):
    class Broken(Scripted):
        def prepare(self, problem):
            raise RuntimeError("out of order")

    (_, row) = rows_of(compared(around, Scripted("good", STEPS), Broken("broken"), seeds=1))
    assert row.faults == {"raised RuntimeError: out of order": 1}


def test_what_misses_the_target_is_not_counted_as_found():
    problem = pl.PathProblem(WALL, corners="allow")  # past the obstacle's corner: two segments of √5 are no way, 4 is
    optimum, _ = pl.any_angle_path(problem)
    long = [(2, 0), (0, 0), (0, 1), (0, 0), (0, 2)]
    (row,) = rows_of(compared(problem, Scripted("long", long, STEPS), target=0.4))
    assert (row.found, row.runs) == (1, 2)
    assert row.worst_gap == pytest.approx(6.0 / optimum - 1)
    assert row.faults == {"missed the target": 1}


def test_anytime_methods_get_our_time_and_ten_times_that(around):
    given = []

    class Noting(Anytime):
        def prepare(self, problem):
            def solve(seed, seconds, target):
                given.append(seconds)
                return np.array(STEPS)

            return solve

    rows = rows_of(compared(around, Scripted("ours", STEPS), Noting("theirs"), seeds=1))
    assert [row.who for row in rows] == ["ours", "theirs, 1 × our time", "theirs, 10 × our time"]
    assert given[-2:] == [rows[0].seconds, 10 * rows[0].seconds]


def test_who_is_not_installed_is_listed_and_not_run(around):
    missing = Missing("from the future", STEPS)
    assert [run.who for run in compared(around, Scripted("good", STEPS), missing, seeds=1)] == ["good"]
    assert methods([missing]) == [("from the future", "not installed", "a test")]


def test_the_document_is_json_and_holds_every_run(around):
    peers = [Scripted("good", STEPS, None)]
    runs = compared(around, *peers)
    told = json.loads(json.dumps(document(runs, peers, Limits(), "strict"), allow_nan=False))
    assert told["schema"] == "pathloom.bench/1"
    assert [r["fault"] for r in told["runs"]] == ["", "found none"]
    assert told["rows"][0]["found"] == 1
    assert told["methods"][0]["version"].startswith("pathloom ")


def test_markdown_has_a_rule_below_the_heads():
    assert markdown(("a", "b"), [("1", "2")]) == "| a | b |\n| --- | --- |\n| 1 | 2 |"
