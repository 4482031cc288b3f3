"""Swarms: each equation by hand with prepared draws, and what all of them promise."""

import math
import pickle
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples
from scipy.stats import ks_2samp, wilcoxon

import pathloom as pl
from pathloom.kernel.compose import compose
from pathloom.kernel.run import first_generator, run
from pathloom.kernel.termination import MaxEvaluations, MaxGenerations
from pathloom.paths.vectors.decoding import Waypoints, violations
from pathloom.paths.vectors.planner import Judge, VectorPlanner, Vectors
from pathloom.testing.problems import views
from pathloom.testing.symmetry import LEAST_P, alike, features
from pathloom_baselines.afsa import Afsa
from pathloom_baselines.afsa_grid import AfsaGrid
from pathloom_baselines.bezier import BezierGa
from pathloom_baselines.gwo import Gwo, _overwritten
from pathloom_baselines.pso import Flight, Pso
from pathloom_baselines.ssa import Ssa

SWARMS = (Pso(), Gwo(), Ssa(), Afsa())
NEUTRAL = (Pso(), Gwo(frame="neutral"), Ssa(frame="neutral"), Afsa())
ALL = (*SWARMS, AfsaGrid(), BezierGa())


def short(planner, generations=5, **fields):
    return replace(planner, termination=(MaxGenerations(limit=generations),), **fields)


def each(planners):
    return pytest.mark.parametrize("planner", planners, ids=lambda p: p.name)


# Prepared draws ---------------------------------------------------------------------------------


class Draws:
    """A generator that gives prepared numbers, and complains of any other use."""

    def __init__(self, *prepared):
        self.left = list(prepared)

    def _next(self, kind, shape):
        name, value = self.left.pop(0)
        value = np.asarray(value, float)
        assert (name, value.shape) == (kind, shape)
        return value

    def random(self, size=()):
        return self._next("uniform", size)

    def standard_normal(self, size=()):
        return self._next("normal", size)

    def uniform(self, low, high, size):
        assert (low, high) == (-1.0, 1.0)
        return self._next("between", size)

    def permutation(self, n):
        return self._next("permutation", (n,)).astype(int)


def vectors(genes, costs):
    genes, costs = np.array(genes, float), np.array(costs, float)
    nothing = np.zeros(len(costs))
    return Vectors(genes, np.zeros((len(costs), 1), np.int32), costs[:, np.newaxis], nothing, -costs, costs)


class PlainJudge:
    """Values genes by a function of them, and remembers what it was asked."""

    problem = None

    def __init__(self, cost):
        self.cost, self.asked = cost, []

    def __call__(self, genes):
        self.asked.append(np.array(genes))
        return vectors(genes, [self.cost(row) for row in genes])


def state(swarm, memory=None, generation=0):
    return SimpleNamespace(vectors=swarm, memory=memory, generation=generation)


def near(expected):
    return pytest.approx(np.array(expected, float), rel=1e-12, abs=1e-15)


# Deb's rules ------------------------------------------------------------------------------------


def valued(violation, fitness):
    one = vectors([[0.0]] * len(violation), fitness)
    return replace(one, violations=np.array(violation, float), fitness=np.array(fitness, float))


def test_feasible_beats_infeasible_then_the_smaller_violation_then_the_fitter():
    ranked = valued([0, 0, 0, 0.5, 0.5, 2], [3, 1, -7, 9, 2, 100])
    assert ranked.order().tolist() == [0, 1, 2, 3, 4, 5]
    assert ranked.at([5, 3, 0, 2, 4, 1]).order().tolist() == [2, 5, 3, 1, 4, 0]
    assert ranked.at([3, 4, 5]).best() == 0
    assert ranked.at([5, 2, 1]).best() == 2
    for i in range(6):
        for j in range(6):
            assert ranked.at([i]).better(ranked.at([j]))[0] == (i < j)


def test_equal_ones_stay_in_their_order_and_none_is_better():
    same = valued([1, 1, 1], [-1, -1, -1])
    assert same.order().tolist() == [0, 1, 2]
    assert not same.better(same.at([0])).any()


# PSO --------------------------------------------------------------------------------------------


def flown(planner, x, v, draws, generation=5):
    swarm = vectors([x, [0.4, 0.9]], [5.0, 1.0])
    flight = Flight(np.array([v, [0.0, 0.0]]), vectors([[0.6, 0.1], [0.4, 0.9]], [4.0, 1.0]))
    judge = PlainJudge(lambda row: row[0])
    return planner.move(state(swarm, flight, generation), judge, draws)


R = ("uniform", [[[0.25, 0.5], [0.0, 0.0]], [[0.1, 0.3], [0.0, 0.0]]])  # r1 and r2, for each dimension


