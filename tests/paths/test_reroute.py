"""Re-routing: valid, close to what it replaces, and the best way under its prices."""

import heapq
import itertools
import math

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

import pathloom as pl
from pathloom.exact.octile import octile_path
from pathloom.kernel.counting import counting
from pathloom.paths.objectives import Length, Turns, UnsafeCells
from pathloom.paths.reroute import Reroute
from pathloom.paths.tree_seeding import PerturbedTrees

PLAIN = Reroute(spread=0.0, near=0.0, turn=0.0, longest=1000, margin=1000)


def mutants(mutation, problem, seed=0, n=40, rounds=1):
    rng = np.random.default_rng(seed)
    parents = population = PerturbedTrees().sample(problem, n, rng)
    for _ in range(rounds):
        population = mutation.apply(population, np.arange(n), problem, rng)
    return parents, population


@given(
    st.integers(0, 10_000), st.integers(2, 40), st.integers(0, 5), st.sampled_from(["strict", "no-squeeze", "allow"])
)
@examples(40)
def test_only_one_stretch_changes_and_it_stays_close(seed, longest, margin, corners):
    problem = pl.PathProblem(pl.load_map(f"random-12:35:s{seed % 7}", corners=corners), corners=corners)
    decode = problem.representation.decode
    for parent, mutant in zip(*mutants(Reroute(longest=longest, margin=margin), problem, seed, 8), strict=True):
        before, after = decode(parent), decode(mutant)
        assert pl.validate(after, problem) is None
        assert len({tuple(c) for c in after.tolist()}) == len(after)
        first = next((k for k in range(min(len(before), len(after))) if (before[k] != after[k]).any()), None)
        if first is None:
            continue
        last = next(k for k in range(1, len(before)) if k >= len(after) or (before[-k] != after[-k]).any())
        new = after[first : len(after) - last + 1]
        start = max(first - 1 - longest, 0)
        old = before[start : len(before) - last + 2 + longest]
        low, high = old.min(axis=0) - margin, old.max(axis=0) + margin
        assert (new >= low).all()
        assert (new <= high).all()


@pytest.mark.parametrize("name", ["random-15:50:s1", "maze-11:1", "rooms-13:3", "empty-5"])
def test_with_length_as_the_only_price_nothing_gets_longer_and_all_become_shortest(name):
    problem = pl.PathProblem(pl.load_map(name))
    parents, once = mutants(PLAIN, problem)
    assert (Length().measure(once, problem) <= Length().measure(parents, problem) + 1e-9).all()
    _, often = mutants(PLAIN, problem, rounds=200)
    assert Length().measure(often, problem) == pytest.approx(octile_path(problem)[0])


@pytest.mark.parametrize(
    ("price", "objective"), [({"turn": 1e9}, Turns()), ({"near": 1e9}, UnsafeCells()), ({"near": 1e9}, Length())]
)
def test_what_is_dear_is_avoided(price, objective):
    problem = pl.PathProblem(pl.load_map("blocks-20:20%:s2"))
    dear = Reroute(spread=0.0, **{"turn": 0.0, "near": 0.0, "longest": 1000, "margin": 1000, **price})
    parents, found = (objective.measure(p, problem) for p in mutants(dear, problem, rounds=30))
    assert found.min() <= parents.min()
    assert found.mean() < 0.8 * parents.mean() or isinstance(objective, Length)


def test_a_stretch_of_two_steps_is_the_best_of_all_ways_in_its_box():
    problem = pl.PathProblem(pl.load_map("random-12:35:s3", corners="allow"), corners="allow")
    parents, found = mutants(Reroute(spread=0.0, near=0.0, turn=0.0, longest=2, margin=0), problem, n=60)
    for parent, mutant in zip(parents, found, strict=True):
        before, after = (problem.representation.decode(row) for row in (parent, mutant))
        if len(after) < len(before):  # one node was cut out: a corner over a legal diagonal
            assert len(after) == len(before) - 1
            assert Length().measure(mutant[np.newaxis], problem) < Length().measure(parent[np.newaxis], problem)


def test_the_same_generator_gives_the_same_mutants_and_draws_differ():
    problem = pl.PathProblem(pl.load_map("random-15:50:s1"))
    first, again, other = (mutants(Reroute(), problem, seed)[1] for seed in (1, 1, 2))
    assert first.tobytes() == again.tobytes()
    assert first.shape != other.shape or first.tobytes() != other.tobytes()
    _, found = mutants(Reroute(), problem)
    assert len({row.tobytes() for row in found}) > 25


def test_a_path_without_interior_is_counted_and_kept():
    problem = pl.PathProblem(pl.load_map("empty-5"), start=(0, 0), goal=(0, 0))
    population = problem.representation.encode([np.array([(0, 0)])] * 3)
    with counting() as counts:
        mutated = Reroute().apply(population, np.array([0, 2]), problem, np.random.default_rng(0))
    assert mutated.tolist() == population.tolist()
    assert counts == {"mutation failed": 2}


