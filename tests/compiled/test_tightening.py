"""Kernels that shorten paths at any angle, against twins in plain Python."""

import math
from itertools import pairwise

import naive
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from naive import Cell, Cells, examples

from pathloom import PathProblem, compiled

SLACK = 1e-9


def sees(problem: PathProblem, a: Cell, b: Cell) -> bool:
    return naive.segment_free(problem.context.occupied, a, b, problem.corners)


def around(problem: PathProblem, cell: Cell, reach: int) -> list[Cell]:
    """Return the free cells within so many rows and columns, row by row."""
    rows, cols = problem.context.occupied.shape
    return [
        (r, c)
        for r in range(max(0, cell[0] - reach), min(rows, cell[0] + reach + 1))
        for c in range(max(0, cell[1] - reach), min(cols, cell[1] + reach + 1))
        if not problem.context.occupied[r, c]
    ]


def dropped(problem: PathProblem, path: Cells) -> Cells:
    return naive.without_points(problem.context.occupied, path, problem.corners, 0)


def pulled(problem: PathProblem, path: Cells, sweeps: int) -> Cells:
    """Slide one point after the other to where both segments together are shortest."""
    path = dropped(problem, path)
    for _ in range(sweeps):
        before, points = path, list(path)
        for i in range(1, len(points) - 1):
            a, b = points[i - 1], points[i + 1]
            while True:

                def price(c: Cell, a: Cell = a, b: Cell = b) -> float:
                    return math.dist(a, c) + math.dist(c, b)

                open_to = [c for c in around(problem, points[i], 1) if sees(problem, a, c) and sees(problem, c, b)]
                best = min(open_to, key=price)
                if price(best) >= price(points[i]) - SLACK:
                    break
                points[i] = best
        if tuple(points) == before:
            break
        path = dropped(problem, tuple(points))
    return path


def through_band(problem: PathProblem, path: Cells, radius: int) -> float:
    """Return the length of the shortest path from layer to layer: the same, the next, or the next but one."""
    layers = [around(problem, cell, radius) for cell in path]
    layers[0], layers[-1] = [path[0]], [path[-1]]
    nodes = {(k, cell) for k, layer in enumerate(layers) for cell in layer}

    def edges(node):
        k, here = node
        for layer, there in nodes:
            if k <= layer <= k + 2 and there != here and sees(problem, here, there):
                yield (layer, there), math.dist(here, there)

    reached = {(0, path[0]): 0.0}
    waiting = dict(reached)
    while waiting:  # Dijkstra without a heap
        node = min(waiting, key=waiting.get)
        far = waiting.pop(node)
        for other, step in edges(node):
            if far + step < reached.get(other, math.inf) - SLACK:
                reached[other] = waiting[other] = far + step
    return reached[len(path) - 1, path[-1]]


def seeds(problem: PathProblem, n: int = 3) -> np.ndarray:
    it = problem.context
    words = np.array([3, 2**40 + 1, 2**63 + 5, 11], np.uint64)
    return compiled.seeding.sample_from_trees(
        n, 1, it.moves, it.cols, it.start, it.goal, it.reachable_cells, 2.0, 4.0, words
    )


def reachable(problem: PathProblem) -> bool:
    return problem.reachable


@given(problem=naive.problems(max_side=8).filter(reachable), sweeps=st.integers(0, 3))
@examples(60)
def test_pulling_is_its_twin(problem: PathProblem, sweeps: int) -> None:
    it = problem.context
    paths = seeds(problem)
    found = compiled.tightening.pulled(paths, it.blocked, it.cols, it.policy, sweeps)
    for before, after in zip(naive.unpacked(paths, it.cols), naive.unpacked(found, it.cols), strict=True):
        twin = pulled(problem, before, sweeps)
        assert math.isclose(naive.length(after), naive.length(twin), abs_tol=1e-6)
        assert naive.path_free(it.occupied, after, problem.corners)
        assert naive.length(after) <= naive.length(before) + SLACK


@given(problem=naive.problems(max_side=6).filter(reachable), radius=st.integers(1, 2))
@examples(30)
def test_one_round_through_the_band_is_as_short_as_its_twin(problem: PathProblem, radius: int) -> None:
    it = problem.context
    paths = seeds(problem, 2)
    found = compiled.tightening.through_band(paths, it.blocked, it.cols, it.policy, radius, 1)
    for before, after in zip(naive.unpacked(paths, it.cols), naive.unpacked(found, it.cols), strict=True):
        taut = dropped(problem, before)
        assert naive.path_free(it.occupied, after, problem.corners)
        best = through_band(problem, taut, radius)
        # what deletion makes of the shortest one may be shorter still, by the triangle inequality
        assert naive.length(after) <= min(naive.length(taut), best) + 1e-6


