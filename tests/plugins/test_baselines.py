"""The plain genetic algorithms and the multi-population ones, statement by statement."""

import math
from dataclasses import dataclass

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.kernel.run import run
from pathloom.kernel.state import Deme, State
from pathloom_baselines.control import ByPopulation
from pathloom_baselines.crossover import BestMeeting
from pathloom_baselines.migration import RingMigration
from pathloom_baselines.mutation import TwoPoint
from pathloom_baselines.objectives import SmoothD2Legacy, SmoothnessPenalty
from pathloom_baselines.repair import DetourRemoval
from pathloom_baselines.sampling import GreedyWalk, RandomPerRow, RandomWalk
from pathloom_baselines.selection import KeepAll

BASIC = ("basic-ga", "bga", "bga-50", "ga-imaga", "ga-iga", "ga-lit37")
ISLANDS = ("mpmga", "mpga-textbook")
EVERY = (*BASIC, *ISLANDS, "ga-imga")


def on(grid, corners="allow", **ends):
    return pl.PathProblem(pl.load_map(grid, corners=corners), corners=corners, **ends)


@pytest.fixture
def empty():
    return on("empty-10")


def rng(seed=0):
    return np.random.default_rng(seed)


def packed(problem, *paths):
    return problem.representation.encode([np.array(path) for path in paths])


def unpacked(problem, population):
    return [[tuple(cell) for cell in problem.representation.decode(row).tolist()] for row in population]


def lengths(population, problem):
    return pl.compiled.measures.lengths(population, problem.context.cols)


# Initialisation -----------------------------------------------------------------------------------


def test_a_cell_of_each_row_is_drawn_and_no_row_is_gone_back_to(empty):
    paths = unpacked(empty, RandomPerRow().sample(empty, 50, rng()))
    for path in paths:
        rows = [r for r, _ in path]
        assert rows == sorted(rows, reverse=True)  # from the bottom row to the top one
        assert set(rows) == set(range(10))
    widest = [max(sum(r == row for r, _ in path) for row in range(10)) for path in paths]
    assert max(widest) >= 8  # no limit on how far apart the cells of two rows are


def test_cells_are_drawn_from_columns_where_start_and_goal_share_a_row():
    problem = on("empty-10", start=(4, 0), goal=(4, 9))
    for path in unpacked(problem, RandomPerRow().sample(problem, 20, rng())):
        columns = [c for _, c in path]
        assert columns == sorted(columns)
        assert set(columns) == set(range(10))


def test_paths_that_cannot_be_closed_are_counted_drawn_again_and_given_up_in_the_end():
    problem = on("random-20:102")
    with counting() as counts:
        found = RandomPerRow(reach=4, tries=20).sample(problem, 40, rng(1))
    assert counts["samples failed"] >= 20
    assert len(found) == 40
    assert counts["samples repeated"] == 40 - len(problem.representation.distinct(found)[0])
    blocks = on("blocks-50:20%")
    assert len(RandomPerRow(tries=100).sample(blocks, 5, rng())) == 0  # no midpoint leads round a wide obstacle
    helped = RandomPerRow(tries=100, fallback=pl.compose("imga", sampling="perturbed-trees").sampling)
    assert len(helped.sample(blocks, 5, rng())) == 5


def failures(name, reach):
    with counting() as counts:
        RandomPerRow(reach=reach).sample(on(name), 20, rng(1))
    return counts.get("samples failed", 0)


def test_with_four_neighbours_initialisation_takes_over_on_large_maps_as_the_paper_of_agacd_times_it():
    small, large = (failures(name, 4) for name in ("random-20:20%", "random-50:20%"))
    assert large > 50 * small  # 0.31 s and 43 s, table 7 and 11
    assert failures("random-50:20%", 8) < large / 50


def test_greedy_walks_are_shorter_the_greedier_they_are():
    problem = on("random-20:75")
    mean = [lengths(GreedyWalk(greed=greed).sample(problem, 200, rng()), problem).mean() for greed in (0.2, 0.5, 0.8)]
    assert mean[0] > mean[1] > mean[2]