def test_long_segments_are_replaced_by_single_steps_or_kept():
    problem = pl.PathProblem(pl.load_map("empty-5"))
    path = np.array([(4, 0), (2, 0), (0, 4)])
    population = problem.representation.encode([path] * 20)
    mutated = PLAIN.apply(population, np.arange(20), problem, np.random.default_rng(0))
    for row in mutated:
        assert pl.validate(problem.representation.decode(row), problem) is None


class Draws:
    """The random numbers of a kernel."""

    def __init__(self, words):
        self.words = naive.xoshiro(words)

    def uniform(self):
        return (next(self.words) >> 11) / 2**53

    def below(self, bound):
        return (next(self.words) >> 32) * bound >> 32

    def ratio(self, scale):
        u = self.uniform()
        return scale * u / (1.0 - u) if self.uniform() >= 0.25 else 0.0


def rerouted(path, problem, mutation, draws):
    """What `Reroute` makes of a path of single steps, by Dijkstra's search over cells and headings."""
    it = problem.context
    blocked = it.occupied
    distance = it.distance.reshape(blocked.shape)
    if len(path) < 3:
        return path
    most = min(mutation.longest, len(path) - 1)
    span = min(most, int(2.0 * math.exp(draws.uniform() * math.log(0.5 * (most + 1)))))
    first = draws.below(len(path) - span)
    stretch = path[first : first + span + 1]
    start, goal = stretch[0], stretch[-1]

    def direction(a, b):
        return next(d for d, cell in naive.legal_steps(blocked, a, problem.corners) if cell == b)

    entry = direction(path[first - 1], start) if first > 0 else None
    leave = direction(goal, path[first + span + 1]) if first + span + 1 < len(path) else None
    about = int(math.exp(draws.uniform() * math.log(mutation.margin + 1.0))) - 1
    box = [
        (max(min(c[i] for c in stretch) - about, 0), min(max(c[i] for c in stretch) + about, blocked.shape[i] - 1))
        for i in (0, 1)
    ]
    inside = list(itertools.product(*(range(low, high + 1) for low, high in box)))
    amount = draws.uniform()
    amount *= mutation.spread * amount
    half = {cell: 0.5 + 0.5 * amount * draws.uniform() for cell in inside}
    weight = draws.ratio(mutation.near)
    near = 1.5 if draws.uniform() < 0.5 else min(distance[c] for c in stretch)
    each, angle = draws.ratio(mutation.turn), 0.0
    if draws.uniform() < 0.5:
        each, angle = 0.0, 0.5 * each

    def turn(a, b):
        if a is None or b is None or a == b:
            return 0.0
        return each + angle * min(abs(a - b), 8 - abs(a - b))

    heap, done, count = [(0.0, 0, start, entry, [start])], set(), itertools.count(1)
    while heap:
        cost, _, here, heading, way = heapq.heappop(heap)
        if here is None:
            return naive.without_loops([*path[:first], *way, *path[first + span + 1 :]])
        if (here, heading) in done:
            continue
        done.add((here, heading))
        if here == goal:
            heapq.heappush(heap, (cost + turn(heading, leave), next(count), None, None, way))
            continue
        for d, there in naive.legal_steps(blocked, here, problem.corners):
            if there in half:
                step = math.hypot(there[0] - here[0], there[1] - here[1]) * (half[here] + half[there])
                price = step + turn(heading, d) + (weight if distance[there] <= near else 0.0)
                heapq.heappush(heap, (cost + price, next(count), there, d, [*way, there]))
    return path


@pytest.mark.parametrize("corners", ["strict", "no-squeeze", "allow"])
@pytest.mark.parametrize("name", ["random-12:35:s3", "rooms-13:3", "maze-11:1", "random-15:60:s2"])
def test_the_way_is_that_of_a_plain_search_under_the_same_prices(name, corners):
    problem = pl.PathProblem(pl.load_map(name, corners=corners), corners=corners)
    rng = np.random.default_rng(5)
    population = PerturbedTrees().sample(problem, 60, rng)
    mutation = Reroute(longest=30, margin=5)
    words = np.random.default_rng(7)
    mutated = mutation.apply(population, np.arange(60), problem, words)
    draws = Draws(np.random.default_rng(7).bit_generator.random_raw(4).tolist())
    cols = problem.context.cols
    changed = 0
    for before, after in zip(naive.unpacked(population, cols), naive.unpacked(mutated, cols), strict=True):
        assert list(after) == list(rerouted(list(before), problem, mutation, draws))
        changed += after != before
    assert changed > 5 or name == "maze-11:1"  # where there is one way
