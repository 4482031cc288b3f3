"""IMAGA, statement by statement of its paper, and what it reaches on the maps that we have."""

import math
from dataclasses import dataclass
from itertools import combinations
from typing import ClassVar

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import WeightedReciprocals, measure
from pathloom.kernel.run import iterate, run
from pathloom_imaga.collision import RecursiveMidpoint
from pathloom_imaga.control import AdaptiveEvolution
from pathloom_imaga.crossover import PositionalSinglePoint
from pathloom_imaga.deletion import MidpointPointDeletion
from pathloom_imaga.libraries import libraries
from pathloom_imaga.mutation import D4GeneMedian
from pathloom_imaga.objectives import D4ObstacleCount, EnergyPerLength, TurnCount
from pathloom_imaga.planner import Imaga
from pathloom_imaga.probability import BandedAdaptive
from pathloom_imaga.sampling import RestrictedUniform
from pathloom_imaga.selection import GreedyRoulette, ThreeStage
from pathloom_imaga.step_length import FittedStep, PublishedStep
from pathloom_imaga.weighting import ReferenceScaled

TABLES = (  # tables 1 and 2: mean length, mean number of turns, energy per unit of length
    (32.0219, 14.16, 1.442), (31.0273, 8.46, 1.272), (31.5068, 5.86, 1.186), (30.2773, 6.32, 1.209),
    (28.8734, 11.04, 1.382), (28.2973, 6.50, 1.229), (27.7814, 6.04, 1.217), (27.6039, 3.00, 1.109),
)  # fmt: skip


@pytest.fixture
def empty():
    return pl.PathProblem(pl.load_map("empty-10"), corners="allow")


def rng(seed=0):
    return np.random.default_rng(seed)