def test_a_greedy_walk_that_is_held_is_given_up():
    pocket = np.zeros((9, 9), bool)
    pocket[2:7, 5] = pocket[2, 2:6] = pocket[6, 2:6] = True
    problem = pl.PathProblem(pocket, start=(4, 4), goal=(4, 8))
    with counting() as counts:
        assert len(GreedyWalk(greed=1.0, tries=3).sample(problem, 5, rng())) == 0
    assert counts == {"samples failed": 3}


# Fitness ------------------------------------------------------------------------------------------

BENT = [(9, 0), (9, 1), (9, 2), (8, 3), (7, 3), (7, 4), (6, 4), (6, 5), (7, 4), (7, 3)]
"""Straight on, 45°, 45°, 90°, 90°, 90°, 135° and 45° off the old direction."""


def test_turns_cost_by_the_angle_between_the_way_back_and_the_way_on(empty):
    population = packed(empty, BENT, BENT[:2], BENT[:3])
    assert SmoothnessPenalty().measure(population, empty).tolist() == [3 + 3 + 15 + 15 + 15 + 20 + 3, 0, 0]
    assert SmoothnessPenalty(base=1.0, price=(1.0, 10.0, 100.0)).measure(population, empty).tolist() == [134, 1, 1]


@pytest.mark.parametrize(
    ("cells", "penalty"),
    [
        ([(9, 0), (8, 0), (9, 0)], 20.0),  # back: 0°
        ([(9, 4), (5, 4), (9, 9)], 15.0),  # 51.3°
        ([(9, 4), (5, 4), (5, 0)], 15.0),  # 90°
        ([(9, 0), (9, 5), (8, 9)], 3.0),  # 166.0°
        ([(9, 0), (9, 3), (8, 9)], 0.0),  # 170.5°
    ],
)
def test_angles_off_the_grid_fall_into_the_same_classes(empty, cells, penalty):
    assert SmoothnessPenalty().measure(packed(empty, cells), empty).tolist() == [penalty]


@pytest.mark.parametrize(
    ("cells", "penalty"),
    [
        ([(9, 0), (8, 1), (7, 2)], 0.0),  # straight on, diagonal: 8
        ([(9, 0), (9, 1), (8, 2)], 5.0),  # 135°: 5
        ([(9, 0), (9, 1), (9, 2)], 30.0),  # straight on, and yet
        ([(9, 0), (8, 1), (9, 2)], 30.0),  # as dear as a right angle
        ([(9, 0), (9, 1), (8, 0)], 5000.0),  # 45°: 1
        ([(9, 0), (9, 1), (9, 0)], 5000.0),  # back: 0
    ],
)
def test_the_legacy_penalty_takes_straight_on_for_a_right_angle(empty, cells, penalty):
    assert SmoothD2Legacy().measure(packed(empty, cells), empty).tolist() == [penalty]
    assert SmoothD2Legacy(base=1.0).measure(packed(empty, cells), empty).tolist() == [penalty + 1]


def test_the_basic_fitness_is_one_over_length_and_seven_over_the_penalty_and_one(empty):
    planner = pl.compose("basic-ga")
    found = planner.evaluate(packed(empty, BENT, [(9, 0), (0, 9)]), empty).fitness
    length = 7 + 2 * math.sqrt(2)
    assert found == pytest.approx([1 / length + 7 / (74 + 1), 1 / (9 * math.sqrt(2)) + 7], rel=1e-12)


