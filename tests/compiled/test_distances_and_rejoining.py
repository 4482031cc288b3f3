"""Distances of obstacles from segments and lines; stretches of paths made anew, and paths joined in turn."""

import itertools
import math
from collections import Counter
from fractions import Fraction

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import Cell, Cells, examples

import pathloom as pl
from pathloom import compiled
from pathloom.kernel.counting import counting
from pathloom.paths.insertion import mutate_between, sample_in_turn
from pathloom.paths.problem import PathProblem

# Distances --------------------------------------------------------------------------------------


def clear(blocked: np.ndarray, pairs: list[tuple[Cell, Cell]], square: Fraction, infinite: bool) -> list[bool]:
    """Hold segments against a distance whose square is given."""
    rows, cols = blocked.shape
    ids = np.array([[r * cols + c for r, c in pair] for pair in pairs], np.int32).reshape(-1, 2)
    first, second = (np.ascontiguousarray(ids[:, k]) for k in (0, 1))
    flat = np.ascontiguousarray(blocked, np.uint8).ravel()
    above, below = float(square.numerator), float(square.denominator)
    return compiled.distances.clear(flat, rows, cols, first, second, above, below, infinite).tolist()


def squared_distance(p: Cell, a: Cell, b: Cell, infinite: bool) -> Fraction:
    """Return the square of the distance of a point from a segment, or from the line through it."""
    dr, dc = b[0] - a[0], b[1] - a[1]
    t = Fraction((p[0] - a[0]) * dr + (p[1] - a[1]) * dc, dr * dr + dc * dc) if a != b else Fraction(0)
    if not infinite:
        t = min(max(t, Fraction(0)), Fraction(1))
    return (p[0] - a[0] - t * dr) ** 2 + (p[1] - a[1] - t * dc) ** 2


def clear_by_definition(blocked: np.ndarray, a: Cell, b: Cell, square: Fraction, infinite: bool) -> bool:
    return all(squared_distance((r, c), a, b, infinite) >= square for r, c in np.argwhere(blocked).tolist())


squares = st.sampled_from([Fraction(1, 2), Fraction(2), Fraction(1), Fraction(9, 25), Fraction(1, 10**4), Fraction(13)])


@given(data=st.data(), blocked=naive.maps(9), square=squares, infinite=st.booleans())
@examples(200)
def test_an_obstacle_is_in_the_way_where_its_centre_is_nearer_than_the_distance(data, blocked, square, infinite):
    cell = naive.cells_of(blocked.shape)
    pairs = data.draw(st.lists(st.tuples(cell, cell), max_size=12))
    expected = [clear_by_definition(blocked, a, b, square, infinite) for a, b in pairs]
    assert clear(blocked, pairs, square, infinite) == expected


@pytest.mark.parametrize("infinite", [False, True])
@pytest.mark.parametrize("square", [Fraction(1, 2), Fraction(2), Fraction(1, 4), Fraction(8, 5)])
def test_one_obstacle_anywhere_is_held_against_every_segment_as_its_twin_does(square: Fraction, infinite: bool) -> None:
    cells = [divmod(k, 5) for k in range(35)]
    for obstacle in cells[::3]:
        blocked = np.zeros((7, 5), bool)
        blocked[obstacle] = True
        pairs = [(a, b) for a in cells for b in cells]
        expected = [squared_distance(obstacle, a, b, infinite) >= square for a, b in pairs]
        assert clear(blocked, pairs, square, infinite) == expected


def test_a_distance_that_equals_the_threshold_is_not_too_near() -> None:
    blocked = np.zeros((5, 5), bool)
    blocked[0, 2] = True  # at √2 from the diagonal through (0, 0), at √½ from that through (0, 1)
    for a, square in (((0, 0), Fraction(2)), ((0, 1), Fraction(1, 2))):
        b = a[0] + 3, a[1] + 3
        for infinite in (False, True):
            assert clear(blocked, [(a, b), (b, a)], square, infinite) == [True, True]
            assert clear(blocked, [(a, b), (b, a)], square + Fraction(1, 10**6), infinite) == [False, False]


