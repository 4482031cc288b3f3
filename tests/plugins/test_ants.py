"""Ant colonies on a grid, statement by statement, and the genetic algorithms that begin with ants."""

import math
import pickle
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar

import naive
import numpy as np
import pytest
from scipy.stats import ks_2samp

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import first_generator, run
from pathloom.kernel.state import Individual
from pathloom.paths.ants.ant_system import AntSystem, Die, GoalDistance, MaxMin, Retreat, Uniform
from pathloom_baselines.aco_ga import AntPaths, ShorterParts
from pathloom_baselines.ants import InProportion, NoWorseThanMean, StepAndGoalDistance

COLONIES = ("aco", "aco-hga-aco", "colony")
EVERY = (*COLONIES, "aco-ga", "smartpath", "ga-hga-aco", "hga-aco")
EAST = 2


def on(grid, corners="allow", **ends):
    return pl.PathProblem(
        pl.load_map(grid, corners=corners) if isinstance(grid, str) else grid, corners=corners, **ends
    )


def short(name, generations=6):
    """The planner with little to do."""
    stop = [{"use": "max-generations", "limit": generations}]
    if name == "hga-aco":
        return pl.compose(
            name, genetic={"population": 12, "termination": stop}, colony={"ants": 12, "termination": stop}
        )
    return pl.compose(name, termination=stop, **({"ants": 12} if name in COLONIES else {"population": 12}))


def marched(problem, *paths, **more):
    """The state of a colony after these paths, each a list of cells, with fitness 1 / length."""
    population = naive.packed(paths, problem.context.cols)
    lengths = np.array([naive.length(path) for path in paths])
    best = int(lengths.argmin())
    deme = pl.Deme(population, lengths[:, np.newaxis], 1 / lengths)
    fittest = Individual(population[best], lengths[best : best + 1], 1 / lengths[best], 0)
    cells = problem.context.blocked.size
    facts = {"demes": (deme,), "best": fittest, "pheromone": np.ones((cells, 8)), "table": np.zeros(cells, np.int32)}
    return pl.ColonyState(problem, {}, **{**facts, "stuck": np.zeros(cells, np.int32), **more})


STRAIGHT = ((0, 0), (0, 1), (0, 2))
ROUND = ((0, 0), (1, 1), (0, 2))
ROOM = on(np.zeros((3, 3), bool), start=(0, 0), goal=(0, 2))
SOUTH_EAST, NORTH_EAST = 3, 1


# The transition rule ----------------------------------------------------------------------------


def first_steps(planner, problem, ants=20_000):
    """How often each cell is an ant's first step."""
    state = replace(planner, ants=ants).start(problem, np.random.default_rng(1))
    return np.bincount(state.population[:, 1], minlength=9) / len(state.population)


@pytest.mark.parametrize("beta", [0.0, 1.0, 7.0])
def test_a_step_is_drawn_in_proportion_to_pheromone_and_heuristic(beta):
    problem = on(np.zeros((3, 3), bool), start=(0, 0), goal=(2, 2))
    planner = pl.compose("aco", beta=beta, deadlock="retreat", initial=Uniform(level=0.3))
    eta = {1: 1 / math.sqrt(5), 3: 1 / math.sqrt(5), 4: 1 / math.sqrt(2)}  # one over the distance to the goal
    total = sum(value**beta for value in eta.values())
    shares = first_steps(planner, problem)
    for cell, value in eta.items():
        assert shares[cell] == pytest.approx(value**beta / total, abs=0.015)


@dataclass(frozen=True, kw_only=True)
class MoreToTheEast(pl.InitialPheromone):
    """Four times as much on steps to the east."""

    def lay(self, colony, problem, known):
        table = np.ones((problem.context.blocked.size, 8))
        table[:, EAST] = 4.0
        return table


@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0, 2.0])
def test_pheromone_counts_with_its_exponent(alpha):
    problem = on(np.zeros((3, 3), bool), start=(0, 0), goal=(2, 2))
    planner = pl.compose("aco", alpha=alpha, beta=0.0, deadlock="retreat", initial=MoreToTheEast())
    shares = first_steps(planner, problem)
    assert shares[1] == pytest.approx(4**alpha / (4**alpha + 2), abs=0.015)
    assert shares[3] == pytest.approx(1 / (4**alpha + 2), abs=0.015)


def test_whoever_stands_beside_the_goal_goes_there_unless_epsilon_says_otherwise():
    problem = on(np.zeros((3, 3), bool), start=(1, 1), goal=(0, 2))
    assert (first_steps(pl.compose("aco"), problem, 500)[2]) == 1.0
    assert first_steps(pl.compose("aco", heuristic={"epsilon": 1.0}), problem, 500)[2] < 1.0