def test_the_fitness_of_bga_is_that_of_agacd():
    blocked = np.zeros((5, 5), bool)
    blocked[2, 2] = blocked[2, 3] = True
    problem = pl.PathProblem(blocked, start=(4, 0), goal=(4, 4), corners="allow")
    planner = pl.compose("bga")
    assert planner.objectives.weights.round(4).tolist() == [0.4118, 0.3431, 0.2451]  # eq. (25)
    population = packed(problem, [(4, 0), (3, 1), (3, 2), (4, 3), (4, 4)], [(4, 0), (4, 4)])
    turned = 3 * math.pi / 4
    by_hand = [
        0.4118 / (2 + 2 * math.sqrt(2)) + 0.3431 / turned + 0.2451 / 1.2,
        0.4118 / 4 + 0.3431 / 0.01745 + 0.2451 / 1.0,  # a straight path counts as turning by 1°
    ]
    assert planner.evaluate(population, problem).fitness == pytest.approx(by_hand, rel=2e-4)


# Operators ----------------------------------------------------------------------------------------


def test_two_point_mutation_gives_up_both_positions_and_joins_what_is_beside_them(empty):
    population = packed(empty, [(9, 0), (8, 1), (9, 2)])
    mutants = TwoPoint().apply(population, np.array([0]), empty, rng())
    assert unpacked(empty, mutants) == [[(9, 0), (9, 1), (9, 2)]]
    hump = [(9, 0), (8, 1), (7, 2), (6, 3), (7, 4), (8, 5), (9, 6)]
    mutants = TwoPoint().apply(packed(empty, *[hump] * 500), np.arange(500), empty, rng())
    removed = [len(set(hump) - set(path)) for path in unpacked(empty, mutants)]
    assert set(removed) == {0, 2, 3, 4, 5}  # two or more; two on a slope are made again


def test_tails_are_exchanged_where_the_two_shortest_children_come_out(empty):
    # both go round once, in different halves, and meet in (5, 4)
    late = [(9, 0), (8, 1), (7, 2), (6, 3), (5, 4), (5, 5), (5, 6), (4, 7), (3, 8)]
    early = [(9, 0), (8, 0), (7, 0), (6, 1), (5, 2), (5, 3), (5, 4), (4, 5), (3, 6), (3, 7), (3, 8)]
    population = packed(empty, early, late)
    with counting() as counts:
        children = BestMeeting().cross(population, np.array([[0, 1]]), empty, rng())
    assert counts == {"children tried": 2}
    assert unpacked(empty, children) == [late[:5] + early[7:], early[:7] + late[5:]]


def test_parents_without_a_common_cell_are_joined_where_they_are_one_step_apart(empty):
    left, right = [(9, 0), (0, 0), (5, 4), (0, 9)], [(9, 0), (9, 9), (5, 5), (0, 9)]
    population = packed(empty, left, right)
    children = unpacked(empty, BestMeeting().cross(population, np.array([[0, 1]]), empty, rng()))
    assert children == [[(9, 0), (9, 9), (5, 5), (5, 4), (0, 9)], [(9, 0), (0, 0), (5, 4), (5, 5), (0, 9)]]
    with counting() as counts:
        stay = BestMeeting(beside=False).cross(population, np.array([[0, 1]]), empty, rng())
    assert stay.tolist() == population.tolist()
    assert counts == {"crossover without a common cell": 1}


def test_a_path_that_comes_back_beside_itself_is_cut_short(empty):
    detour = [(9, 0), (8, 0), (7, 0), (7, 1), (7, 2), (8, 2), (8, 1), (7, 1), (6, 2)]
    repaired = DetourRemoval().apply(packed(empty, detour), empty, rng())
    assert unpacked(empty, repaired) == [[(9, 0), (8, 1), (7, 1), (6, 2)]]


@given(problem=naive.problems(), seed=st.integers(0, 99))
@naive.examples(120)
def test_every_operator_keeps_paths_legal_wherever_start_and_goal_lie(problem, seed):
    for sampling in (RandomPerRow(tries=20), RandomPerRow(reach=4, tries=20), GreedyWalk(tries=5), RandomWalk()):
        first = sampling.sample(problem, 6, rng(seed))
        if len(first) < 6:
            assert len(first) == 0 or sampling.name == "random-walk"
            continue
        assert problem.reachable
        crossed = BestMeeting().cross(first, np.array([[0, 1], [4, 2]]), problem, rng(seed))
        mutated = TwoPoint().apply(crossed, np.array([0, 3, 4, 5]), problem, rng(seed))
        repaired = DetourRemoval().apply(mutated, problem, rng(seed))
        for population in (first, crossed, mutated, repaired):
            for path in unpacked(problem, population):
                assert pl.validate(np.array(path), problem) is None
                assert naive.steps_singly(path)
                assert len(set(path)) == len(path)


