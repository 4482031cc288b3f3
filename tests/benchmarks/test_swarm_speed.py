"""Swarms beside mealpy, on the same problem in the same run: mealpy is asked for by these benchmarks alone.

Its releases pin an old numpy; ``pip install --no-deps mealpy pandas`` beside ours works.
"""

import time

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.compose import compose
from pathloom.kernel.run import iterate

GENERATIONS = 10


@pytest.fixture(scope="module")
def problem():
    grid = pl.load_map("random-20:75:s3", corners="allow")
    return pl.PathProblem(grid, corners="allow")


def ours(name, generations):
    return compose(name, population=100, termination=[{"use": "max-generations", "limit": generations}])


def theirs(name, planner, problem, generations):
    """The same vectors, decoder, cost and population, in mealpy; one vector at a time is how it asks."""
    mealpy = pytest.importorskip("mealpy", reason="mealpy is not installed: the benchmarks' peer")
    genes = len(planner.decoder.straight(problem))

    def cost(vector):
        return float(planner.evaluate_genes(np.asarray(vector)[np.newaxis], problem)[0].costs[0])

    bounds = mealpy.FloatVar(lb=[0.0] * genes, ub=[1.0] * genes)
    method = {"pso": mealpy.PSO.OriginalPSO, "gwo": mealpy.GWO.OriginalGWO}[name](epoch=generations, pop_size=100)
    return method, {"bounds": bounds, "obj_func": cost, "minmax": "min", "log_to": None}


@pytest.mark.parametrize("name", ["pso", "gwo", "ssa"])
def test_swarm_of_100_and_50_iterations(benchmark, problem, name):
    planner = ours(name, 50)
    benchmark(lambda: list(iterate(problem, planner, 1)))


@pytest.mark.parametrize("name", ["pso", "gwo"])
def test_ten_iterations_of_ours(benchmark, problem, name):
    benchmark.group = f"{name}, 100 × {GENERATIONS}, beside mealpy"
    planner = ours(name, GENERATIONS)
    benchmark(lambda: list(iterate(problem, planner, 1)))


@pytest.mark.parametrize("name", ["pso", "gwo"])
def test_ten_iterations_of_mealpy(benchmark, problem, name):
    benchmark.group = f"{name}, 100 × {GENERATIONS}, beside mealpy"
    method, task = theirs(name, ours(name, GENERATIONS), problem, GENERATIONS)
    benchmark.pedantic(lambda: method.solve(task, seed=1), rounds=5)


@pytest.mark.parametrize("name", ["pso", "gwo"])
def test_a_generation_is_at_least_fifteen_times_as_fast_as_mealpys(problem, name):
    planner = ours(name, GENERATIONS)
    list(iterate(problem, planner, 0))  # whatever is to be compiled, is

    def seconds(work):
        began = time.process_time()
        work()
        return time.process_time() - began

    method, task = theirs(name, planner, problem, GENERATIONS)
    slow = seconds(lambda: method.solve(task, seed=1))
    fast = min(seconds(lambda: list(iterate(problem, planner, 1))) for _ in range(5))
    assert slow / fast > 15
