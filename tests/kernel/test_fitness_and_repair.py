"""Weighted reciprocals, repairs in turn, rules for weights, and what control and migration are told."""

import math
import pickle
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

import pathloom as pl
from kernel.one_max import Flip, OneMax, RandomBits, Uniform, Zeros
from pathloom.kernel.compose import build, compose, freeze, override
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.evolution import Evolution, Generational
from pathloom.kernel.repair import InTurn
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.loops import LoopRemoval

RNG = np.random.default_rng(0)


def evolution(**slots) -> Evolution:
    """Return a small planner for bit strings."""
    slots = {"objectives": pl.Terms({"zeros": Zeros()}), "crossover": Uniform(), "mutation": Flip(), **slots}
    return Evolution(population=8, sampling=RandomBits(), **slots)


# Weighted reciprocals ---------------------------------------------------------------------------


def twin(row: list[float], weights: list[float], floors: list[float]) -> float:
    """Add up w / max(t, floor); the last floor stands for all that follow, and a weight of 0 counts for nothing."""
    total = 0.0
    for k, (value, weight) in enumerate(zip(row, weights, strict=True)):
        under = max(value, floors[min(k, len(floors) - 1)])
        if weight > 0:
            total += math.inf if under == 0 else weight / under
    return total


numbers = st.sampled_from([0.0, 0.1, 1.0, 3.0, math.inf]) | st.floats(0.0, 1e6)


@given(
    data=st.data(),
    floors=st.lists(st.sampled_from([0.0, 0.5, 1.0]), min_size=1, max_size=4),
    n=st.integers(0, 4),
    m=st.integers(1, 5),
)
@examples(150)
def test_each_objective_counts_by_its_own_reciprocal(data, floors: list[float], n: int, m: int) -> None:
    values = data.draw(st.lists(st.lists(numbers | st.just(-2.0), min_size=m, max_size=m), min_size=n, max_size=n))
    weights = data.draw(st.lists(st.sampled_from([0.0, 0.25, 1.0, 3.0]), min_size=m, max_size=m))
    fitness = WeightedReciprocals(floors=tuple(floors)).combine(
        np.array(values, float).reshape(n, m), np.array(weights)
    )
    assert fitness.shape == (n,)
    assert fitness.tolist() == pytest.approx([twin(row, weights, floors) for row in values])


def test_under_its_floor_an_objective_counts_no_more_than_at_it() -> None:
    values = np.array([[0.0, 0.0], [0.5, 0.2], [1.0, 4.0], [math.inf, math.inf]])
    fitness = WeightedReciprocals(floors=(0.5, 2.0)).combine(values, np.array([1.0, 4.0]))
    assert fitness.tolist() == [4.0, 4.0, 2.0, 0.0]


def test_one_floor_stands_for_all_objectives_and_those_too_many_for_none() -> None:
    values = np.array([[0.0, 0.5, 4.0]])
    assert WeightedReciprocals().combine(values, np.ones(3)).tolist() == [2.25]
    assert WeightedReciprocals(floors=(1.0, 1.0, 1.0, 9.0)).combine(values, np.ones(3)).tolist() == [2.25]


def test_without_a_floor_a_zero_outweighs_everything_unless_it_has_no_weight() -> None:
    values = np.array([[0.0, 4.0], [-0.0, 4.0], [-1.0, 4.0], [1.0, 4.0]])
    for floor in (0.0, -0.0):
        bare = WeightedReciprocals(floors=(floor,))
        assert bare.combine(values, np.array([1.0, 1.0])).tolist() == [math.inf, math.inf, math.inf, 1.25]
        assert bare.combine(values, np.array([0.0, 1.0])).tolist() == [0.25] * 4


def test_no_floors_at_all_are_refused_at_composition(registry) -> None:
    with pytest.raises(pl.ConfigError, match="weighted-reciprocals: floors is a list of at least one number; got none"):
        WeightedReciprocals(floors=())
    with pytest.raises(pl.ConfigError, match=r"planner\.fitness: weighted-reciprocals: floors is a list of at least"):
        compose("imga", registry=registry, fitness={"use": "weighted-reciprocals", "floors": []})


def test_a_floor_is_no_number_below_zero() -> None:
    for floors in ((-1.0,), (1.0, math.nan)):
        with pytest.raises(pl.ConfigError, match="weighted-reciprocals: floors is a list"):
            WeightedReciprocals(floors=floors)


