"""The kernel knows nothing of paths: one loop solves bits, reals and paths alike."""

import pickle
import tomllib

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.compose import build, compose, freeze
from pathloom.kernel.problem import Problem
from pathloom.kernel.run import iterate, run
from pathloom.kernel.selection import Roulette
from pathloom.kernel.state import Deme
from pathloom.kernel.survival import BestOfBoth, KeepBest
from pathloom.kernel.termination import MaxGenerations, Stagnation, WallTime

ONE_MAX = """
[problem]
use = "onemax/one-max"
size = 40
[planner]
use = "evolution"
population = 60
sampling = "random-bits"
objectives = { zeros = 1.0 }
crossover = { use = "uniform", rate = 0.9 }
mutation = { use = "onemax/flip", rate = 0.6 }
selection = { use = "tournament", size = 3 }
survival = { use = "keep-best", elites = 2 }
[[planner.termination]]
use = "max-generations"
limit = 80
"""
SPHERE = """
[problem]
use = "sphere/space"
dimensions = 4
[planner]
use = "evolution"
sampling = { use = "in-a-box", side = 8.0 }
objectives = { distance = { use = "squared-distance" } }
crossover = "blend"
mutation = { use = "sphere/jitter", sigma = 0.1, rate = 0.5 }
survival = "best-of-both"
termination = { use = "max-evaluations", limit = 8000 }
"""


def load(text, registry):
    document = tomllib.loads(text)
    problem = build(Problem, document["problem"], registry, "problem")
    return problem, compose(document["planner"], registry=registry)


def test_one_max_is_solved_by_the_loop_the_registry_and_the_config(registry):
    problem, planner = load(ONE_MAX, registry)
    finished = run(problem, planner, seed=1)
    assert problem.representation.decode(finished.outcome.solution) == "1" * 40
    assert finished.state.best.fitness == np.inf


def test_the_sphere_is_solved_by_the_same_loop(registry):
    problem, planner = load(SPHERE, registry)
    finished = run(problem, planner, seed=1)
    assert np.abs(finished.outcome.solution).max() < 0.05
    assert finished.state.evaluations == 8000


def test_a_seed_fixes_everything_and_another_seed_changes_it(registry):
    problem, planner = load(SPHERE, registry)
    first, second, other = (run(problem, planner, seed=s).outcome.solution for s in (3, 3, 4))
    assert first.tobytes() == second.tobytes() != other.tobytes()


def test_the_global_generators_are_not_touched(registry):
    problem, planner = load(ONE_MAX, registry)
    before = np.random.get_state()[1].tobytes()  # noqa: NPY002 - that it stays as it is, is the point
    run(problem, planner, seed=5)
    assert np.random.get_state()[1].tobytes() == before  # noqa: NPY002


def test_a_state_can_be_pickled_and_taken_up_again_bit_for_bit(registry):
    problem, planner = load(SPHERE, registry)
    states = list(iterate(problem, planner, seed=2))
    taken_up = pickle.loads(pickle.dumps(states[7]))
    for expected in states[8:20]:
        taken_up = planner.step(taken_up)
        assert taken_up.population.tobytes() == expected.population.tobytes()
        assert taken_up.history == expected.history


def test_stepping_twice_from_one_state_gives_the_same_state(registry):
    problem, planner = load(ONE_MAX, registry)
    state = planner.start(problem, np.random.default_rng(0))
    first, second = planner.step(state), planner.step(state)
    assert first.population.tobytes() == second.population.tobytes()


def test_evaluations_are_counted_by_the_framework(registry):
    problem, planner = load(ONE_MAX, registry)
    state = list(iterate(problem, planner, seed=0))[-1]
    assert state.generation == 80
    assert state.evaluations == 60 * 81
    assert state.history.evaluations == tuple(60 * k for k in range(1, 82))


def test_the_history_holds_the_best_so_far_and_the_best_of_each_generation(registry):
    problem, planner = load(SPHERE, registry)
    history = list(iterate(problem, planner, seed=0))[-1].history
    assert list(history.best) == list(np.maximum.accumulate(history.generation_best))
    assert all(0 < d <= 1 for d in history.diversity)


def test_an_operator_of_another_representation_is_refused_by_name(registry):
    problem, _ = load(SPHERE, registry)
    _, planner = load(ONE_MAX, registry)
    with pytest.raises(pl.ConfigError, match="'random-bits' works on 'bits'; the problem has 'reals'"):
        planner.start(problem, np.random.default_rng(0))


def test_crossover_and_mutation_can_be_left_out(registry):
    problem, planner = load(ONE_MAX, registry)
    bare = compose(planner, registry=registry, crossover="none", mutation=None)
    assert freeze(bare, registry)["crossover"] == "none"
    states = list(iterate(problem, bare, seed=0))
    first = {row.tobytes() for row in states[0].population}
    assert {row.tobytes() for row in states[-1].population} <= first


def test_an_objective_of_the_wrong_shape_is_named(registry):
    problem, planner = load(ONE_MAX, registry)
    bad = pl.Term("bad", _objective(lambda population: np.zeros((3, 3))))
    with pytest.raises(pl.PluginError, match=r"objective 'bad': wanted shape \(60,\), one value a row; got \(3, 3\)"):
        compose(planner, registry=registry, objectives=pl.Terms([bad])).start(problem, np.random.default_rng(0))