def test_pso_weighs_inertia_own_best_and_best_of_all_in_each_dimension():
    moved, flight = flown(short(Pso(), 10), [0.5, 0.2], [0.1, -0.05], Draws(R))
    # w = 0.65 at half of the budget; v = 0.65 · 0.1 + 2 · 0.25 · (0.6 − 0.5) + 2 · 0.1 · (0.4 − 0.5)
    # and 0.65 · −0.05 + 2 · 0.5 · (0.1 − 0.2) + 2 · 0.3 · (0.9 − 0.2) = 0.2875, of which 0.2 is left
    assert flight.velocities[0] == near([0.095, 0.2])
    assert moved.genes[0] == near([0.595, 0.4])
    assert flight.own.genes.tolist() == [[moved.genes[0, 0], moved.genes[0, 1]], [0.4, 0.9]]  # 0.595 < 4, 0.4 < 1


def test_pso_keeps_what_was_best_where_the_new_place_is_worse():
    planner = short(Pso(), 10)
    swarm = vectors([[0.5, 0.2], [0.4, 0.9]], [0.5, 0.4])
    flight = Flight(np.full((2, 2), 0.1), swarm)
    zero = ("uniform", np.zeros((2, 2, 2)))
    _, after = planner.move(state(swarm, flight), PlainJudge(lambda row: row[0]), Draws(zero))
    assert after.own.genes.tolist() == swarm.genes.tolist()


def test_pso_with_constriction_by_hand():
    planner = short(Pso(form="constriction", cognitive=2.05, social=2.05, fastest=9.0), 10)
    assert planner.constriction == pytest.approx(0.7298, abs=5e-5)
    _, flight = flown(planner, [0.5, 0.2], [0.1, -0.05], Draws(R))
    pull = [0.1 + 2.05 * 0.25 * 0.1 - 2.05 * 0.1 * 0.1, -0.05 - 2.05 * 0.5 * 0.1 + 2.05 * 0.3 * 0.7]
    assert flight.velocities[0] == near(np.multiply(planner.constriction, pull))
    with pytest.raises(pl.ConfigError, match=r"above 4, such as 2\.05 each; got 2 \+ 2"):
        Pso(form="constriction")


@pytest.mark.parametrize(
    ("bounds", "draws", "x", "v"),
    [
        ("clip", (), [1.0, 0.0], [0.0, 0.0]),
        ("reflect", (), [0.9, 0.05], [-0.15, 0.1]),
        ("random", (("uniform", [[0.3, 0.7], [0.1, 0.1]]),), [0.3, 0.7], [0.0, 0.0]),
    ],
)
def test_pso_at_the_border(bounds, draws, x, v):
    planner = short(Pso(bounds=bounds, inertia_first=1.0, inertia_last=1.0, cognitive=0.0, social=0.0), 10)
    zero = ("uniform", np.zeros((2, 2, 2)))
    moved, flight = flown(planner, [0.95, 0.05], [0.15, -0.1], Draws(zero, *draws))
    assert moved.genes[0] == near(x)
    assert flight.velocities[0] == near(v)


# GWO --------------------------------------------------------------------------------------------

LEADERS = [[0.8, 0.2], [0.6, 0.4], [0.1, 0.9]]
R1 = [[[0.75, 0.25]], [[0.5, 1.0]], [[0.0, 0.5]]]  # for each leader, wolf and dimension
R2 = [[[0.5, 0.25]], [[1.0, 0.5]], [[0.25, 0.0]]]


@pytest.mark.parametrize(
    ("frame", "parts"),
    [
        # X_l − (2 a r1 − a) · |2 r2 X_l − X| with X = (0.5, 0.3) and a = 1
        ("absolute", [(0.8 - 0.5 * 0.3, 0.2 + 0.5 * 0.2), (0.6, 0.4 - 0.1), (0.1 + 0.45, 0.9)]),
        # … |2 r2 (X_l − X)|
        ("neutral", [(0.8 - 0.5 * 0.3, 0.2 + 0.5 * 0.05), (0.6, 0.4 - 0.1), (0.1 + 0.2, 0.9)]),
    ],
)
def test_gwo_goes_to_the_middle_of_three_places_round_the_leaders(frame, parts):
    judge = PlainJudge(lambda row: 7.0)
    planner = short(Gwo(frame=frame), 10)
    memory = vectors(LEADERS, [1.0, 2.0, 3.0])
    planner.move(state(vectors([[0.5, 0.3]], [5.0]), memory, 5), judge, Draws(("uniform", [R1, R2])))
    assert judge.asked[0][0] == near(np.mean(parts, axis=0))


def test_gwo_follows_the_three_best_ever_seen():
    memory = Gwo().remember(vectors([[0.1], [0.2], [0.3], [0.4]], [4.0, 2.0, 9.0, 3.0]))
    assert memory.genes.ravel().tolist() == [0.2, 0.4, 0.1]
    planner = short(Gwo(), 1)  # a = 0 would be at the end of the budget only
    rest = Draws(("uniform", np.full((2, 3, 1, 1), 0.5)))  # A = 0: to the mean of the leaders
    moved, after = planner.move(state(vectors([[0.9]], [9.0]), memory), PlainJudge(lambda row: 2.5), rest)
    assert moved.genes[0] == near([0.7 / 3])
    assert after.costs.tolist() == [2.0, 2.5, 3.0]


