"""What plugins cost, as ratios measured in one run: `pytest tests/benchmarks --benchmark-enable` prints the times.

An operator of one path at a time in plain Python beside its compiled counterpart, and 500 components of others beside
none.
"""

import os
import subprocess
import sys
import time
from dataclasses import dataclass

import numpy as np
import pytest
from cli.distributions import distribution

import pathloom as pl
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run
from pathloom.testing.problems import first_population


@dataclass(frozen=True, kw_only=True)
class Same(pl.PathMutation):
    """Leave every path as it is."""

    def mutate(self, path, problem, rng):
        return path


@dataclass(frozen=True, kw_only=True)
class SamePair(pl.PathCrossover):
    """Leave both parents as they are."""

    def cross_one(self, mother, father, problem, rng):
        return mother, father


@dataclass(frozen=True, kw_only=True)
class AsItIs(pl.PathRepair):
    """Leave every path as it is."""

    def repair(self, path, problem, rng):
        return path


@dataclass(frozen=True, kw_only=True)
class Cells(pl.PathObjective):
    """Number of cells that the path names."""

    def measure_one(self, path, problem):
        return float(len(path))


@dataclass(frozen=True, kw_only=True)
class Jitter(pl.PathMutation):
    """Move one interior way-point to a random neighbour."""

    def mutate(self, path, problem, rng):
        if len(path) < 3:
            return path
        moved = path.copy()
        moved[rng.integers(1, len(path) - 1)] += rng.integers(-1, 2, 2)
        return moved


PATH_WISE = {"mutation": Same(rate=0.2), "crossover": SamePair(rate=0.8), "repair": AsItIs()}


@pytest.fixture(scope="module")
def problem():
    grid = pl.load_map("random-20:75:s3", corners="allow")
    return pl.PathProblem(grid, start="top-left", goal="bottom-right", corners="allow")


def least(work, repeats=9):
    """Return the least time of this process alone: others may be busy on the same machine."""
    times = []
    for _ in range(repeats):
        began = time.process_time()
        work()
        times.append(time.process_time() - began)
    return min(times)


def calls(problem, n=100):
    population, rng = first_population(problem, n), np.random.default_rng(0)
    return {
        "mutation": lambda: Same().apply(population, np.arange(n), problem, rng),
        "crossover": lambda: SamePair().cross(population, np.arange(n).reshape(-1, 2), problem, rng),
        "repair": lambda: AsItIs().apply(population, problem, rng),
        "objective": lambda: Cells().measure(population, problem),
    }


@pytest.mark.parametrize("kind", ["mutation", "crossover", "repair", "objective"])
def test_what_100_paths_cost_on_top_of_the_operators_own_code(benchmark, problem, kind):
    benchmark(calls(problem)[kind])


@pytest.mark.parametrize("kind", ["mutation", "crossover", "repair", "objective"])
def test_taking_rows_apart_costs_less_than_walking_along_each_path_once(problem, kind):
    """Which is what the least of operators does: some 10 µs for a path of 20 cells in plain Python."""
    paths = [problem.representation.decode(row) for row in first_population(problem, 100)]

    def walk():
        for path in paths:
            for (r0, c0), (r1, c1) in zip(path[:-1].tolist(), path[1:].tolist(), strict=True):
                max(abs(r1 - r0), abs(c1 - c0))
                np.hypot(r1 - r0, c1 - c0)

    assert least(calls(problem)[kind]) < least(walk, 5)


@pytest.mark.parametrize("slot", [*PATH_WISE, "objectives", "jitter"])
def test_imga_with_one_path_wise_part_takes_at_most_ten_times_as_long(problem, slot):
    compiled = compose("imga")
    if slot == "objectives":
        mixed = compose(compiled, objectives={**dict.fromkeys(["length"], 1.0), "cells": Cells()})
    elif slot == "jitter":
        mixed = compose(compiled, mutation=Jitter())
    else:
        mixed = compose(compiled, **{slot: PATH_WISE[slot]})
    run(problem, compiled, 0)  # whatever is to be compiled or cached, is
    ours, theirs = least(lambda: run(problem, compiled, 1), 5), least(lambda: run(problem, mixed, 1), 5)
    assert theirs / ours < 10


@pytest.fixture(scope="module")
def crowded(tmp_path_factory):
    """A folder with ten plugins of 50 components each."""
    site = tmp_path_factory.mktemp("crowded")
    one = "@dataclass(frozen=True, kw_only=True)\nclass Jitter{0}(pl.PathMutation):\n    '''Leave all as it is.'''\n\n"
    one += "    reach: pl.Count = 1\n\n    def mutate(self, path, problem, rng):\n        return path\n\n"
    for k in range(10):
        source = "from dataclasses import dataclass\n\nimport pathloom as pl\n\n"
        source += "".join(one.format(number) for number in range(50))
        source += "@pl.hookimpl\ndef register(add):\n" + "".join(f"    add(Jitter{number})\n" for number in range(50))
        distribution(site, f"acme-{k}", points={f"acme{k}": f"m_acme{k}"}, modules={f"m_acme{k}": source})
    return site


def command(*words, site=None):
    environment = {**os.environ, **({"PYTHONPATH": str(site)} if site else {})}
    subprocess.run([sys.executable, "-m", "pathloom", *words], env=environment, check=True, capture_output=True)


@pytest.mark.parametrize("others", [0, 500])
@pytest.mark.parametrize("words", [("plugins", "list"), ("plan", "--map", "random-12:20", "--quiet")], ids=" ".join)
def test_commands_among_500_components_of_others(benchmark, crowded, words, others):
    if not benchmark.enabled:
        pytest.skip("only its times say anything")
    benchmark.group = " ".join(words)
    benchmark.pedantic(lambda: command(*words, site=crowded if others else None), rounds=7, warmup_rounds=1)