def test_heuristics_are_those_of_their_formulas():
    problem = on(np.zeros((2, 4), bool), start=(0, 0), goal=(1, 3))
    step = (1 * 4 + 1, NORTH_EAST)  # from (1, 1) to (0, 2)
    away = math.sqrt(2)
    assert GoalDistance().desirability(problem)[step] == pytest.approx(1 / away)
    assert GoalDistance(epsilon=0.5).desirability(problem)[step] == pytest.approx(1 / (away + 0.5))
    assert StepAndGoalDistance().desirability(problem)[step] == pytest.approx(1 / (math.sqrt(2) + away))
    assert GoalDistance().desirability(problem)[4 + 2, EAST] == math.inf


def test_the_first_pheromone_is_what_it_is_said_to_be():
    planner, nobody = pl.compose("aco"), marched(ROOM, STRAIGHT).demes[0]
    assert (Uniform(level=0.5).lay(planner, ROOM, nobody) == 0.5).all()
    laid = InProportion(factor=10.0).lay(planner, ROOM, nobody)
    assert laid[3 + 1, 0] == pytest.approx(10.0)  # from (1, 1) north, where the goal is one cell away
    assert laid[1, EAST] == laid.max() < math.inf


# Pheromone update -------------------------------------------------------------------------------


def test_every_ant_that_arrived_leaves_q_over_its_length_on_its_own_steps():
    # programs that go around with a stale loop variable deposit the last ant's path as often as there are ants
    found = AntSystem(rho=0.25, q=2.0).update(marched(ROOM, STRAIGHT, ROUND, STRAIGHT), 0.0)
    assert found[0, EAST] == pytest.approx(0.75 + 2 * 2.0 / 2.0)
    assert found[1, EAST] == pytest.approx(0.75 + 2 * 2.0 / 2.0)
    # and those that take the number of nodes for the length cannot tell these two paths from each other
    assert found[0, SOUTH_EAST] == pytest.approx(0.75 + 2.0 / (2 * math.sqrt(2)))
    assert found[4, NORTH_EAST] == pytest.approx(0.75 + 2.0 / (2 * math.sqrt(2)))
    assert found[1, 6] == found[2, 6] == pytest.approx(0.75)  # the way back


def test_pheromone_may_lie_on_cells():
    found = AntSystem(rho=0.5, on="cells").update(marched(ROOM, STRAIGHT), 0.0)
    into_the_middle = [(0, EAST), (2, 6), (3, NORTH_EAST), (4, 0), (5, 7)]
    assert [found[step] for step in into_the_middle] == [pytest.approx(0.5 + 0.5)] * 5
    assert found[1, 6] == pytest.approx(0.5)  # into the start


def test_only_the_best_ant_leaves_pheromone_within_limits():
    state = marched(ROOM, ROUND, STRAIGHT)
    most = 1 / (0.5 * 2.0)  # Q / (rho L)
    found = MaxMin(rho=0.5).update(state, 0.0)
    assert found[0, EAST] == pytest.approx(min(0.5 + 1 / 2.0, most))
    assert found[0, SOUTH_EAST] == pytest.approx(0.5)
    found = MaxMin(rho=0.5).update(replace(state, pheromone=np.zeros((9, 8))), 0.0)
    assert found[0, SOUTH_EAST] == pytest.approx(most / 18)
    earlier = replace(state, demes=(marched(ROOM, ROUND).demes[0],))
    assert MaxMin(rho=0.5, who="ever").update(earlier, 0.0)[0, EAST] > MaxMin(rho=0.5).update(earlier, 0.0)[0, EAST]


def test_the_least_pheromone_by_chance_lets_a_converged_colony_find_its_path_one_time_in_twenty():
    problem = on(np.zeros((3, 6), bool), start=(0, 0), goal=(0, 5))
    least, most = MaxMin(least="chance").limits(marched(problem, [(0, c) for c in range(6)]))
    others = (30 + 24 + 40) / 18 - 2  # steps along rows, columns, diagonals; all but the one taken and the one back
    assert (most / (most + others * least)) ** 5 == pytest.approx(0.05)