def test_gwo_in_the_authors_program_forgets_the_one_that_a_new_best_displaces():
    memory = Gwo(leaders="authors").remember(vectors([[0.1], [0.2], [0.3], [0.4]], [4.0, 5.0, 3.0, 3.5]))
    assert memory.costs.tolist() == [3.0, 3.5, 3.5] or memory.costs.tolist()[:2] == [3.0, 3.5]
    assert Gwo().remember(vectors([[0.1], [0.2], [0.3]], [1.0, 2.0, 0.5])).costs.tolist() == [0.5, 1.0, 2.0]
    forgetful = Gwo(leaders="authors").remember(vectors([[0.1], [0.2], [0.3]], [1.0, 2.0, 0.5]))
    assert forgetful.costs.tolist()[:2] == [0.5, 2.0]


def one_after_the_other(costs, leaders):
    """The rule of the authors' program, wolf by wolf."""
    alpha, beta, delta = leaders or (math.inf, math.inf, math.inf)
    for f in costs:
        if f < alpha:
            alpha = f
        if alpha < f < beta:
            beta = f
        if alpha < f and beta < f < delta:
            delta = f
    return alpha, beta, delta


@given(st.lists(st.integers(0, 9), min_size=1, max_size=12), st.booleans())
@examples(150)
def test_leaders_overwritten_are_those_that_a_loop_over_wolves_leaves(costs, again):
    led = sorted(costs[:3]) if again and len(costs) >= 4 else None
    ranks = np.array([*led, *costs[3:]] if led else costs)
    found = [int(ranks[row]) for row in _overwritten(ranks, 3 if led else 0)]
    expected = one_after_the_other(costs[3:] if led else costs, tuple(led) if led else None)
    assert [f for f, e in zip(found, expected, strict=True) if e < math.inf] == [e for e in expected if e < math.inf]


# SSA --------------------------------------------------------------------------------------------

FIVE = [[0.5, 0.4], [0.6, 0.2], [0.3, 0.3], [0.2, 0.8], [0.9, 0.1]]  # from the best to the worst
COSTS = [1.0, 2.0, 3.0, 4.0, 5.0]
NO_SCOUTS = ("permutation", [0, 1, 2, 3, 4]), ("normal", np.empty((0, 2))), ("between", np.empty((0, 1)))
STILL = (("normal", np.zeros((3, 1))), ("uniform", np.zeros((3, 2))))  # Q and A of the scroungers


def flock(**fields):
    return Ssa(**{"decoder": Waypoints(count=1), "producers": 0.4, **fields})


def sparrows(draws, planner=None, genes=FIVE, costs=COSTS, cost=lambda row: 0.0):
    """Return what the sparrows' places are valued as, in the order of their rank."""
    planner = planner or short(flock(scouts=0.0), 10)
    judge = PlainJudge(cost)
    order = [3, 0, 4, 2, 1]  # the population need not be sorted
    swarm = vectors(np.array(genes)[order], np.array(costs)[order])
    planner.move(state(swarm), judge, Draws(*draws))
    return judge.asked


def test_producers_shrink_by_rank_where_all_is_safe():
    alpha = ("uniform", [[0.5], [0.0]])  # 1 − u lies in (0, 1]
    asked = sparrows([("uniform", 0.79), alpha, *STILL, *NO_SCOUTS])
    # X · exp(−i / (α T)) with i = 1, 2 and T = 10
    assert asked[0] == near([np.multiply(FIVE[0], math.exp(-1 / 5)), np.multiply(FIVE[1], math.exp(-2 / 10))])


def test_the_best_sparrow_moves_too_and_never_away_from_zero():
    asked = sparrows([("uniform", 0.0), ("uniform", [[0.0], [0.0]]), *STILL, *NO_SCOUTS])
    assert (asked[0] < np.array(FIVE[:2])).all()


def test_producers_all_shift_by_one_normal_number_where_there_is_alarm():
    asked = sparrows([("uniform", 0.8), ("normal", [[0.1], [-0.3]]), *STILL, *NO_SCOUTS])
    assert asked[0] == near([[0.6, 0.5], [0.3, 0.0]])  # 0.2 − 0.3 stays on the border