def test_without_selection_every_individual_is_a_parent_once():
    assert KeepAll().select(np.array([3.0, 1.0, 2.0]), 3, rng()).tolist() == [0, 1, 2]
    assert KeepAll().select(np.array([3.0, 1.0]), 5, rng()).tolist() == [0, 1, 0, 1, 0]


# Migration ----------------------------------------------------------------------------------------


def demes(problem, *fitness):
    """Populations of straight paths, told apart by the column where they bend; the fitness is given."""
    made, column = [], 0
    for values in fitness:
        paths = [[(9, 0), (5, column + k), (0, 9)] for k in range(len(values))]
        column += len(values)
        made.append(Deme(packed(problem, *paths), np.array(values)[:, np.newaxis], np.array(values)))
    return tuple(made)


def bends(problem, deme):
    return [path[1][1] for path in unpacked(problem, deme.population)]


def exchanged(migration, problem, before, generation=0, seed=0):
    return migration.exchange(before, State(problem, {}, generation), rng(seed))


def test_on_a_ring_the_best_take_the_places_of_the_next_ones_worst_all_at_once(empty):
    before = demes(empty, [0.9, 0.1, 0.2], [0.3, 0.8, 0.4], [0.5, 0.6, 0.7])  # columns 0–2, 3–5, 6–8
    after = exchanged(RingMigration(rate=0.34), empty, before)
    assert [bends(empty, d) for d in after] == [[0, 8, 2], [0, 4, 5], [4, 7, 8]]
    assert [d.fitness.tolist() for d in after] == [[0.9, 0.7, 0.2], [0.9, 0.8, 0.4], [0.8, 0.6, 0.7]]
    assert all(d.values[:, 0].tolist() == d.fitness.tolist() for d in after)
    assert [bends(empty, d) for d in before] == [[0, 1, 2], [3, 4, 5], [6, 7, 8]]


def test_migrants_may_come_from_all_others_or_from_one_partner(empty):
    before = demes(empty, [0.9, 0.1, 0.2], [0.3, 0.8, 0.4], [0.5, 0.6, 0.7])
    complete = exchanged(RingMigration(topology="complete"), empty, before)
    assert [bends(empty, d) for d in complete] == [[0, 4, 2], [0, 4, 5], [0, 7, 8]]
    left_alone = set()
    for seed in range(40):
        after = exchanged(RingMigration(topology="random-pairs"), empty, before, seed=seed)
        alone = [k for k in range(3) if after[k] is before[k]]
        assert len(alone) == 1  # of three, one has no partner
        a, b = (k for k in range(3) if k not in alone)
        best = [int(np.argmax(d.fitness)) for d in before]
        assert bends(empty, after[a])[int(np.argmin(before[a].fitness))] == 3 * b + best[b]
        assert bends(empty, after[b])[int(np.argmin(before[b].fitness))] == 3 * a + best[a]
        left_alone.update(alone)
    assert left_alone == {0, 1, 2}


def test_a_share_of_each_population_moves_at_each_interval(empty):
    before = demes(empty, [0.5, 0.4, 0.3, 0.2, 0.1], [1.5, 1.4, 1.3, 1.2, 1.1])
    for rate, moved in ((0.0, 1), (0.2, 1), (0.4, 2), (1.0, 5)):
        after = exchanged(RingMigration(populations=2, rate=rate), empty, before)
        assert sum(f > 1 for f in after[0].fitness) == moved
    due = [g + 1 for g in range(12) if exchanged(RingMigration(interval=5), empty, before, g) is not before]
    assert due == [5, 10]
    alone = demes(empty, [0.5, 0.4])
    assert exchanged(RingMigration(populations=1), empty, alone) is alone