def test_without_a_path_there_are_neither_limits_nor_deposits():
    nobody = pl.Deme(np.empty((0, 1), np.int32), np.empty((0, 1)), np.empty(0))
    state = replace(marched(ROOM, STRAIGHT), demes=(nobody,), best=None)
    for update in (AntSystem(rho=0.5), MaxMin(rho=0.5), MaxMin(rho=0.5, who="ever"), NoWorseThanMean(rho=0.5)):
        assert (update.update(state, 0.0) == 0.5).all()


def test_ants_longer_than_the_mean_leave_nothing():
    longest = ((0, 0), (1, 0), (2, 1), (1, 2), (0, 2))
    found = NoWorseThanMean(rho=1.0).update(marched(ROOM, STRAIGHT, ROUND, longest), 0.0)
    assert (found[0, EAST], found[0, SOUTH_EAST], found[0, 4]) == (0.5, pytest.approx(1 / math.sqrt(8)), 0.0)


# Deadlock ---------------------------------------------------------------------------------------

POCKET = np.array(
    [[glyph == "#" for glyph in line] for line in ("........", ".####...", "....#...", ".####...", "........")]
)
"""From the west an ant that goes straight for the east finds itself in a pocket."""


def in_the_pocket(corners="strict"):
    return on(POCKET, corners, start=(2, 0), goal=(2, 7))


def test_an_ant_without_a_way_on_dies_or_takes_steps_back():
    problem = in_the_pocket()
    dying, going_back = (
        run(problem, pl.compose("aco", beta=60.0, deadlock=how, termination="max-generations"), 0)
        for how in ("die", "retreat")
    )
    assert dying.outcome.solution is None
    assert dying.outcome.reason == "none of 2550 ants arrived: each came to a cell with no way on"
    assert dying.state.counts == {"ants lost": 51 * 50}
    assert (dying.state.evaluations, dying.state.history.best) == (0, ())
    assert dying.state.stuck[2 * 8 + 3] == 50
    assert pl.validate(problem.representation.decode(going_back.outcome.solution), problem) is None
    assert len(going_back.state.population) == 50


def test_no_cell_is_visited_twice_and_every_step_is_legal():
    for corners in naive.POLICIES:
        problem = on("blocks-20:25%:s1", corners)
        state = pl.compose("aco", deadlock="retreat", beta=1.0).start(problem, first_generator(3))
        for path in naive.unpacked(state.population, 20):
            assert len(set(path)) == len(path)
            assert naive.steps_singly(path)
            assert naive.path_free(problem.context.occupied, path, corners)


# Planners ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", EVERY)
@pytest.mark.parametrize("corners", naive.POLICIES)
def test_a_path_is_found_whatever_the_corners(name, corners):
    for grid in ("iga-map1", "blocks-12:20%:s3", "random-9:10:s1"):
        result = pl.plan(on(grid, corners), short(name), seed=4)
        assert result.found
        assert pl.validate(result.path, result.path_problem) is None


@pytest.mark.parametrize("name", EVERY)
def test_smallest_problems(name):
    room = np.zeros((3, 5), bool)
    for goal, length in (((1, 1), 0.0), ((1, 2), 1.0), ((0, 2), math.sqrt(2)), ((1, 3), 2.0)):
        result = pl.plan(on(room, start=(1, 1), goal=goal), short(name), seed=2)
        assert result.length == pytest.approx(length)
    corridor = pl.plan(on(np.zeros((1, 6), bool), start=(0, 5), goal=(0, 0)), short(name))
    assert corridor.length == 5.0


@pytest.mark.parametrize("name", EVERY)
def test_without_a_way_there_is_no_path_and_a_reason(name):
    wall = np.zeros((5, 5), bool)
    wall[2] = True
    problem = on(wall, start=(0, 0), goal=(4, 4))
    assert pl.plan(problem, name).status == "unreachable"
    outcome = run(problem, short(name), 0).outcome
    assert outcome.solution is None
    assert outcome.reason


