"""Multi-objective planners: pymoo's algorithms on arrays, the same every time, within the constraints."""

import pickle
from dataclasses import dataclass
from typing import ClassVar

import moocore
import numpy as np
import pytest
from pymoo.algorithms.moo.age import AGEMOEASurvival
from pymoo.algorithms.moo.nsga2 import binary_tournament
from pymoo.algorithms.moo.nsga3 import ReferenceDirectionSurvival
from pymoo.algorithms.moo.rvea import APDSurvival
from pymoo.algorithms.moo.sms import LeastHypervolumeContributionSurvival
from pymoo.algorithms.moo.spea2 import SPEA2Survival
from pymoo.core.population import Population
from pymoo.core.problem import Problem
from pymoo.operators.survival.rank_and_crowding import RankAndCrowding
from pymoo.optimize import minimize

import pathloom as pl
from pathloom.exact.front import exact_front
from pathloom.kernel.component import parameters
from pathloom.kernel.compose import build, compose, freeze
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import first_generator, iterate, run
from pathloom.kernel.termination import MaxGenerations, Stagnation
from pathloom.paths.constraints import parse_constraint
from pathloom.paths.objectives import Length, TurnAngle, Turns, UnsafeCells
from pathloom_pymoo import adapters
from pathloom_pymoo.archive import compromise, merged, new_values
from pathloom_pymoo.nsga2 import Nsga2, rank_and_crowding
from pathloom_pymoo.reference import directions
from pathloom_pymoo.survival import survive
from pathloom_pymoo.tournament import by_dominance, by_least, contestants, winners

ALGORITHMS = ("nsga2", "nsga3", "sms-emoa", "age-moea", "moead", "rvea", "spea2")
PROBLEM = pl.PathProblem(pl.load_map("random-12:35:s2"))
WIDE = pl.PathProblem(pl.load_map("blocks-40:15%:s1"))
THREE = {"length": 1.0, "unsafe-cells": 1.0, "turns": 1.0}
each_algorithm = pytest.mark.parametrize("name", ALGORITHMS)


def short(name, generations=6, **slots):
    return compose(name, **{"population": 24, "termination": MaxGenerations(limit=generations), **slots})


def last(planner, problem=PROBLEM, seed=0):
    return run(problem, planner, seed).state


def nondominated(values):
    """The slow twin: those that nobody else is at least as good as everywhere and better somewhere."""
    return [a for a in values if not any(all(b <= a) and any(b < a) for b in values)]


# The planners


@each_algorithm
def test_the_same_seed_gives_the_same_bytes(name):
    planner = short(name, constraints=() if name == "moead" else (parse_constraint("length <= 1.3 x optimum"),))
    first, again, other = (last(planner, seed=seed) for seed in (3, 3, 4))
    for one, two in ((first.population, again.population), (first.archive.values, again.archive.values)):
        assert one.tobytes() == two.tobytes()
    assert first.archive.population.tobytes() == again.archive.population.tobytes()
    assert first.history == again.history
    assert first.population.shape != other.population.shape or (first.population != other.population).any()


@each_algorithm
def test_a_state_is_plain_data_and_steps_alike_twice(name):
    planner = short(name)
    state = planner.step(planner.start(PROBLEM, first_generator(1)))
    thawed = pickle.loads(pickle.dumps(state))
    first, again, third = planner.step(state), planner.step(state), planner.step(thawed)
    for other in (again, third):
        assert first.population.tobytes() == other.population.tobytes()
        assert first.archive.values.tobytes() == other.archive.values.tobytes()
        assert first.random == other.random
        assert all(first.memory[k].tobytes() == other.memory[k].tobytes() for k in first.memory)


@each_algorithm
def test_nobody_elses_random_numbers_and_warnings_are_touched(name):
    import random
    import warnings

    np.random.seed(5)  # noqa: NPY002
    random.seed(5)
    before, plain, filters = np.random.get_state()[1].tolist(), random.getstate(), list(warnings.filters)  # noqa: NPY002
    last(short(name))
    assert np.random.get_state()[1].tolist() == before  # noqa: NPY002
    assert random.getstate() == plain
    assert warnings.filters == filters


