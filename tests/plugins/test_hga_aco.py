"""HGA-ACO, equation by equation, and what the paper leaves open."""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import naive
import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.run import first_generator, run
from pathloom.kernel.state import Individual, State
from pathloom_hga_aco.control import FamilyCompetition
from pathloom_hga_aco.crossover import SinglePointGeneAware
from pathloom_hga_aco.deadlock import DeadAngleTable
from pathloom_hga_aco.heuristic import EdgeLength
from pathloom_hga_aco.mutation import TwoWayReverseSearch
from pathloom_hga_aco.objectives import AngleTablePenalty, MeanTurnAngle
from pathloom_hga_aco.pheromone import TwoBest
from pathloom_hga_aco.sampling import GuidedWalk
from pathloom_hga_aco.seeding import GaPheromoneSeed

EAST, SOUTH_EAST, WEST = 2, 3, 6
ROOM = pl.PathProblem(np.zeros((7, 7), bool), start=(0, 0), goal=(0, 2), corners="allow")
STRAIGHT = ((0, 0), (0, 1), (0, 2))
ROUND = ((0, 0), (1, 1), (0, 2))
WIDE = ((0, 0), (1, 0), (1, 1), (1, 2), (0, 2))


def on(grid, corners="allow", **ends):
    return pl.PathProblem(
        pl.load_map(grid, corners=corners) if isinstance(grid, str) else grid, corners=corners, **ends
    )


def short(generations=5, colony=5, **more):
    stop = [[{"use": "max-generations", "limit": limit}] for limit in (generations, colony)]
    return pl.compose(
        "hga-aco",
        genetic={"population": 12, "termination": stop[0]},
        colony={"ants": 12, "termination": stop[1]},
        **more,
    )


def deme_of(*paths, fitness=None):
    population = naive.packed(paths, 7)
    lengths = np.array([naive.length(path) for path in paths])
    return pl.Deme(population, lengths[:, np.newaxis], 1 / lengths if fitness is None else np.array(fitness, float))


def marched(*paths, best=None, **more):
    """A colony's state after these paths, ``best`` being the best of all marches."""
    deme = deme_of(*paths) if paths else pl.Deme(np.empty((0, 1), np.int32), np.empty((0, 1)), np.empty(0))
    if best is not None:
        found = deme_of(best)
        best = Individual(found.population[0], found.values[0], float(found.fitness[0]), 0)
    facts = {"demes": (deme,), "best": best, "pheromone": np.ones((49, 8))}
    tables = {"table": np.zeros(49, np.int32), "stuck": np.zeros(49, np.int32)}
    return pl.ColonyState(ROOM, {}, **{**facts, **tables, **more})


# Fitness, eqs. (20) to (26) ---------------------------------------------------------------------

TURNS = {  # included angle: the three nodes
    "180 along an axis": ((0, 0), (0, 1), (0, 2)),
    "180 along a diagonal": ((0, 0), (1, 1), (2, 2)),
    "135 from an axis": ((0, 0), (0, 1), (1, 2)),
    "135 from a diagonal": ((0, 0), (1, 1), (1, 2)),
    "90 of axes": ((0, 0), (0, 1), (1, 1)),
    "90 of diagonals": ((0, 0), (1, 1), (0, 2)),
    "45 from an axis": ((0, 0), (0, 1), (1, 0)),
    "45 from a diagonal": ((0, 0), (1, 1), (1, 0)),
    "0": ((0, 0), (0, 1), (0, 0)),
}
CORRECTED = {"180": 0, "135": 10, "90": 100, "45": 10_000, "0": 10_000}
PRINTED = {
    "180 along an axis": 100,
    "180 along a diagonal": 10_000,
    "135 from an axis": 10_000,
    "135 from a diagonal": 100,
    "90 of axes": 10,
    "90 of diagonals": 10,
    "45 from an axis": 0,
    "45 from a diagonal": 0,
    "0": 10_000,
}


