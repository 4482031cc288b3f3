"""How growth is fitted, drawn, and measured."""

import json

import numpy as np
import pytest

from pathloom.bench.memory import _measured
from pathloom.bench.parallel import _same, _threads
from pathloom.bench.scale import HEADS, Point, figure, fits, measured
from pathloom.bench.suite import problem_on
from pathloom.planning import plan


def points(of, family="f"):
    return [Point(family, side, of(float(side**2)), 0.0) for side in (64, 128, 256, 512)]


def test_n_log_n_is_recognised_and_so_is_what_grows_faster():
    (flat,) = fits(points(lambda n: 3e-9 * n * np.log2(n)))
    assert flat.exponent == pytest.approx(1.0)
    assert flat.last == pytest.approx(1.0)
    assert flat.seconds == pytest.approx(3e-9)
    (steep,) = fits(points(lambda n: 1e-12 * n**2))
    assert steep.exponent > 1.5
    (started,) = fits(points(lambda n: 1.0 + 1e-12 * n**2))
    assert started.exponent < 1.0 < fits(points(lambda n: 0.01 + 1e-12 * n**2))[0].last


def test_a_family_of_one_size_has_no_fit():
    assert fits(points(lambda n: n)[:1]) == []


def test_time_and_memory_are_measured_of_every_map():
    found = list(measured("imga", "allow", [8, 12], 1, ("empty-{n}", "random-{n}:10%"), with_memory=False))
    assert [(p.family, p.cells) for p in found] == [
        ("empty-N", 64), ("empty-N", 144), ("random-N:10%", 64), ("random-N:10%", 144)
    ]  # fmt: skip
    assert all(p.cpu > 0 and len(p.line()) == len(HEADS) for p in found)


def test_the_memory_of_a_run_is_counted_in_bytes_a_cell():
    found = _measured({"use": "imga", "sampling": "perturbed-trees"}, "random-40:20%", "allow")
    assert 1.0 < found.traced < 10_000.0
    assert found.resident is None or found.resident >= 0.0
    json.dumps(vars(found))


@pytest.mark.parametrize("dark", [False, True])
def test_all_families_and_n_log_n_are_drawn(dark):
    drawn = figure([*points(lambda n: n), *points(lambda n: 2 * n, "g")], "title", dark=dark)
    assert [line.get_label() for line in drawn.axes[0].lines] == ["f", "g", "N log N"]


def test_four_threads_give_what_one_gives():
    assert _threads("imga", "random-20:20%", "allow", 6)[2]


def test_results_that_differ_are_told_apart():
    problem = problem_on("random-20:20%", "allow")
    assert _same(plan(problem, "imga", seed=1), plan(problem, "imga", seed=1))
    assert not _same(plan(problem, "imga", seed=1), plan(problem, "imga", seed=2))
