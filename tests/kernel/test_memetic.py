"""Evolution that learns, newcomers, one of several mutations, and what the driver stamps."""

import dataclasses
from dataclasses import dataclass
from itertools import count as counting_up
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

import pathloom as pl
from kernel.sphere import InABox, Jitter, Space, SquaredDistance
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.immigrants import RandomImmigrants
from pathloom.kernel.memetic import Memetic
from pathloom.kernel.mutation import OneOf
from pathloom.kernel.run import iterate, run
from pathloom.kernel.sampling import Mixed
from pathloom.kernel.selection import Tournament
from pathloom.kernel.state import Deme, generator
from pathloom.kernel.survival import BestOfBoth
from pathloom.kernel.termination import MaxGenerations

PROBLEM = Space(dimensions=3)


@dataclass(frozen=True, kw_only=True)
class Lesson(pl.Repair):
    """Halve a point where it is left of the middle, which helps, and double it where it is not, which harms."""

    def apply(self, population, problem, rng):
        return population * np.where(population[:, :1] < 0.0, 0.5, 2.0)


@dataclass(frozen=True, kw_only=True)
class Polish(pl.Repair):
    """Take away the first coordinate."""

    def apply(self, population, problem, rng):
        polished = population.copy()
        polished[:, 0] = 0.0
        return polished


def learner(control, generations=6, population=12, **slots):
    slots = {"mutation": Jitter(rate=0.7, sigma=0.5), "survival": BestOfBoth(distinct=True)} | slots
    return pl.Evolution(
        sampling=InABox(), objectives=Terms({"distance": SquaredDistance()}), population=population,
        selection=Tournament(), control=control, termination=(MaxGenerations(limit=generations),), **slots,
    )  # fmt: skip


def fitness_of(row):
    total = sum(float(x) ** 2 for x in row)
    return 1.0 / total if total else np.inf


def next_generation(planner, state, learning, polish, elite):
    """What `Memetic` does, one individual after the other."""
    rng, deme = generator(state.random), state.demes[0]
    children = list(deme.population)
    if state.generation > 0:
        parents = planner.selection.select(deme.fitness, len(deme), rng)
        children = list(planner.vary(deme.population[parents], deme.fitness[parents], PROBLEM, 0.0, rng))
    if learning:
        for k, child in enumerate(children):
            learned = child * (0.5 if child[0] < 0.0 else 2.0)
            if fitness_of(learned) >= fitness_of(child):
                children[k] = learned
    if polish:
        best: list[int] = []
        for k in sorted(range(len(children)), key=lambda k: -fitness_of(children[k])):
            if not any((children[k] == children[other]).all() for other in best):
                best.append(k)
        for k in best[:elite]:
            polished = children[k].copy()
            polished[0] = 0.0
            if fitness_of(polished) >= fitness_of(children[k]):
                children[k] = polished
    ranked = sorted([*deme.population, *children], key=lambda row: -fitness_of(row))
    first = [row for k, row in enumerate(ranked) if not any((row == other).all() for other in ranked[:k])]
    again = [row for k, row in enumerate(ranked) if any((row == other).all() for other in ranked[:k])]
    return np.array([*first, *again][: len(deme)])


@pytest.mark.parametrize("elite", [1, 3, 50])
@pytest.mark.parametrize(("learning", "polish"), [(True, True), (True, False), (False, True), (False, False)])
def test_a_memetic_generation_is_its_twin(learning, polish, elite):
    control = Memetic(learning=Lesson() if learning else None, polish=Polish() if polish else None, elite=elite)
    planner = learner(control)
    states = list(iterate(PROBLEM, planner, 3))
    for before, after in pairwise(states):
        twin = next_generation(planner, before, learning, polish, elite)
        assert np.allclose(after.population, twin, rtol=0.0, atol=1e-12)


def test_learning_never_harms_and_all_of_it_is_counted():
    states = list(iterate(PROBLEM, learner(Memetic(learning=Lesson(), polish=Polish(), elite=2)), 1))
    history = states[-1].history
    assert list(history.best) == sorted(history.best)
    # The first population; then it learns; from then on children are measured, and what they learned.
    assert np.diff(history.evaluations).tolist() == [12 + 2] + [12 + 12 + 2] * 5
    assert history.evaluations[0] == 12