def test_scroungers_of_the_better_half_go_round_the_best_producer_with_one_number_for_all_dimensions():
    planner = short(flock(producers=0.2, scouts=0.0), 10)
    genes, costs = [*FIVE[:4], [0.9, 0.1], [0.2, 0.1]], [*COSTS, 6.0]
    judge = PlainJudge(lambda row: 0.0)
    draws = Draws(
        ("uniform", 0.9), ("normal", [[0.1]]), ("normal", [[0.5], [0.5], [0.25], [0.3], [0.1]]),
        ("uniform", [[0.7, 0.2], [0.7, 0.6], *[[0.0, 0.0]] * 3]), ("permutation", range(6)), *NO_SCOUTS[1:],
    )  # fmt: skip
    planner.move(state(vectors(genes, costs)), judge, draws)
    producer = np.array([0.6, 0.5])
    assert judge.asked[0] == near([producer])
    # ranks 2 and 3 of 6: X_P + Σ |X_ij − X_Pj| A_j / d
    assert judge.asked[1][0] == near(producer + (abs(0.6 - 0.6) - abs(0.2 - 0.5)) / 2)
    assert judge.asked[1][1] == near(producer + (abs(0.3 - 0.6) + abs(0.3 - 0.5)) / 2)
    # ranks 4 to 6: Q · exp((X_worst − X) / i²), worst = (0.2, 0.1)
    for k, (i, q) in enumerate(((4, 0.25), (5, 0.3), (6, 0.1))):
        gap = np.subtract([0.2, 0.1], genes[i - 1])
        assert judge.asked[1][2 + k] == near(q * np.exp(gap / i**2))


def test_hind_sparrows_take_the_difference_to_the_worst_before_they_divide_it():
    gap, rank = np.subtract(FIVE[4], FIVE[3]), 4
    right, wrong = np.exp(gap / rank**2), np.exp(np.array(FIVE[4]) - np.array(FIVE[3]) / rank**2)
    draws = [("uniform", 0.9), ("normal", np.zeros((2, 1))), ("normal", [[0.5]] * 3), STILL[1], *NO_SCOUTS]
    asked = sparrows(draws)
    assert asked[1][1] == near(0.5 * right)
    assert abs(asked[1][1] - 0.5 * wrong).min() > 0.01


def test_scouts_fly_to_the_best_and_the_best_itself_from_the_worst():
    planner = short(flock(scouts=0.4), 10)
    still = [("uniform", 0.9), ("normal", np.zeros((2, 1))), *STILL]
    scouting = [("permutation", [0, 3, 1, 2, 4]), ("normal", [[9.0, 9.0], [0.5, -1.0]]), ("between", [[0.5], [9.0]])]
    asked = sparrows([*still, *scouting], planner)
    # judged: the two producers; then the best, who is moved again, and ranks 3 to 5
    assert [len(a) for a in asked] == [2, 4]
    # rank 1 is the best: X + K |X − X_worst| / (f − f_w), f = 1, f_w = 5
    assert asked[1][0] == near([0.5 + 0.5 * 0.4 / -4.0, 0.4 + 0.5 * 0.3 / -4.0])
    # rank 4 is not: X_best + β |X − X_best|, and the row that is judged is its own
    assert asked[1][2] == near([0.5 + 0.5 * 0.3, 0.4 - 1.0 * 0.4])


def test_a_sparrow_keeps_its_place_unless_the_new_one_is_better():
    planner = short(flock(scouts=0.4), 10)
    still = [("uniform", 0.9), ("normal", np.zeros((2, 1))), *STILL]
    scouting = [("permutation", [4, 3, 1, 2, 0]), ("normal", np.zeros((2, 2))), ("between", np.zeros((2, 1)))]
    judge = PlainJudge(lambda row: 4.5)
    after, _ = planner.move(state(vectors(FIVE, COSTS)), judge, Draws(*still, *scouting))
    assert after.costs.tolist() == [1.0, 2.0, 3.0, 4.0, 4.5]
    assert after.genes[:4].tolist() == FIVE[:4]
    assert after.genes[4].tolist() == FIVE[0]  # β = 0: where the best is


def test_the_neutral_frame_counts_from_the_middle_of_the_map():
    planner = short(flock(scouts=0.0, frame="neutral"), 10)
    signs = ("uniform", [[0.7, 0.2]] * 3)  # L = (+, −)
    draws = [("uniform", 0.1), ("uniform", [[0.5], [0.0]]), ("normal", [[0.5]] * 3), STILL[1], signs, *NO_SCOUTS]
    asked = sparrows(draws, planner)
    assert asked[0][0] == near(0.5 + np.multiply(np.subtract(FIVE[0], 0.5), math.exp(-1 / 5)))
    gap = 2 * np.abs(np.subtract(FIVE[4], FIVE[3]))
    assert asked[1][1] == near(0.5 + 0.5 * 0.5 * np.array([1, -1]) * np.exp(-gap / 16))


def test_local_search_tries_each_gene_of_the_best_and_keeps_what_is_better():
    planner = short(flock(scouts=0.0, local_search=True), 10)
    judge = PlainJudge(lambda row: 0.0 if row.tolist() == [0.77, 0.4] else 9.0)
    draws = [("uniform", 0.9), ("normal", np.zeros((2, 1))), *STILL, *NO_SCOUTS]
    search = [("permutation", [1, 0]), ("uniform", 0.33), ("uniform", 0.77)]
    after, _ = planner.move(state(vectors(FIVE, COSTS)), judge, Draws(*draws, *search))
    assert judge.asked[2:] == [near([[0.5, 0.33]]), near([[0.77, 0.4]])]
    assert after.genes[after.best()].tolist() == [0.77, 0.4]


