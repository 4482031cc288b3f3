"""The midpoint test of segments and the exchange at a position, against their twins."""

import math

import naive
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from naive import Cell, Cells, examples

from pathloom import PathProblem, compiled

SIGNS = ((1, 1), (1, -1), (-1, 1), (-1, -1))


def words(seed: int) -> list[int]:
    return np.random.default_rng(seed).bit_generator.random_raw(4).tolist()


def free_by_midpoints(blocked: np.ndarray, a: Cell, b: Cell, signs: Cell) -> bool:
    """Look at the rounded midpoint, then at those of both halves, until the ends are neighbours."""
    if blocked[a] or blocked[b]:
        return False
    if max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1:
        return True
    middle = tuple(s * math.floor((s * p + s * q) / 2 + 0.5) for s, p, q in zip(signs, a, b, strict=True))
    return free_by_midpoints(blocked, a, middle, signs) and free_by_midpoints(blocked, middle, b, signs)


@given(blocked=naive.maps(12), signs=st.sampled_from(SIGNS), data=st.data())
@examples(150)
def test_midpoints_of_midpoints_are_looked_at_until_neighbours_are_reached(blocked, signs, data) -> None:
    cells = st.lists(naive.cells_of(blocked.shape), min_size=20, max_size=20)
    pairs = list(zip(data.draw(cells), data.draw(cells), strict=True))
    first, second = (
        np.array([r * blocked.shape[1] + c for r, c in ends], np.int32) for ends in zip(*pairs, strict=True)
    )
    found = compiled.midpoints.segments_free(blocked.ravel().astype(np.uint8), blocked.shape[1], first, second, *signs)
    assert found.tolist() == [free_by_midpoints(blocked, a, b, signs) for a, b in pairs]


@pytest.mark.parametrize("signs", SIGNS)
def test_halves_are_rounded_forwards(signs: Cell) -> None:
    blocked = np.zeros((2, 4), bool)
    blocked[1 if signs[0] > 0 else 0, 2 if signs[1] > 0 else 1] = True  # ⌊0.5 + ½⌋ and ⌊1.5 + ½⌋ on axes forwards
    ends = np.array([0], np.int32), np.array([7], np.int32)
    assert not compiled.midpoints.segments_free(blocked.ravel().astype(np.uint8), 4, *ends, *signs)[0]
    assert compiled.midpoints.segments_free(blocked[::-1].ravel().astype(np.uint8), 4, *ends, *signs)[0]


def test_a_long_segment_is_tested_to_its_end() -> None:
    blocked = np.zeros((1, 2000), np.uint8)
    blocked[0, 1998] = 1
    ends = np.array([0], np.int32), np.array([1999], np.int32)
    assert not compiled.midpoints.segments_free(blocked.ravel(), 2000, *ends, 1, 1)[0]