@each_algorithm
def test_the_front_is_the_trade_offs_of_all_generations(name):
    planner = short(name)
    seen = []
    evaluate = type(planner).evaluate

    def spy(self, population, problem):
        values, violation = evaluate(self, population, problem)
        seen.extend(values)
        return values, violation

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(type(planner), "evaluate", spy)
        state = last(planner)
    front = planner.front(state)
    assert {tuple(v) for v in front.values.tolist()} == {tuple(v) for v in nondominated(np.array(seen))}
    assert front.values.tolist() == sorted(front.values.tolist())
    assert state.evaluations == len(seen)
    measured = [term.objective.measure(front.population, PROBLEM) for term in planner.objectives]
    assert np.stack(measured, axis=1).tolist() == front.values.tolist()
    for row in front.population:
        assert pl.validate(PROBLEM.representation.decode(row), PROBLEM) is None


@each_algorithm
def test_small_fronts_are_found_exactly(name):
    planner = short(name, 40, population=60)
    wanted = exact_front(PROBLEM, planner.objectives)
    found = planner.front(last(planner))
    assert found.values == pytest.approx(wanted.values)


@each_algorithm
@pytest.mark.parametrize("n", [1, 2, 3])
def test_tiny_populations_and_tiny_problems_run(name, n):
    for problem in (
        PROBLEM,
        pl.PathProblem(pl.load_map("empty-5"), start=(0, 0), goal=(0, 0)),
        pl.PathProblem(pl.load_map("empty-5"), start=(0, 0), goal=(1, 1)),
    ):
        state = last(short(name, 3, population=n), problem)
        assert len(state.archive) >= 1


@each_algorithm
@pytest.mark.parametrize("objectives", [["length", "clearance"], ["length", "clearance", "turn-angle", "turns"]])
def test_two_objectives_and_four_serve_and_some_may_be_negative(name, objectives):
    state = last(short(name, objectives=objectives), WIDE)
    assert state.archive.values.shape[1] == len(objectives)
    assert (state.archive.values[:, 1] < 0).all()
    assert len(state.archive) == len(nondominated(state.archive.values)) >= 1


@each_algorithm
def test_plan_answers_with_one_of_the_front(name):
    result = pl.plan(PROBLEM, short(name), seed=2)
    front = last(short(name), seed=2).archive.values.tolist()
    assert result.found
    assert list(result.objectives.values()) in front
    assert result.history["best"] == sorted(result.history["best"])


def test_weights_choose_among_the_trade_offs():
    answers = [
        pl.plan(PROBLEM, short("nsga2", 20, objectives={**dict.fromkeys(THREE, 0.0), label: 1.0})).objectives
        for label in THREE
    ]
    for label, answer in zip(THREE, answers, strict=True):
        assert answer[label] == min(other[label] for other in answers)


def test_the_compromise_has_the_least_weighted_share_of_each_range():
    values = np.array([[0.0, 100.0], [4.0, 20.0], [10.0, 0.0]])
    assert compromise(values, np.array([1.0, 1.0])) == 1
    assert compromise(values, np.array([5.0, 1.0])) == 0
    assert compromise(values, np.array([1.0, 5.0])) == 2
    assert compromise(values[:1], np.array([1.0, 1.0])) == 0


def test_stagnation_waits_for_the_front():
    states = list(iterate(PROBLEM, short("nsga2", termination=Stagnation(patience=10))))
    changed = [k for k in range(1, len(states)) if states[k].archive is not states[k - 1].archive]
    assert states[-1].generation == changed[-1] + 10


def test_the_seeds_follow_the_objectives_unless_told_otherwise():
    objectives = pl.Terms({"length": Length(), "angle": TurnAngle()})
    default = Nsga2().sampling
    assert default.serving(objectives).parts[0].objectives == objectives
    own = build(pl.Sampling, {"use": "scalarised", "objectives": {"turns": 2.0}}, default_registry(), "")
    assert own.serving(objectives) == own


def test_the_front_of_the_first_population_starts_with_the_optima():
    state = Nsga2().start(PROBLEM, first_generator(0))
    wanted = exact_front(PROBLEM, Nsga2().objectives).values
    assert state.archive.values.min(axis=0) == pytest.approx(wanted.min(axis=0))


