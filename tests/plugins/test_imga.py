"""IMGA, statement by statement of its paper, and what it reaches on the maps that we have."""

import heapq
import math
from itertools import pairwise

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.paths.context import STEPS
from pathloom_imga.crossover import CommonNode
from pathloom_imga.objectives import QuadrantEnergy, UnsafeNode
from pathloom_imga.sampling import MedianInsertion
from pathloom_imga.selection import ThreeLayer


def labelled(numbers, n=10):
    """Cells of the labels in the paper's figures: 1 at the bottom left, row by row upwards."""
    return np.array([(n - 1 - (k - 1) // n, (k - 1) % n) for k in numbers])


@pytest.fixture
def empty():
    return pl.PathProblem(pl.load_map("empty-10"), corners="allow")


def test_layers_of_99_100_and_101_keep_the_size_of_the_population():
    for m, counts in ((99, (33, 33, 0)), (100, (33, 33, 1)), (101, (33, 33, 2))):
        fitness = np.arange(m, 0, -1.0)
        chosen = ThreeLayer().select(fitness, m, np.random.default_rng(0))
        times = np.bincount(chosen, minlength=m)
        assert len(chosen) == m
        assert (times[: counts[0]] == 2).all()
        assert (times[counts[0] : 2 * counts[1]] == 1).all()
        assert times[2 * counts[1] :].sum() == counts[2]


def test_the_papers_example_of_crossover_exchanges_tails_at_67(empty):
    mother = labelled([1, 2, 12, 67, 69, 89, 100])
    father = labelled([1, 11, 22, 67, 78, 80, 100])
    population = empty.representation.encode([mother, father])
    children = CommonNode().cross(population, np.array([[0, 1]]), empty, np.random.default_rng(0))
    expected = [labelled([1, 2, 12, 67, 78, 80, 100]), labelled([1, 11, 22, 67, 69, 89, 100])]
    for row, want in zip(children, expected, strict=True):
        assert empty.representation.decode(row).tolist() == want.tolist()


def test_parents_without_a_common_node_are_not_crossed(empty):
    mother, father = labelled([1, 2, 13, 100]), labelled([1, 11, 22, 100])
    population = empty.representation.encode([mother, father])
    with counting() as counts:
        children = CommonNode().cross(population, np.array([[0, 1]]), empty, np.random.default_rng(0))
    assert children.tolist() == population.tolist()
    assert counts == {"crossover without a common cell": 1}


def test_the_papers_example_of_deletion_leaves_one_turn(empty):
    # fig. 5: S-21-34-66-76-G loses 21 and 34; the segment S-66 passes free cells
    planner = pl.compose("imga")
    blocked = np.zeros((10, 10), bool)
    blocked[tuple(labelled([65])[0])] = True  # what keeps the start from seeing 76
    blocked[tuple(labelled([78])[0])] = True  # and 66 from seeing the goal
    problem = pl.PathProblem(pl.OccupancyGrid(blocked), corners="allow")
    path = labelled([1, 21, 34, 66, 76, 100])
    out = planner.refinement.apply(problem.representation.encode([path]), problem, np.random.default_rng(0))
    kept = problem.representation.decode(out[0]).tolist()
    assert kept == labelled([1, 66, 76, 100]).tolist()


def test_safety_charges_five_for_every_node_but_the_last_beside_an_obstacle():
    blocked = np.zeros((5, 5), bool)
    blocked[2, 2] = blocked[2, 3] = True
    problem = pl.PathProblem(pl.OccupancyGrid(blocked), start=(0, 0), goal=(1, 3), corners="allow")
    population = problem.representation.encode([np.array([(0, 0), (1, 1), (1, 2), (1, 3)])])
    assert UnsafeNode().measure(population, problem).tolist() == [10.0]  # (1,1) and (1,2); the last one is free
    assert UnsafeNode(per="obstacle").measure(population, problem).tolist() == [15.0]
    assert UnsafeNode(penalty=1.0).measure(population, problem).tolist() == [2.0]


@pytest.mark.parametrize(
    ("cells", "energy"),
    [
        ([(9, 0), (5, 3), (0, 9)], 1.0),  # up-right to another up-right: first quadrant
        ([(9, 0), (8, 1), (7, 2), (0, 9)], 0.0),  # straight on
        ([(9, 0), (5, 0), (5, 5)], 1.0),  # along an axis: the better side
        ([(9, 0), (5, 5), (5, 3)], 10.0),  # along an axis, away from the goal
        ([(9, 0), (5, 5), (4, 3)], 3.0),  # up-left: second quadrant
        ([(9, 0), (5, 5), (7, 6)], 3.0),  # down-right: fourth quadrant
        ([(9, 0), (5, 5), (6, 4)], 10.0),  # down-left: third
    ],
)
def test_energy_goes_by_the_quadrant_of_the_direction_taken(empty, cells, energy):
    population = empty.representation.encode([np.array(cells)])
    assert QuadrantEnergy().measure(population, empty).tolist() == [energy]


def test_energy_is_the_same_in_the_eight_symmetries_of_the_square(empty):
    path = np.array([(9, 0), (9, 3), (5, 4), (6, 8), (0, 9)])
    grid = np.zeros((10, 10), bool)
    found = set()
    for turn in range(4):
        for flip in (False, True):
            cells = path.copy()
            for _ in range(turn):
                cells = np.stack((cells[:, 1], 9 - cells[:, 0]), axis=1)
            if flip:
                cells = cells[:, ::-1]
            problem = pl.PathProblem(
                pl.OccupancyGrid(grid), start=tuple(cells[0]), goal=tuple(cells[-1]), corners="allow"
            )
            found.add(float(QuadrantEnergy().measure(problem.representation.encode([cells]), problem)[0]))
    assert len(found) == 1


def test_individuals_are_different_from_each_other():
    problem = pl.PathProblem(pl.load_map("blocks-20:20%:s2"))
    population = MedianInsertion().sample(problem, 100, np.random.default_rng(0))
    assert len({row.tobytes() for row in population}) == 100


def test_where_there_are_not_enough_different_paths_they_are_repeated_and_counted():
    problem = pl.PathProblem(pl.load_map("empty-2"))
    with counting() as counts:
        population = MedianInsertion().sample(problem, 10, np.random.default_rng(0))
    assert len(population) == 10
    assert counts["samples repeated"] >= 5


def test_a_sampler_that_finds_nothing_ends_says_so_and_can_fall_back():
    grid = pl.load_map("maze-41:1:s1")
    result = pl.plan(pl.PathProblem(grid), "imga")
    assert result.status == "not-found"
    assert result.budget["counts"]["samples failed"] >= 1000
    assert "'median-insertion' found no first individual" in result.reason
    helped = pl.plan(pl.PathProblem(grid), pl.compose("imga", sampling={"fallback": "perturbed-trees"}))
    assert helped.found
    assert helped.budget["counts"]["samples by fallback"] == 100


def test_guards_cut_loops_out_and_fail_less_often_on_a_dense_map():
    problem = pl.PathProblem(pl.load_map("blocks-20:40%:s2", corners="allow"), corners="allow")
    failed, looped = {}, {}
    for reading in ("guarded", "as-printed"):
        with counting() as counts:
            rows = MedianInsertion(reading=reading).sample(problem, 100, np.random.default_rng(0))
        failed[reading] = counts["samples failed"]
        looped[reading] = np.mean([len(set(row[row >= 0].tolist())) < (row >= 0).sum() for row in rows])
    assert failed["guarded"] < 0.7 * failed["as-printed"]
    assert looped["guarded"] == 0
    assert looped["as-printed"] > 0.9


def runs(problem, planner, seeds=30):
    results = [pl.plan(problem, planner, seed=s) for s in range(seeds)]
    assert all(r.found for r in results)
    for r in results:
        assert r.metrics["turns"] <= _turns(r.unrefined)
        assert r.length <= _length(r.unrefined) + 1e-12
    return sorted(results, key=lambda r: r.length)


def _turns(path):
    steps = np.diff(path, axis=0)
    return sum(a[0] * b[1] != a[1] * b[0] or a @ b < 0 for a, b in pairwise(steps))


def _length(path):
    return np.hypot(*np.diff(path, axis=0).T).sum()


def test_on_map_1_the_best_of_thirty_is_the_any_angle_optimum():
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    found = [r.length for r in runs(problem, pl.compose("imga"))]
    assert round(found[0], 4) == 13.7901
    assert round(float(np.median(found)), 4) == 13.7901


@pytest.mark.data
def test_on_environment_4_the_best_of_thirty_is_the_papers_to_the_last_figure(data):
    grid = pl.load_map(data / "ga_grids" / "ga_smooth_20x20.csv")
    problem = pl.PathProblem(grid, start="top-left", goal="bottom-right", corners="allow")
    found = runs(problem, pl.compose("imga"))
    best = found[0].metrics  # table 3 and the text: length, turns, tangencies, passages between two obstacles
    assert (round(best["length"], 4), best["turns"], best["touches"], best["squeezes"]) == (29.6896, 7, 3, 0)
    optimum, _ = pl.any_angle_path(problem)
    assert np.median([r.length for r in found]) / optimum - 1 < 0.0036


@pytest.mark.data
def test_imga_is_shorter_and_has_fewer_turns_than_the_plain_algorithm(data):
    grid = pl.load_map(data / "ga_grids" / "ga_smooth_20x20.csv")
    problem = pl.PathProblem(grid, start="top-left", goal="bottom-right", corners="allow")
    ours, plain = ([pl.plan(problem, name, seed=s) for s in range(10)] for name in ("imga", "ga-imga"))
    assert max(r.length for r in ours) < min(r.length for r in plain)
    assert np.mean([r.metrics["turns"] for r in ours]) < np.mean([r.metrics["turns"] for r in plain])


def test_the_fittest_path_instead_of_the_shortest_is_a_choice():
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    fittest = pl.plan(problem, pl.compose("imga", archive="none"), seed=1)
    assert round(fittest.length, 4) == 14.1942  # the fittest 8-connected path of this map, its points deleted


def fittest(problem, planner):
    """The least cost a L + b S + c E of any path of single steps, by search over cells and headings, and such a path."""
    it = problem.context
    unsafe, energy = planner.objectives[1].objective, planner.objectives[2].objective
    a, b, c = planner.objectives.weights
    sign = np.array(it.signs)
    price = [energy.price[0 if (sign * s >= 0).all() else 2 if (sign * s <= 0).all() else 1] for s in np.array(STEPS)]
    heap, cost, before = [(0.0, it.start, -1)], {(it.start, -1): 0.0}, {}
    while heap:
        so_far, cell, heading = heapq.heappop(heap)
        if cell == it.goal:
            path = [cell]
            while (cell, heading) in before:
                cell, heading = before[cell, heading]
                path.append(cell)
            return so_far, np.array([path[::-1]], np.int32)
        for d, (dr, dc) in enumerate(STEPS):
            if it.moves[cell] >> d & 1:
                there = cell + dr * it.cols + dc
                turn = c * price[d] if heading not in (-1, d) else 0.0
                total = so_far + a * math.hypot(dr, dc) + b * unsafe.penalty * it.unsafe[cell] + turn
                if total < cost.get((there, d), math.inf):
                    cost[there, d] = total
                    before[there, d] = (cell, heading)
                    heapq.heappush(heap, (total, there, d))
    raise AssertionError("no path")


@pytest.mark.data
def test_the_papers_result_is_no_optimum_of_its_own_fitness(data):
    grid = pl.load_map(data / "ga_grids" / "ga_smooth_20x20.csv")
    problem = pl.PathProblem(grid, start="top-left", goal="bottom-right", corners="allow")
    planner = pl.compose("imga")
    cost, path = fittest(problem, planner)
    deleted = planner.refinement.apply(path, problem, np.random.default_rng(0))
    assert round(cost, 2) == 253.85
    assert round(float(pl.compiled.measures.lengths(deleted, 20)[0]), 4) == 31.2625
    literal = [pl.plan(problem, pl.compose("imga", archive="none"), seed=s).length for s in range(30)]
    assert round(min(literal), 1) == 35.2
    assert round(float(np.median(literal)), 1) == 37.0