# Control ------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Longer(pl.Mutation):
    """Take the way round, of 2 instead of 1, whatever the path was."""

    def apply(self, population, chosen, problem, rng):
        out = problem.representation.stack(population, packed(problem, [(0, 0), (0, 1), (1, 1)]))[:-1]
        out[chosen, :3] = [0, 1, 3]
        return out


@pytest.mark.parametrize(
    ("control", "generation", "heat"),
    [
        ({}, 0, 1.0),
        ({}, 10, 0.9**10),
        ({"accuracy": 2.0}, 3, 2.0 * 0.9**3),
        ({"temperature": 0.25, "decay": 0.5}, 1, 0.125),
        ({}, 500, 0.9**500),
        ({}, 7050, 1e-99),
        ({"temperature": 0.0}, 0, 1e-99),
        ({"acceptance": "no-worse"}, 0, 1e-99),
        ({"acceptance": "always"}, 30, math.inf),
    ],
)
def test_a_worse_mutant_is_accepted_as_in_annealing(control, generation, heat):
    problem = pl.PathProblem(np.zeros((2, 2), bool), start=(0, 0), goal=(1, 1), corners="allow")
    planner = pl.compose(
        "mpmga", crossover=None, mutation=Longer(), objectives={"length": 1.0}, fitness={"floors": [1.0]},
        control=ByPopulation(profiles=((0.0, 1.0),), **control),
    )  # fmt: skip
    deme = planner.evaluate(packed(problem, *[[(0, 0), (1, 1)]] * 4000), problem)
    after = planner.control.advance(planner, State(problem, {}, generation, demes=(deme,)), 0, rng(3))
    drop = 1 / math.sqrt(2) - 1 / 2
    assert set(after.fitness) <= {0.5, 1 / math.sqrt(2)}
    assert (after.fitness == 0.5).mean() == pytest.approx(math.exp(-drop / heat), abs=0.02)


@pytest.mark.parametrize("control", [{"acceptance": "no-worse"}, {"temperature": 0.0}, {}], ids=str)
def test_mutants_that_are_no_worse_are_always_accepted(empty, control):
    planner = pl.compose("mpmga", crossover=None, control={"profiles": [[0.0, 1.0]], **control})
    deme = planner.evaluate(RandomPerRow().sample(empty, 60, rng()), empty)
    after = planner.control.advance(planner, State(empty, {}, 200, demes=(deme,)), 0, rng())
    assert (after.fitness >= deme.fitness).all()
    assert (after.fitness > deme.fitness).any()
    problem = on("empty-10", start=(9, 0), goal=(8, 2))
    deme = planner.evaluate(packed(problem, *[[(9, 0), (8, 1), (8, 2)]] * 20), problem)
    after = planner.control.advance(planner, State(problem, {}, 200, demes=(deme,)), 0, rng())
    assert set(after.fitness) == set(deme.fitness)
    assert unpacked(problem, after.population) == [[(9, 0), (9, 1), (8, 2)]] * 20  # another path, as fit


@dataclass(frozen=True, kw_only=True)
class Crossed(pl.Crossover):
    """Change nothing, and remember which pairs came."""

    def cross(self, population, pairs, problem, rng):
        SEEN["pairs"] = pairs
        return population


@dataclass(frozen=True, kw_only=True)
class Mutated(pl.Mutation):
    """Change nothing, and remember who was chosen."""

    def apply(self, population, chosen, problem, rng):
        SEEN["chosen"] = chosen
        return population


SEEN = {}