def swaps():
    for entry in default_registry().all_entries():
        for slot, kind in (
            ("sampling", pl.Sampling), ("crossover", pl.Crossover), ("mutation", pl.Mutation), ("repair", pl.Repair)
        ):  # fmt: skip
            fits = issubclass(entry.component, kind) and entry.component.works_on in ("", "cells")
            if fits and not any(p.required for p in parameters(entry.component)):
                yield pytest.param(slot, entry.name, id=f"{slot}:{entry.name}")


@pytest.mark.parametrize(("slot", "component"), list(swaps()))
def test_every_operator_serves_or_says_by_name_why_not(slot, component):
    try:
        planner = short("nsga2", 3, **{slot: component})
    except pl.ConfigError as error:
        assert component.rpartition("/")[2] in str(error)  # noqa: PT017
        return
    state = last(planner)
    assert len(state.archive)
    for row in state.archive.population:
        assert pl.validate(PROBLEM.representation.decode(row), PROBLEM) is None


def test_a_planner_is_rebuilt_from_its_table():
    planner = short("nsga3", constraints=(parse_constraint("length <= 1.2 x optimum"),))
    assert build(pl.Planner, freeze(planner), default_registry(), "") == planner


def test_all_of_ours_are_front_planners():
    registry = default_registry()
    assert all(issubclass(registry.find(pl.Planner, name), FrontPlanner) for name in ALGORITHMS)


# Constraints


@each_algorithm
def test_every_answer_keeps_to_the_constraints(name):
    if name == "moead":
        with pytest.raises(pl.ConfigError, match="moead"):
            short(name, constraints=(parse_constraint("length <= 20"),))
        return
    limits = (parse_constraint("length <= 1.05 x optimum"), parse_constraint("turns <= 9"))
    planner = short(name, 25, constraints=limits, sampling="perturbed-trees")
    front = planner.front(last(planner))
    assert len(front)
    for limit in limits:
        assert (limit.violation(front.population, PROBLEM) == 0.0).all()
    free = exact_front(PROBLEM, planner.objectives).values.tolist()
    shortest = min(v[0] for v in free)
    assert front.values == pytest.approx(np.array([v for v in free if v[0] <= 1.05 * shortest and v[2] <= 9]))


def test_who_breaks_a_constraint_least_is_nearest_to_the_answer():
    planner = short("nsga2", 30, constraints=(parse_constraint("turns <= 0"),))
    finished = run(PROBLEM, planner, 0)
    assert finished.outcome.solution is None
    assert "every path breaks a constraint" in finished.outcome.reason
    assert pl.plan(PROBLEM, planner).status == "not-found"
    first = planner.start(PROBLEM, first_generator(0))
    assert finished.state.violation.min() <= first.violation.min()


# Like pymoo


def crowd(seed, n=60, m=3, constrained=True):
    rng = np.random.default_rng(seed)
    values = rng.integers(0, 9, (n, m)).astype(float)
    broken = np.maximum(rng.integers(-6, 4, n), 0).astype(float) if constrained else np.zeros(n)
    return values, broken


def in_pymoo(survival, values, broken, n, seed, **more):
    """Who survives if pymoo does it all, and how it marks everybody."""
    population = Population.new(
        F=values, G=broken[:, np.newaxis], H=np.empty((len(values), 0)), X=np.arange(len(values))
    )
    facts = Problem(n_var=1, n_obj=values.shape[1], n_ieq_constr=1)
    rng = np.random.default_rng(seed)
    kept = survival.do(facts, population, n_survive=n, random_state=rng, **more)
    return [int(one.X) for one in kept], population, rng.random()


@pytest.mark.parametrize("seed", range(30))
def test_nsga2_lets_live_whom_pymoo_lets_live(seed):
    values, broken = crowd(seed, m=2 + seed % 4, constrained=seed % 3 > 0)
    wanted, marked, after = in_pymoo(RankAndCrowding(), values, broken, 25, seed)
    rng = np.random.default_rng(seed)
    found, marks, _ = Nsga2(population=25).survivors(values, broken, np.arange(0), None, rng)
    assert found.tolist() == wanted
    assert rng.random() == after
    alive = [k for k in wanted if broken[k] == 0]
    assert marks["rank"][alive].tolist() == marked[alive].get("rank").tolist()
    assert marks["crowding"][alive].tolist() == marked[alive].get("crowding").tolist()