@given(problem=naive.problems(max_side=6).filter(reachable), rounds=st.integers(1, 4))
@examples(40)
def test_more_rounds_through_the_band_never_lengthen(problem: PathProblem, rounds: int) -> None:
    it = problem.context
    paths = seeds(problem)
    few, more = (
        compiled.tightening.through_band(paths, it.blocked, it.cols, it.policy, 2, k) for k in (rounds, rounds + 1)
    )
    lengths = compiled.measures.lengths
    assert (lengths(more, it.cols) <= lengths(few, it.cols) + SLACK).all()
    assert (lengths(few, it.cols) <= lengths(paths, it.cols) + SLACK).all()


def shortest_over(problem: PathProblem, cells: set[Cell]) -> float:
    def edges(here):
        for there in cells:
            if there != here and sees(problem, here, there):
                yield there, math.dist(here, there)

    return naive.dijkstra(problem.start, edges)[problem.goal]


@given(problem=naive.problems(max_side=7).filter(reachable), halo=st.integers(0, 2))
@examples(50)
def test_the_pool_holds_every_point_and_what_is_near(problem: PathProblem, halo: int) -> None:
    it = problem.context
    paths = seeds(problem)
    child = compiled.pooling.pooled(paths, np.arange(3), it.blocked, it.cols, it.policy, halo, 10_000)
    (path,) = naive.unpacked(child[np.newaxis], it.cols)
    pool = {near for row in naive.unpacked(paths, it.cols) for cell in row for near in around(problem, cell, halo)}
    assert (path[0], path[-1]) == problem.ends
    assert naive.path_free(it.occupied, path, problem.corners)
    assert math.isclose(naive.length(path), shortest_over(problem, pool), abs_tol=1e-6)


def test_a_pool_without_room_keeps_the_shortest_path() -> None:
    problem = PathProblem(np.eye(6, k=2, dtype=bool) | np.eye(6, k=-3, dtype=bool), corners="allow")
    it = problem.context
    paths = seeds(problem, 6)
    order = np.argsort(compiled.measures.lengths(paths, it.cols), kind="stable")
    child = compiled.pooling.pooled(paths, order, it.blocked, it.cols, it.policy, 2, 2)
    assert naive.unpacked(child[np.newaxis], it.cols) == naive.unpacked(paths[order[:1]], it.cols)


@given(problem=naive.problems(max_side=6).filter(reachable), halo=st.integers(0, 2))
@examples(40)
def test_a_large_pool_gives_the_any_angle_optimum(problem: PathProblem, halo: int) -> None:
    it = problem.context
    blocked = it.occupied
    everywhere = sorted(naive.octile_distances(blocked, problem.start, problem.corners))
    ways = [cells for cells in (detour(problem, cell) for cell in everywhere) if cells]
    child = compiled.pooling.pooled(
        naive.packed(ways, it.cols), np.arange(len(ways)), it.blocked, it.cols, it.policy, halo, 10_000
    )
    best = naive.any_angle_distances(blocked, problem.start, problem.corners)[problem.goal]
    (path,) = naive.unpacked(child[np.newaxis], it.cols)
    assert math.isclose(naive.length(path), best, abs_tol=1e-6)


def detour(problem: PathProblem, through: Cell) -> Cells:
    """Return a path of single steps through a cell."""
    it = problem.context
    halves = [
        compiled.search.octile_path(it.moves, it.cols, a, b)
        for a, b in pairwise((it.start, through[0] * it.cols + through[1], it.goal))
    ]
    cells = [*halves[0].tolist(), *halves[1].tolist()[1:]]
    return tuple(divmod(cell, it.cols) for cell in cells)


@given(problem=naive.problems(max_side=8).filter(reachable), data=st.data())
@examples(60)
def test_a_flooded_tree_holds_the_distances_up_to_its_limit(problem: PathProblem, data: st.DataObject) -> None:
    it = problem.context
    eighths = data.draw(st.lists(st.integers(8, 24), min_size=it.blocked.size, max_size=it.blocked.size))
    price = np.array(eighths, np.float32) / np.float32(8)
    stretch = data.draw(st.sampled_from((1.0, 1.25, 100.0)))

    def edges(cell: Cell):
        for _, there in naive.legal_steps(it.occupied, cell, problem.corners):
            mean = (price.reshape(it.occupied.shape)[cell] + price.reshape(it.occupied.shape)[there]) / 2
            yield there, math.dist(cell, there) * float(mean)

    expected = naive.dijkstra(problem.start, edges)
    distance, parent = np.empty(it.blocked.size), np.empty(it.blocked.size, np.int32)
    there = compiled.seeding.flood(it.moves, price, it.cols, it.start, it.goal, 3.0, stretch, distance, parent)
    assert math.isclose(there, expected[problem.goal], rel_tol=1e-12)
    for cell, far in expected.items():
        flat = cell[0] * it.cols + cell[1]
        if far <= stretch * there:
            assert math.isclose(distance[flat], far, rel_tol=1e-12)
            step = distance[flat] - distance[parent[flat]] if flat != it.start else 0.0
            assert step >= 1.0 or flat == it.start
        else:
            assert distance[flat] >= far - 1e-9
