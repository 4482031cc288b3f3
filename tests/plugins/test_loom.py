"""loom, the default planner: never worse than what it began with, as good as the exact search, anytime."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

import pathloom as pl
from pathloom.exact import additive_optimum
from pathloom.exact.scalarised import Scalarised
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import first_generator, run
from pathloom.paths.objectives import Length, Turns
from pathloom.paths.priced_trees import PricedTrees
from pathloom_loom.pool import GenePool

POLICIES = ("strict", "no-squeeze", "allow")


@dataclass(frozen=True, kw_only=True)
class Wobble(pl.PathObjective):
    """How far from the middle of the map the path gets, and how unequal its rows and columns are: no sum over steps."""

    def measure_one(self, path, problem):
        rows, cols = (path - path.mean(axis=0)).T
        middle = np.array(problem.context.occupied.shape) / 2
        return float(np.hypot(*(path - middle).T).max() + abs(rows.std() - cols.std()) * len(path))


OBJECTIVES = {
    "length": {"length": 1.0},
    "additive": {"length": 1.0, "unsafe-cells": 1.0, "turns": 1.0},
    "not additive": {"length": 1.0, "clearance": 10.0, "turn-angle": 1.0},
    "papers of others": {
        "length": 6.0,
        "safety": {"use": "imga/unsafe-node"},
        "energy": {"use": "imga/quadrant-energy"},
    },
    "of a third party, in plain Python": Terms({"wobble": Wobble()}),
    "partly additive": Terms({"length": (Length(), 2.0), "wobble": (Wobble(), 1.0)}),
}


def problem_on(name, corners="strict", **ends):
    return pl.PathProblem(pl.load_map(name, corners=corners), corners=corners, **ends)


def total(planner, row, problem):
    return 1.0 / planner.fitness_of(row, problem)[1]


def checked(problem, planner, seed=0):
    """Run, and return the finished run, whose answer has passed the validator."""
    finished = run(problem, planner, seed)
    assert pl.validate(problem.representation.decode(finished.outcome.solution), problem) is None
    return finished


def test_it_is_what_plans_unless_another_is_named():
    result = pl.plan(problem_on("iga-map1", "allow"))
    assert result.planner == "loom"
    assert result.config["planner"] == pl.freeze(pl.compose("loom"))


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("objectives", OBJECTIVES)
def test_it_is_never_worse_than_what_it_began_with_whatever_the_objectives(objectives, corners):
    planner = pl.compose("loom", objectives=OBJECTIVES[objectives])
    for name in ("random-20:25%:s3", "blocks-12:20%:s3", "rooms-25:5"):
        problem = problem_on(name, corners)
        seeds = planner.sampling.serving(planner.objectives).sample(problem, planner.population, first_generator(5))
        finished = checked(problem, planner, 5)
        least = min(total(planner, row, problem) for row in seeds)
        assert total(planner, finished.outcome.solution, problem) <= least * (1 + 1e-12)
        assert list(finished.state.history.best) == sorted(finished.state.history.best)


@pytest.mark.parametrize("corners", POLICIES)
def test_under_additive_objectives_it_is_no_worse_than_the_best_path_of_single_steps(corners):
    planner = pl.compose("loom", objectives=OBJECTIVES["additive"])
    for name in ("random-20:30%:s5", "random-50:20%:s6", "rooms-40:8"):
        problem = problem_on(name, corners)
        optimum = additive_optimum(problem, planner)
        assert total(planner, checked(problem, planner).outcome.solution, problem) <= optimum.cost * (1 + 1e-9)


EMPTY = {
    "crossover": {"crossover": "none"},
    "mutation": {"mutation": "none"},
    "both": {"crossover": "none", "mutation": "none"},
    "learning": {"control": {"learning": "none"}},
    "polish": {"control": {"polish": "none"}},
    "learning and polish": {"control": {"learning": "none", "polish": "none"}},
    "all four": {"crossover": "none", "mutation": "none", "control": {"learning": "none", "polish": "none"}},
}


@pytest.mark.parametrize("slots", EMPTY)
def test_with_empty_slots_it_works_as_well_as_it_can(slots):
    planner = pl.compose("loom", **EMPTY[slots])
    problem = problem_on("random-20:25%:s3")
    finished = checked(problem, planner)
    # The shortest path of single steps is among the first ones.
    assert finished.outcome.found.values[0] <= pl.octile_path(problem)[0] + 1e-9
    assert list(finished.state.history.best) == sorted(finished.state.history.best)


@pytest.mark.parametrize("population", [1, 2, 3, 7])
def test_it_bears_populations_of_any_size(population):
    checked(problem_on("random-20:25%:s3"), pl.compose("loom", population=population))


CORRIDOR = np.ones((5, 30), bool)
CORRIDOR[2, :] = False
SNAKE = np.array([[c == "#" for c in row] for row in (".....", "####.", ".....", ".####", ".....")])
ODD = {
    "start is goal": (np.zeros((6, 9), bool), (2, 3), (2, 3), 0.0),
    "neighbours": (np.zeros((6, 9), bool), (2, 3), (2, 4), 1.0),
    "diagonal neighbours": (np.zeros((6, 9), bool), (2, 3), (3, 4), math.sqrt(2)),
    "one cell": (np.zeros((1, 1), bool), (0, 0), (0, 0), 0.0),
    "one row": (np.zeros((1, 40), bool), (0, 39), (0, 0), 39.0),
    "one column": (np.zeros((40, 1), bool), (0, 0), (39, 0), 39.0),
    "a corridor": (CORRIDOR, (2, 0), (2, 29), 29.0),
    "nothing in the way": (np.zeros((12, 31), bool), (11, 0), (0, 30), math.hypot(11, 30)),
    "a snake": (SNAKE, (0, 0), (4, 4), None),
}


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("case", ODD)
def test_odd_maps_have_the_exact_optimum_as_well(case, corners):
    occupied, start, goal, length = ODD[case]
    problem = pl.PathProblem(occupied, start=start, goal=goal, corners=corners)
    result = pl.plan(problem, "loom", seed=1)
    assert result.status == "found"
    assert result.length == pytest.approx(pl.any_angle_path(problem)[0], abs=1e-9)
    assert length is None or result.length == pytest.approx(length, abs=1e-9)


@pytest.mark.parametrize("corners", POLICIES)
def test_its_path_has_no_superfluous_points(corners):
    for name in ("empty-9", "empty-5", "empty-30", "random-20:10%:s1", "random-20:30%:s5", "rooms-25:5", "maze-21:1"):
        for seed in range(3):
            path = pl.plan(problem_on(name, corners), "loom", seed=seed).path
            steps = np.diff(path, axis=0)
            across = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
            assert across.all(), (name, seed, path.tolist())


def test_a_goal_behind_a_wall_is_unreachable():
    occupied = np.zeros((5, 5), bool)
    occupied[2] = True
    assert pl.plan(pl.PathProblem(occupied)).status == "unreachable"


@pytest.mark.parametrize("density", [10, 20, 30, 40])
def test_on_maps_of_20_by_20_its_path_is_the_shortest_of_all(density):
    for seed in range(10):
        problem = problem_on(f"random-20:{density}%:s{seed}", POLICIES[seed % 3])
        assert pl.plan(problem, "loom").length == pytest.approx(pl.any_angle_path(problem)[0], rel=1e-12), seed


def test_on_larger_maps_it_is_within_a_twentieth_of_a_percent():
    names = ["random-50:20%:s1", "random-50:30%:s2", "blocks-50:25%:s3", "rooms-100", "rooms-100:20:s4"]
    gaps = []
    for name, corners in zip(names, (*POLICIES, *POLICIES), strict=False):
        problem = problem_on(name, corners)
        gaps.append(pl.plan(problem, "loom").length / pl.any_angle_path(problem)[0] - 1.0)
    assert min(gaps) >= -1e-12
    assert np.mean(gaps) <= 0.0005


@pytest.mark.parametrize("objectives", ["length", "additive"])
def test_with_a_time_limit_it_goes_on_until_the_limit_and_says_so(objectives):
    problem = problem_on("random-20:30%:s5")
    planner = pl.compose("loom", objectives=OBJECTIVES[objectives])
    usual = pl.plan(problem, planner, seed=2)
    longer = pl.plan(problem, planner, seed=2, time_limit=0.3)
    assert longer.config["planner"]["termination"] == [{"use": "wall-time", "seconds": 0.3}]
    assert longer.config["run"]["time_limit"] == 0.3
    assert longer.budget["seconds"] + longer.budget["phases"]["loading"] >= 0.3
    assert longer.budget["generations"] > usual.budget["generations"]
    assert longer.fitness >= usual.fitness


def test_a_termination_that_was_set_stays_with_a_time_limit():
    planner = pl.compose("loom", termination=[{"use": "max-generations", "limit": 2}])
    result = pl.plan(problem_on("iga-map1"), planner, time_limit=60)
    assert result.budget["generations"] == 2


def test_more_time_leads_on_from_where_less_time_ended():
    problem = problem_on("random-50:30%:s1")
    planner = pl.compose("loom", objectives=OBJECTIVES["additive"])
    runs = [pl.plan(problem, planner, seed=4, time_limit=seconds) for seconds in (0.02, 0.1, 0.4)]
    for less, more in pairwise(runs):
        shorter, longer = sorted((less.history["best"], more.history["best"]), key=len)
        assert longer[: len(shorter)] == shorter
    by_generations = sorted(runs, key=lambda result: result.budget["generations"])
    totals = [1.0 / result.fitness for result in by_generations]
    assert totals == sorted(totals, reverse=True)


@pytest.mark.parametrize("name", ["iga-map1", "random-50:30%:s1", "rooms-40:8"])
def test_the_first_path_is_there_before_the_best(name):
    budget = pl.plan(problem_on(name), "loom").budget
    assert 0.0 < budget["seconds_to_first"] <= budget["seconds_to_best"] <= budget["seconds"]


def test_its_seeds_serve_the_planners_objectives():
    own = Terms({"turns": (Turns(), 2.0)})
    mine = Terms({"length": Length()})
    for sampling in (Scalarised(), PricedTrees()):
        assert sampling.serving(own).objectives == own
        assert type(sampling)(objectives=mine).serving(own).objectives == mine
    served = pl.compose("loom").sampling.serving(own)
    assert served.parts[1].objectives == own
    problem = problem_on("random-20:25%:s3")
    for objectives in (own, mine):
        planner = pl.compose("loom", objectives=objectives)
        first = planner.start(problem, first_generator(0))
        optimum = additive_optimum(problem, planner)
        assert 1.0 / first.best.fitness == pytest.approx(optimum.cost, rel=1e-9)


def pool(population, problem, **fields):
    return GenePool(**fields).apply(population, problem, np.random.default_rng(0))


def test_the_gene_pool_changes_the_longest_path_alone():
    problem = problem_on("random-20:25%:s3")
    trees = default_registry().find(pl.Sampling, "perturbed-trees")()
    population = trees.sample(problem, 15, np.random.default_rng(2))
    lengths = pl.compiled.measures.lengths(population, 20)
    changed = pool(population, problem)
    longest = int(np.argsort(lengths, kind="stable")[-1])
    decode = problem.representation.decode
    for k in range(15):
        assert (k == longest) != (decode(changed[k]).tolist() == decode(population[k]).tolist())
    assert pl.compiled.measures.lengths(changed, 20)[longest] < lengths.min()


def test_the_gene_pool_bears_a_population_of_one_and_of_none():
    problem = problem_on("random-20:25%:s3")
    one = problem.representation.encode([pl.octile_path(problem)[1]])
    changed = pool(one, problem)
    assert len(changed) == 1
    assert pl.validate(problem.representation.decode(changed[0]), problem) is None
    assert len(pool(one[:0], problem)) == 0


def test_nothing_that_it_takes_is_made_for_other_planners_only():
    """Each of its own parts serves in the planner of a paper."""
    problem = problem_on("random-20:25%:s3")
    for slots in (
        {"refinement": "loom/string-pulling"},
        {"refinement": "loom/band-search"},
        {"survival": {"use": "best-of-both", "distinct": True}, "control": {"use": "memetic", "learning": "gene-pool"}},
        {"mutation": {"use": "one-of", "parts": [{"use": "reroute"}, {"use": "imga/d8-gene-median"}]}},
    ):
        checked(problem, pl.compose("imga", archive="none", **slots))