# Sampling, section 2.1 --------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "N", "k"), [("imaga-fig1", 17, 9), ("random-20:75", 37, 19), ("empty-10", 17, 9)])
def test_from_corner_to_corner_there_are_half_as_many_libraries_as_diagonals(name, N, k):
    problem = pl.PathProblem(pl.load_map(name))
    found = libraries(problem.context)
    rows, cols = problem.grid.shape
    assert (rows + cols - 3, math.ceil(N / 2), len(found)) == (N, k, k)
    assert sum(map(len, found)) == problem.grid.free_count - 2  # all free cells but start and goal
    assert set((found[-1] // cols - found[-1] % cols).tolist()) == {2 - cols}  # N is odd: one diagonal is left


@given(problem=naive.problems(9))
@examples(120)
def test_a_library_is_two_lines_across_the_way_wherever_it_leads(problem):
    (r0, c0), (r1, c1) = problem.ends
    found = [set(cells.tolist()) for cells in libraries(problem.context)]
    expected = {}
    for r, c in naive.free_cells(problem.context.occupied):
        ahead = ((r1 > r0) - (r1 < r0)) * (r - r0) + ((c1 > c0) - (c1 < c0)) * (c - c0)
        if 0 < ahead < abs(r1 - r0) + abs(c1 - c0):
            expected.setdefault((ahead + 1) // 2, set()).add(r * problem.context.cols + c)
    assert len(found) == max(abs(r1 - r0) + abs(c1 - c0), 1) // 2
    assert {number: cells for number, cells in enumerate(found, 1) if cells} == expected


def test_paths_pass_a_cell_of_every_library(empty):
    found = [set(cells.tolist()) for cells in libraries(empty.context)]
    for path in RestrictedUniform(step=4).sample(empty, 20, rng()):
        assert all(cells & set(path.tolist()) for cells in found)


def test_the_longer_the_step_the_longer_the_paths(empty):
    lengths = [
        pl.compiled.measures.lengths(RestrictedUniform(step=step).sample(empty, 100, rng()), 10).mean()
        for step in (3, 4, 6, 10)
    ]
    assert lengths == sorted(lengths)
    assert lengths[0] < 0.7 * lengths[-1]


def test_a_step_of_2_leaves_one_row_and_column_and_hardly_a_draw_succeeds():
    problem = pl.PathProblem(pl.load_map("random-20:75", corners="allow"), corners="allow")
    with counting() as counts:
        assert len(RestrictedUniform(step=2, tries=200).sample(problem, 5, rng())) == 0
    assert counts == {"samples failed": 200}


def test_the_goal_is_held_to_the_step_unless_told_otherwise():
    problem = pl.PathProblem(np.zeros((9, 9), bool), start=(4, 0), goal=(4, 8), corners="allow")
    failed = []
    for goal_in_reach in (True, False):
        with counting() as counts:
            RestrictedUniform(goal_in_reach=goal_in_reach).sample(problem, 100, rng())
        failed.append(counts.get("samples failed", 0))
    assert failed[0] > 50
    assert failed[1] == 0


def test_a_sampler_that_finds_nothing_says_so_and_may_fall_back():
    problem = pl.PathProblem(pl.load_map("maze-11:1"))
    sampling = RestrictedUniform(tries=30, fallback=pl.compose("imga", sampling="perturbed-trees").sampling)
    with counting() as counts:
        assert len(sampling.sample(problem, 6, rng())) == 6
    assert counts == {"samples failed": 30, "samples by fallback": 6}
    outcome = run(problem, Imaga(sampling=RestrictedUniform(tries=30)), 0).outcome
    assert outcome.solution is None
    assert outcome.reason == "'restricted-uniform' found no first individual in 30 tries"


@dataclass(frozen=True)
class Drawn:
    """A sampling whose paths have the lengths that a test wants."""

    lengths: dict[int, int]

    def draw(self, problem, n, step, tries, rng):
        if step not in self.lengths:
            return np.empty((0, 1), np.int32)
        return np.array([[0, self.lengths[step]]], np.int32)


def test_the_step_is_a_quadratic_of_the_length():
    problem = pl.PathProblem(np.zeros((1, 9), bool), start=(0, 0), goal=(0, 1))
    drawn = Drawn({2: 1, 4: 2, 7: 3})  # step = (x² + x) / 2 + 1
    for wanted in (1.0, 1.7, 2.0, 2.5, 3.0):
        expected = round((wanted**2 + wanted) / 2 + 1)
        assert FittedStep(stretch=wanted).step(drawn, problem, rng()) == expected
    assert FittedStep(stretch=2.5).step(drawn, problem, rng()) == 5  # on a polygon of the three points: 5.5, so 6


def test_no_step_is_guessed_beyond_the_lengths_that_were_drawn():
    problem = pl.PathProblem(np.zeros((1, 9), bool), start=(0, 0), goal=(0, 1))
    drawn = Drawn({2: 1, 4: 2, 7: 3})
    assert [FittedStep(stretch=wanted).step(drawn, problem, rng()) for wanted in (0.1, 90.0)] == [2, 7]
    assert FittedStep(stretch=1.5).step(Drawn({5: 1, 6: 2}), problem, rng()) == 5  # too few for a parabola
    assert FittedStep(stretch=1.5, largest=9).step(Drawn({}), problem, rng()) == 9


def test_the_fit_chooses_the_default_step_on_maps_like_the_papers():
    for name in ("imaga-fig1", "iga-map1", "random-20:75", "random-20:102", "blocks-50:20%"):
        problem = pl.PathProblem(pl.load_map(name, corners="allow"), corners="allow")
        assert FittedStep().step(RestrictedUniform(), problem, rng()) == RestrictedUniform().step
        assert FittedStep(stretch=1.9).step(RestrictedUniform(), problem, rng()) > RestrictedUniform().step


def test_calibration_failures_are_counted_apart_and_its_samples_do_not_count_as_failed():
    problem = pl.PathProblem(pl.load_map("random-20:102"))
    with counting() as counts:
        FittedStep().step(RestrictedUniform(), problem, rng())
    assert set(counts) == {"calibration failed"}


def test_equation_11_as_printed_never_gives_a_step():
    x = np.linspace(0, 100, 100_001)
    printed = -0.00064 * x**2 + 0.0519 * x - 0.9058
    assert printed.max() == pytest.approx(0.146, abs=5e-4)
    assert x[printed.argmax()] == pytest.approx(40.55, abs=0.01)
    problem = pl.PathProblem(np.zeros((20, 20), bool))
    assert PublishedStep(factor=1.0).step(RestrictedUniform(), problem, rng()) == 2
    assert PublishedStep(stretch=30 / math.hypot(19, 19)).step(RestrictedUniform(), problem, rng()) == 8  # 7.52


# Fitness, section 2.2 ---------------------------------------------------------------------------


@given(problem=naive.problems(), border=st.booleans(), data=st.data())
@examples(100)
def test_safety_counts_obstacles_and_the_wall_around_the_map_beside_every_node_but_the_last(problem, border, data):
    occupied = problem.context.occupied
    walled = np.pad(occupied, 1, constant_values=border)
    path = data.draw(naive.paths_on(occupied.shape))
    expected = sum(int(walled[r + 1 + dr, c + 1 + dc]) for r, c in path[:-1] for dr, dc in naive.STEPS[::2])
    population = naive.packed([path], problem.context.cols)
    assert D4ObstacleCount(border=border).measure(population, problem).tolist() == [expected]


@given(problem=naive.problems(), turn=st.integers(0, 3), length=st.integers(0, 3), data=st.data())
@examples(100)
def test_energy_is_turns_and_length_per_unit_of_length(problem, turn, length, data):
    path = data.draw(naive.paths_on(problem.context.occupied.shape))
    population = naive.packed([path], problem.context.cols, padding=2)
    T, D = naive.turns(path), naive.length(path)
    expected = (turn * T + length * D) / D if D > 0 else length
    found = EnergyPerLength(turn=float(turn), length=float(length)).measure(population, problem)
    assert found == pytest.approx([expected], rel=1e-12)
    assert TurnCount().measure(population, problem).tolist() == [T]


def test_one_and_one_are_the_weights_that_give_the_energies_of_the_tables():
    for D, T, E in TABLES:
        assert abs((1.0 * T + 1.0 * D) / D - E) < 7.5e-4
        omega = (E - T / D) / (1 - T / D)  # eq. (16) solved for ω
        assert not 0 <= omega <= 1


def test_on_the_reference_path_every_term_counts_as_much():
    for name in ("imaga-fig1", "blocks-12:20%:s3"):
        problem = pl.PathProblem(pl.load_map(name))
        planner = Imaga()
        path = pl.octile_path(problem)[1]
        values = measure(list(planner.terms.objectives()), problem.representation.encode([path]), problem)
        assert planner.fitness.combine(values, planner.weights(problem)) == pytest.approx([3.0])
        assert planner.fitness.combine(values, planner.terms.weights)[0] < 2.0


def test_a_term_keeps_its_own_weight_and_one_that_is_zero_keeps_nothing_else():
    problem = pl.PathProblem(np.zeros((1, 5), bool), start=(0, 0), goal=(0, 4))
    terms = pl.Terms({"length": (pl.compose("imaga").terms[0].objective, 3.0), "turns": (TurnCount(), 7.0)})
    weights = ReferenceScaled().weights(terms, problem)
    assert weights.tolist() == [12.0, 7.0]  # 3 times length 4; 7 where there is no turn to multiply by
    same_ends = pl.PathProblem(np.zeros((1, 5), bool), start=(0, 0), goal=(0, 0))
    assert ReferenceScaled().weights(terms, same_ends).tolist() == [3.0, 7.0]
    assert ReferenceScaled().weights(terms, problem).tolist() == [12.0, 7.0]


def test_a_path_without_obstacles_beside_it_counts_as_if_there_were_one():
    planner = Imaga()
    assert planner.fitness == WeightedReciprocals(floors=(1e-9, 1.0, 1e-9))
    fitness = planner.fitness.combine(np.array([[2.0, 0.0, 1.0], [2.0, 1.0, 1.0]]), np.array([2.0, 5.0, 1.0]))
    assert fitness.tolist() == [7.0, 7.0]


# Selection, section 2.3 -------------------------------------------------------------------------


def test_the_best_is_always_in_the_pool_and_the_others_come_by_the_wheel():
    fitness = np.concatenate(([1.001], np.ones(199)))
    pools = [GreedyRoulette().select(fitness, 200, rng(seed)) for seed in range(20)]
    assert all(len(pool) == 200 and pool[0] == 0 for pool in pools)
    assert len(set(np.concatenate(pools).tolist())) == 200
    assert GreedyRoulette().select(np.ones(1), 1, rng()).tolist() == [0]


def test_three_stages_take_the_best_twice_and_the_middle_once():
    fitness = np.array([3.0, 9.0, 1.0, 5.0, 7.0, 2.0])
    assert sorted(ThreeStage().select(fitness, 6, rng()).tolist()) == [0, 1, 1, 3, 4, 4]


# Crossover and mutation, section 2.4 ------------------------------------------------------------


def test_probabilities_adapt_in_the_outer_bands_and_jump_at_their_edges():
    fitness = np.array([0.0, 1.0 - 1e-9, 1.0 + 1e-9, 1.5, 2.0 - 1e-9, 2.0 + 1e-9, 2.5, 3.0])
    r = (3.0 - fitness) / 3.0
    crossed, mutated = (BandedAdaptive(base=base).rates(fitness, 0.5) for base in (0.8, 0.2))
    assert crossed == pytest.approx([1.0, 0.8 + 0.2 * r[1], 0.8, 0.8, 0.8, 0.8 * r[5], 0.8 * r[6], 0.0])
    assert crossed[[1, 2, 4, 5]] == pytest.approx([0.933, 0.8, 0.8, 0.267], abs=5e-4)
    assert mutated == pytest.approx([0.4, 0.2 * (1 + r[1]), 0.2, 0.2, 0.2, 0.2 * r[5], 0.2 * r[6], 0.0])


def test_where_all_are_as_fit_all_have_the_probability_of_the_middle():
    assert BandedAdaptive().rates(np.full(4, 0.3), 0.0).tolist() == [0.8] * 4
    with pytest.raises(pl.ConfigError, match="thresh"):
        BandedAdaptive(thresh=1)


def test_the_papers_example_of_crossover_exchanges_tails_behind_the_third_node():
    a, b, c, d, e, g, h = (2, 0), (2, 1), (1, 2), (1, 3), (2, 4), (2, 2), (2, 3)
    problem = pl.PathProblem(np.zeros((3, 5), bool), start=a, goal=e, corners="allow")
    population = problem.representation.encode([np.array(path) for path in ((a, b, c, d, e), (a, b, g, h, e))])
    seen = {
        tuple(naive.unpacked(PositionalSinglePoint().cross(population, np.array([[0, 1]]), problem, rng(seed)), 5))
        for seed in range(20)
    }
    behind_b, behind_c, behind_d = (
        ((a, b, g, h, e), (a, b, c, d, e)), ((a, b, c, h, e), (a, b, g, d, e)), ((a, b, c, d, e), (a, b, g, h, e)),
    )  # fmt: skip
    assert seen == {behind_b, behind_c, behind_d}


def test_a_child_that_cannot_be_joined_is_its_parent_and_is_counted():
    split = np.zeros((3, 5), bool)
    split[1, 1:4] = True
    problem = pl.PathProblem(split, start=(1, 0), goal=(1, 4), corners="allow")
    above, below = [(1, 0), (0, 1), (0, 2), (0, 3), (1, 4)], [(1, 0), (2, 1), (2, 2), (2, 3), (1, 4)]
    population = problem.representation.encode([np.array(above), np.array(below)])
    failed = 0
    for seed in range(20):
        with counting() as counts:
            children = PositionalSinglePoint().cross(population, np.array([[0, 1]]), problem, rng(seed))
        failed += counts.get("crossover failed", 0)
        if counts:
            assert children.tolist() == population.tolist()
    assert 0 < failed < 40


def test_a_node_moves_to_one_of_its_four_neighbours():
    problem = pl.PathProblem(np.zeros((3, 3), bool), start=(1, 0), goal=(1, 2), corners="allow")
    population = problem.representation.encode([np.array([(1, 0), (1, 1), (1, 2)])])
    mutants = {
        naive.unpacked(D4GeneMedian().apply(population, np.array([0]), problem, rng(k)), 3)[0] for k in range(20)
    }
    assert mutants == {((1, 0), (0, 1), (1, 2)), ((1, 0), (2, 1), (1, 2))}


# Adaptive evolution, section 2.5 ----------------------------------------------------------------


def generations(planner, problem, seed=0):
    """Evaluations and gain of the best fitness in each generation."""
    history = list(iterate(problem, planner, seed))[-1].history
    return np.diff(history.evaluations), np.diff(history.generation_best)


@pytest.fixture(scope="module")
def obstacles():
    return pl.PathProblem(pl.load_map("random-20:75", corners="allow"), corners="allow")


def test_a_generation_that_has_not_improved_is_repeated_and_one_that_has_is_not(obstacles):
    spent, gain = generations(pl.compose("imaga"), obstacles)
    assert (gain >= 0).all()  # the best is never lost
    assert (spent[gain == 0] == 100 * (1 + AdaptiveEvolution().threshold)).all()
    assert (spent[gain > 0] <= 400).all()
    assert (spent[gain > 0] == 100).any()
    assert set(spent.tolist()) == {100, 200, 300, 400}


def test_without_repetitions_adaptive_evolution_is_an_ordinary_generation(obstacles):
    ordinary, none = (pl.compose("imaga", control=c) for c in ("generational", AdaptiveEvolution(threshold=0)))
    assert run(obstacles, ordinary, 5).state.history == run(obstacles, none, 5).state.history


def test_equation_23_as_printed_never_repeats_since_the_best_is_in_the_pool_and_never_varied(obstacles):
    spent, _ = generations(pl.compose("imaga", control={"judge": "worse"}), obstacles)
    assert set(spent.tolist()) == {100}


def test_a_best_child_that_is_worse_is_seen_before_the_elite_is_put_back_and_not_after(obstacles):
    worse = {"judge": "worse", "threshold": 2}
    careless = {"mutation": D4GeneMedian(rate=1.0), "selection": "roulette"}
    before, after = (
        generations(pl.compose("imaga", control=worse | {"elite": elite}, **careless), obstacles)[0]
        for elite in ("after", "before")
    )
    assert set(before.tolist()) > {100}
    assert set(after.tolist()) == {100}


@dataclass(frozen=True, kw_only=True)
class Noting(ThreeStage):
    """Selection by stages that notes among whom it selects."""

    seen: ClassVar[list[list[float]]] = []

    def select(self, fitness, n, rng):
        self.seen.append(fitness.tolist())
        return super().select(fitness, n, rng)


def test_each_repetition_selects_among_the_children_of_the_one_before(obstacles):
    planner = Imaga(control=AdaptiveEvolution(selection=Noting()))
    last = run(obstacles, planner, 1).state
    Noting.seen.clear()
    following = planner.step(last)
    parents, *children = [sorted(f) for f in (last.fitness.tolist(), *Noting.seen, following.fitness.tolist())]
    assert len(children) == 4
    assert all(one != other for one, other in combinations([parents, *children], 2))


# Deletion, section 2.6 --------------------------------------------------------------------------


def test_by_midpoints_map_1_of_iga_has_a_way_shorter_than_any():
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    cells = np.array(naive.free_cells(problem.context.occupied))

    def edges(cell):
        seen = RecursiveMidpoint().segments_free(np.broadcast_to(cell, cells.shape), cells, problem)
        return ((tuple(c), math.dist(c, cell)) for c in cells[seen].tolist() if tuple(c) != cell)

    shortest = naive.dijkstra(problem.ends[0], edges)[problem.ends[1]]
    assert (round(shortest, 3), round(pl.any_angle_path(problem)[0], 3)) == (13.476, 13.79)


def test_points_that_the_midpoint_test_should_have_kept_are_put_back(obstacles):
    population = RestrictedUniform().sample(obstacles, 50, rng())
    decode = obstacles.representation.decode
    cut, mended = (MidpointPointDeletion(restore=r).apply(population, obstacles, rng()) for r in (False, True))
    assert sum(pl.validate(decode(row), obstacles) is not None for row in cut) > 25
    assert all(pl.validate(decode(row), obstacles) is None for row in mended)
    with counting() as counts:
        MidpointPointDeletion().apply(population, obstacles, rng())
    assert set(counts) == {"points restored"}


# The planner, sections 2.7 and 3 ----------------------------------------------------------------


@given(problem=naive.problems(9).filter(lambda problem: problem.reachable), seed=st.integers(0, 99))
@examples(40)
def test_the_planner_answers_with_a_legal_path_or_says_why_it_cannot(problem, seed):
    planner = Imaga(
        population=9, termination=pl.compose("imaga", termination=[{"use": "max-generations", "limit": 3}]).termination
    )
    outcome = run(problem, planner, seed).outcome
    if outcome.solution is None:
        assert "found no first individual" in outcome.reason
    else:
        assert pl.validate(problem.representation.decode(outcome.solution), problem) is None


def test_the_planner_finds_the_any_angle_optimum_of_both_printed_maps():
    for name in ("imaga-fig1", "iga-map1"):
        problem = pl.PathProblem(pl.load_map(name), corners="allow")
        best = min(pl.plan(problem, "imaga", seed=s).length for s in range(5))
        assert best == pytest.approx(pl.any_angle_path(problem)[0])


def figures(problem, seeds, **slots):
    """Length and number of turns of the answer for each seed."""
    planner = pl.compose("imaga", **slots)
    answers = np.stack([_answer(problem, planner, seed) for seed in seeds])
    return answers[:, 0], answers[:, 1]


def _answer(problem, planner, seed):
    row = run(problem, planner, seed).outcome.solution[np.newaxis]
    return pl.compiled.measures.lengths(row, 20)[0], pl.compiled.measures.turns(row, 20)[0, 0]


@pytest.fixture(scope="module")
def map_102(data):
    return pl.PathProblem(pl.load_map(data / "ga_grids" / "ssa_20x20.csv"), corners="allow")


@pytest.fixture(scope="module")
def map_75(data):
    grid = pl.load_map(data / "ga_grids" / "ga_smooth_20x20.csv")
    return pl.PathProblem(grid, start="top-left", goal="bottom-right", corners="allow")


@pytest.mark.data
def test_table_2_is_reached(map_102):
    lengths, turns = figures(map_102, range(15))
    assert lengths.min() <= 27.5156
    assert lengths.mean() <= 27.6039
    assert turns.mean() <= 4
    assert ((turns + lengths) / lengths).mean() == pytest.approx(1.109, abs=1e-3)


@pytest.mark.data
def test_table_1_is_reached(map_75):
    lengths, turns = figures(map_75, range(25))
    assert lengths.min() <= 29.6897
    assert lengths.mean() <= 30.2773
    assert turns.mean() == pytest.approx(7.0, abs=0.3)  # the paper has 6.32 on paths that are longer by 1 %


@pytest.mark.data
def test_with_the_midpoint_test_alone_paths_come_out_that_are_shorter_than_any(map_75, map_102):
    for problem, printed in ((map_75, 29.6896), (map_102, 27.5155)):
        unmended = {"use": "imaga/midpoint-point-deletion", "restore": False}
        lengths, _ = figures(problem, range(3), refinement=unmended)
        assert lengths.min() < pl.any_angle_path(problem)[0] - 0.1 < printed


@pytest.mark.data
def test_with_its_points_put_back_the_printed_length_is_out_of_reach(map_75):
    lengths, _ = figures(map_75, range(3), refinement="imaga/midpoint-point-deletion")
    assert lengths.min() > 30.2773


@pytest.mark.data
def test_the_fittest_path_instead_of_the_shortest_is_not_the_papers(map_75, map_102):
    for problem, mean in ((map_75, 30.2773), (map_102, 27.6039)):
        lengths, _ = figures(problem, range(10), archive="none")
        assert lengths.min() > mean


@pytest.mark.data
def test_sampling_and_deletion_alone_do_as_well_so_that_the_lengths_say_nothing_of_evolution(map_75):
    planner = Imaga()
    alone = []
    for seed in range(10):
        drawn = planner.sampling.sample(map_75, 900, rng(seed))
        alone.append(pl.compiled.measures.lengths(planner.refinement.apply(drawn, map_75, rng()), 20).min())
    assert np.mean(alone) < figures(map_75, range(10))[0].mean()