@pytest.mark.parametrize("turn", TURNS)
def test_the_angle_table_corrected_and_as_printed(turn):
    row = naive.packed([TURNS[turn]], 7, 2)
    assert AngleTablePenalty().measure(row, ROOM)[0] == CORRECTED[turn.split()[0]]
    assert AngleTablePenalty(reading="as-printed").measure(row, ROOM)[0] == PRINTED[turn]


def test_angles_between_those_of_the_table_cost_as_the_smaller_one():
    for after, price in (((1, 6), 10), ((2, 2), 100), ((3, 0), 10_000)):  # 161.6, 116.6 and 71.6 degrees
        path = ((0, 0), (0, 1), after) if price < 10_000 else ((0, 0), (0, 1), (3, 0))
        assert AngleTablePenalty().measure(naive.packed([path], 7), ROOM)[0] == price
    beyond = naive.packed([((0, 0), (0, 2), (1, 2))], 7)  # a step that the printed table does not know
    assert AngleTablePenalty(reading="as-printed").measure(beyond, ROOM)[0] == 10_000


def test_penalties_add_up_and_short_paths_have_none():
    zigzag = [(0, 0), (1, 1), (1, 2), (2, 3), (2, 4)]
    values = AngleTablePenalty(base=1.0).measure(naive.packed([zigzag, [(0, 0)], [(0, 0), (1, 1)]], 7), ROOM)
    assert values.tolist() == [31.0, 1.0, 1.0]


def test_fitness_is_a_over_length_plus_b_over_penalty_with_a_floor():
    planner = pl.compose("ga-hga-aco")
    deme = planner.evaluate(naive.packed([STRAIGHT, ROUND, [(0, 0), (0, 1), (1, 2), (0, 2)]], 7), ROOM)
    root = math.sqrt(2)
    # straight on Σw = 0, which counts as 1; one right angle; 135° and 45°
    assert deme.fitness == pytest.approx([1 / 2 + 7 / 1, 1 / (2 * root) + 7 / 100, 1 / (2 + root) + 7 / 10_010])
    shifted = pl.compose(
        planner, objectives={"length": 1.0, "bends": {"use": "angle-table-penalty", "base": 1.0, "weight": 7}}
    )
    assert shifted.evaluate(naive.packed([ROUND], 7), ROOM).fitness[0] == pytest.approx(1 / (2 * root) + 7 / 101)


def test_as_printed_the_second_term_is_next_to_nothing():
    planner = pl.compose("ga-hga-aco")
    path = [(6 - k, k) for k in range(7)]
    problem = on(np.zeros((7, 7), bool))
    values = AngleTablePenalty(reading="as-printed").measure(naive.packed([path], 7), problem)
    assert WeightedReciprocals().combine(np.array([[8.5, values[0]]]), np.array([1.0, 7.0])) == pytest.approx(
        1 / 8.5, rel=2e-3
    )
    assert planner.objectives.weights.tolist() == [1.0, 7.0]


def test_the_mean_turn_is_0_straight_on_and_greatest_there_as_printed():
    rows = naive.packed([STRAIGHT, ROUND, [(0, 0)]], 7)
    assert MeanTurnAngle().measure(rows, ROOM) == pytest.approx([0.0, math.pi / 2 / 2, 0.0])
    assert MeanTurnAngle(reading="as-printed").measure(rows, ROOM) == pytest.approx([math.pi / 2, math.pi / 4, 0.0])


# Genetic operators ------------------------------------------------------------------------------


def test_walks_always_arrive_even_out_of_a_pocket():
    grid = ("........", ".####...", "....#...", ".####...", "........")
    problem = on([[glyph == "#" for glyph in line] for line in grid], "strict", start=(2, 0), goal=(2, 7))
    for pull in (0.0, 2.0, 50.0):
        paths = naive.unpacked(GuidedWalk(pull=pull).sample(problem, 20, np.random.default_rng(0)), 8)
        assert len(paths) == 20
        assert all(naive.path_free(problem.context.occupied, p, "strict") and len(set(p)) == len(p) for p in paths)