def test_a_line_goes_on_behind_both_ends_and_a_segment_does_not() -> None:
    blocked = np.zeros((1, 9), bool)
    blocked[0, 8] = True
    for pair in (((0, 2), (0, 4)), ((0, 4), (0, 2))):
        assert clear(blocked, [pair], Fraction(2), infinite=True) == [False]
        assert clear(blocked, [pair], Fraction(2), infinite=False) == [True]
        assert clear(blocked, [pair], Fraction(17), infinite=False) == [False]  # 4 cells from its end


@pytest.mark.parametrize("infinite", [False, True])
def test_a_segment_of_one_point_is_as_near_as_the_point(infinite: bool) -> None:
    blocked = np.zeros((3, 9), bool)
    blocked[2, 5] = True
    assert clear(blocked, [((2, 2), (2, 2))], Fraction(9), infinite) == [True]
    assert clear(blocked, [((2, 2), (2, 2))], Fraction(10), infinite) == [False]


def test_long_segments_on_a_large_map_agree_with_whole_numbers() -> None:
    rng = np.random.default_rng(5)
    blocked = rng.random((300, 401)) < 0.002
    r, c = np.nonzero(blocked)
    ends = np.stack((rng.integers(0, 300, (400, 2)), rng.integers(0, 401, (400, 2))), axis=2)
    pairs = [(tuple(a), tuple(b)) for a, b in ends.tolist()]
    for a, b in pairs:
        dr, dc = b[0] - a[0], b[1] - a[1]
        along, cross = (r - a[0]) * dr + (c - a[1]) * dc, (r - a[0]) * dc - (c - a[1]) * dr
        squared = dr * dr + dc * dc
        before, behind = (r - a[0]) ** 2 + (c - a[1]) ** 2, (r - b[0]) ** 2 + (c - b[1]) ** 2
        on_line = 2 * cross**2 < squared
        on_segment = np.where(along <= 0, 2 * before < 1, np.where(along >= squared, 2 * behind < 1, on_line))
        assert clear(blocked, [(a, b)], Fraction(1, 2), infinite=True) == [not on_line.any()]
        assert clear(blocked, [(a, b)], Fraction(1, 2), infinite=False) == [not on_segment.any()]


# Median insertion on an empty map ---------------------------------------------------------------