def test_where_one_individual_alone_was_measured_it_is_named_too(registry):
    problem, planner = load(ONE_MAX, registry)
    bad = pl.Term("bad", _objective(lambda population: np.zeros((len(population), 2))))
    alone = compose(planner, registry=registry, objectives=pl.Terms([bad]), population=1)
    with pytest.raises(pl.PluginError, match=r"wanted shape \(1,\), one value a row; got \(1, 2\) for '[01]{40}'"):
        alone.start(problem, np.random.default_rng(0))


def test_an_objective_that_returns_nan_is_named_with_the_individual(registry):
    problem, planner = load(ONE_MAX, registry)
    bad = pl.Term("bad", _objective(lambda population: np.full(len(population), np.nan)))
    with pytest.raises(pl.PluginError, match="objective 'bad': returned NaN for '[01]{40}'"):
        compose(planner, registry=registry, objectives=pl.Terms([bad])).start(problem, np.random.default_rng(0))


def _objective(function):
    class Bad(pl.Objective):
        def measure(self, population, problem):
            return function(population)

    return Bad()


def test_stagnation_stops_when_the_best_has_not_changed(registry):
    problem, planner = load(ONE_MAX, registry)
    lazy = compose(
        planner,
        registry=registry,
        termination=[Stagnation(patience=5), MaxGenerations(limit=99)],
        mutation=None,
        crossover=None,
    )
    assert list(iterate(problem, lazy, seed=0))[-1].generation == 5


def test_a_time_limit_answers_with_the_best_so_far(registry):
    problem, planner = load(ONE_MAX, registry)
    endless = compose(planner, registry=registry, termination=[WallTime(seconds=1e9)])
    finished = run(problem, endless, seed=0, time_limit=0.05)
    assert finished.outcome.solution is not None
    assert finished.state.generation >= 1


def test_an_interrupt_answers_with_the_best_so_far(registry):
    problem, planner = load(ONE_MAX, registry)

    def watch(state):
        if state.generation == 4:
            raise KeyboardInterrupt

    finished = run(problem, planner, seed=0, watch=watch)
    assert finished.interrupted
    assert finished.state.generation == 4
    assert finished.outcome.solution is not None


@pytest.mark.parametrize("seed", [-1, 1.5, "7", None, True])
def test_a_seed_is_a_whole_number_from_zero_on(registry, seed):
    problem, planner = load(ONE_MAX, registry)
    with pytest.raises(pl.ConfigError, match="seed is an integer in"):
        run(problem, planner, seed=seed)


def test_observers_see_every_state_and_change_nothing(registry):
    problem, planner = load(ONE_MAX, registry)
    seen = []

    class Witness(pl.Observer):
        def observe(self, state):
            seen.append(state.generation)

    watched = compose(planner, registry=registry, observers=(Witness(),))
    assert run(problem, watched, 1).outcome.solution.tobytes() == run(problem, planner, 1).outcome.solution.tobytes()
    assert seen == list(range(81))


def test_several_populations_exchange_through_migration(registry):
    problem, planner = load(ONE_MAX, registry)

    class Swap(pl.Migration):
        demes = 2

        def exchange(self, demes, state, rng):
            return demes[::-1]

    both = compose(planner, registry=registry, migration=Swap(), crossover=None, mutation=None, survival="replacement")
    state = both.start(problem, np.random.default_rng(0))
    assert len(state.demes) == 2
    assert state.evaluations == 120
    after = both.step(state)
    genes = {row.tobytes() for row in state.demes[1].population}
    assert {row.tobytes() for row in after.demes[0].population} <= genes


def test_roulette_prefers_the_fit_in_proportion():
    chosen = Roulette().select(np.array([1.0, 3.0]), 40_000, np.random.default_rng(0))
    assert abs(np.mean(chosen == 1) - 0.75) < 0.01


@pytest.mark.parametrize(
    ("fitness", "allowed"),
    [([0.0, 0.0], {0, 1}), ([1.0, np.inf], {1}), ([-2.0, -1.0], {1}), ([5.0], {0}), ([np.inf, np.inf], {0, 1})],
)
def test_roulette_bears_zero_infinite_and_negative_fitness(fitness, allowed):
    assert set(Roulette().select(np.array(fitness), 200, np.random.default_rng(0)).tolist()) == allowed


def ranked(*fitness):
    fitness = np.array(fitness, float)
    return Deme(np.arange(len(fitness))[:, None] + fitness[:, None], fitness[:, None], fitness)


def test_the_best_parents_take_the_places_of_the_worst_children(registry):
    problem, _ = load(SPHERE, registry)
    after = KeepBest(elites=2).survive(ranked(9, 1, 8, 2), ranked(3, 4, 5, 6), problem, np.random.default_rng(0))
    assert after.fitness.tolist() == [9, 8, 5, 6]
    assert after.values[:, 0].tolist() == [9, 8, 5, 6]
    assert after.population[:, 0].tolist() == [9, 10, 7, 9]
    one = KeepBest().survive(ranked(1, 9), ranked(3, 2), problem, np.random.default_rng(0))
    assert one.fitness.tolist() == [3, 9]


def test_of_parents_and_children_the_fittest_are_left(registry):
    problem, _ = load(SPHERE, registry)
    after = BestOfBoth().survive(ranked(9, 1, 8, 2), ranked(3, 4, 5, 6), problem, np.random.default_rng(0))
    assert after.fitness.tolist() == [9, 8, 6, 5]


def test_the_best_is_the_first_of_equals(registry):
    problem, planner = load(ONE_MAX, registry)
    still = compose(planner, registry=registry, mutation=None, crossover=None)
    assert [state.best.generation for state in iterate(problem, still, seed=0)] == [0] * 81
