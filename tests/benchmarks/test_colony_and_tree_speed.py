"""Ants and trees beside the same in plain Python: `pytest tests/benchmarks -n 0 --benchmark-enable` measures them."""

import statistics
import time

import pytest

import pathloom as pl
from benchmarks.plain_aco import PlainAco
from benchmarks.plain_rrt import PlainRrt
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run

PAPER = {"aco": "14.3 to 15.3 s", "hga-aco": "1.36 to 1.49 s", "s-rrt": "1.78 to 2.23 s", "rrt": "1.46 to 1.86 s"}


@pytest.fixture(scope="module")
def problem():
    return pl.PathProblem(pl.load_map("random-20:75:s3", corners="allow"), corners="allow")


@pytest.fixture(scope="module")
def blocks():
    return pl.PathProblem(pl.load_map("blocks-20:20%", corners="allow"), corners="allow")


@pytest.mark.parametrize("name", PAPER)
def test_a_run_with_the_usual_parameters(benchmark, problem, blocks, name):
    benchmark.extra_info["paper"] = PAPER[name]
    benchmark.group = f"{name}; in the paper {PAPER[name]}"
    planner, on = compose(name), blocks if name.endswith("rrt") else problem
    benchmark(lambda: run(on, planner, 1))


def test_a_smooth_path(benchmark, blocks):
    benchmark(lambda: pl.plan(blocks, "s-rrt", seed=1))


def seconds(work):
    began = time.process_time()
    work()
    return time.process_time() - began


def test_compiled_ants_are_at_least_fifteen_times_as_fast(problem):
    planner = compose("aco", termination=[{"use": "max-generations", "limit": 4}])
    run(problem, planner, 0)
    slow = seconds(lambda: PlainAco(problem.grid.occupied.tolist(), *problem.ends, 1).run(4))
    fast = min(seconds(lambda: run(problem, planner, 1)) for _ in range(5))
    assert slow / fast > 15


def test_the_plain_ants_find_paths_as_good(problem):
    planner = compose("aco", termination=[{"use": "max-generations", "limit": 12}])
    ours = [1 / run(problem, planner, seed).state.best.fitness for seed in range(40)]
    theirs = [PlainAco(problem.grid.occupied.tolist(), *problem.ends, seed).run(12) for seed in range(4)]
    assert abs(statistics.median(ours) / statistics.median(theirs) - 1) < 0.05


def test_a_compiled_tree_is_at_least_ten_times_as_fast_and_its_path_as_good(blocks):
    planner, occupied = compose("s-rrt"), blocks.grid.occupied.tolist()
    ours = [pl.plan(blocks, planner, seed=seed) for seed in range(20)]
    theirs = []
    slow = seconds(lambda: theirs.extend(PlainRrt(occupied, *blocks.ends, seed).run() for seed in range(20)))
    fast = min(seconds(lambda: [run(blocks, planner, seed) for seed in range(20)]) for _ in range(3))
    assert slow / fast > 10
    lengths = [result.metrics["polyline_length"] for result in ours]
    assert abs(statistics.mean(lengths) / statistics.mean(theirs) - 1) < 0.06