@pytest.mark.parametrize(
    ("density", "missed", "alarms"), [(0.1, 0.32, 0.067), (0.2, 0.23, 0.11), (0.3, 0.16, 0.14), (0.4, 0.11, 0.15)]
)
def test_midpoints_miss_collisions_and_see_some_that_are_none(density: float, missed: float, alarms: float) -> None:
    rng = np.random.default_rng(0)
    verdicts = []
    for _ in range(120):
        blocked = (rng.random((20, 20)) < density).astype(np.uint8).ravel()
        a, b = rng.choice(np.flatnonzero(blocked == 0), (2, 400)).astype(np.int32)
        gap = np.maximum(abs(a // 20 - b // 20), abs(a % 20 - b % 20))
        ends = blocked, 20, a[(gap >= 2) & (gap <= 6)], b[(gap >= 2) & (gap <= 6)]
        verdicts.append((compiled.segments.segments_free(*ends, 0), compiled.midpoints.segments_free(*ends, -1, 1)))
    exact, guessed = (np.concatenate(found) for found in zip(*verdicts, strict=True))
    assert guessed[~exact].mean() == pytest.approx(missed, abs=0.01)
    assert (~guessed[exact]).mean() == pytest.approx(alarms, abs=0.02)


def inserted(a: Cell, b: Cell, signs: Cell) -> Cells:
    """Return the cells from a to b by median insertion where nothing is in the way."""
    if max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1:
        return (a, b) if a != b else (a,)
    middle = tuple(s * math.floor((s * p + s * q) / 2) for s, p, q in zip(signs, a, b, strict=True))
    return inserted(a, middle, signs) + inserted(middle, b, signs)[1:]


def exchanges(mother: Cells, father: Cells, signs: Cell, loops: bool) -> set[tuple[Cells, Cells]]:
    """Return every pair of children that a cut at one position inside the shorter parent can give on a free map."""
    found = set()
    for cut in range(2, min(len(mother), len(father))):  # so many cells are kept
        pair = tuple(
            head[: cut - 1] + inserted(head[cut - 1], tail[cut], signs) + tail[cut + 1 :]
            for head, tail in ((mother, father), (father, mother))
        )
        found.add(pair if loops else tuple(map(naive.without_loops, pair)))
    return {(mother, father)} if mother == father else found or {(mother, father)}


def exchanged(problem, paths, pairs, state, *, reach=4, cap=40, guarded=True, loops=False, padding=2):
    it = problem.context
    population = naive.packed(paths, it.cols, padding)
    before = population.copy()
    children, failed = compiled.joining.exchange_at_position(
        population, np.array(pairs, np.int64).reshape(-1, 2), it.blocked, it.moves, it.rows, it.cols, *it.signs,
        reach, cap, guarded, loops, np.array(state, np.uint64),
    )  # fmt: skip
    np.testing.assert_array_equal(population, before)
    return naive.unpacked(children, it.cols), failed


@given(shape=st.tuples(st.integers(1, 5), st.integers(1, 5)), loops=st.booleans(), state=naive.words, data=st.data())
@examples(150)
def test_children_are_cut_at_one_position_and_joined_where_they_were_cut(shape, loops, state, data) -> None:
    start, goal = (data.draw(naive.cells_of(shape)) for _ in range(2))
    problem = PathProblem(np.zeros(shape, bool), start=start, goal=goal, corners="allow")
    paths = data.draw(st.lists(naive.paths_on(shape), min_size=4, max_size=4))
    children, failed = exchanged(problem, paths, [(2, 0)], state, loops=loops)
    assert (children[2], children[0]) in exchanges(paths[2], paths[0], problem.context.signs, loops)
    assert (children[1], children[3]) == (paths[1], paths[3])
    assert failed == (2 if min(len(paths[2]), len(paths[0])) < 3 else 0)


def test_every_position_inside_the_shorter_parent_is_cut_sometimes() -> None:
    problem = PathProblem(np.zeros((6, 6), bool), start=(0, 0), goal=(5, 5))
    short, long = (
        tuple((k, k) for k in range(6)),
        ((0, 0), (1, 0), (2, 0), (3, 0), (4, 1), (4, 2), (4, 3), (4, 4), (5, 5)),
    )
    seen = {tuple(exchanged(problem, [short, long], [(0, 1)], words(k))[0]) for k in range(40)}
    assert seen == exchanges(short, long, (1, 1), loops=False)
    assert len(seen) == 4


@given(
    problem=naive.problems(),
    state=naive.words,
    reach=st.sampled_from([4, 8]),
    cap=st.sampled_from([0, 1, 40]),
    guarded=st.booleans(),
    loops=st.booleans(),
)
@examples(120)
def test_children_are_legal_or_their_parents(problem, state, reach, cap, guarded, loops) -> None:
    it = problem.context
    assume(problem.reachable and it.start != it.goal)
    walks = compiled.walks.sample_by_walking(
        6, 10_000, it.start, it.goal, it.moves, it.cols, np.array(state, np.uint64)
    )[0]
    paths = naive.unpacked(walks, it.cols)
    options = {"reach": reach, "cap": cap, "guarded": guarded, "loops": loops}
    children, failed = exchanged(problem, paths, [(5, 0), (1, 4)], state, **options)
    assert (children, failed) == exchanged(problem, paths, [(5, 0), (1, 4)], state, **options)
    assert children[2:4] == paths[2:4]
    assert sum(old == new for old, new in zip(paths, children, strict=True)) >= 2 + failed
    for path in children:
        assert (path[0], path[-1]) == problem.ends
        assert naive.steps_singly(path)
        assert naive.path_free(it.occupied, path, problem.corners)
        assert loops or len(set(path)) == len(path)


def test_where_one_child_cannot_be_joined_its_parent_stays_and_the_other_is_made() -> None:
    blocked = np.array([[0, 0, 0, 0, 0], [0, 1, 1, 1, 0], [0, 0, 0, 0, 0]], bool)
    problem = PathProblem(blocked, start=(1, 0), goal=(1, 4), corners="allow")
    above, below = ((1, 0), (0, 1), (0, 2), (0, 3), (1, 4)), ((1, 0), (2, 1), (2, 2), (2, 3), (1, 4))
    seen = {exchanged(problem, [above, below], [(0, 1)], words(k))[1] for k in range(20)}
    assert seen == {0, 2}  # behind the last interior cell goal is a neighbour; before it a wall stands between


def test_without_pairs_nothing_changes() -> None:
    problem = PathProblem(np.zeros((2, 2), bool))
    paths = [((1, 0), (0, 1)), ((1, 0), (1, 1), (0, 1))]
    assert exchanged(problem, paths, [], [1, 2, 3, 4]) == (paths, 0)
