"""Crossing kernels against slow twins: where two paths meet, and where one comes back beside itself."""

import math

import naive
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from naive import Cells, examples

from pathloom import PathProblem, compiled

PLENTY = 1000
"""More meeting points than any two small paths have."""


def neighbours(blocked, corners):
    """Return for each free cell the cells that are one legal step away."""
    return {
        cell: {there for _, there in naive.legal_steps(blocked, cell, corners)} for cell in naive.free_cells(blocked)
    }


def meetings(mother: Cells, father: Cells, steps=None) -> list[tuple[int, int]]:
    """Return where interior cells are the same, or one step apart, as positions in both."""
    inside = [(i, j) for i in range(1, len(mother) - 1) for j in range(1, len(father) - 1)]
    common = [(i, j) for i, j in inside if mother[i] == father[j]]
    if common or steps is None:
        return common
    return [(i, j) for i, j in inside if mother[i] in steps.get(father[j], ())]


def children(mother: Cells, father: Cells, points: list[tuple[int, int]]) -> set[Cells]:
    pairs = [(mother[: i + 1] + father[j:], father[: j + 1] + mother[i:]) for i, j in points]
    return {naive.without_loops(child) for pair in pairs for child in pair}


def without_detours(path: Cells, steps) -> Cells:
    """Go on, from each cell, with the last one of the path that is a step away."""
    kept, i = [], 0
    while True:
        i = max(k for k, cell in enumerate(path) if cell == path[i])
        kept.append(path[i])
        if i == len(path) - 1:
            return tuple(kept)
        i = max([i + 1, *(k for k in range(i + 1, len(path)) if path[k] in steps.get(path[i], ()))])


@st.composite
def crossings(draw):
    """A map, two paths over its free cells that need not be connected, and whether passing by counts."""
    problem = draw(naive.problems())
    blocked, ends = problem.context.occupied, problem.ends
    free = naive.free_cells(blocked)
    inside = st.lists(st.sampled_from(free), max_size=8).map(lambda cells: (ends[0], *cells, ends[1]))
    paths = [naive.without_loops(draw(inside)) for _ in range(2)]
    return problem, paths, draw(st.booleans()), draw(naive.words)


def crossed(problem: PathProblem, paths: list[Cells], points: int, beside: bool, words: list[int]):
    it = problem.context
    found, failed, tried = compiled.crossing.cross_where_shortest(
        naive.packed(paths, it.cols, 2),
        np.array([[0, 1]]),
        it.moves,
        it.cols,
        points,
        beside,
        np.array(words, np.uint64),
    )
    return naive.unpacked(found, it.cols), failed, tried


@given(drawn=crossings())
@examples(100)
def test_the_two_shortest_different_children_are_kept(drawn):
    problem, paths, beside, words = drawn
    steps = neighbours(problem.context.occupied, problem.corners) if beside else None
    points = meetings(*paths, steps)
    possible = children(*paths, points)
    found, failed, tried = crossed(problem, paths, PLENTY, beside, words)
    assert (failed, tried) == (not points, 2 * len(points))
    if not points:
        assert found == paths
        return
    assert found[0] in possible
    by_length = sorted(naive.length(child) for child in possible)
    assert math.isclose(naive.length(found[0]), by_length[0])
    if len(possible) == 1:
        assert found[1] == paths[1]
    else:
        assert found[1] in possible - {found[0]}
        assert math.isclose(naive.length(found[1]), by_length[1])


@given(drawn=crossings(), points=st.integers(1, 3))
@examples(100)
def test_no_more_points_are_tried_than_allowed(drawn, points):
    problem, paths, beside, words = drawn
    steps = neighbours(problem.context.occupied, problem.corners) if beside else None
    all_points = meetings(*paths, steps)
    found, _, tried = crossed(problem, paths, points, beside, words)
    assert tried == 2 * min(points, len(all_points))
    assert set(found) <= {*children(*paths, all_points), *paths}


def test_each_meeting_point_is_tried_as_often():
    # two paths that meet three times: with one point tried, a third of the crossings each
    problem = PathProblem(np.zeros((3, 9), bool), start=(1, 0), goal=(1, 8), corners="allow")
    up = ((1, 0), (0, 1), (1, 2), (0, 3), (1, 4), (0, 5), (1, 6), (0, 7), (1, 8))
    down = tuple((2 - r, c) for r, c in up)
    firsts = [crossed(problem, [up, down], 1, False, state(seed))[0][0] for seed in range(900)]
    # the switch is at the only place where both neighbours in rows differ
    places = [next(c for c in (2, 4, 6) if path[c - 1][0] != path[c + 1][0]) for path in firsts]
    assert all(250 < places.count(c) < 350 for c in (2, 4, 6))


def test_many_pairs_at_once_give_what_one_at_a_time_gives():
    rng = np.random.default_rng(4)
    problem = PathProblem(np.zeros((6, 6), bool), start=(0, 0), goal=(5, 5), corners="allow")
    cells = [tuple(map(tuple, rng.integers(0, 6, (k, 2)).tolist())) for k in rng.integers(1, 30, 20)]
    paths = [naive.without_loops(((0, 0), *inside, (5, 5))) for inside in cells]
    pairs = rng.permutation(20)[:18].reshape(-1, 2)
    it = problem.context
    words = np.array(state(1), np.uint64)
    population = naive.packed(paths, 6)
    before = population.tobytes()
    together, _, _ = compiled.crossing.cross_where_shortest(population, pairs, it.moves, 6, 4, True, words.copy())
    alone = list(paths)
    for x, y in pairs:
        one, _, _ = compiled.crossing.cross_where_shortest(
            naive.packed([paths[x], paths[y]], 6), np.array([[0, 1]]), it.moves, 6, 4, True, words
        )
        alone[x], alone[y] = naive.unpacked(one, 6)
    assert naive.unpacked(together, 6) == alone
    assert population.tobytes() == before


@given(problem=naive.problems(), data=st.data())
@examples(100)
def test_detours_are_cut_out_as_in_the_twin(problem, data):
    it = problem.context
    free = st.sampled_from(naive.free_cells(it.occupied))
    paths = data.draw(st.lists(st.lists(free, min_size=1, max_size=12).map(tuple), min_size=1, max_size=4))
    found = compiled.crossing.without_detours(naive.packed(paths, it.cols, 3), it.moves, it.cols)
    steps = neighbours(it.occupied, problem.corners)
    assert naive.unpacked(found, it.cols) == [without_detours(path, steps) for path in paths]


def test_a_path_of_single_steps_has_no_detour_left():
    for corners in naive.POLICIES:
        occupied = np.random.default_rng(2).random((12, 12)) < 0.2
        occupied[0, 0] = occupied[11, 11] = False
        problem = PathProblem(occupied, start=(0, 0), goal=(11, 11), corners=corners)
        it = problem.context
        walks, _ = compiled.walks.sample_by_walking(
            20, 100_000, it.start, it.goal, it.moves, 12, np.array(state(3), np.uint64)
        )
        shorter = compiled.crossing.without_detours(walks, it.moves, 12)
        steps = neighbours(occupied, corners)
        assert len(shorter) == len(walks) == 20
        for walk, path in zip(naive.unpacked(walks, 12), naive.unpacked(shorter, 12), strict=True):
            assert naive.path_free(occupied, path, corners)
            assert naive.steps_singly(path)
            assert naive.length(path) <= naive.length(walk)
            for k, cell in enumerate(path):
                assert not steps[cell] & set(path[k + 2 :])


def state(seed: int) -> list[int]:
    return np.random.default_rng(seed).bit_generator.random_raw(4).tolist()