def test_the_stronger_the_pull_the_shorter_the_walks():
    problem = on(np.zeros((20, 20), bool))
    means = []
    for pull in (0.5, 1.0, 2.0, 10.0):
        found = GuidedWalk(pull=pull).sample(problem, 200, np.random.default_rng(1))
        means.append(pl.compiled.measures.lengths(found, 20).mean())
    assert means == sorted(means, reverse=True)
    assert means[-1] == pytest.approx(19 * math.sqrt(2), rel=0.01)


MOTHER = ((0, 0), (0, 1), (0, 2), (0, 3), (0, 4), (1, 5), (2, 6))
MEETS_HER = ((0, 0), (1, 1), (1, 2), (0, 3), (1, 4), (2, 5), (2, 6))
APART = ((0, 0), (1, 0), (2, 1), (2, 2), (2, 3), (2, 4), (2, 5), (2, 6))
FAR = on(np.zeros((7, 7), bool), start=(0, 0), goal=(2, 6))


def test_parents_with_a_gene_in_common_are_cut_there():
    found = SinglePointGeneAware().cross(
        naive.packed([MOTHER, MEETS_HER], 7), np.array([[0, 1]]), FAR, np.random.default_rng(0)
    )
    assert naive.unpacked(found, 7) == [MOTHER[:3] + MEETS_HER[3:], MEETS_HER[:3] + MOTHER[3:]]


def in_common(one, other):
    """How many cells two paths have in common from the beginning."""
    pairs = zip(one, other, strict=False)
    return next((k for k, (a, b) in enumerate(pairs) if a != b), min(len(one), len(other)))


def test_parents_without_are_cut_at_a_position_and_joined():
    parents, seen = [MOTHER, APART], set()
    for seed in range(40):
        with counting() as counts:
            found = SinglePointGeneAware().cross(
                naive.packed(parents, 7), np.array([[0, 1]]), FAR, np.random.default_rng(seed)
            )
        assert counts == {}
        for child, (head, tail) in zip(naive.unpacked(found, 7), (parents, parents[::-1]), strict=True):
            assert naive.steps_singly(child)
            assert (child[0], child[-1]) == ((0, 0), (2, 6))
            heads, tails = in_common(child, head), in_common(child[::-1], tail[::-1])
            assert heads >= 2  # a cut is never before the first gene between the ends
            assert tails >= 1
            seen.add(heads)
    assert len(seen) > 3


def test_pairs_of_both_kinds_are_crossed_at_once_and_others_left_alone():
    rows = naive.packed([MOTHER, MEETS_HER, MOTHER, APART, APART], 7)
    found = SinglePointGeneAware().cross(rows, np.array([[0, 1], [3, 2]]), FAR, np.random.default_rng(3))
    paths = naive.unpacked(found, 7)
    assert paths[0] == MOTHER[:3] + MEETS_HER[3:]
    assert paths[4] == APART
    assert paths[3] != APART


def test_of_two_mutants_the_shorter_one_is_kept_where_fitness_is_unknown():
    problem = on("random-20:75:s0")
    paths = GuidedWalk(pull=0.7).sample(problem, 40, np.random.default_rng(0))
    mutation, chosen = TwoWayReverseSearch(), np.arange(0, 40, 3)
    both = mutation.both(paths, chosen, problem, np.random.default_rng(5))
    found = mutation.apply(paths, chosen, problem, np.random.default_rng(5))
    lengths = [pl.compiled.measures.lengths(np.ascontiguousarray(p), 20) for p in (*both, found[chosen])]
    assert lengths[2].tolist() == np.minimum(*lengths[:2]).tolist()
    old, first, second = (naive.unpacked(p, 20) for p in (paths[chosen], *both))
    assert found.shape[1] >= paths.shape[1]
    for path, to_start, from_goal in zip(old, first, second, strict=True):
        kept = next((k for k in range(1, len(path)) if to_start[-k:] != path[-k:]), len(path)) - 1
        gene = len(path) - kept
        assert from_goal[: gene - 1] == path[: gene - 1] or gene < 2
        assert 0 < gene < len(path) - 1 or to_start == path
    untouched = np.setdiff1d(np.arange(40), chosen)
    assert naive.unpacked(found[untouched], 20) == naive.unpacked(paths[untouched], 20)


