"""AGACD, statement by statement of its paper, and what it reaches on the maps that we have."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.run import run
from pathloom.paths.collision import Exact
from pathloom_agacd.collision import LinearTrial
from pathloom_agacd.crossover import SinglePoint
from pathloom_agacd.deletion import SequentialPointDeletion
from pathloom_agacd.fitness import ShiftedReciprocals
from pathloom_agacd.mutation import SingleGene
from pathloom_agacd.objectives import NeighbourPenaltyOnce, TurnAngleSum
from pathloom_agacd.planner import Agacd
from pathloom_agacd.probability import ExponentialFall, ExponentialRise
from pathloom_agacd.repair import DropColliding
from pathloom_agacd.sampling import GoalBiasedGreedyWalk
from pathloom_agacd.weighting import DelphiRatio


@dataclass(frozen=True, kw_only=True)
class InPython(LinearTrial):
    """The same test in a class of its own, which the kernels do not know."""


def drawn(*rows, corners="allow", **ends):
    return pl.PathProblem(np.array([[glyph == "#" for glyph in row] for row in rows]), corners=corners, **ends)


def random_map(obstacles, seed=0, size=20, corners="allow"):
    return pl.PathProblem(pl.load_map(f"random-{size}:{obstacles}:s{seed}", corners=corners), corners=corners)


def paths_of(population, problem):
    return [problem.representation.decode(row).tolist() for row in population]


# Section 3: collision ---------------------------------------------------------------------------


def test_the_trial_is_verified_under_the_corner_policy_and_says_how_often_it_was_wrong():
    for corners, passes in (("allow", True), ("no-squeeze", False), ("strict", False)):
        problem = drawn("#.", ".#", start=(1, 0), goal=(0, 1), corners=corners)
        assert LinearTrial(verified=False).free((1, 0), (0, 1), problem)
        with counting() as counts:
            assert LinearTrial().free((1, 0), (0, 1), problem) is passes
        assert counts == ({} if passes else {"segments refused by the exact test": 1})


def test_exact_arithmetic_takes_whole_numbers_of_samples_a_cell():
    assert LinearTrial(arithmetic="exact", step=0.05).step == 0.05
    assert LinearTrial(step=0.03).step == 0.03
    with pytest.raises(pl.ConfigError, match=r"1 / step to be an integer; got step 0\.03"):
        LinearTrial(arithmetic="exact", step=0.03)


def test_smaller_steps_miss_less():
    problem = random_map(80)
    rng = np.random.default_rng(0)
    free = np.argwhere(~problem.context.occupied)
    a, b = (free[rng.integers(len(free), size=40_000)] for _ in range(2))
    missed = {}
    for step in (0.25, 0.1, 0.01):
        with counting() as counts:
            LinearTrial(arithmetic="exact", step=step).segments_free(a, b, problem)
        missed[step] = counts.get("segments refused by the exact test", 0)
    assert missed[0.25] > missed[0.1] > missed[0.01]


# Section 4.3: the first population --------------------------------------------------------------


def test_walks_on_random_maps_have_some_55_nodes_and_nearly_all_cross_themselves():
    for obstacles, nodes in ((40, 54), (80, 55), (120, 66)):
        counts, looped, ratios = [], [], []
        for seed in range(12):
            problem = random_map(obstacles, seed)
            walks = [GoalBiasedGreedyWalk(loops=loops, steps=20_000) for loops in ("keep", "cut")]
            kept, cut = (walk.sample(problem, 60, np.random.default_rng(seed)) for walk in walks)
            counts += (kept >= 0).sum(axis=1).tolist()
            looped += [len({*map(tuple, path)}) < len(path) for path in paths_of(kept, problem)]
            ratios += (pl.compiled.measures.lengths(cut, 20) / pl.octile_path(problem)[0]).tolist()
        assert abs(np.median(counts) / nodes - 1) < 0.15
        assert np.mean(looped) > 0.98
        assert 1.2 < np.median(ratios) < 1.35  # loops cut out, against the shortest path of single steps


def test_a_wall_that_faces_the_goal_traps_walks_and_trees_take_over():
    for arm, trapped in ((3, False), (8, True)):
        blocked = np.zeros((20, 20), bool)
        blocked[8, 12 - arm : 13] = blocked[8 : 9 + arm, 12] = True
        problem = pl.PathProblem(blocked, corners="allow")
        with counting() as counts:
            population = GoalBiasedGreedyWalk().sample(problem, 60, np.random.default_rng(0))
        assert len(population) == 60
        assert all(pl.validate(path, problem) is None for path in map(np.array, paths_of(population, problem)))
        assert counts.get("samples by fallback", 0) == (60 if trapped else 0)
        assert counts.get("samples failed", 0) == (20 if trapped else 0)


def test_without_a_fallback_walks_are_repeated_and_counted():
    problem = drawn("....", ".##.", "..#.", "....", start=(1, 0), goal=(1, 3))
    sampling = GoalBiasedGreedyWalk(steps=4, tries=1, fallback=None)
    for seed in range(40):
        with counting() as counts:
            population = sampling.sample(problem, 50, np.random.default_rng(seed))
        if len(population):
            assert len(population) == 50
            assert counts["samples repeated"] == 50 - len(np.unique(population, axis=0)) or len(population[0]) > 4
            assert population[-1].tolist() in population[:-1].tolist()
            break
    else:
        pytest.fail("no walk of forty arrived")
    assert len(GoalBiasedGreedyWalk(steps=1, fallback=None).sample(problem, 5, np.random.default_rng(0))) == 0


# Section 4.4: fitness ---------------------------------------------------------------------------


def smoothness_as_printed(path):
    """Eqs. (10) to (17), with k1 = k2 in place of the garbled case of (13)."""
    points = [(c + 1.0, -float(r)) for r, c in path]
    total = 0.0
    for (x0, y0), (x1, y1), (x2, y2) in zip(points, points[1:], points[2:], strict=False):
        k1, k2 = (dy / dx if dx else math.inf for dx, dy in ((x1 - x0, y1 - y0), (x2 - x1, y2 - y1)))
        if k1 == k2:
            continue
        a1, b1, c1 = (x0 - x1) ** 2 + (y0 - y1) ** 2, (x2 - x1) ** 2 + (y2 - y1) ** 2, (x0 - x2) ** 2 + (y0 - y2) ** 2
        total += math.pi - math.acos((a1 + b1 - c1) / (2 * math.sqrt(a1) * math.sqrt(b1)))
    return total


def test_smoothness_is_the_papers_sum_and_differs_where_a_path_goes_straight_back():
    problem = pl.PathProblem(np.zeros((9, 9), bool), corners="allow")
    rng = np.random.default_rng(0)
    paths = [rng.integers(9, size=(k, 2)) for k in (1, 2, 3, 5, 8, 13) for _ in range(40)]
    paths = [path[np.r_[True, (np.diff(path, axis=0) != 0).any(axis=1)]] for path in paths]
    paths += [
        np.array(p) for p in ([(0, 0), (0, 4), (0, 2), (0, 8)], [(0, 0), (4, 4), (2, 2)], [(0, 0), (2, 2), (8, 8)])
    ]
    population = problem.representation.encode(paths)
    printed = TurnAngleSum(reading="slopes").measure(population, problem)
    assert printed == pytest.approx([smoothness_as_printed(path.tolist()) for path in paths], abs=1e-6)
    back = TurnAngleSum().measure(population, problem) - printed
    assert back[-3:] == pytest.approx([2 * math.pi, math.pi, 0.0])
    assert (back > 1).sum() > 2  # random paths have some as well


def test_safety_charges_each_obstacle_beside_a_point_once():
    problem = drawn(".....", ".##..", "...#.", ".....", start=(3, 0), goal=(0, 4))
    path = [np.array([(3, 0), (2, 1), (2, 2), (1, 3), (0, 4)])]
    straight = [np.array([(3, 0), (0, 0), (0, 4)])]
    rows = [problem.representation.encode(p) for p in (path, straight)]
    # (2, 1) and (2, 2) pass (1, 1) and (1, 2), which (1, 3) passes again; (2, 2) and (1, 3) pass (2, 3)
    assert [NeighbourPenaltyOnce().measure(row, problem).tolist() for row in rows] == [[1.3], [1.1]]
    assert NeighbourPenaltyOnce(of="cells").measure(rows[1], problem).tolist() == [1.2]


def test_the_weights_are_the_papers():
    planner = pl.compose("agacd")
    problem = drawn(".")
    assert planner.weights(problem).round(4).tolist() == [0.4118, 0.3431, 0.2451]  # eq. (25)
    weights = DelphiRatio(ratios=(1.0, 1.6, 1.2, 1.4)).weights(planner.objectives, problem)
    assert weights.sum() == pytest.approx(1.0)
    assert (weights[:-1] / weights[1:]).tolist() == pytest.approx([1.0, 1.6, 1.2, 1.4])  # eq. (21)
    assert DelphiRatio(ratios=()).weights(planner.objectives, problem).tolist() == [1.0]


def test_ratios_that_do_not_fit_the_objectives_are_refused_with_both_numbers():
    with pytest.raises(pl.ConfigError, match="one number fewer than there are objectives; got 1 for 3: length"):
        pl.compose("agacd", weighting={"ratios": [1.2]})
    with pytest.raises(pl.ConfigError, match=r"ratios is a list.*\[1, inf\)"):
        DelphiRatio(ratios=(1.2, 0.9))


def test_a_path_without_turns_counts_as_one_of_one_degree_and_the_other_readings_can_be_chosen():
    planner = pl.compose("agacd")
    problem = drawn("....", start=(0, 0), goal=(0, 3))
    straight = problem.representation.encode([np.array([(0, 0), (0, 3)])])
    w1, w2, w3 = planner.weights(problem)
    assert planner.evaluate(straight, problem).fitness == pytest.approx(w1 / 3 + w2 / math.radians(1) + w3 / 1)
    for fitness, expected in (
        (ShiftedReciprocals(), w1 / 3 + w2 / (1 + 0) + w3),
        (WeightedReciprocals(floors=(1.0, math.inf, 1.0)), w1 / 3 + w3),  # the term left out
    ):
        other = pl.compose("agacd", fitness=fitness)
        assert other.evaluate(straight, problem).fitness == pytest.approx(expected)
    no_weight = ShiftedReciprocals().combine(np.array([[0.0, 1.0]]), np.array([0.0, 2.0]))
    assert no_weight.tolist() == [1.0]  # 2 / (1 + 1), and nothing of 0 / 0


def test_fitness_values_as_printed_need_radians():
    # the best of table 5, 0.4692, on a map where no path is shorter than 27 and safety at least 1: 94 degrees in all
    w1, w2, w3 = pl.compose("agacd").weights(drawn("."))
    turned = w2 / (0.4692 - w1 / 27 - w3 / 1)
    assert math.degrees(turned) == pytest.approx(94, abs=1.5)


# Sections 4.6 and 4.7: probabilities and operators ------------------------------------------------


def test_probabilities_are_those_of_the_equations():
    fitness = np.array([1.0, 2.0, 3.0, 4.0, 5.0])  # mean 3, best 5
    for progress in (0.0, 0.4, 1.0):
        fall, rise = math.exp(-progress), math.exp(progress)
        expected = [0.7 * fall, 0.7 * fall, 0.7 * fall, 0.35 * fall, 0.0]  # eqs. (26) and (27)
        assert ExponentialFall().rates(fitness, progress) == pytest.approx(expected)
        expected = [0.3 * rise, 0.3 * rise, 0.15 * rise, 0.075 * rise, 0.0]  # eqs. (28) and (29)
        assert ExponentialRise().rates(fitness, progress) == pytest.approx(expected)
        assert ExponentialFall().rates(np.full(7, 0.1), progress) == pytest.approx(np.full(7, 0.65 * fall))
        assert ExponentialRise().rates(np.full(7, 0.1), progress) == pytest.approx(np.full(7, 0.3 * rise))
    assert ExponentialFall(middle="low").rates(fitness, 0.0)[2:].tolist() == pytest.approx([0.65, 0.325, 0.0])
    assert ExponentialRise(middle="high").rates(fitness, 0.0)[2:].tolist() == pytest.approx([0.3, 0.15, 0.0])
    assert ExponentialRise(high=0.5).rates(fitness, 1.0)[0] == 1.0  # 0.5 e, cut off


@pytest.mark.parametrize("corners", ["strict", "no-squeeze", "allow"])
def test_children_and_mutants_are_valid_whatever_the_corner_policy(corners):
    problem = random_map(90, seed=3, corners=corners)
    rng = np.random.default_rng(0)
    population = GoalBiasedGreedyWalk().sample(problem, 60, rng)
    pairs, chosen = np.arange(60).reshape(-1, 2), np.arange(60)
    for _ in range(30):
        population = SinglePoint().cross(population, pairs, problem, rng)
        population = SingleGene().apply(population, chosen, problem, rng)
        rng.shuffle(population)
    assert all(pl.validate(np.array(path), problem) is None for path in paths_of(population, problem))
    assert not problem.context.occupied.ravel()[population[population >= 0]].any()


@pytest.mark.parametrize("trial", [{}, {"verified": False}, {"arithmetic": "exact", "step": 0.05}])
def test_the_kernels_and_a_collision_test_in_python_give_the_same(trial):
    problem = random_map(75, corners="strict")
    walks = GoalBiasedGreedyWalk().sample(problem, 60, np.random.default_rng(0))
    pairs, chosen = np.arange(40).reshape(-1, 2)[::-1], np.arange(0, 60, 2)
    population = SinglePoint(collision=None).cross(walks, pairs, problem, np.random.default_rng(0))  # some collide
    for operator in (SinglePoint, SingleGene, DropColliding, SequentialPointDeletion):
        results = []
        for collision in (LinearTrial(**trial), InPython(**trial)):
            part, rng = operator(collision=collision), np.random.default_rng(1)
            with counting() as counts:
                if isinstance(part, SinglePoint):
                    out = part.cross(population, pairs, problem, rng)
                elif isinstance(part, SingleGene):
                    out = part.apply(population, chosen, problem, rng)
                else:
                    out = part.apply(population, problem, rng)
            refused = counts.pop("segments refused by the exact test", 0)
            results.append((out.tobytes(), counts))
            assert trial != {"verified": False} or refused == 0
        assert results[0] == results[1]
        assert results[0][0] != population.tobytes()


def test_halves_that_cannot_be_joined_leave_the_parents():
    problem = drawn("...", ".#.", "...", start=(2, 0), goal=(0, 2))
    around = [np.array([(2, 0), (0, 0), (0, 2)]), np.array([(2, 0), (2, 2), (0, 2)])]
    population = problem.representation.encode(around)
    failed = set()
    for seed in range(40):
        with counting() as counts:
            children = SinglePoint().cross(population, np.array([[0, 1]]), problem, np.random.default_rng(seed))
        assert all(pl.validate(np.array(path), problem) is None for path in paths_of(children, problem))
        failed.add(counts.get("crossover failed", 0))
    assert failed == {0, 2}  # both cut behind the same place, or one behind the start and one before the goal
    unchecked = [
        SinglePoint(collision=None).cross(population, np.array([[0, 1]]), problem, np.random.default_rng(seed))
        for seed in range(40)
    ]
    assert any([[2, 0], [0, 2]] in paths_of(children, problem) for children in unchecked)  # through the obstacle


@pytest.mark.parametrize("collision", [None, LinearTrial(), InPython(), Exact()])
def test_paths_of_one_cell_cannot_be_cut_nor_have_a_gene_replaced(collision):
    problem = drawn("..", "..", start=(0, 0), goal=(0, 0))
    population = problem.representation.encode([np.array([(0, 0)])] * 2)
    with counting() as counts:
        children = SinglePoint(collision=collision).cross(
            population, np.array([[0, 1]]), problem, np.random.default_rng(0)
        )
        mutants = SingleGene(collision=collision).apply(population, np.array([0, 1]), problem, np.random.default_rng(0))
    assert children.tolist() == mutants.tolist() == [[0], [0]]
    assert counts == {"crossover failed": 2, "mutation failed": 2}


def test_common_nodes_are_another_way_to_join():
    problem = pl.PathProblem(np.zeros((6, 6), bool), corners="allow")
    parents = [np.array([(5, 0), (3, 1), (2, 2), (0, 5)]), np.array([(5, 0), (2, 2), (1, 4), (0, 5)])]
    population = problem.representation.encode(parents)
    children = SinglePoint(join="common-node").cross(population, np.array([[0, 1]]), problem, np.random.default_rng(0))
    assert paths_of(children, problem) == [[[5, 0], [3, 1], [2, 2], [1, 4], [0, 5]], [[5, 0], [2, 2], [0, 5]]]


def test_a_gene_moves_to_a_neighbour_or_anywhere():
    problem = pl.PathProblem(np.zeros((9, 9), bool), corners="allow")
    population = problem.representation.encode([np.array([(8, 0), (4, 4), (0, 8)])])
    for among, reach in (("neighbours", 1), ("anywhere", 8)):
        far = set()
        for seed in range(200):
            mutant = SingleGene(among=among).apply(population, np.array([0]), problem, np.random.default_rng(seed))
            path = paths_of(mutant, problem)[0]
            far |= {max(abs(r - 4), abs(c - 4)) for r, c in path[1:-1]}
        assert max(far) <= reach
        assert len(far - {0}) == (1 if reach == 1 else 4)


# Section 4.1: colliding individuals ---------------------------------------------------------------


def test_individuals_that_collide_are_dropped_and_drawn_anew():
    problem = drawn("...", ".#.", "...", start=(2, 0), goal=(0, 2))
    population = problem.representation.encode(
        [np.array(p) for p in ([(2, 0), (0, 2)], [(2, 0), (0, 0), (0, 2)], [(2, 0), (1, 2), (0, 2)])]
    )
    with counting() as counts:
        repaired = DropColliding().apply(population, problem, np.random.default_rng(0))
    assert counts["colliding individuals dropped"] == 2
    assert paths_of(repaired, problem)[1] == [[2, 0], [0, 0], [0, 2]]
    assert all(pl.validate(np.array(path), problem) is None for path in paths_of(repaired, problem))
    nobody = GoalBiasedGreedyWalk(steps=1, tries=1, fallback=None)
    with counting() as counts:
        kept = DropColliding(refill=nobody).apply(population, problem, np.random.default_rng(0))
    assert kept.tolist() == population.tolist()
    assert counts["colliding individuals kept"] == 2


def test_repair_by_drawing_takes_the_place_of_checks_in_the_operators():
    planner = pl.compose(
        "agacd", crossover={"collision": "none"}, mutation={"collision": "none"}, repair="agacd/drop-colliding"
    )
    result = pl.plan(random_map(75), planner, seed=1)
    assert result.found
    assert result.budget["counts"]["colliding individuals dropped"] > 1000


# Section 4.8: deletion ----------------------------------------------------------------------------


def test_the_papers_example_of_deletion_drops_b_and_d_and_keeps_c():
    # A sees C; A does not see D; C sees E
    problem = drawn(".....", ".....", ".....", ".....", "...#.", ".....", start=(5, 0), goal=(0, 4))
    path = np.array([(5, 0), (5, 2), (5, 4), (3, 4), (0, 4)])
    out = SequentialPointDeletion().apply(problem.representation.encode([path]), problem, np.random.default_rng(0))
    assert paths_of(out, problem) == [[[5, 0], [5, 4], [0, 4]]]


def test_deletion_makes_a_path_fitter_never_less_so():
    planner = pl.compose("agacd")
    problem = random_map(80, seed=5)
    population = GoalBiasedGreedyWalk().sample(problem, 100, np.random.default_rng(0))
    deleted = planner.refinement.apply(population, problem, np.random.default_rng(0))
    before, after = (planner.evaluate(p, problem) for p in (population, deleted))
    assert (after.values <= before.values + 1e-9).all()  # shorter, smoother, and with fewer obstacles beside points
    assert (after.fitness > before.fitness).all()


# Section 5: the planner ---------------------------------------------------------------------------


def test_the_presets_are_those_of_tables_6_and_10():
    for name, population, generations, pc, pm in (
        ("agacd", 60, 300, (0.65, 0.7), (0.15, 0.3)),
        ("agacd-50", 80, 500, (0.75, 0.9), (0.15, 0.3)),
    ):
        planner = pl.compose(name)
        assert (planner.population, planner.termination[0].limit) == (population, generations)
        fall, rise = planner.crossover.probability, planner.mutation.probability
        assert ((fall.low, fall.high), (rise.low, rise.high)) == (pc, pm)


@pytest.mark.parametrize("corners", ["strict", "no-squeeze", "allow"])
def test_it_finds_paths_on_maps_of_any_shape_and_between_any_cells(corners):
    grid = np.ascontiguousarray(pl.load_map("blocks-20:20%:s4", corners=corners).occupied[:, :13])
    free = np.argwhere(~grid)
    rng = np.random.default_rng(0)
    planner = pl.compose("agacd", population=12, termination=[{"use": "max-generations", "limit": 15}])
    found = 0
    for _ in range(15):
        start, goal = (tuple(cell) for cell in free[rng.integers(len(free), size=2)].tolist())
        problem = pl.PathProblem(grid, start=start, goal=goal, corners=corners)
        result = pl.plan(problem, planner, seed=1)
        assert result.found == problem.reachable
        found += result.found
    assert found > 5
    there = pl.plan(pl.PathProblem(grid, start=start, goal=start, corners=corners), planner)
    assert (there.path.tolist(), there.length) == ([list(start)], 0.0)
    assert there.to_dict()["fitness"] is not None


def test_it_comes_close_to_the_optimum_and_the_elite_is_never_lost():
    gaps = []
    for seed in range(10):
        problem = random_map(75, seed)
        result = pl.plan(problem, "agacd", seed=seed, optimum=True)
        best = result.history["generation_best"]
        assert all(a <= b for a, b in pairwise(best))
        gaps.append(result.gap["any_angle"])
    assert np.median(gaps) < 0.02


def test_the_trial_alone_lets_paths_pass_that_collide_and_the_answer_says_so():
    literal = {"use": "agacd/linear-trial", "verified": False}
    planner = pl.compose("agacd", crossover={"collision": literal}, mutation={"collision": literal})
    results = [pl.plan(random_map(75, seed, corners="strict"), planner, seed=seed) for seed in range(4)]
    assert any(r.status == "not-found" and "obstacle" in r.reason for r in results)


def test_with_the_exact_test_throughout_it_is_the_same_planner():
    planner = pl.compose(
        "agacd", crossover={"collision": "exact"}, mutation={"collision": "exact"}, refinement={"collision": "exact"}
    )
    assert isinstance(planner, Agacd)
    assert planner.crossover.collision == Exact()
    problem = random_map(75)
    finished = run(problem, planner, 1)
    assert pl.validate(problem.representation.decode(finished.outcome.solution), problem) is None
    assert "segments refused by the exact test" not in finished.state.counts