def test_floors_come_from_a_config_and_the_fitness_is_what_the_planner_maximises(registry) -> None:
    table = {"use": "weighted-reciprocals", "floors": [2.0, 1.0]}
    planner = compose(evolution(), registry=registry, fitness=table)
    assert planner.fitness == WeightedReciprocals(floors=(2.0, 1.0))
    assert freeze(planner, registry)["fitness"] == table
    deme = planner.evaluate(np.array([[1, 1, 1], [0, 0, 0], [1, 1, 0]], np.int8), OneMax(size=3))
    assert deme.fitness.tolist() == [0.5, 1 / 3, 0.5]


# Repairs in turn --------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Writes(pl.Repair):
    """Put a digit behind each number."""

    digit: pl.Whole = 0

    def apply(self, population, problem, rng):
        return 10 * population + self.digit


@dataclass(frozen=True, kw_only=True)
class Draws(pl.Repair):
    """Put a random digit behind each number."""

    def apply(self, population, problem, rng):
        return 10 * population + rng.integers(10, size=population.shape)


@dataclass(frozen=True, kw_only=True)
class Careless(Writes):
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected", "even"})


@dataclass(frozen=True, kw_only=True)
class Demanding(Writes):
    needs: ClassVar[frozenset[str]] = frozenset({"8-connected"})


def test_steps_are_taken_in_their_order() -> None:
    population = np.array([[1], [2]])
    in_turn = InTurn(steps=(Writes(digit=7), InTurn(steps=(Writes(digit=8),)), Writes(digit=9)))
    assert in_turn.apply(population, OneMax(), RNG).tolist() == [[1789], [2789]]
    assert population.tolist() == [[1], [2]]


def test_steps_draw_from_one_generator_one_after_the_other() -> None:
    one, two = (np.random.default_rng(4) for _ in range(2))
    found = InTurn(steps=(Draws(), Draws())).apply(np.ones((5, 3), int), OneMax(), one)
    assert found.tolist() == Draws().apply(Draws().apply(np.ones((5, 3), int), OneMax(), two), OneMax(), two).tolist()
    assert one.random() == two.random()


def test_no_steps_change_nothing() -> None:
    population = np.array([[1, 2]])
    assert InTurn().apply(population, OneMax(), RNG).tolist() == [[1, 2]]
    assert InTurn().breaks == InTurn().needs == frozenset()


def test_what_one_step_breaks_or_needs_all_of_them_do() -> None:
    in_turn = InTurn(steps=(Writes(), InTurn(steps=(Careless(), PointDeletion())), Demanding()))
    assert in_turn.breaks == {"8-connected", "even"}
    assert in_turn.needs == {"8-connected"}
    assert InTurn.breaks == InTurn(steps=(Writes(),)).breaks == frozenset()


def test_steps_in_turn_are_compared_pickled_and_rebuilt_with_what_they_break(registry) -> None:
    in_turn = InTurn(steps=(LoopRemoval(), PointDeletion(passes=0)))
    again = build(pl.Repair, freeze(in_turn, registry), registry, "repair")
    for copy in (again, pickle.loads(pickle.dumps(in_turn)), replace(in_turn)):
        assert copy == in_turn
        assert hash(copy) == hash(in_turn)
        assert copy.breaks == {"8-connected"}
    assert in_turn != InTurn(steps=in_turn.steps[::-1])
    assert replace(in_turn, steps=(LoopRemoval(),)).breaks == frozenset()


def test_a_planner_whose_mutation_needs_single_steps_takes_no_step_that_breaks_them(registry) -> None:
    keeps = compose("ga-imga", registry=registry, repair={"use": "in-turn", "steps": ["loop-removal"]})
    assert keeps.repair == InTurn(steps=(LoopRemoval(),))
    with pytest.raises(pl.ConfigError, match="'single-gene' needs 8-connected individuals, which 'in-turn' does not"):
        override(keeps, "repair.steps", ["loop-removal", "point-deletion"], registry)


def test_a_step_that_needs_single_steps_needs_them_from_the_whole_planner(registry) -> None:
    planner = compose("imga", registry=registry, repair=InTurn(steps=(Demanding(),)))
    with pytest.raises(pl.ConfigError, match="repair 'in-turn' needs 8-connected individuals, which 'in-turn' does"):
        compose(planner, registry=registry, repair=InTurn(steps=(Demanding(), PointDeletion())))


def test_a_step_for_another_representation_is_refused_by_name() -> None:
    planner = evolution(repair=InTurn(steps=(InTurn(steps=(LoopRemoval(),)),)))
    with pytest.raises(pl.ConfigError, match="repair 'loop-removal' works on 'cells'; the problem has 'bits'"):
        planner.start(OneMax(size=6), np.random.default_rng(0))