@pytest.mark.parametrize(("fields", "horizon"), [({}, 10), ({"horizon": 77}, 77)])
def test_the_horizon_is_the_limit_of_generations(fields, horizon):
    assert short(Ssa(**fields), 10)._horizon == horizon
    assert replace(Ssa(), termination=(MaxEvaluations(limit=9),))._horizon == 500


# AFSA -------------------------------------------------------------------------------------------

SHOAL = [[0.5, 0.5], [0.6, 0.5], [0.5, 0.6]]  # one way-point each, 0.1 and √2 / 10 apart


def test_of_swarming_and_following_a_fish_does_what_is_better():
    rng = np.random.default_rng(1)
    judge = PlainJudge(lambda row: row.sum())
    genes = rng.random((30, 2))
    after, _ = Afsa(decoder=Waypoints(count=1)).move(state(vectors(genes, genes.sum(axis=1))), judge, rng)
    assert [len(asked) for asked in judge.asked[-2:]] == [30, 30]
    assert after.costs == near(np.minimum(*(asked.sum(axis=1) for asked in judge.asked[-2:])))
    assert (np.hypot(*(after.genes - genes).T) <= 0.1 * math.sqrt(2) + 1e-12).all()


def test_each_try_looks_within_sight_and_a_better_place_is_stepped_towards():
    planner = Afsa(decoder=Waypoints(count=1), visual=0.2, tries=3)
    judge = PlainJudge(lambda row: row[0])
    draws = Draws(
        ("between", [[0.5, -0.5], [0.5, -0.5]]),  # where to, if nothing better is found
        ("between", [[-0.5, 0.0], [1.0, 1.0]]),  # the first finds something, the second does not
        ("uniform", [[0.5]]),
        ("between", [[0.5, 0.5]]),
        ("uniform", np.empty((0, 1))),
        ("between", [[0.2, 0.0]]),
        ("uniform", np.empty((0, 1))),
    )
    moved = planner._prey(vectors([[0.5, 0.5], [0.3, 0.3]], [0.5, 0.3]), judge, 1, draws)
    assert judge.asked[0] == near([[0.4, 0.5], [0.5, 0.5]])
    assert judge.asked[1] == near([[0.4, 0.4]])
    assert judge.asked[2] == near([[0.34, 0.3]])
    assert moved[0] == near([0.5 - 0.1 * 0.5, 0.5])  # step · U along the unit vector to (0.4, 0.5)
    assert moved[1] == near([0.3 + 0.1 * 0.5, 0.3 - 0.1 * 0.5])  # step · U(−1, 1) in each dimension
    assert draws.left == []


def test_the_size_of_a_step_is_the_root_mean_square_over_way_points():
    planner = Afsa(decoder=Waypoints(count=2))
    moved = planner._towards(np.zeros((1, 4)), np.array([[0.3, 0.4, 0.0, 0.0]]), 2, Draws(("uniform", [[1.0]])))
    assert moved[0] == near(np.array([0.3, 0.4, 0.0, 0.0]) * 0.1 / math.sqrt(0.25 / 2))
    assert planner._towards(np.ones((1, 4)), np.ones((1, 4)), 2, Draws(("uniform", [[1.0]]))).tolist() == [[1.0] * 4]


def swarmed(costs, cost, genes=SHOAL, **fields):
    planner = Afsa(decoder=Waypoints(count=1), **fields)
    fish = vectors(genes, costs)
    apart = np.hypot(*(fish.genes[:, np.newaxis] - fish.genes).transpose(2, 0, 1))
    return planner, fish, (apart <= 0.11) & ~np.eye(len(fish), dtype=bool), PlainJudge(cost)


def test_fish_swarm_where_the_centre_is_better_and_not_crowded():
    planner, fish, sight, judge = swarmed([3.0, 1.0, 2.0], lambda row: 1.5, delta=0.7)
    moved, went = planner._swarm(fish, sight, judge, 1, Draws(("uniform", [[1.0], [0.5]])))
    assert judge.asked[0] == near([[0.55, 0.55], [0.5, 0.5], [0.5, 0.5]])
    assert went.tolist() == [True, False, True]  # 1.5 is better than 3 and 2
    assert moved[0] == near([0.5 + 0.1 * math.sqrt(0.5)] * 2)
    assert moved[2] == near([0.5, 0.6 - 0.05])


def test_no_fish_swarms_where_too_many_are_in_sight():
    planner, fish, sight, judge = swarmed([3.0, 1.0, 2.0], lambda row: 0.0, delta=0.6)
    _, went = planner._swarm(fish, sight, judge, 1, Draws(("uniform", [[1.0]] * 2)))
    assert went.tolist() == [False, True, True]  # 2 of 3 are in sight of the first