def survivals():
    yield "rank", RankAndCrowding, {}
    yield "niches", lambda: ReferenceDirectionSurvival(directions(3, 25)), {}
    yield "hypervolume", LeastHypervolumeContributionSurvival, {"ideal": np.zeros(3), "nadir": np.full(3, 9.0)}
    yield "geometry", AGEMOEASurvival, {}
    yield "strength", lambda: SPEA2Survival(normalize=True), {}
    yield "angles", lambda: APDSurvival(directions(3, 25)), {"n_gen": 0.3, "n_max_gen": 1.0}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(("make", "more"), [pytest.param(*rest, id=label) for label, *rest in survivals()])
def test_survivals_of_pymoo_choose_the_same_from_arrays(make, more):
    ours, theirs = make(), make()
    for seed in range(6):  # the same objects again: what they remember goes on
        values, broken = crowd(seed, constrained=seed % 3 > 0)
        wanted, _, after = in_pymoo(theirs, values, broken, 25, seed, **more)
        rng = np.random.default_rng(seed)
        found, _ = survive(ours, values, broken, 25, rng, **more)
        assert found.tolist() == wanted
        assert rng.random() == after


def test_tournaments_have_the_winners_of_pymoo_except_where_pymoo_draws_lots():
    from types import SimpleNamespace

    for seed in range(5):
        values, broken = crowd(seed)
        _, rank, crowding = rank_and_crowding(values, 60, np.random.default_rng(0))
        population = Population.new(
            F=values, G=broken[:, np.newaxis], H=np.empty((60, 0)), rank=rank, crowding=crowding
        )
        drawn = contestants(40, 60, np.random.default_rng(seed))
        for kind in ("comp_by_dom_and_crowding", "comp_by_rank_and_crowding"):
            judged = [
                by_dominance(drawn, values) if "dom" in kind else by_least(drawn, rank),
                by_least(drawn, -crowding),
            ]
            ours = [winners(drawn, broken, judged, np.random.default_rng(k)).tolist() for k in range(8)]
            theirs = [
                binary_tournament(
                    population, drawn, SimpleNamespace(tournament_type=kind, random_state=np.random.default_rng(k))
                )[:, 0].tolist()
                for k in range(8)
            ]
            sure = 0
            for pair, mine, pymoos in zip(
                drawn.tolist(), zip(*ours, strict=True), zip(*theirs, strict=True), strict=True
            ):
                assert set(mine) <= set(pair)
                if len(set(pymoos)) == 1:
                    sure += len(set(mine)) == 1
                    assert pymoos[0] in mine
            assert sure >= 25


def test_everybody_takes_part_in_as_many_tournaments():
    drawn = contestants(60, 30, np.random.default_rng(0))
    assert drawn.shape == (60, 2)
    assert np.bincount(drawn.ravel()).tolist() == [4] * 30


# The archive


@pytest.mark.parametrize("seed", range(10))
def test_merging_keeps_the_first_of_each_trade_off(seed):
    rng = np.random.default_rng(seed)
    representation = PROBLEM.representation
    front = pl.kernel.front.Front(np.empty((0, 3), np.int32), np.empty((0, 3)))
    everything, changed = [], []
    for batch in range(6):
        values = rng.integers(0, 6, (12, 3)).astype(float)
        population = np.arange(36, dtype=np.int32).reshape(12, 3) + 36 * batch
        everything += zip(values, population, strict=True)
        before = front.values.tolist()
        front, new = merged(front, population, values, representation)
        changed.append(new == (front.values.tolist() != before))
    best = nondominated(np.array([v for v, _ in everything]))
    wanted = {tuple(v): next(p for w, p in everything if (w == v).all()).tolist() for v in best}
    assert dict(zip(map(tuple, front.values.tolist()), front.population.tolist(), strict=True)) == wanted
    assert all(changed)