# Rules for weights ------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Shares(pl.Weighting):
    """The same weight for each of so many objectives."""

    objectives: pl.Count = 2

    def check(self, terms):
        if len(terms) != self.objectives:
            raise pl.ConfigError(f"{self.name}: wants {self.objectives} objectives; got {', '.join(terms.labels)}")

    def weights(self, terms, problem):
        return np.full(len(terms), 1.0 / len(terms))


@dataclass(frozen=True, kw_only=True)
class BySize(pl.Weighting):
    """A rule that asks the problem and has no check of its own."""

    def weights(self, terms, problem):
        return np.full(len(terms), float(problem.size))


def test_a_rule_refuses_objectives_when_the_planner_is_composed(registry) -> None:
    with pytest.raises(pl.ConfigError, match="^shares: wants 2 objectives; got zeros$"):
        evolution(weighting=Shares())
    with pytest.raises(pl.ConfigError, match="^planner: shares: wants 2 objectives; got zeros$"):
        compose(evolution(), registry=registry, weighting=Shares())
    fitting = evolution(weighting=Shares(objectives=1))
    with pytest.raises(pl.ConfigError, match="planner: shares: wants 1 objectives; got one, two"):
        compose(fitting, registry=registry, objectives=pl.Terms({"one": Zeros(), "two": Zeros()}))


def test_the_weights_of_a_rule_take_the_place_of_those_beside_the_objectives() -> None:
    terms = pl.Terms({"one": (Zeros(), 5.0), "two": (Zeros(), 7.0)})
    rows, problem = np.array([[0, 0, 0, 1]], np.int8), OneMax(size=4)
    for weighting, weights in ((None, [5.0, 7.0]), (Shares(), [0.5, 0.5]), (BySize(), [4.0, 4.0])):
        planner = evolution(objectives=terms, weighting=weighting)
        assert planner.weights(problem).tolist() == weights
        assert planner.evaluate(rows, problem).fitness.tolist() == [1 / (3 * sum(weights))]


# What control and migration are told ------------------------------------------------------------


class Telling(Generational):
    """The usual control, which says what it is told and what it returns."""

    def advance(self, planner, state, which, rng):
        deme = super().advance(planner, state, which, rng)
        TOLD.append(("control", state, which, deme))
        return deme


class Swapping(pl.Migration):
    """Three populations that change places."""

    demes = 3

    def exchange(self, demes, state, rng):
        TOLD.append(("migration", state, demes))
        return demes[::-1]


TOLD: list[tuple] = []


@pytest.fixture
def told() -> list[tuple]:
    TOLD.clear()
    return TOLD


def test_control_is_told_the_state_and_which_of_its_populations(told) -> None:
    planner = evolution(control=Telling(), migration=Swapping())
    state = planner.start(OneMax(size=6), np.random.default_rng(0))
    planner.step(state)
    of_control = [entry for entry in told if entry[0] == "control"]
    assert [which for _, _, which, _ in of_control] == [0, 1, 2]
    assert all(given is state for _, given, _, _ in of_control)


def test_migration_is_told_the_new_populations_and_the_state_before(told) -> None:
    planner = evolution(control=Telling(), migration=Swapping())
    state = planner.start(OneMax(size=6), np.random.default_rng(0))
    assert told == []  # nothing is exchanged before the first generation
    after = planner.step(planner.step(state))
    (_, first, _), (_, second, demes) = (entry for entry in told if entry[0] == "migration")
    assert (first.generation, second.generation, after.generation) == (0, 1, 2)
    assert first is state
    assert len(second.history.best) == 2
    made = [entry[3] for entry in told if entry[0] == "control"][-3:]
    assert all(given is new for given, new in zip(demes, made, strict=True))
    assert all(got is given for got, given in zip(after.demes, demes[::-1], strict=True))


def test_control_sees_what_migration_left(told) -> None:
    planner = evolution(control=Telling(), migration=Swapping())
    state = planner.step(planner.start(OneMax(size=6), np.random.default_rng(0)))
    before = [entry[3] for entry in told if entry[0] == "control"]
    assert all(deme is old for deme, old in zip(state.demes, before[::-1], strict=True))


def test_a_control_that_varies_twice_advances_one_generation_at_a_time() -> None:
    class Twice(pl.Control):
        def advance(self, planner, state, which, rng):
            deme, problem = state.demes[which], state.problem
            for _ in range(2):
                children = planner.vary(deme.population, deme.fitness, problem, planner.progress(state), rng)
                deme = planner.evaluate(children, problem)
            return deme

    state = evolution().start(OneMax(size=6), np.random.default_rng(0))
    after = evolution(control=Twice()).step(state)
    assert after.generation == 1
    assert after.evaluations == 8 * 3