@dataclass(frozen=True, kw_only=True)
class Mark(pl.Mutation):
    """Write a number, and what one needs and loses."""

    mark: float = 1.0
    breaks = frozenset({"order"})

    def apply(self, population, chosen, problem, rng):
        changed = population.copy()
        changed[chosen] += self.mark
        return changed


@dataclass(frozen=True, kw_only=True)
class Careful(Mark):
    """The same, with other demands."""

    breaks = frozenset({"sum"})
    needs = frozenset({"sorted"})


def drawn(mutation, n=3000, seed=0):
    changed = mutation.apply(np.zeros((n, 1)), np.arange(0, n, 2), PROBLEM, np.random.default_rng(seed))[:, 0]
    assert not changed[1::2].any()
    return [int((changed[::2] == mark).sum()) for mark in (1.0, 10.0, 100.0)]


MARKS = tuple(Mark(mark=mark, rate=0.1) for mark in (1.0, 10.0, 100.0))


@pytest.mark.parametrize("shares", [(), (1.0, 1.0, 2.0), (0.0, 3.0, 0.0)])
def test_each_of_the_chosen_is_changed_by_one_part_as_often_as_its_share_says(shares):
    found = drawn(OneOf(parts=MARKS, shares=shares))
    assert sum(found) == 1500  # each of the chosen once, whatever the parts' own rates
    wanted = np.array(shares or (1.0, 1.0, 1.0))
    wanted = 1500 * wanted / wanted.sum()
    assert np.abs(np.array(found) - wanted).max() <= 5 * np.sqrt(375)
    assert all(here == 0 for here, there in zip(found, wanted, strict=True) if there == 0)


def test_one_of_nobody_changes_nobody():
    population = np.zeros((4, 1))
    assert (OneOf(parts=MARKS).apply(population, np.array([], int), PROBLEM, np.random.default_rng(0)) == 0).all()


def test_one_of_loses_and_needs_what_its_parts_do():
    both = OneOf(parts=(Mark(), Careful()))
    assert both.breaks == {"order", "sum"}
    assert both.needs == {"sorted"}


@pytest.mark.parametrize(
    ("parts", "shares", "says"),
    [
        ((), (), "at least one mutation"),
        (MARKS, (1.0,), "wanted 3 shares, one a part; got 1"),
        (MARKS, (0.0, 0.0, 0.0), "shares add up"),
        (MARKS, (1.0, np.inf, 0.0), "share"),
        (MARKS, (1.0, -1.0, 1.0), "share"),
    ],
)
def test_shares_and_parts_without_sense_are_refused(parts, shares, says):
    with pytest.raises(pl.ConfigError, match=says):
        OneOf(parts=parts, shares=shares)


def test_a_part_for_another_representation_is_refused_by_name():
    @dataclass(frozen=True, kw_only=True)
    class OfBits(Mark):
        works_on = "bits"

    planner = learner(Memetic(), mutation=OneOf(parts=(Jitter(), OfBits())))
    with pytest.raises(pl.ConfigError, match="works on 'bits'"):
        planner.start(PROBLEM, np.random.default_rng(0))


@dataclass(frozen=True, kw_only=True)
class Far(pl.Sampling):
    """Points that come from far away, at most so many."""

    most: int = 100

    def sample(self, problem, n, rng):
        return np.full((min(n, self.most), problem.dimensions), 99.0)


@pytest.mark.parametrize(("most", "arrived"), [(100, [1, 4, 5]), (2, [1, 4]), (0, [])])
def test_immigrants_take_the_places_of_the_chosen_as_far_as_there_are_any(most, arrived):
    population = np.zeros((7, 3))
    immigrants = RandomImmigrants(sampling=Far(most=most))
    changed = immigrants.apply(population, np.array([1, 4, 5]), PROBLEM, np.random.default_rng(0))
    assert (changed == 99.0).all(axis=1).nonzero()[0].tolist() == arrived
    assert (population == 0.0).all()
    assert (np.delete(changed, arrived, 0) == 0.0).all()


