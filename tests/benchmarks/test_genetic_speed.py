"""AGACD, IMAGA and IGA beside the same in plain Python, and beside the times that their papers print.

`pytest tests/benchmarks -n 0 --benchmark-enable` measures them. No test asserts a time, only ratios measured in one run.
"""

import time
from functools import partial
from itertools import pairwise

import numpy as np
import pytest

import pathloom as pl
from benchmarks.plain_agacd import PlainAgacd
from benchmarks.plain_iga import PlainIga
from benchmarks.plain_imaga import PlainImaga
from pathloom.kernel.compose import compose
from pathloom.kernel.evaluation import measure
from pathloom.kernel.run import run

PAPERS = {
    "agacd": "1.51 s on 20 × 20 cells, MATLAB R2018a",
    "agacd-50": "10.16 s on 50 × 50 cells, MATLAB R2018a",
    "imaga": "2.22 s and 2.75 s on 20 × 20 cells, MATLAB 2017b",
    "iga": "4.203 s on 20 × 20 cells, with what is not said",
}
TWINS = {"agacd": PlainAgacd, "imaga": PlainImaga, "iga": PlainIga}


def problem_on(name):
    return pl.PathProblem(pl.load_map(name, corners="allow"), start="bottom-left", goal="top-right", corners="allow")


@pytest.fixture(scope="module")
def problem():
    return problem_on("random-20:75:s3")


def planner_of(name, generations, **others):
    return compose(name, termination=[{"use": "max-generations", "limit": generations}], **others)


def plain(name, problem, seed):
    """Return the twin, for whom rows are counted upwards: the way then leads to greater numbers in both axes."""
    top = len(problem.grid.occupied) - 1
    start, goal = ((top - row, col) for row, col in problem.ends)
    return TWINS[name](problem.grid.occupied[::-1].tolist(), start, goal, seed)


def beside_the_paper(benchmark, name):
    benchmark.extra_info["paper"] = PAPERS[name]
    benchmark.group = f"{name}; in the paper {PAPERS[name]}"


@pytest.mark.parametrize("name", TWINS)
def test_with_the_papers_parameters(benchmark, problem, name):
    beside_the_paper(benchmark, name)
    planner = compose(name)
    benchmark(lambda: run(problem, planner, 1))


@pytest.mark.parametrize("name", TWINS)
def test_in_plain_python(benchmark, problem, name):
    beside_the_paper(benchmark, name)
    fewer = {} if benchmark.enabled else {"generations": 2}
    benchmark.pedantic(lambda: plain(name, problem, 1).run(**fewer), rounds=1)


@pytest.mark.parametrize("name", ["blocks-50:20%", "random-50:20%"])
def test_agacd_of_80_individuals_and_500_generations(benchmark, name):
    beside_the_paper(benchmark, "agacd-50")
    problem, planner = problem_on(name), compose("agacd-50")
    benchmark(lambda: run(problem, planner, 1))


@pytest.mark.parametrize("name", TWINS)
def test_the_plain_twin_measures_and_deletes_alike(problem, name):
    twin, planner = plain(name, problem, 1), compose(name)
    paths = [twin.sample() for _ in range(30)]
    paths += [child for pair in pairwise(paths) for child in twin.cross(*pair)]
    top = len(problem.grid.occupied) - 1

    def rows(paths):
        return problem.representation.encode([np.array([(top - r, c) for r, c in path]) for path in paths])

    values = measure(list(planner.objectives.objectives()), rows(paths), problem)
    np.testing.assert_allclose([twin.values(p) for p in paths], values)
    deletion = planner.refinement or planner.repair.steps[1]
    deleted = deletion.apply(rows(paths), problem, np.random.default_rng(1))
    np.testing.assert_array_equal(rows(map(twin.delete, paths)), deleted)


@pytest.mark.parametrize(
    ("name", "size", "within"),
    [
        ("agacd", {"population": 60, "generations": 60}, 0.05),
        ("imaga", {"population": 60, "generations": 5}, 0.02),
        ("iga", {"population": 100, "generations": 9}, 0.02),
    ],
)
def test_the_plain_twin_finds_paths_as_good(problem, name, size, within):
    planner = planner_of(name, **size)
    ours = [problem.representation.decode(run(problem, planner, s).outcome.solution) for s in range(25)]
    lengths = [np.hypot(*np.diff(path, axis=0).T).sum() for path in ours]
    theirs = [plain(name, problem, s).run(**size) for s in range(5)]
    assert np.median(theirs) == pytest.approx(np.median(lengths), rel=within)


@pytest.mark.parametrize(("name", "generations", "times"), [("agacd", 30, 5), ("imaga", 5, 15), ("iga", 5, 10)])
def test_a_compiled_generation_is_many_times_as_fast_as_one_in_plain_python(problem, name, generations, times):
    def seconds(work):
        """Return the time of this process alone: others may be busy on the same machine."""
        began = time.process_time()
        work()
        return time.process_time() - began

    def least(work, repeats):
        return min(seconds(work) for _ in range(repeats))

    few, many = planner_of(name, 1), planner_of(name, 1 + generations)
    run(problem, few, 0)  # whatever is to be compiled or cached, is
    ours = least(lambda: run(problem, many, 1), 15) - least(lambda: run(problem, few, 1), 15)
    twin = partial(plain, name, problem, 1)
    theirs = least(lambda: twin().run(generations=1 + generations), 2) - least(lambda: twin().run(generations=1), 2)
    assert theirs / ours > times