# Competition ------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class ByColumn(pl.Objective):
    """The column of the path's second cell, which is all there is to judge by."""

    def measure(self, population, problem):
        return 1.0 + population[:, 1] % 7


@dataclass(frozen=True, kw_only=True)
class Exchange(pl.Crossover):
    """Children as they are told."""

    children: tuple[int, int] = (0, 0)

    def cross(self, population, pairs, problem, rng):
        out = population.copy()
        for x, y in pairs:
            out[x, 1], out[y, 1] = self.children
        return out


def second_cells(seconds):
    return np.array([[0, second, 48] for second in seconds], np.int32)


def advanced(seconds, control=None, seed=0, **slots):
    planner = pl.compose(
        "ga-hga-aco", population=len(seconds), objectives={"column": ByColumn()}, fitness="reciprocal-of-sum",
        selection="keep-all", pairing="consecutive-pairs", control=control or FamilyCompetition(), **slots,
    )  # fmt: skip
    with counting() as counts:
        deme = planner.evaluate(second_cells(seconds), ROOM)
        before = counts.pop("evaluations")
        found = planner.control.advance(planner, State(ROOM, {}, demes=(deme,)), 0, np.random.default_rng(seed))
    assert before == len(seconds)
    return found, counts.get("evaluations", 0)


@pytest.mark.parametrize(
    ("parents", "children", "stay"),
    [
        ((3, 5), (1, 2), {1, 2}),  # both children are fitter
        ((3, 5), (4, 6), {3, 4}),  # one parent, one child
        ((3, 5), (6, 6), {3, 5}),  # both parents
        ((3, 5), (3, 4), {3, 4}),  # two of the same are not the best two
        ((3, 3), (3, 3), {3}),  # unless there is nobody else
        ((5, 3), (5, 3), {3, 5}),  # children like their parents change nothing
    ],
)
def test_the_best_two_different_ones_of_a_family_go_on(parents, children, stay):
    found, evaluations = advanced(parents, crossover=Exchange(rate=1.0, children=children), mutation="none")
    assert set(found.population[:, 1].tolist()) == stay
    assert found.fitness.tolist() == (1 / found.values[:, 0]).tolist()
    assert evaluations == 2


def test_families_do_not_mix():
    found, evaluations = advanced((3, 5, 1, 6, 2), crossover=Exchange(rate=1.0, children=(4, 4)), mutation="none")
    seconds = found.population[:, 1].tolist()
    assert (set(seconds[:2]), set(seconds[2:4]), seconds[4]) == ({3, 4}, {1, 4}, 2)
    assert evaluations == 4


@dataclass(frozen=True, kw_only=True)
class ToldMutants(TwoWayReverseSearch):
    """Mutants as they are told."""

    mutants: tuple[int, int] = (0, 0)

    def both(self, population, chosen, problem, rng):
        return tuple(second_cells([second] * len(chosen)) for second in self.mutants)


def test_the_fitter_mutant_takes_the_place_even_of_a_fitter_individual():
    for mutants in ((4, 5), (5, 4)):
        found, evaluations = advanced((3, 6), crossover="none", mutation=ToldMutants(rate=1.0, mutants=mutants))
        assert found.population[:, 1].tolist() == [4, 4]
        assert evaluations == 4
        found, _ = advanced(
            (3, 6), FamilyCompetition(worse=False), crossover="none", mutation=ToldMutants(rate=1.0, mutants=mutants)
        )
        assert found.population[:, 1].tolist() == [3, 4]


@dataclass(frozen=True, kw_only=True)
class Told(pl.Mutation):
    """One mutant as it is told."""

    def apply(self, population, chosen, problem, rng):
        out = population.copy()
        out[chosen, 1] = 6
        return out