def test_fish_follow_the_best_in_sight_unless_it_is_crowded_there():
    planner, fish, sight, _ = swarmed([1.0, 3.0, 2.0], None, delta=0.7)
    moved, went = planner._follow(fish, sight, 1, Draws(("uniform", [[1.0], [0.5]])))
    assert went.tolist() == [False, True, True]
    assert moved[1:] == near([[0.5, 0.5], [0.5, 0.55]])
    planner, fish, sight, _ = swarmed([1.0, 3.0, 2.0], None, delta=0.6)
    assert not planner._follow(fish, sight, 1, Draws(("uniform", np.empty((0, 1)))))[1].any()


@pytest.mark.parametrize(("cost", "went"), [(2.6, True), (2.5, False)])
def test_swarming_fish_can_compare_food_with_the_crowd_instead(cost, went):
    # Y_c / n_f > δ Y_i with Y = 1 / cost and two companions: cost > 0.9 · 2 · 1.4 = 2.52
    planner, fish, sight, judge = swarmed([cost, 1.0, 0.6], lambda row: 1.4, crowding="food-ratio", delta=0.9)
    draws = Draws(("uniform", np.ones((int(went), 1))))
    assert planner._swarm(fish, sight, judge, 1, draws)[1].tolist() == [went, False, False]


@pytest.mark.parametrize(("cost", "went"), [(1.9, True), (1.7, False)])
def test_following_fish_can_compare_food_with_the_crowd_instead(cost, went):
    # fish 1 sees fish 0, which two others see: cost > 0.9 · 2 · 1; fish 0 sees fish 2, whom one sees: 1 > 0.9 · 1 · 0.9
    planner, fish, sight, _ = swarmed([1.0, cost, 0.9], None, crowding="food-ratio", delta=0.9)
    draws = Draws(("uniform", np.ones((1 + int(went), 1))))
    assert planner._follow(fish, sight, 1, draws)[1].tolist() == [True, went, False]


def test_a_fish_without_company_preys():
    planner, fish, _, judge = swarmed([1.0, 2.0, 3.0], lambda row: 0.0)
    alone = np.zeros((3, 3), bool)
    none = Draws(("uniform", np.empty((0, 1))), ("uniform", np.empty((0, 1))))
    assert not planner._swarm(fish, alone, judge, 1, none)[1].any()
    assert not planner._follow(fish, alone, 1, none)[1].any()


# Favourite places -------------------------------------------------------------------------------


def visited(planner, mirrored, seed):
    """Return the places that one step values, from a population or from the mirrored one, mirrored back."""
    same, rng = np.random.default_rng(0), np.random.default_rng(seed)
    found = []
    for _ in range(200):
        genes, costs = same.beta(1.5, 6.0, (12, 4)), np.arange(12.0)
        genes = np.where(mirrored, 1.0 - genes, genes)
        swarm = vectors(genes, costs)
        judge = PlainJudge(lambda row: 1.0)
        planner.move(state(swarm, planner.remember(swarm), 3), judge, rng)
        found.append(np.concatenate(judge.asked))
    places = np.concatenate(found)
    places = np.where(mirrored, 1.0 - places, places)
    return np.column_stack((places, (places[:, 0] - 0.5) * (places[:, 1] - 0.5)))  # rows, columns, and how they agree


def least_p(planner, mirrored):
    planner = short(planner, 10, decoder=Waypoints(count=2))
    ours, theirs = visited(planner, np.zeros(4, bool), 1), visited(planner, np.array(mirrored), 2)
    return min(ks_2samp(a, b, method="asymp").pvalue for a, b in zip(ours.T, theirs.T, strict=True))


FLIPS = ([True, False, True, False], [True] * 4)  # upside down; turned by half


@pytest.mark.parametrize("mirrored", FLIPS, ids=["upside down", "by half a turn"])
@each(NEUTRAL)
def test_a_mirrored_swarm_moves_as_the_swarm_does(planner, mirrored):
    assert least_p(planner, mirrored) > LEAST_P


@pytest.mark.parametrize("mirrored", FLIPS, ids=["upside down", "by half a turn"])
@each((Gwo(), Ssa()))
def test_as_printed_some_swarms_move_otherwise_where_the_map_is_mirrored(planner, mirrored):
    assert least_p(planner, mirrored) < 1e-9


def cost_near_row(row, planner, seed):
    """Return what the best way along a row costs, or along the same row of the map upside down."""
    occupied = pl.load_map(f"random-30:12%:s{seed % 6}", corners="allow").occupied.copy()
    occupied[26, [0, 29]] = False
    occupied = occupied if row == 26 else occupied[::-1]
    problem = pl.PathProblem(np.ascontiguousarray(occupied), start=(row, 0), goal=(row, 29), corners="allow")
    planner = compose(short(planner, 30, population=40), decoder="rows")
    return run(problem, planner, 100 * row + seed).state.top.costs[0]


