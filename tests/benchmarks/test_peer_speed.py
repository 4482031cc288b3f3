"""Ours beside general libraries for evolution, as ratios of processor time measured in one run.

`pytest tests/benchmarks/test_peer_speed.py -n 0 --benchmark-enable`; `python -m pathloom.bench --target 1` prints the times.
"""

import time

import numpy as np
import pytest

import pathloom as pl
from pathloom.bench.measure import fault_of, length_of
from pathloom.bench.ours import Ours, usual
from pathloom.bench.peers import PEERS
from pathloom.bench.suite import problem_on
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run

WITHIN = 1.01
"""Length, in optima, that counts as reached."""
TIMES = {"DEAP paths": 10, "PyGAD GA": 50, "mealpy BaseGA": 50, "pymoo GA": 50}
"""How many times our time each takes at least, where it comes so far; DEAP's paths start near the optimum."""
PATIENCE = 20.0
"""Seconds that a library gets."""


def seconds(work):
    began = time.process_time()
    work()
    return time.process_time() - began


@pytest.fixture(scope="module")
def problem():
    return problem_on("random-20:75:s3", "allow")


def ours(generations):
    limit = [{"use": "max-generations", "limit": generations}]
    return compose("imga", sampling="perturbed-trees", termination=limit)


def in_pymoo(problem, generations, *, unique):
    algorithm = PEERS["pymoo GA, our operators"].setup(problem, 1, unique=unique)
    for _ in range(1 + generations):
        algorithm.next()


@pytest.mark.parametrize("unique", [True, False])
def test_twenty_generations_in_pymoo(benchmark, problem, unique):
    benchmark.group = "imga over perturbed trees, 100 × 20"
    benchmark.pedantic(lambda: in_pymoo(problem, 20 if benchmark.enabled else 2, unique=unique), rounds=3)


def test_twenty_generations_of_ours(benchmark, problem):
    benchmark.group = "imga over perturbed trees, 100 × 20"
    planner = ours(20)
    benchmark(lambda: run(problem, planner, 1))


@pytest.mark.parametrize("unique", [True, False], ids=["new children only", "any children"])
def test_a_generation_is_at_least_twenty_times_as_fast_as_with_the_same_operators_in_pymoo(problem, unique):
    few, many = ours(1), ours(51)
    run(problem, many, 0)
    in_pymoo(problem, 1, unique=unique)

    def least(work, repeats):
        return min(seconds(work) for _ in range(repeats))

    fast = (least(lambda: run(problem, many, 1), 9) - least(lambda: run(problem, few, 1), 9)) / 50
    slow = least(lambda: in_pymoo(problem, 10, unique=unique), 2) - least(
        lambda: in_pymoo(problem, 0, unique=unique), 2
    )
    assert slow / 10 / fast > 20


@pytest.mark.filterwarnings("default")  # those are theirs
@pytest.mark.parametrize("map_", ["random-20:10%:s1", "blocks-20:25%"])
@pytest.mark.parametrize("name", TIMES)
def test_a_path_within_one_percent_takes_a_fraction_of_a_librarys_time(benchmark, name, map_):
    if not benchmark.enabled:
        pytest.skip("takes seconds: -n 0 --benchmark-enable")
    if PEERS[name].version() is None:
        pytest.skip(f"{PEERS[name].distribution} is not installed")
    problem = problem_on(map_, "allow")
    target = WITHIN * pl.any_angle_path(problem)[0]
    mine, theirs = Ours(usual()[0]).prepare(problem), PEERS[name].prepare(problem)
    assert length_of(mine(0, PATIENCE, target)) <= target
    fast = np.median([seconds(lambda s=s: mine(s, PATIENCE, target)) for s in range(9)])
    reached = []
    for seed in range(2):
        began = time.process_time()
        path = theirs(seed, PATIENCE, target)
        spent = time.process_time() - began
        if not fault_of(path, problem) and length_of(path) <= target:
            reached.append(spent)
    benchmark.pedantic(lambda: mine(1, PATIENCE, target), rounds=5)
    benchmark.extra_info["reached"] = f"{len(reached)} of 2"
    if not reached:
        pytest.skip(f"{name} does not come within 1 % of the optimum")
    benchmark.extra_info["times"] = float(min(reached) / fast)
    assert min(reached) / fast > TIMES[name]