def test_another_mutation_and_a_repair_find_their_place():
    @dataclass(frozen=True, kw_only=True)
    class ToTwo(pl.Repair):
        def apply(self, population, problem, rng):
            return np.where(population == 6, 2, population).astype(np.int32)

    found, evaluations = advanced((3, 5), crossover="none", mutation=Told(rate=1.0))
    assert (found.population[:, 1].tolist(), evaluations) == ([6, 6], 2)
    found, _ = advanced((3, 5), crossover="none", mutation=Told(rate=1.0), repair=ToTwo())
    assert found.population[:, 1].tolist() == [2, 2]
    found, evaluations = advanced((3, 5), crossover="none", mutation="none")
    assert (found.population[:, 1].tolist(), evaluations) == ([3, 5], 0)


# Fusion, eq. (28) -------------------------------------------------------------------------------

COLONY = pl.compose("hga-aco").colony


def test_the_best_paths_are_laid_to_and_fro():
    laid = GaPheromoneSeed(share=0.5, phi=3.0, base=0.01).lay(COLONY, ROOM, deme_of(ROUND, STRAIGHT))
    assert laid[0, SOUTH_EAST] == laid[8, 7] == pytest.approx(3.0 / (2 * math.sqrt(2) * math.sqrt(2)))
    assert laid[0, EAST] == laid[1, WEST] == laid[48, EAST] == 0.01
    both = GaPheromoneSeed(share=1.0, phi=3.0, base=0.01).lay(COLONY, ROOM, deme_of(ROUND, STRAIGHT))
    assert both[0, EAST] == pytest.approx(3.0 / 2.0)


def test_a_step_that_several_paths_take_bears_the_most_or_the_sum():
    paths = deme_of(STRAIGHT, ((0, 0), (0, 1), (1, 2), (0, 2)))
    lengths = 2.0, 2.0 + math.sqrt(2)
    for overlap, value in (("max", 1 / lengths[0]), ("sum", 1 / lengths[0] + 1 / lengths[1])):
        assert GaPheromoneSeed(share=1.0, overlap=overlap, base=0.01).lay(COLONY, ROOM, paths)[
            0, EAST
        ] == pytest.approx(value)


def test_other_steps_bear_the_least_of_the_max_min_ant_system():
    laid = GaPheromoneSeed(base="cells").lay(COLONY, ROOM, deme_of(STRAIGHT))
    assert laid[48, EAST] == pytest.approx(1 / (0.3 * 2.0) / (2 * 49))
    least, _ = COLONY.pheromone.limits(marched(best=STRAIGHT))
    assert GaPheromoneSeed().lay(COLONY, ROOM, deme_of(STRAIGHT))[48, EAST] == pytest.approx(least)


def test_at_least_one_path_is_laid_and_without_any_all_steps_are_alike():
    assert (GaPheromoneSeed(share=0.0, base=0.01).lay(COLONY, ROOM, deme_of(STRAIGHT))[0, EAST]) == pytest.approx(0.5)
    nobody = pl.Deme(np.empty((0, 1), np.int32), np.empty((0, 1)), np.empty(0))
    assert (GaPheromoneSeed().lay(COLONY, ROOM, nobody) == 1.0).all()
    assert (GaPheromoneSeed(base=0.2).lay(COLONY, ROOM, nobody) == 0.2).all()


def test_long_segments_are_laid_cell_by_cell():
    laid = GaPheromoneSeed(base=0.01).lay(COLONY, ROOM, deme_of(((0, 0), (0, 2))))
    assert laid[0, EAST] == laid[1, EAST] == pytest.approx(0.5)


# Pheromone update, eqs. (31) to (34) ------------------------------------------------------------


@pytest.mark.parametrize("progress", [0.0, 0.25, 1.0])
def test_the_two_best_paths_share_the_deposit_by_the_used_budget(progress):
    update = TwoBest(rho=0.3, least="none")
    found = update.update(marched(WIDE, ROUND, best=STRAIGHT), progress)
    assert found[0, EAST] == pytest.approx(0.7 + progress / 2.0)  # A / (N_c D_g)
    assert found[0, SOUTH_EAST] == pytest.approx(0.7 + (1 - progress) / (2 * math.sqrt(2)))  # B / (N_c D_n)
    assert found[0, 4] == pytest.approx(0.7)  # (34): the poorer path of the iteration only evaporates