def test_without_anybody_chosen_nobody_is_drawn():
    @dataclass(frozen=True, kw_only=True)
    class Never(pl.Sampling):
        def sample(self, problem, n, rng):
            pytest.fail("somebody was drawn")

    population = np.zeros((2, 3))
    left = RandomImmigrants(sampling=Never()).apply(population, np.array([], int), PROBLEM, np.random.default_rng(0))
    assert left is population


rows = st.lists(st.integers(-2, 2), min_size=1, max_size=8)


@given(rows, rows)
@examples(100)
def test_the_best_of_both_that_differ_come_first(parents, children):
    def deme(numbers):
        population = np.array(numbers, float)[:, np.newaxis]
        return Deme(population, population**2, -(population[:, 0] ** 2))

    kept = BestOfBoth(distinct=True).survive(deme(parents), deme(children), PROBLEM, np.random.default_rng(0))
    ranked = sorted([*parents, *children], key=lambda x: x**2)
    first = list(dict.fromkeys(ranked))
    again = list(ranked)
    for one in first:
        again.remove(one)
    assert sorted(map(abs, kept.population[:, 0])) == sorted(map(abs, [*first, *again][: len(parents)]))
    assert len(set(kept.population[:, 0])) == min(len(first), len(parents))
    assert (kept.fitness == -(kept.population[:, 0] ** 2)).all()


@dataclass(frozen=True, kw_only=True)
class Asking(pl.Sampling):
    """Remembers for whom it samples."""

    whom: tuple[str, ...] = ()
    weights: tuple[float, ...] = ()

    def serving(self, objectives):
        return Asking(whom=tuple(objectives.labels), weights=tuple(term.weight for term in objectives))

    def sample(self, problem, n, rng):
        assert (self.whom, self.weights) == (("distance",), (3.0,))
        return np.zeros((n, problem.dimensions))


def test_samplings_serve_the_planners_objectives_with_their_weights_however_deep_they_stand():
    asking = Mixed(parts=(Asking(), Mixed(parts=(Asking(), Asking()))))
    planner = pl.compose(learner(Memetic()), objectives={"distance": SquaredDistance()})
    planner = pl.compose(planner, sampling=asking, objectives=Terms({"distance": (SquaredDistance(), 3.0)}))
    assert len(planner.start(PROBLEM, np.random.default_rng(0)).population) == 12


def test_so_do_samplings_within_a_mutation_and_the_config_stays_as_it_was():
    newcomers = OneOf(parts=(RandomImmigrants(sampling=Mixed(parts=(Asking(),))),))
    planner = pl.compose(learner(Memetic()), objectives=Terms({"distance": (SquaredDistance(), 3.0)}))
    planner = dataclasses.replace(planner, mutation=dataclasses.replace(newcomers, rate=1.0))
    before = pl.freeze(planner)
    state = planner.step(planner.step(planner.start(PROBLEM, np.random.default_rng(0))))
    assert state.generation == 2  # the one that asks would have refused
    assert pl.freeze(planner) == before


class Steps:
    """A clock that goes on by one whenever somebody looks."""

    def __init__(self):
        self.ticks = counting_up()

    def __call__(self):
        return float(next(self.ticks))


@pytest.mark.parametrize("seed", range(4))
def test_a_run_says_when_its_first_answer_was_there_and_when_the_one_that_stayed(seed):
    finished = run(PROBLEM, learner(Memetic(), generations=9), seed, clock=Steps())
    assert finished.first == 1.0  # the first look after the beginning is that at the first population
    assert finished.best == 1.0 + finished.state.best.generation
    assert finished.phases["sampling"] == 1.0
    assert finished.phases["evolution"] == 10.0


def test_a_run_without_an_answer_has_no_such_times():
    planner = learner(Memetic(), generations=2)
    finished = run(PROBLEM, pl.compose(planner, sampling=Far(most=0)), 0)
    assert finished.first is finished.best is None
    assert finished.outcome.solution is None