@pytest.mark.parametrize(("frame", "biased"), [("absolute", True), ("neutral", False)])
def test_gwo_as_printed_is_better_near_row_0_and_in_the_neutral_frame_it_is_not(frame, biased):
    low, high = ([cost_near_row(row, Gwo(frame=frame), seed) for seed in range(30)] for row in (3, 26))
    better = sum(a < b for a, b in zip(low, high, strict=True))
    assert (wilcoxon(low, high).pvalue < 1e-3) == biased
    assert (better >= 22) == biased


@each((*NEUTRAL, AfsaGrid(), BezierGa()))
def test_whole_runs_have_no_favourite_direction(planner):
    few = 2 if isinstance(planner, Afsa) else 8
    planner = short(planner, few) if isinstance(planner, AfsaGrid) else short(planner, few, population=15)
    found = []
    for turn, view in enumerate(views()):
        last = [run(view.problem, planner, 100 * turn + seed).state for seed in range(25)]
        rows = [s.trails[0] if isinstance(planner, AfsaGrid) else s.top.paths[0] for s in last]
        found.append(np.concatenate([features(view.back(row[np.newaxis]), 12) for row in rows]))
    alike(found)


# What all of them promise -----------------------------------------------------------------------


def plain(found):
    return {k: v for k, v in vars(found).items() if k not in ("problem", "seconds")}


@each(ALL)
def test_a_state_is_plain_data_and_goes_on_as_if_never_put_aside(planner):
    problem = pl.PathProblem(pl.load_map("random-12:25:s1", corners="strict"))
    planner = short(planner, 9)
    first = planner.step(planner.start(problem, first_generator(3)))
    again = pickle.loads(pickle.dumps(first))
    one, other = (planner.step(planner.step(s)) for s in (first, again))
    assert str(plain(one)) == str(plain(other))
    assert one.history == other.history
    assert one.population.tobytes() == other.population.tobytes()
    assert one.random == other.random


@each(ALL)
def test_a_seed_gives_one_run_and_another_seed_another(planner):
    problem = pl.PathProblem(pl.load_map("random-12:25:s1", corners="strict"))
    one, same, other = (run(problem, short(planner), seed).state for seed in (5, 5, 6))
    assert (one.history, one.counts, one.random) == (same.history, same.counts, same.random)
    where = [s.trails if isinstance(planner, AfsaGrid) else s.vectors.genes for s in (one, same, other)]
    assert where[0].tobytes() == where[1].tobytes() != where[2].tobytes()


@each((*SWARMS, Ssa(local_search=True), BezierGa()))
def test_as_many_evaluations_are_reported_as_vectors_were_valued(planner, monkeypatch):
    valued = []
    of = type(planner)
    original = of.evaluate_genes

    def witness(self, genes, problem):
        valued.append(len(genes))
        return original(self, genes, problem)

    monkeypatch.setattr(of, "evaluate_genes", witness)
    found = run(pl.PathProblem(pl.load_map("random-12:25:s1")), short(planner), 1).state
    assert found.evaluations == sum(valued) == found.history.evaluations[-1]


@each(ALL)
@given(problem=naive.problems(8), seed=st.integers(0, 99))
@examples(25)
def test_an_answer_is_legal_on_any_map_and_none_is_given_with_a_reason(planner, problem, seed):
    few = {"fish": 8} if isinstance(planner, AfsaGrid) else {"population": 8}
    finished = run(problem, short(planner, 4, **few), seed)
    row, reason = finished.outcome.solution, finished.outcome.reason
    if row is None:
        assert reason == "none of 8 fish came to the goal" or reason.startswith("no feasible vector among ")
        assert finished.state.answer is None
    else:
        assert pl.validate(problem.representation.decode(row), problem) is None
    best = finished.state.history.best
    assert all(a <= b for a, b in pairwise(best))
    if problem.start == problem.goal:
        assert row[row >= 0].tolist() == [problem.context.start]


@each(SWARMS)
@pytest.mark.parametrize("decoder", ["rows", "waypoints"])
@pytest.mark.parametrize(
    ("start", "goal"), [((2, 2), (2, 2)), ((2, 2), (2, 3)), ((2, 2), (1, 3)), ((4, 0), (4, 8)), ((0, 8), (4, 0))]
)
def test_on_an_empty_map_the_straight_way_is_found(planner, decoder, start, goal):
    problem = pl.PathProblem(np.zeros((5, 9), bool), start=start, goal=goal)
    planner = compose(short(planner, 20, population=30, noise=0.05), decoder=decoder)
    finished = run(problem, planner, 0)
    length = pl.compiled.measures.lengths(finished.outcome.solution[np.newaxis], 9)[0]
    apart = sorted((abs(goal[0] - start[0]), abs(goal[1] - start[1])))
    octile = apart[1] + (math.sqrt(2) - 1) * apart[0]  # a gene in each row or column allows no longer segments
    assert length <= 1.05 * (octile if decoder == "rows" else math.dist(start, goal))