def test_a_path_that_is_best_of_both_leaves_both_parts():
    found = TwoBest(rho=0.3, q=3.0, least="none").update(marched(STRAIGHT, ROUND, best=STRAIGHT), 0.25)
    assert found[0, EAST] == pytest.approx(0.7 + 3.0 / 2.0)


def test_where_nobody_arrived_the_best_of_all_leaves_its_part():
    update = TwoBest(rho=0.3, least="none")
    assert update.update(marched(best=STRAIGHT), 0.25)[0, EAST] == pytest.approx(0.7 + 0.25 / 2.0)
    assert (update.update(marched(), 0.25) == 0.7).all()
    assert TwoBest().limits(marched()) == (0.0, math.inf)


def test_pheromone_keeps_within_the_limits_of_the_best_path():
    most = 1 / (0.3 * 2.0)
    found = TwoBest(least="cells").update(marched(STRAIGHT, best=STRAIGHT, pheromone=np.full((49, 8), 9.0)), 0.5)
    assert (found == most).all()
    found = TwoBest(least="cells").update(marched(STRAIGHT, best=STRAIGHT, pheromone=np.zeros((49, 8))), 0.5)
    assert found[48, EAST] == pytest.approx(most / (2 * 49))


def test_the_weight_shifts_from_the_iteration_to_the_best_of_all_as_the_colony_goes_on():
    shares = []

    @dataclass(frozen=True, kw_only=True)
    class Witness(TwoBest):
        def deposits(self, state, progress):
            shares.append(progress)
            return super().deposits(state, progress)

    run(on("iga-map1"), pl.compose(short(3), colony={"pheromone": Witness(), "termination": "max-generations"}), 0)
    assert shares == pytest.approx([k / 50 for k in range(51)])


def test_as_printed_a_diagonal_is_eleven_times_less_desirable():
    eta = EdgeLength().desirability(ROOM)
    assert (eta[0, EAST] / eta[0, SOUTH_EAST]) ** 7 == pytest.approx(11.3, abs=0.02)


# Deadlock, eq. (35) -----------------------------------------------------------------------------


def stuck_in(*cells, **more):
    stuck = np.zeros(49, np.int32)
    for cell, ants in cells:
        stuck[cell] = ants
    return marched(STRAIGHT, stuck=stuck, **more)


def test_pheromone_into_a_dead_angle_is_cut():
    table = DeadAngleTable(penalty=0.25, times=1)
    _, pheromone = table.learn(stuck_in((16, 3)), np.full((49, 8), 2.0))
    assert pheromone[15, EAST] == pheromone[8, SOUTH_EAST] == pheromone[17, WEST] == 0.5
    assert pheromone[16].tolist() == [2.0] * 8  # the steps out of it
    untouched = np.ones((49, 8))
    assert table.learn(marched(STRAIGHT), untouched)[1] is untouched


def test_a_cell_is_closed_after_so_many_ants():
    table = DeadAngleTable(times=4)
    memory, _ = table.learn(stuck_in((16, 3)), np.ones((49, 8)))
    assert table.closed(memory).sum() == 0
    memory, _ = table.learn(stuck_in((16, 1), (24, 9), table=memory), np.ones((49, 8)))
    assert np.flatnonzero(table.closed(memory)).tolist() == [16, 24]
    memory, _ = table.learn(stuck_in(table=memory), np.ones((49, 8)))
    assert np.flatnonzero(table.closed(memory)).tolist() == [16, 24]  # it stays


def test_cells_that_somebody_came_through_are_spared_or_not():
    for spare, closed in ((True, []), (False, [1])):
        memory, _ = DeadAngleTable(times=1, spare=spare).learn(stuck_in((1, 5)), np.ones((49, 8)))
        assert np.flatnonzero(DeadAngleTable(times=1).closed(memory)).tolist() == closed


def test_the_table_is_cleared_where_it_would_close_every_way_or_every_so_often():
    table = DeadAngleTable(times=1, spare=False)
    with counting() as counts:
        memory, _ = table.learn(stuck_in((1, 1), (7, 1), (8, 1)), np.ones((49, 8)))  # all around the start
    assert (memory.sum(), counts) == (0, {"dead-angle table cleared": 1})
    often = replace(table, every=3)
    memories = [often.learn(stuck_in((16, 1), generation=g), np.ones((49, 8)))[0].sum() for g in range(4)]
    assert memories == [1, 1, 0, 1]


