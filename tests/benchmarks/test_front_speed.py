"""NSGA-II beside pymoo's own loop with the same operators: its mating and its elimination of duplicates."""

import pytest
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.optimize import minimize

import pathloom as pl
from pathloom.kernel.compose import compose
from pathloom.kernel.run import first_generator, iterate
from pathloom_pymoo.adapters import PathCrossover, PathMutation, PathSampling, PathsProblem

GENERATIONS = 20
OBJECTIVES = ["length", "unsafe-cells", "turns"]
OPERATORS = {
    "default": {"crossover": "shared-node", "mutation": "reroute"},
    "imga": {"crossover": "imga/common-node", "mutation": "imga/d8-gene-median"},
}


@pytest.fixture(scope="module")
def problem():
    return pl.PathProblem(pl.load_map("random-20:100:s3"))


def ours(operators, generations=GENERATIONS):
    return compose(
        "nsga2", objectives=OBJECTIVES, sampling="perturbed-trees", population=100, **OPERATORS[operators],
        termination=[{"use": "max-generations", "limit": generations}],
    )  # fmt: skip


def theirs(operators, problem, generations=GENERATIONS):
    parts = OPERATORS[operators]
    algorithm = NSGA2(
        pop_size=100,
        sampling=PathSampling("perturbed-trees"),
        crossover=PathCrossover(parts["crossover"]),
        mutation=PathMutation(parts["mutation"]),
    )
    return minimize(PathsProblem(problem, OBJECTIVES), algorithm, ("n_gen", generations), seed=1)


@pytest.mark.parametrize("operators", OPERATORS)
def test_twenty_generations_of_ours(benchmark, problem, operators):
    benchmark.group = f"NSGA-II, 100 × {GENERATIONS}, operators: {operators}"
    planner = ours(operators)
    benchmark(lambda: list(iterate(problem, planner, 1)))


@pytest.mark.parametrize("operators", OPERATORS)
def test_twenty_generations_of_pymoo(benchmark, problem, operators):
    benchmark.group = f"NSGA-II, 100 × {GENERATIONS}, operators: {operators}"
    benchmark.pedantic(lambda: theirs(operators, problem), rounds=5, warmup_rounds=1)


@pytest.mark.parametrize("name", ["nsga2", "nsga3", "sms-emoa", "age-moea", "moead", "rvea", "spea2"])
def test_one_generation(benchmark, problem, name):
    benchmark.group = "one generation of 100, three objectives, 20 × 20"
    planner = compose(name, objectives=OBJECTIVES)
    state = planner.start(problem, first_generator(1))
    for _ in range(10):
        state = planner.step(state)
    benchmark(lambda: planner.step(state))