def seen(problem, which, *, rates=(0.0, 0.0), **control):
    """Which pairs are crossed and which individuals mutated in one population of 10, the last of them the fittest."""
    planner = pl.compose(
        "mpmga", crossover=Crossed(rate=rates[0]), mutation=Mutated(rate=rates[1]), control=ByPopulation(**control)
    )
    fitness = np.linspace(0.1, 1.0, 10)
    deme = Deme(packed(problem, *[[(9, 0), (0, 9)]] * 10), np.zeros((10, 3)), fitness)
    planner.control.advance(planner, State(problem, {}, demes=(deme,) * 9), which, rng(1))
    return SEEN["pairs"], SEEN["chosen"]


def test_each_population_has_its_own_probabilities_and_the_list_goes_round(empty):
    profiles = ((1.0, 0.0), (0.0, 1.0), (1.0, 1.0))
    for which in range(7):
        pairs, chosen = seen(empty, which, profiles=profiles)
        assert (len(pairs), len(chosen)) == (5 * profiles[which % 3][0], 10 * profiles[which % 3][1])
    default = ByPopulation().profiles
    assert default == ((0.8, 0.1), (0.3, 0.6), (0.8, 0.6))  # high and low, table 10
    with pytest.raises(pl.ConfigError, match="at least one pair"):
        ByPopulation(profiles=())


def test_adaptive_probabilities_fall_from_the_highest_at_the_mean_to_the_lowest_at_the_best(empty):
    profiles = ((1.0, 0.0), (0.0, 1.0))
    pairs, chosen = seen(empty, 0, probabilities="adaptive", profiles=profiles)
    assert set(range(5)) <= set(chosen.tolist())  # below the mean
    assert 9 not in chosen
    assert all(9 not in pair for pair in pairs.tolist())  # a pair goes by its fitter parent
    control = ByPopulation(probabilities="adaptive")
    planner = pl.compose("mpmga", control=control)
    fitness = np.array([0.0, 0.5, 0.75, 1.0, 0.25])  # the mean is 0.5
    crossing, mutating = control._rates(planner, State(empty, {}), 1, fitness)
    assert crossing == pytest.approx([0.8, 0.8, 0.55, 0.3, 0.8])
    assert mutating == pytest.approx([0.6, 0.6, 0.35, 0.1, 0.6])
    crossing, mutating = control._rates(planner, State(empty, {}), 1, np.ones(3))
    assert (crossing.tolist(), mutating.tolist()) == ([0.3] * 3, [0.6] * 3)  # converged


def test_the_operators_own_rates_count_only_where_that_is_said(empty):
    for rates in ((1.0, 0.0), (0.0, 1.0)):
        pairs, chosen = seen(empty, 0, rates=rates, probabilities="operators")
        assert (len(pairs), len(chosen)) == (5 * rates[0], 10 * rates[1])
    pairs, chosen = seen(empty, 0, rates=(1.0, 1.0), profiles=((0.0, 0.0),))
    assert (len(pairs), len(chosen)) == (0, 0)


def test_an_operator_that_is_missing_is_left_out(empty):
    problem = on("random-20:75")
    for slots in ({"crossover": "none"}, {"mutation": "none"}, {"crossover": "none", "mutation": "none"}):
        for control in ({}, {"probabilities": "operators"}, {"probabilities": "adaptive"}, {"acceptance": "always"}):
            planner = pl.compose(
                "mpmga", control=control, termination=[{"use": "max-generations", "limit": 3}], **slots
            )
            assert run(problem, planner, 0).outcome.solution is not None


def test_what_is_repaired_is_repaired_before_it_is_judged():
    problem = on("random-20:75")
    for acceptance in ("annealed", "always"):
        planner = pl.compose(
            "mpmga", repair="baselines/detour-removal", control={"acceptance": acceptance},
            termination=[{"use": "max-generations", "limit": 5}],
        )  # fmt: skip
        for deme in run(problem, planner, 0).state.demes:
            repaired = DetourRemoval().apply(deme.population, problem, rng())
            assert unpacked(problem, repaired) == unpacked(problem, deme.population)
            assert planner.evaluate(deme.population, problem).fitness.tolist() == deme.fitness.tolist()