def test_what_the_table_counts_is_in_the_state():
    wall = np.zeros((3, 3), bool)
    wall[:, 1] = True
    apart = on(wall, start=(0, 0), goal=(0, 2))
    state = run(apart, pl.compose("hga-aco", colony={"deadlock": {"times": 1}}).colony, 0).state
    assert state.counts == {"ants lost": 101 * 50, "dead-angle table cleared": 101}


def test_no_ant_enters_a_closed_cell():
    problem = on("random-20:75:s0")
    colony = pl.compose("hga-aco").colony
    state = colony.start(problem, first_generator(0))
    middle = int(state.population[0][10])
    table = np.zeros(400, np.int32)
    table[middle] = 10
    assert (colony.step(replace(state, table=table)).population != middle).all()
    assert (colony.step(state).population == middle).any()


def test_ants_may_die_in_dead_angles():
    assert DeadAngleTable().retreats
    assert not DeadAngleTable(stuck="die").retreats


# The hybrid -------------------------------------------------------------------------------------


def states_of(planner, problem=None, seed=1):
    return list(pl.iterate(problem or on("random-12:20:s1"), planner, seed=seed))


def test_both_phases_are_in_history_and_budget():
    states = states_of(short(5, 4))
    assert [s.colony is None for s in states] == [True] * 6 + [False] * 5
    last = states[-1]
    assert last.evaluations == last.genetic.evaluations + last.colony.evaluations
    assert last.colony.evaluations == sum(len(s.population) for s in states[6:])
    assert [s.generation for s in states] == list(range(11))
    assert len(last.history.best) == 11
    assert last.history.evaluations == tuple(s.evaluations for s in states)
    progress = [short(5, 4).progress(s) for s in states]
    assert progress == sorted(progress)
    assert (progress[0], progress[5], progress[6], progress[-1]) == (0.0, 0.5, 0.5, 1.0)


def test_fitness_is_the_colonys_in_both_phases():
    for state in states_of(short(3, 3)):
        lengths = pl.compiled.measures.lengths(state.population, 12)
        assert state.fitness == pytest.approx(1 / lengths)
        assert 1 / state.best.fitness <= lengths.min() + 1e-9
    bends = pl.compose(
        short(3, 3), genetic={"objectives": {"turns": 1.0}}
    )  # the GA does not measure what the colony does
    for state in states_of(bends):
        assert state.fitness == pytest.approx(1 / pl.compiled.measures.lengths(state.population, 12))
    assert states_of(bends)[-1].evaluations == states_of(bends)[-1].genetic.evaluations + 4 * 12