@each(SWARMS)
@pytest.mark.parametrize("population", [1, 2, 3])
def test_a_swarm_may_be_small(planner, population):
    problem = pl.PathProblem(pl.load_map("random-12:25:s1"))
    assert run(problem, short(planner, 4, population=population), 0).state.generation == 4


@each(SWARMS)
def test_where_nothing_is_found_the_reason_says_how_much_was_tried(planner):
    wall = np.zeros((9, 9), bool)
    wall[4] = True
    problem = pl.PathProblem(wall, start=(8, 0), goal=(0, 8))
    result = run(problem, short(planner), 0)
    assert result.outcome.reason == f"no feasible vector among {result.state.evaluations} evaluations"
    result = run(problem, compose(short(planner), decoder="rows"), 0)
    assert result.outcome.reason.endswith("; one gene a row can only say paths that never turn back")
    assert pl.plan(problem, planner).status == "unreachable"


def test_occupied_nodes_cost_the_area_of_the_map_each_and_what_lies_between_costs_nothing():
    wall = np.zeros((5, 9), bool)
    wall[:4, 4] = True
    problem = pl.PathProblem(wall, start=(0, 0), goal=(0, 8), corners="allow")
    swarm = Pso(handling="occupied-nodes", decoder=Waypoints(count=2))
    places = [[(0, 2), (0, 6)], [(0, 4), (0, 6)], [(1, 4), (2, 4)], [(4, 4), (4, 5)]]
    genes = np.array([[((r + 0.5) / 5, (c + 0.5) / 9) for r, c in pair] for pair in places]).reshape(4, 4)
    found, legal = swarm.evaluate_genes(genes, problem)
    detour = math.hypot(4, 4) + 1 + 5
    assert found.costs == near([8.0, 45.0, 90.0, detour])
    assert found.order().tolist() == [0, 3, 1, 2]  # the first one runs through the wall
    assert legal.tolist() == [False, False, False, True]
    faithful, _ = Pso(decoder=Waypoints(count=2)).evaluate_genes(genes, problem)
    assert faithful.order()[0] == 3
    assert faithful.violations.tolist() == violations(faithful.paths, problem).tolist()
    assert faithful.costs == near([8, 8, math.hypot(1, 4) + 1 + math.hypot(2, 4), detour] + 140 * faithful.violations)
    judge = Judge(swarm, problem)
    judge(genes)
    assert (judge.top.costs[0], judge.legal.costs[0]) == (8.0, pytest.approx(detour))
    assert run(problem, short(swarm), 1).state.top.costs[0] == 8.0  # straight through the wall


def test_what_is_fit_is_decided_by_the_objectives():
    problem = pl.PathProblem(pl.load_map("random-20:75:s3", corners="allow"), corners="allow")
    shortest = pl.plan(problem, short(Pso(), 60), seed=2)
    straightest = pl.plan(problem, compose(short(Pso(), 60), objectives={"turns": 1.0, "length": 0.01}), seed=2)
    assert straightest.metrics["turns"] < shortest.metrics["turns"]
    assert straightest.objectives["turns"] == straightest.metrics["turns"]
    assert shortest.fitness == pytest.approx(1 / shortest.length)


def test_an_answer_can_be_refined():
    problem = pl.PathProblem(pl.load_map("random-20:75:s3", corners="allow"), corners="allow")
    raw = pl.plan(problem, short(Pso(), 30), seed=2)
    refined = pl.plan(problem, compose(short(Pso(), 30), refinement="point-deletion"), seed=2)
    assert refined.unrefined.tolist() == raw.path.tolist()
    assert refined.length <= raw.length


def test_uniform_first_vectors_lie_anywhere_and_others_about_the_straight_way():
    problem = pl.PathProblem(np.zeros((10, 20), bool), start=(9, 0), goal=(0, 19))
    anywhere = Pso(population=2000, spread="uniform").first_genes(problem, np.random.default_rng(0))
    around = Pso(population=2000).first_genes(problem, np.random.default_rng(0))
    assert np.abs(anywhere.mean(axis=0) - 0.5).max() < 0.03
    assert anywhere.std(axis=0).min() > 0.27
    assert np.abs(around.mean(axis=0) - Waypoints().straight(problem)).max() < 0.02
    assert 0.08 < around.std(axis=0)[4:8].min() < around.std(axis=0).max() < 0.11


def test_vectors_are_for_paths_only():
    from kernel.sphere import Space

    for planner in (Pso(), BezierGa()):
        with pytest.raises(pl.ConfigError, match="works on 'cells'|plans paths; got a problem of kind 'space'"):
            planner.start(Space(), np.random.default_rng(0))


def test_every_planner_searches_with_vectors():
    assert all(isinstance(planner, VectorPlanner) for planner in (*SWARMS, BezierGa()))