# Planners -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "population", "generations", "crossover", "mutation"),
    [
        ("basic-ga", 200, 50, 0.8, 0.2),
        ("bga", 60, 300, 0.8, 0.3),
        ("bga-50", 60, 500, 0.9, 0.3),
        ("ga-imga", 100, 50, 0.8, 0.2),
        ("ga-imaga", 100, 50, 0.8, 0.2),
        ("ga-iga", 300, 150, 0.8, 0.05),
        ("ga-lit37", 100, 50, 0.8, 0.2),
        ("mpmga", 15, 500, None, None),
    ],
)
def test_planners_have_the_parameters_of_their_papers(name, population, generations, crossover, mutation):
    planner = pl.compose(name)
    assert (planner.population, planner.termination[0].limit) == (population, generations)
    if crossover is not None:
        assert (planner.crossover.rate, planner.mutation.rate) == (crossover, mutation)
        assert (planner.archive, planner.refinement, planner.survival.name) == (None, None, "replacement")


def test_every_reconstruction_says_that_it_is_one():
    for name in EVERY:
        planner = pl.compose(name)
        assert planner.fidelity == ("standard" if name in ("basic-ga", "mpga-textbook") else "reconstructed")


@pytest.mark.parametrize("corners", ["allow", "strict"])
@pytest.mark.parametrize("name", [*BASIC, *ISLANDS])
def test_on_an_empty_map_the_answer_is_within_five_percent_of_the_optimum(name, corners):
    problem = on("empty-20", corners=corners)
    optimum, _ = pl.octile_path(problem)
    for seed in range(3):
        found = run(problem, pl.compose(name), seed).outcome.solution
        assert lengths(found[np.newaxis], problem)[0] <= 1.05 * optimum


def test_moving_single_genes_of_random_walks_does_not_come_that_near():
    problem = on("empty-20")
    optimum, _ = pl.octile_path(problem)
    for seed in range(5):
        finished = run(problem, pl.compose("ga-imga"), seed)
        gap = finished.state.best.values[0] / optimum - 1
        assert 0.05 < gap < 0.4


@pytest.mark.parametrize("name", EVERY)
def test_evaluations_counted_are_those_made(name, monkeypatch):
    made = []
    plain = pl.Evolution.evaluate
    monkeypatch.setattr(
        pl.Evolution,
        "evaluate",
        lambda self, population, problem: made.append(len(population)) or plain(self, population, problem),
    )
    planner = pl.compose(name, termination=[{"use": "max-generations", "limit": 4}])
    state = run(on("random-20:75"), planner, 1).state
    assert state.evaluations == sum(made)
    assert state.history.evaluations[-1] == state.evaluations
    of_all = planner.population * (planner.migration.demes if planner.migration else 1)
    if name == "mpmga":  # children once, and mutants again
        assert 5 * of_all < state.evaluations <= 9 * of_all
    else:
        assert state.evaluations == 5 * of_all


@pytest.mark.parametrize("name", EVERY)
def test_where_there_is_no_way_none_is_found(name):
    blocked = np.zeros((8, 8), bool)
    blocked[4] = True
    assert pl.plan(pl.PathProblem(blocked), name).status == "unreachable"


def test_where_no_first_path_is_found_that_is_said():
    result = pl.plan(on("blocks-50:20%"), pl.compose("bga", sampling={"tries": 100}))
    assert result.status == "not-found"
    assert "'random-per-row' found no first individual in 100 tries" in result.reason


def test_one_population_is_divided_at_random_into_equal_ones():
    problem = on("random-20:102")
    for name, populations in (("mpmga", 3), ("mpga-textbook", 10)):
        planner = pl.compose(name)
        state = planner.start(problem, rng(5))
        assert [len(deme) for deme in state.demes] == [planner.population] * populations
        whole = planner.sampling.sample(problem, populations * planner.population, rng(5))
        parts = [path for deme in state.demes for path in unpacked(problem, deme.population)]
        assert parts != unpacked(problem, whole)
        assert sorted(parts) == sorted(unpacked(problem, whole))
        for deme in state.demes:
            assert planner.evaluate(deme.population, problem).fitness.tolist() == deme.fitness.tolist()
        assert (
            planner.step(state).demes[0].fitness.tolist()
            != planner.step(planner.start(problem, rng(6))).demes[0].fitness.tolist()
        )