def test_values_that_somebody_has_are_not_new():
    known = np.array([[1.0, 2.0], [3.0, 4.0]])
    values = np.array([[5.0, 5.0], [3.0, 4.0], [0.0, 9.0], [5.0, 5.0]])
    assert new_values(values, known).tolist() == [0, 2]
    assert new_values(known, known).tolist() == []


# Bad input


@pytest.mark.parametrize(
    ("objectives", "words"),
    [
        (["length"], "allowed are 2 to 5 objectives; got 1: length"),
        (
            ["length", "turns", "clearance", "turn-angle", "unsafe-cells", "obstacles-beside"],
            "2 to 5 objectives; got 6",
        ),
        (["length", "lenght"], "did you mean 'length'"),
        ({"length": 1.0, "again": {"use": "length"}}, "'again' is the same objective as 'length'"),
    ],
)
@each_algorithm
def test_objectives_without_a_trade_off_are_refused(name, objectives, words):
    with pytest.raises(pl.ConfigError, match=".") as error:
        compose(name, objectives=objectives)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


def test_contradictory_constraints_are_refused_when_composing():
    texts = ["length <= 10", "length >= 12"]
    with pytest.raises(pl.ConfigError, match="contradict each other"):
        compose("nsga2", constraints=tuple(map(parse_constraint, texts)))