def join(a: Cell, b: Cell, signs: Cell) -> Cells:
    """Return the cells after a, to b: midpoints, rounded down on axes from start to goal."""
    if max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1:
        return (b,) if a != b else ()
    middle = tuple(s * ((s * p + s * q) // 2) for p, q, s in zip(a, b, signs, strict=True))
    return join(a, middle, signs) + join(middle, b, signs)


def open_map(shape: tuple[int, int], start: Cell, goal: Cell) -> PathProblem:
    return PathProblem(np.zeros(shape, bool), start=start, goal=goal)


class Words:
    """The random numbers that a kernel draws which is seeded from a generator of this seed."""

    def __init__(self, seed: int) -> None:
        self.words = naive.xoshiro(np.random.default_rng(seed).bit_generator.random_raw(4).tolist())

    def below(self, bound: int) -> int:
        return (next(self.words) >> 32) * bound >> 32


# Mutation between two cells ---------------------------------------------------------------------


def mutated(problem: PathProblem, paths: list[Cells], chosen: list[int], seed: int = 0, padding: int = 0, **options):
    """Return the paths and the number of failures; options as for `mutate_between`."""
    population = naive.packed(paths, problem.context.cols, padding)
    before = population.tobytes()
    with counting() as counts:
        found = mutate_between(
            population, np.array(chosen, np.int64), problem, np.random.default_rng(seed),
            **{"beyond": False, "tries": 5, "insertions": 0, **options},
        )  # fmt: skip
    assert population.tobytes() == before
    assert found.dtype == np.int32
    assert found.flags.c_contiguous
    assert set(counts) <= {"mutation failed"}
    return naive.unpacked(found, problem.context.cols), counts.get("mutation failed", 0)


def mutated_on_an_empty_map(problem, paths, chosen, seed, *, beyond, tries, insertions, loops):
    """Return what the words of the generator lead to, and how many paths stay."""
    words = Words(seed)
    out, failed = list(paths), 0
    for k in chosen:
        path = paths[k]
        least = min(2 if beyond else 1, len(path) - 2)
        for _ in range(tries if least > 0 else 0):
            i = words.below(len(path) - least)
            j = words.below(len(path) - least - 1)
            i, j = sorted((i, j + (j >= i)))
            piece = join(path[i], path[j + least], problem.context.signs)
            if len(piece) - 1 <= insertions:
                child = path[: i + 1] + piece + path[j + least + 1 :]
                out[k] = child if loops else naive.without_loops(child)
                break
        else:
            failed += 1
    return out, failed


@given(
    data=st.data(),
    shape=st.tuples(st.integers(1, 9), st.integers(1, 9)),
    seed=st.integers(0, 2**32),
    beyond=st.booleans(),
    tries=st.integers(1, 3),
    insertions=st.sampled_from([0, 1, 4]),
    loops=st.booleans(),
)
@examples(150)
def test_what_lies_between_two_cells_is_made_anew_as_the_words_say(data, shape, seed, beyond, tries, insertions, loops):
    start, goal = (data.draw(naive.cells_of(shape)) for _ in range(2))
    problem = open_map(shape, start, goal)
    paths = data.draw(st.lists(naive.paths_on(shape, 9), min_size=1, max_size=4))
    chosen = data.draw(st.lists(st.integers(0, len(paths) - 1), unique=True))
    options = {"beyond": beyond, "tries": tries, "loops": loops}
    padding = data.draw(st.integers(0, 5))
    found = mutated(problem, paths, chosen, seed, padding, insertions=insertions, **options)
    most = insertions or 4 * sum(shape)
    assert found == mutated_on_an_empty_map(problem, paths, chosen, seed, insertions=most, **options)


STAIRS = ((6, 0), (6, 2), (4, 2), (4, 4), (2, 4), (2, 6))


@pytest.mark.parametrize("beyond", [False, True])
def test_every_stretch_is_as_likely_to_be_cut(beyond: bool) -> None:
    problem = open_map((7, 7), (6, 0), (2, 6))
    cells, runs = len(STAIRS), 4000
    drawn = [mutated(problem, [STAIRS], [0], seed, beyond=beyond, loops=True)[0][0] for seed in range(runs)]
    gap = 3 if beyond else 2
    stretches = [(i, j) for i, j in itertools.combinations(range(cells), 2) if j - i >= gap]
    expected = {(*STAIRS[: i + 1], *join(STAIRS[i], STAIRS[j], (-1, 1)), *STAIRS[j + 1 :]) for i, j in stretches}
    counts = Counter(drawn)
    assert set(counts) == expected
    assert len(expected) == len(stretches)
    spread = 4 * math.sqrt(runs / len(stretches))
    assert all(abs(times - runs / len(stretches)) < spread for times in counts.values())


def test_beyond_gives_up_two_interior_cells_or_the_only_one() -> None:
    problem = open_map((7, 7), (6, 0), (2, 6))
    four = ((6, 0), (6, 6), (5, 6), (2, 6))
    assert mutated(problem, [four], [0], beyond=True)[0] == [((6, 0), *join((6, 0), (2, 6), (-1, 1)))]
    three = ((6, 0), (6, 6), (2, 6))
    for beyond in (False, True):
        assert mutated(problem, [three], [0], beyond=beyond)[0] == [((6, 0), *join((6, 0), (2, 6), (-1, 1)))]


@pytest.mark.parametrize("beyond", [False, True])
def test_paths_without_an_interior_stay_and_are_counted(beyond: bool) -> None:
    problem = open_map((7, 7), (6, 0), (2, 6))
    paths = [((6, 0), (2, 6)), ((3, 3),), STAIRS]
    assert mutated(problem, paths, [0, 1], beyond=beyond) == (paths, 2)
    assert mutated(problem, paths, [], beyond=beyond) == (paths, 0)


@given(
    data=st.data(),
    problem=naive.problems(max_side=8),
    seed=st.integers(0, 2**32),
    reach=st.sampled_from([4, 8]),
    guarded=st.booleans(),
    beyond=st.booleans(),
)
@examples(120)
def test_a_child_keeps_head_and_tail_and_goes_in_legal_single_steps_between(
    data, problem, seed, reach, guarded, beyond
):
    it = problem.context
    path = data.draw(st.lists(st.sampled_from(naive.free_cells(it.occupied)), min_size=1, max_size=8))
    path = tuple(c for k, c in enumerate(path) if k == 0 or c != path[k - 1])
    options = {"reach": reach, "guarded": guarded, "beyond": beyond}
    (child,), failed = mutated(problem, [path], [0], seed, loops=True, **options)
    if failed:
        assert child == path
        return

    def may_come_of(i: int, j: int) -> bool:
        tail = len(path) - j
        middle = child[i : len(child) - tail + 1]
        kept = child[: i + 1] == path[: i + 1] and child[len(child) - tail :] == path[j:]
        singly = naive.steps_singly(middle) if len(middle) > 1 else path[i] == path[j]
        return kept and singly and naive.path_free(it.occupied, middle, it.corners)

    gap = min(3 if beyond else 2, len(path) - 1)
    assert any(may_come_of(i, j) for i, j in itertools.combinations(range(len(path)), 2) if j - i >= gap)
    (cut,), _ = mutated(problem, [path], [0], seed, loops=False, **options)
    assert cut == naive.without_loops(child)


def test_a_stretch_that_cannot_be_joined_is_drawn_again() -> None:
    blocked = np.zeros((7, 7), bool)
    blocked[1:6, 2:5] = True  # a block whose middle has no free neighbour
    problem = PathProblem(blocked, start=(3, 0), goal=(3, 6))
    path = (
        *((r, 0) for r in (3, 2, 1, 0)), *((0, c) for c in range(1, 7)), *((r, 6) for r in (1, 2, 3)),
    )  # fmt: skip
    failed = [sum(mutated(problem, [path], [0], seed, tries=tries)[1] for seed in range(200)) for tries in (1, 2, 40)]
    assert failed[0] > 20
    assert 0 < failed[1] < failed[0]
    assert failed[2] == 0


def test_the_words_alone_decide() -> None:
    problem = PathProblem(pl.load_map("iga-map1"))
    path = next(iter(naive.unpacked(sample(problem, 1, 3), 10)))
    assert mutated(problem, [path] * 9, list(range(9)), 7) == mutated(problem, [path] * 9, list(range(9)), 7)
    assert mutated(problem, [path] * 9, list(range(9)), 7) != mutated(problem, [path] * 9, list(range(9)), 8)


# Paths joined in turn ---------------------------------------------------------------------------


def sample(problem: PathProblem, n: int, seed: int, libraries=(), **options) -> np.ndarray:
    ids = [np.array([r * problem.context.cols + c for r, c in cells], np.int32) for cells in libraries]
    rng = np.random.default_rng(seed)
    found = sample_in_turn(problem, ids, n, rng, **{"tries": 50, "redraws": 3, "insertions": 0, **options})
    assert found.dtype == np.int32
    assert found.flags.c_contiguous
    return found


def in_turn_on_an_empty_map(problem, libraries, n, seed, *, tries, redraws, insertions, loops):
    """Return the paths that the words of the generator lead to, the tries that fail and the cells drawn again."""
    words = Words(seed)
    paths, failed, again, in_a_row = [], 0, 0, 0
    while len(paths) < n and in_a_row < tries:
        path: Cells = (problem.start,)
        for library in [*filter(None, libraries), None]:
            here = path[-1]
            for attempt in range(redraws if library else 1):
                cell = library[words.below(len(library))] if library else problem.goal
                again += attempt > 0
                piece = join(here, cell, problem.context.signs)
                if len(piece) - 1 <= insertions:
                    path += piece
                    break
            else:
                failed, in_a_row = failed + 1, in_a_row + 1
                break
        else:
            paths.append(path if loops else naive.without_loops(path))
            in_a_row = 0
    return paths, failed, again


@given(
    data=st.data(),
    shape=st.tuples(st.integers(1, 8), st.integers(1, 8)),
    seed=st.integers(0, 2**32),
    tries=st.integers(1, 4),
    redraws=st.integers(1, 3),
    insertions=st.sampled_from([0, 1, 2]),
    loops=st.booleans(),
)
@examples(150)
def test_each_cell_is_joined_as_it_is_drawn(data, shape, seed, tries, redraws, insertions, loops) -> None:
    start, goal = (data.draw(naive.cells_of(shape)) for _ in range(2))
    problem = open_map(shape, start, goal)
    libraries = data.draw(st.lists(st.lists(naive.cells_of(shape), max_size=4), max_size=4))
    options = {"tries": tries, "redraws": redraws, "loops": loops}
    with counting() as counts:
        found = sample(problem, 4, seed, libraries, insertions=insertions, **options)
    if start == goal:
        assert naive.unpacked(found, shape[1]) == [(start,)] * 4
        return
    most = insertions or 4 * sum(shape)
    paths, failed, again = in_turn_on_an_empty_map(problem, libraries, 4, seed, insertions=most, **options)
    repeated = len(found) - len(paths)
    assert naive.unpacked(found, shape[1]) == [paths[k % len(paths)] for k in range(4) if paths]
    expected = {"samples failed": failed, "cells drawn again": again, "samples repeated": repeated}
    assert counts == {event: times for event, times in expected.items() if times}


@given(problem=naive.problems(max_side=8), seed=st.integers(0, 2**32), redraws=st.sampled_from([1, 5]))
@examples(80)
def test_paths_in_turn_are_legal_on_any_map(problem: PathProblem, seed: int, redraws: int) -> None:
    it = problem.context
    free = naive.free_cells(it.occupied)
    libraries = [free[::3], free[1::2], free[2::5]]
    for loops in (False, True):
        for path in naive.unpacked(sample(problem, 3, seed, libraries, redraws=redraws, loops=loops), it.cols):
            assert (path[0], path[-1]) == problem.ends
            assert len(path) == 1 or naive.steps_singly(path)
            assert naive.path_free(it.occupied, path, it.corners)
            assert loops or len(set(path)) == len(path)


def test_a_cell_that_cannot_be_joined_is_drawn_again_and_not_the_whole_path() -> None:
    pocket = PathProblem([[0, 0, 1, 0], [0, 0, 1, 0], [0, 0, 1, 0]], start=(2, 0), goal=(0, 0))
    library = [(1, 1), (1, 3)]  # the second one has a wall before it
    with counting() as counts:
        sample(pocket, 50, 0, [library], redraws=1)
    assert 25 < counts["samples failed"] < 75
    with counting() as counts:
        sample(pocket, 50, 0, [library], redraws=60)
    assert set(counts) == {"cells drawn again"}


def test_where_nothing_can_be_joined_sampling_ends() -> None:
    split = PathProblem([[0, 1, 0]], start=(0, 0), goal=(0, 2))
    with counting() as counts:
        assert len(sample(split, 5, 0, [[(0, 0), (0, 2)]], tries=7)) == 0
    assert counts["samples failed"] == 7