def test_a_few_first_paths_are_enough_for_all_populations():
    problem = on("random-20:75", corners="strict")
    finished = run(problem, pl.compose("mpmga", termination=[{"use": "max-generations", "limit": 9}]), 0)
    assert finished.state.counts["samples repeated"] > 30  # of 45
    assert finished.state.generation == 9
    assert finished.outcome.solution is not None


def test_migration_makes_the_fitter_prevail_where_nothing_selects():
    problem = on("random-20:75")
    control = {"acceptance": "always"}
    stop = [{"use": "max-generations", "limit": 20}]
    mean = {}
    for populations in (1, 3):
        planner = pl.compose("mpmga", control=control, termination=stop, migration={"populations": populations})
        mean[populations] = [run(problem, planner, seed).state.history.mean[-1] for seed in range(6)]
    assert min(mean[3]) > max(mean[1])


@pytest.mark.parametrize(
    "slots",
    [
        {"migration": {"populations": 1}, "population": 45},
        {"control": {"acceptance": "no-worse"}},
        {"control": {"acceptance": "always"}},
        {"control": {"profiles": [[0.8, 0.2]]}},
        {"control": {"probabilities": "adaptive"}},
        {"selection": "roulette"},
        {"crossover": "baselines/single-point"},
        {"migration": {"topology": "complete", "interval": 5}},
        {"migration": {"topology": "random-pairs", "rate": 0.4}},
    ],
    ids=str,
)
def test_ablations_of_mpmga_are_other_searches_that_find_paths_too(slots):
    problem, stop = on("random-20:75"), [{"use": "max-generations", "limit": 8}]
    plain, other = (run(problem, pl.compose("mpmga", termination=stop, **s), 2) for s in ({}, slots))
    assert other.outcome.solution is not None
    assert other.state.history.mean != plain.state.history.mean


def test_the_textbook_form_stops_when_its_elite_has_not_changed_for_ten_generations():
    planner = pl.compose("mpga-textbook")
    state = run(on("random-20:75"), planner, 0).state
    assert state.generation - state.best.generation == 10
    assert len(state.demes) == 10
    crossing, mutating = zip(*planner.control.profiles, strict=True)
    assert (min(crossing), max(crossing), max(mutating)) == pytest.approx((0.7, 0.9, 0.05))
    assert min(mutating) == pytest.approx(0.001)
    assert len(set(planner.control.profiles)) == 10


def test_improved_parts_make_ga_lit37_shorter_and_straighter_than_the_plain_algorithm():
    problem = on("random-20:75")
    plain, better = ([pl.plan(problem, name, seed=s) for s in range(5)] for name in ("ga-imga", "ga-lit37"))
    assert max(r.length for r in better) < min(r.length for r in plain)
    assert max(r.metrics["turns"] for r in better) < min(r.metrics["turns"] for r in plain)


@pytest.mark.data
@pytest.mark.parametrize(
    ("file", "ends", "best"),
    [
        ("ga_smooth_20x20.csv", {"start": "top-left", "goal": "bottom-right"}, 30.9706),  # 75 obstacles
        ("ssa_20x20.csv", {}, 28.6274),  # 102 obstacles
    ],
)
def test_the_best_of_ga_imaga_is_the_one_printed_for_the_traditional_algorithm(data, file, ends, best):
    problem = on(data / "ga_grids" / file, **ends)
    found = [run(problem, pl.compose("ga-imaga"), seed).state.best.values[0] for seed in range(10)]
    assert round(min(found), 4) == best
    assert np.mean(found) < 1.02 * best  # the paper: 32.0219 and 28.8734