@dataclass(frozen=True, kw_only=True)
class Faulty(pl.Objective):
    """Not what an objective is to be."""

    works_on: ClassVar[str] = "cells"
    fault: str = "nan"

    def measure(self, population, problem):
        values = np.arange(len(population), dtype=float)
        if self.fault == "nan":
            values[len(values) // 2] = np.nan
        if self.fault == "inf":
            values[::2] = np.inf
        return values[:-1] if self.fault == "shape" else values


@pytest.mark.parametrize(
    ("fault", "words"), [("nan", r"NaN for array\(\[\[11, +0\]"), ("shape", r"wanted shape \(\d+,\), one value a row")]
)
def test_a_faulty_objective_is_named_with_the_path(fault, words):
    planner = short("nsga2", objectives=pl.Terms({"length": Length(), "mine": Faulty(fault=fault)}))
    with pytest.raises(pl.PluginError, match=words) as error:
        last(planner)
    assert "'faulty'" in str(error.value)
    assert "\n" not in str(error.value)


def test_an_infinite_value_keeps_an_individual_off_the_front():
    planner = short("nsga2", objectives=pl.Terms({"length": Length(), "mine": Faulty(fault="inf")}))
    state = last(planner)
    assert len(state.archive)
    assert np.isfinite(state.archive.values).all()


# The other direction


def minimized(algorithm="nsga2", constraints=(), seed=1, **parts):
    from pymoo.algorithms.moo.age import AGEMOEA
    from pymoo.algorithms.moo.nsga2 import NSGA2

    problem = adapters.PathsProblem(PROBLEM, [Length(), "unsafe-cells", "turns"], constraints)
    operators = {
        "sampling": adapters.PathSampling("perturbed-trees"),
        "crossover": adapters.PathCrossover("shared-node"),
        "mutation": adapters.PathMutation("reroute"),
        "eliminate_duplicates": adapters.NoDuplicatePaths(),
        **parts,
    }
    kind = {"nsga2": NSGA2, "age-moea": AGEMOEA}[algorithm]
    return minimize(problem, kind(pop_size=30, **operators), ("n_gen", 10), seed=seed), problem


@pytest.mark.parametrize("algorithm", ["nsga2", "age-moea"])
def test_our_operators_work_in_pymoos_own_loop(algorithm):
    found, _ = minimized(algorithm)
    for cells, values in zip(found.X, found.F, strict=True):
        path = PROBLEM.representation.decode(cells)
        assert pl.validate(path, PROBLEM) is None
        row = PROBLEM.representation.encode([path])
        assert [o.measure(row, PROBLEM)[0] for o in (Length(), UnsafeCells(), Turns())] == values.tolist()
    assert len({x.tobytes() for x in found.pop.get("X")}) == len(found.pop)
    reference = np.array([60.0, 60.0, 60.0])
    exact = exact_front(PROBLEM, Nsga2().objectives).values
    assert moocore.hypervolume(found.F, ref=reference) > 0.97 * moocore.hypervolume(exact, ref=reference)


def test_pymoos_loop_with_our_operators_repeats_itself():
    first, again, other = (minimized(seed=seed)[0] for seed in (1, 1, 2))
    assert first.F.tobytes() == again.F.tobytes()
    assert first.pop.get("X").tobytes() == again.pop.get("X").tobytes() != other.pop.get("X").tobytes()


def test_operators_of_papers_and_constraints_work_in_pymoo():
    found, _ = minimized(
        constraints=["length <= 1.1 x optimum"],
        crossover=adapters.PathCrossover({"use": "imga/common-node"}, prob=1.0),
        mutation=adapters.PathMutation("imga/d8-gene-median"),
        repair=adapters.PathRepair("loop-removal"),
        sampling=adapters.PathSampling(Nsga2().sampling),
    )
    limit = parse_constraint("length <= 1.1 x optimum")
    assert len(found.X)
    assert (limit.violation(np.ascontiguousarray(found.X, np.int32), PROBLEM) == 0).all()


def test_a_path_without_room_leaves_the_individual_as_it_is():
    problem = adapters.PathsProblem(PROBLEM, ["length", "turns"], width=17)
    shortest = adapters.PathSampling({"use": "scalarised", "vectors": 1, "rest": "perturbed-trees"})
    rng = np.random.default_rng(0)
    population = shortest._do(problem, 30, random_state=rng)
    assert 0 < len(population) < 30
    assert population.shape[1] == 17
    mutants = adapters.PathMutation("reroute")._do(problem, population, random_state=rng)
    assert mutants.shape == population.shape
    for row in mutants:
        assert pl.validate(PROBLEM.representation.decode(row), PROBLEM) is None


def test_hypervolume_of_a_short_run_is_near_the_exact_one():
    problem = pl.PathProblem(pl.load_map("random-20:100:s3"))
    exact = exact_front(problem, Nsga2().objectives).values
    reference = exact.max(axis=0) + 0.1 * np.ptp(exact, axis=0)
    found = compose("nsga2", termination=MaxGenerations(limit=60))
    values = last(found, problem).archive.values
    inside = values[(values < reference).all(axis=1)]
    assert moocore.hypervolume(inside, ref=reference) >= 0.999 * moocore.hypervolume(exact, ref=reference)


def test_the_widest_way_is_found_though_clearance_is_not_additive():
    from scipy.ndimage import label

    distance = WIDE.context.distance.reshape(WIDE.context.occupied.shape)
    widest = 0.0
    for least in np.unique(distance):  # the slow twin: is there a way over cells at least so far from obstacles?
        parts, _ = label(distance >= least, np.ones((3, 3)))
        (r0, c0), (r1, c1) = WIDE.ends
        widest = least if parts[r0, c0] and parts[r0, c0] == parts[r1, c1] else widest
    state = last(short("nsga2", 60, population=60, objectives=["length", "clearance", "turn-angle"]), WIDE)
    clearest = state.archive.population[[state.archive.values[:, 1].argmin()]]
    assert WIDE.context.distance[clearest[clearest >= 0]].min() == widest


def test_operators_that_need_what_others_do_not_leave_are_refused_when_composed():
    with pytest.raises(pl.ConfigError, match="needs 8-connected individuals, which 'point-deletion' does not leave"):
        compose("nsga2", mutation="baselines/single-gene", repair="point-deletion")


def test_parents_come_from_all_trade_offs_if_wanted():
    problem = pl.PathProblem(pl.load_map("blocks-20:20%:s2"))
    planner = compose("nsga2", population=4, from_archive=1.0)
    state = planner.start(problem, first_generator(0))
    for _ in range(40):
        state = planner.step(state)
    assert len(state.archive) > 4
    archive = {row[row >= 0].tobytes() for row in state.archive.population}
    parents, fitness = planner._couples(state, 200, np.random.default_rng(0))
    assert {row[row >= 0].tobytes() for row in parents} == archive
    assert fitness.shape == (400,)
    own, _ = compose(planner, from_archive=0.0)._couples(state, 200, np.random.default_rng(0))
    assert {row[row >= 0].tobytes() for row in own} <= {row[row >= 0].tobytes() for row in state.population}