@pytest.mark.parametrize("name", EVERY)
def test_a_run_goes_on_from_a_pickled_state_as_if_nothing_had_been(name):
    problem, planner = on("random-12:20:s1"), short(name)
    states = list(pl.iterate(problem, planner, seed=5))
    for middle in (0, len(states) // 2):
        state = pickle.loads(pickle.dumps(states[middle]))
        for expected in states[middle + 1 :]:
            assert planner.step(state).history == expected.history  # twice from one state
            state = planner.step(state)
            assert state.history == expected.history
            assert state.random == expected.random
            assert state.population.tobytes() == expected.population.tobytes()
    assert planner.result(state).solution.tobytes() == planner.result(states[-1]).solution.tobytes()


@dataclass(frozen=True, kw_only=True)
class Counted(pl.Objective):
    """The length, and how many paths were asked for."""

    asked: ClassVar[list] = []

    def measure(self, population, problem):
        self.asked.append(len(population))
        return pl.compiled.measures.lengths(np.ascontiguousarray(population), problem.context.cols)


class Everybody(pl.CellPaths):
    """A representation in which all individuals are different, so that every one of them is measured."""

    def distinct(self, population):
        return np.arange(len(population)), np.arange(len(population))


@pytest.mark.parametrize("name", [*COLONIES, "aco-ga", "ga-hga-aco"])
def test_every_path_that_is_measured_counts(name, monkeypatch):
    monkeypatch.setattr(pl.CellPaths, "distinct", Everybody.distinct)
    objectives = {"counted": Counted()}
    planner = pl.compose(short(name), objectives=objectives)
    if name == "aco-ga":
        planner = pl.compose(planner, sampling={"colony": {"objectives": objectives}})
    Counted.asked.clear()
    state = run(on("random-12:20:s1"), planner, 1).state
    assert state.evaluations == sum(Counted.asked) > 0


@pytest.mark.parametrize("name", EVERY)
def test_the_history_tells_of_every_generation(name):
    states = list(pl.iterate(on("iga-map1"), short(name), seed=1))
    history = states[-1].history
    assert len(history.best) == len(states) == states[-1].generation + 1
    assert [s.evaluations for s in states] == list(history.evaluations)
    assert list(history.best) == sorted(history.best)
    assert all(s.seconds > before.seconds for before, s in pairwise(states))


@pytest.mark.parametrize("name", EVERY)
def test_planners_come_near_to_the_optimum_in_an_empty_room(name):
    problem = on(np.zeros((20, 20), bool), "strict")
    for seed in range(3):
        assert pl.plan(problem, name, seed=seed).length <= 1.05 * 19 * math.sqrt(2)


@pytest.mark.parametrize("name", ["aco", "hga-aco"])
def test_a_budget_ends_the_run(name):
    planner = pl.compose(name, termination=[{"use": "max-evaluations", "limit": 700}])
    state = run(on("iga-map1"), planner, 0).state
    assert 700 <= state.evaluations < 850
    assert planner.progress(state) == 1.0


def test_there_is_one_aco():
    found = [e.name for e in default_registry().all_entries(pl.Planner) if e.component.name == "aco"]
    assert found == ["baselines/aco"]


def test_ants_do_their_best_for_any_objective():
    problem = on("blocks-20:20%:s2")
    safe = pl.compose("aco", objectives={"length": 1.0, "unsafe-cells": 10.0}, beta=2.0)
    results = [pl.plan(problem, planner, seed=1) for planner in ("aco", safe)]
    assert results[1].metrics["unsafe_nodes"] < results[0].metrics["unsafe_nodes"]
    assert results[1].fitness == pytest.approx(1 / (results[1].length + 10 * results[1].objectives["unsafe-cells"]))


def test_an_answer_can_be_refined():
    problem = on("random-20:75:s0")
    plain, refined = (pl.plan(problem, pl.compose("aco", refinement=r), seed=1) for r in ("none", "point-deletion"))
    assert refined.unrefined.tolist() == plain.path.tolist()
    assert refined.length < plain.length


@pytest.mark.parametrize("deadlock", ["die", "retreat", "dead-angle-table"])
@pytest.mark.parametrize("pheromone", ["ant-system", "max-min", "two-best", "no-worse-than-mean"])
@pytest.mark.parametrize("heuristic", ["goal-distance", "edge-length", "step-and-goal-distance"])
def test_all_parts_of_a_colony_swap(heuristic, pheromone, deadlock):
    for initial in ("uniform", "in-proportion", "ga-pheromone-seed"):
        parts = {"heuristic": heuristic, "pheromone": pheromone, "deadlock": deadlock, "initial": initial}
        assert pl.plan(on("random-9:10:s1"), pl.compose(short("aco"), **parts), seed=3).found


def test_parts_are_refused_where_they_do_not_belong():
    with pytest.raises(pl.ConfigError, match="'retreat' is a deadlock, not a heuristic"):
        pl.compose("aco", heuristic="retreat")
    with pytest.raises(pl.ConfigError, match="rho is a number in"):
        pl.compose("aco", pheromone={"rho": 0.0})


# Symmetry ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [*COLONIES, "hga-aco"])
def test_ants_have_no_favourite_direction(name):
    occupied = np.ascontiguousarray(pl.load_map("blocks-15:22%:s4").occupied[:, :12])
    cells = np.arange(occupied.size).reshape(occupied.shape)
    planner, found = short(name, 2), []
    for turn in range(8):
        here = np.rot90(cells, turn % 4)
        here = here[:, ::-1] if turn > 3 else here
        ends = [tuple(np.argwhere(here == r * 12 + c)[0].tolist()) for r, c in ((13, 1), (2, 10))]
        problem = on(occupied.ravel()[here], "no-squeeze", start=ends[0], goal=ends[1])
        population = [run(problem, planner, 100 * turn + seed).state.population[0] for seed in range(60)]
        paths = [here.ravel()[row[row >= 0]] for row in population]
        lengths = [np.hypot(*np.diff(np.stack(np.divmod(path, 12)))).sum() for path in paths]
        found.append(([p // 12 for p in paths], [p % 12 for p in paths], lengths))
    for rows, cols, lengths in found[1:]:
        for ours, theirs in ((rows, found[0][0]), (cols, found[0][1])):
            assert ks_2samp([o.mean() for o in ours], [t.mean() for t in theirs], method="asymp").pvalue > 1e-4
        assert ks_2samp(np.round(lengths, 9), np.round(found[0][2], 9), method="asymp").pvalue > 1e-4


# Genetic algorithms that begin with ants --------------------------------------------------------


def test_the_first_population_are_the_ants_paths_best_first():
    problem = on("random-20:75:s0")
    sampling = AntPaths(colony=short("aco"))
    state = run(problem, sampling.colony, 0).state
    with counting() as counts:
        found = sampling.sample(problem, 5, first_generator(0))
    lengths = pl.compiled.measures.lengths(found, 20)
    assert lengths == pytest.approx(np.sort(1 / state.fitness)[:5])
    assert counts["evaluations"] == state.evaluations
    rng = first_generator(0)
    sampling.sample(problem, 5, rng)
    assert rng.bit_generator.state == state.random  # the generator goes on where the ants stopped


def test_paths_are_repeated_and_mutated_where_ants_are_too_few():
    problem, colony = on("random-20:75:s0"), short("aco")
    plain, mutated = (
        AntPaths(colony=colony, mutation=m).sample(problem, 40, first_generator(0))
        for m in (None, pl.compose("basic-ga").mutation)
    )
    few = len(run(problem, colony, 0).state.population)
    paths = [naive.unpacked(population, 20) for population in (plain, mutated)]
    assert paths[0] == [paths[0][k % few] for k in range(40)]
    assert paths[1][:few] == paths[0][:few]
    assert paths[1] != paths[0]


def test_where_no_ant_arrives_there_is_no_population():
    problem = in_the_pocket()
    with counting() as counts:
        sampling = AntPaths(colony=pl.compose(short("aco"), beta=60.0, deadlock="die"))
        assert len(sampling.sample(problem, 5, first_generator(0))) == 0
    assert counts["samples failed"] == 12
    planner = pl.compose("aco-ga", sampling=sampling)
    assert "'ant-paths' found no first individual" in run(problem, planner, 0).outcome.reason


def test_a_child_of_shorter_parts_takes_the_place_of_the_longer_parent():
    mother = ((0, 0), (0, 1), (0, 2), (1, 3), (2, 3), (2, 4))  # shorter up to (0, 2)
    father = ((0, 0), (1, 0), (1, 1), (0, 2), (1, 3), (2, 4))  # and he from (1, 3)
    problem = on(np.zeros((3, 5), bool), start=(0, 0), goal=(2, 4))
    population = naive.packed([mother, father, mother], 5)
    with counting() as counts:
        found = ShorterParts().cross(population, np.array([[0, 1]]), problem, np.random.default_rng(0))
    paths = naive.unpacked(found, 5)
    child = ((0, 0), (0, 1), (0, 2), (1, 3), (2, 4))
    longer = int(naive.length(father) > naive.length(mother))
    assert (paths[longer], paths[1 - longer], paths[2]) == (child, (mother, father)[1 - longer], mother)
    assert counts == {}
    with counting() as counts:
        ShorterParts().cross(population, np.array([[0, 2]]), problem, np.random.default_rng(0))
    assert counts == {"crossover without gain": 1}


def test_aco_ga_cuts_corners_after_each_generation():
    result = pl.plan(on("random-20:75:s0"), "aco-ga", seed=1, optimum=True)
    assert result.optimum["any_angle"] - 1e-9 <= result.length < result.optimum["grid"]


def test_the_dead_go_back_or_die_as_their_parts_say():
    assert (Die().retreats, Retreat().retreats) == (False, True)
