"""Speed as ratios measured in one run: `pytest tests/benchmarks -n 0 --benchmark-enable`. No test asserts a time."""

import time

import numpy as np
import pytest

import pathloom as pl
from benchmarks.plain_imga import PlainImga
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run


@pytest.fixture(scope="module")
def problem():
    grid = pl.load_map("random-20:75:s3", corners="allow")
    return pl.PathProblem(grid, start="top-left", goal="bottom-right", corners="allow")


def literal(generations):
    return compose("imga", termination=[{"use": "max-generations", "limit": generations}])


def test_imga_of_100_individuals_and_50_generations(benchmark, problem):
    planner = literal(50)
    benchmark(lambda: run(problem, planner, 1))


def test_imga_in_plain_python(benchmark, problem):
    benchmark.pedantic(lambda: plain(problem, 1).run(), rounds=2)


def test_any_angle_optimum(benchmark, problem):
    benchmark(lambda: pl.any_angle_path(problem))


@pytest.mark.data
def test_imga_on_the_papers_environment_4(benchmark, data):
    grid = pl.load_map(data / "ga_grids" / "ga_smooth_20x20.csv")
    problem = pl.PathProblem(grid, start="top-left", goal="bottom-right", corners="allow")
    planner = compose("imga")
    benchmark(lambda: run(problem, planner, 1))


def test_plan_with_validation_and_report(benchmark, problem):
    planner = literal(50)
    benchmark(lambda: pl.plan(problem, planner, seed=1))


@pytest.mark.parametrize("name", ["blocks-200:20%", "rooms-200:8", "random-200:30%"])
def test_any_angle_optimum_of_a_large_map(benchmark, name):
    large = pl.PathProblem(pl.load_map(name))
    benchmark.pedantic(lambda: pl.any_angle_path(large), rounds=1)


def test_octile_optimum(benchmark, problem):
    benchmark(lambda: pl.octile_path(problem))


def plain(problem, seed):
    return PlainImga(problem.grid.occupied.tolist(), *problem.ends, seed)


def test_the_plain_twin_finds_paths_as_good(problem):
    planner = literal(10)
    ours = [problem.representation.decode(run(problem, planner, s).outcome.solution) for s in range(4)]
    lengths = [np.hypot(*np.diff(path, axis=0).T).sum() for path in ours]
    theirs = [plain(problem, s).run(generations=10) for s in range(4)]
    assert abs(np.median(lengths) / np.median(theirs) - 1) < 0.03


def test_compiled_imga_is_at_least_forty_times_as_fast_as_plain_python(problem):
    planner = literal(20)
    run(problem, planner, 0)  # whatever is to be compiled or cached, is

    def seconds(work):
        began = time.process_time()
        work()
        return time.process_time() - began

    ours = min(seconds(lambda: run(problem, planner, 1)) for _ in range(7))
    theirs = min(seconds(lambda: plain(problem, 1).run(generations=20)) for _ in range(2))
    assert theirs / ours > 40