def test_the_colony_finds_pheromone_of_the_fittest_fifth():
    planner = short(4, 0 + 1)
    states = states_of(planner)
    last = states[4].genetic
    known = planner._known(last)
    ranked = last.population[np.argsort(-last.fitness, kind="stable")]
    assert known.population.tolist() == ranked.tolist()
    assert known.fitness == pytest.approx(1 / pl.compiled.measures.lengths(ranked, 12))
    laid = planner.colony.initial.lay(planner.colony, states[0].problem, known)
    seeded = {(a, b) for row in naive.unpacked(ranked[:2], 12) for a, b in pairwise(row)}
    strong = np.argwhere(laid > laid.min() * (1 + 1e-9))
    pairs = {
        (divmod(int(c), 12), (int(c) // 12 + naive.STEPS[d][0], int(c) % 12 + naive.STEPS[d][1])) for c, d in strong
    }
    assert pairs == seeded | {(b, a) for a, b in seeded}


def test_the_answer_is_of_both_phases_or_of_the_colony():
    problem = on("random-40:15%", "strict")
    spoilt = {"initial": "uniform", "heuristic": "edge-length", "ants": 3, "deadlock": "die"}
    both, alone = (short(20, 2, answer=answer) for answer in ("both", "colony"))
    both, alone = (pl.compose(p, colony=spoilt) for p in (both, alone))
    ends = [run(problem, p, 1) for p in (both, alone)]
    assert ends[0].state.best.generation <= 20
    assert ends[0].outcome.solution is not None
    assert ends[1].state.colony.best is None or ends[1].state.best.generation > 20
    nobody = pl.compose(alone, colony={"heuristic": "goal-distance", "beta": 900.0, "ants": 1})
    pocket = ("........", ".####...", "....#...", ".####...", "........")
    trap = on([[glyph == "#" for glyph in line] for line in pocket], "strict", start=(2, 0), goal=(2, 7))
    finished = run(trap, nobody, 0)
    assert finished.outcome.solution is None
    assert finished.outcome.reason == "none of 3 ants arrived: each came to a cell with no way on"
    early = states_of(nobody, trap)[3]
    assert nobody.result(early).solution is not None  # as long as the colony has not set out


def test_a_budget_of_both_phases_is_shared():
    for share in (0.25, 0.5, 1.0):
        planner = pl.compose("hga-aco", share=share, termination=[{"use": "max-evaluations", "limit": 2000}])
        state = run(on("iga-map1"), planner, 0).state
        assert 2000 <= state.evaluations < 2100
        if share < 1.0:
            assert share * 2000 <= state.genetic.evaluations < share * 2000 + 100
        else:
            assert state.colony is None


def test_any_evolution_and_any_colony_make_a_hybrid():
    problem = on("blocks-12:20%:s3", "strict")
    stop = {"termination": [{"use": "max-generations", "limit": 4}]}
    for genetic in ("imga", "iga", "agacd", "mpmga"):
        for colony in ("aco", "aco-hga-aco"):
            planner = pl.compose(
                "hga-aco",
                genetic={"use": genetic, "population": 10, **stop},
                colony={"use": colony, "initial": "ga-pheromone-seed", **stop},
            )
            assert pl.plan(problem, planner, seed=2).found


def test_where_the_genetic_algorithm_finds_nobody_the_ants_go_alone():
    maze = on("maze-21:1:s1", "strict")
    lost = {"sampling": {"use": "median-insertion", "tries": 3}}
    planner = pl.compose(short(5, 3), genetic=lost, colony={"deadlock": "retreat"})
    state = run(maze, planner, 0).state
    assert len(state.genetic.population) == 0
    assert state.generation == 4
    assert state.best is not None
    assert state.counts["samples failed"] == 3


def test_seeding_saves_the_colony_its_first_iterations():
    problems = [on(f"random-20:75:s{k}") for k in range(4)]
    found = []
    for initial in ("ga-pheromone-seed", "uniform"):
        planner = pl.compose("hga-aco", colony={"initial": initial})
        runs = [run(problem, planner, seed).state.colony.best for problem in problems for seed in range(3)]
        found.append(np.mean([best.generation for best in runs]))
    assert found[0] < 0.6 * found[1]


def test_the_plan_says_what_it_took():
    result = pl.plan(on("iga-map1"), "hga-aco", seed=1, optimum=True)
    assert result.gap["grid"] == 0.0
    assert (result.budget["generations"], result.objectives) == (201, {"length": pytest.approx(result.length)})
    assert result.fitness == pytest.approx(1 / result.length)
    assert len(result.history["best"]) == 202
    again = pl.plan(on("iga-map1"), result.config["planner"], seed=1)
    assert again.path.tolist() == result.path.tolist()


@pytest.mark.data
def test_on_the_recovered_maps_the_optimum_of_single_steps_is_found(data):
    for file, ends, optimum in (
        ("ssa_20x20.csv", ("bottom-left", "top-right"), 28.6274),
        ("ga_smooth_20x20.csv", ("top-left", "bottom-right"), 30.9706),
    ):
        problem = on(pl.load_map(data / "ga_grids" / file), start=ends[0], goal=ends[1])
        for name in ("hga-aco", "aco-hga-aco"):
            lengths = [pl.plan(problem, name, seed=seed).length for seed in range(3)]
            assert min(lengths) == pytest.approx(optimum, abs=5e-5)
