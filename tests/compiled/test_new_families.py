"""Kernels that rewrite paths, exchange tails and count what lies beside, against their twins."""

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import Cell, Cells, examples

from pathloom import PathProblem, compiled
from pathloom.paths.context import Context
from pathloom.paths.lines import lines_between

shapes = st.tuples(st.integers(1, 8), st.integers(1, 8))

# Without loops ----------------------------------------------------------------------------------


def without_loops(paths: list[Cells], shape: Cell, padding: int = 0) -> list[Cells]:
    population = naive.packed(paths, shape[1], padding)
    before = population.copy()
    found = compiled.reshaping.without_loops(population, shape[0] * shape[1])
    np.testing.assert_array_equal(population, before)
    assert found.dtype == np.int32
    assert found.shape == (len(paths), max([1, *((row >= 0).sum() for row in found)]))
    return naive.unpacked(found, shape[1])


@given(data=st.data(), shape=st.tuples(st.integers(1, 3), st.integers(1, 3)), padding=st.integers(0, 4))
@examples(100)
def test_what_lies_between_two_visits_is_cut_out(data, shape: Cell, padding: int) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape, 14), min_size=1, max_size=4))
    found = without_loops(paths, shape, padding)
    assert found == [naive.without_loops(path) for path in paths]
    assert without_loops(found, shape) == found
    for path, cut in zip(paths, found, strict=True):
        assert len(set(cut)) == len(cut)
        assert (cut[0], cut[-1]) == (path[0], path[-1])


def test_a_path_that_comes_back_to_its_start_is_one_cell() -> None:
    assert without_loops([((0, 0), (0, 1), (0, 0))], (1, 2)) == [((0, 0),)]


def test_the_loop_that_closes_first_goes_first() -> None:
    eight = ((0, 0), (0, 1), (0, 2), (1, 2), (0, 1), (1, 1), (0, 2), (0, 3))
    assert without_loops([eight], (2, 4)) == [((0, 0), (0, 1), (1, 1), (0, 2), (0, 3))]


def test_a_cell_twice_in_a_row_is_a_loop_too() -> None:
    population = np.array([[3, 3, 4, 4, 4, 5]], np.int32)
    assert compiled.reshaping.without_loops(population, 9).tolist() == [[3, 4, 5]]


# Cell by cell -----------------------------------------------------------------------------------


def cell_by_cell(paths: list[Cells], cols: int, padding: int = 0) -> list[Cells]:
    population = naive.packed(paths, cols, padding)
    before = population.copy()
    found = compiled.reshaping.cell_by_cell(population, cols)
    np.testing.assert_array_equal(population, before)
    assert found.dtype == np.int32
    return naive.unpacked(found, cols)


@given(data=st.data(), shape=shapes, padding=st.integers(0, 4))
@examples(150)
def test_every_cell_whose_inside_is_crossed_is_named_in_order(data, shape: Cell, padding: int) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape, 6), min_size=1, max_size=4))
    found = cell_by_cell(paths, shape[1], padding)
    assert found == [naive.cell_by_cell(path) for path in paths]
    for path, cells in zip(paths, found, strict=True):
        assert set(cells) == naive.crossed(shape, path)
        assert naive.steps_singly(cells)
        assert (cells[0], cells[-1]) == (path[0], path[-1])
    assert cell_by_cell(found, shape[1]) == found


def test_every_segment_of_a_small_map_is_crossed_as_clipping_in_fractions_says() -> None:
    cells = [divmod(k, 9) for k in range(63)]
    paths = [(a, b) for a in cells for b in cells if a != b]
    assert cell_by_cell(paths, 9) == [naive.cell_by_cell(path) for path in paths]


def test_through_a_corner_the_path_steps_across() -> None:
    assert cell_by_cell([((0, 0), (2, 6))], 7) == [
        ((0, 0), (0, 1), (1, 2), (1, 3), (1, 4), (2, 5), (2, 6)),
    ]


def test_long_segments_have_room_for_all_their_cells() -> None:
    far = [((0, 0), (0, 499)), ((499, 0), (0, 0), (0, 499), (499, 499))]
    row, around = cell_by_cell(far, 500)
    assert row == tuple((0, c) for c in range(500))
    assert (len(around), len(set(around))) == (3 * 499 + 1,) * 2
    steep = ((119, 0), (0, 79))
    assert cell_by_cell([steep], 80) == [naive.cell_by_cell(steep)]


def test_backwards_the_same_cells_come_in_reverse() -> None:
    there, back = cell_by_cell([((1, 0), (6, 8)), ((6, 8), (1, 0))], 9)
    assert there == back[::-1]


def test_one_cell_and_nobody_stay_as_they_are() -> None:
    nobody = np.empty((0, 3), np.int32)
    assert cell_by_cell([((1, 1),)], 3) == [((1, 1),)]
    assert compiled.reshaping.cell_by_cell(nobody, 3).shape == (0, 1)
    assert compiled.reshaping.without_loops(nobody, 9).shape == (0, 1)


# Tails ------------------------------------------------------------------------------------------


@st.composite
def exchanges(draw: st.DrawFn) -> tuple[Cell, list[Cells], list, list, list]:
    """Draw paths, disjoint pairs of them, where each is cut, and which children are wanted."""
    shape = draw(st.tuples(st.integers(1, 3), st.integers(1, 3)))
    paths = draw(st.lists(naive.paths_on(shape, 9), min_size=2, max_size=6))
    order = draw(st.permutations(range(len(paths))))
    pairs = [order[k : k + 2] for k in range(0, len(order) - 1, 2)][: draw(st.integers(0, 3))]
    at = [[draw(st.integers(0, len(paths[k]) - 1)) for k in pair] for pair in pairs]
    wanted = [[draw(st.booleans()), draw(st.booleans())] for _ in pairs]
    return shape, paths, pairs, at, wanted


def spliced(shape: Cell, paths: list[Cells], pairs, at, wanted, *, loops: bool, padding: int = 0) -> list[Cells]:
    population = naive.packed(paths, shape[1], padding)
    before = population.copy()
    whole = (np.array(table, np.int64).reshape(-1, 2) for table in (pairs, at))
    chosen = np.array(wanted, np.bool_).reshape(-1, 2)
    found = compiled.exchange.splice(population, *whole, chosen, shape[0] * shape[1], loops)
    np.testing.assert_array_equal(population, before)
    assert found.dtype == np.int32
    return naive.unpacked(found, shape[1])


@given(drawn=exchanges(), loops=st.booleans(), padding=st.integers(0, 3))
@examples(120)
def test_wanted_children_have_a_head_and_the_others_tail_and_all_others_stay(drawn, loops: bool, padding: int) -> None:
    _, paths, pairs, at, wanted = drawn
    expected = list(paths)
    for (x, y), (i, j), (first, second) in zip(pairs, at, wanted, strict=True):
        if first:
            expected[x] = paths[x][: i + 1] + paths[y][j + 1 :]
        if second:
            expected[y] = paths[y][: j + 1] + paths[x][i + 1 :]
    if not loops:
        changed = {k for pair, want in zip(pairs, wanted, strict=True) for k, w in zip(pair, want, strict=True) if w}
        expected = [naive.without_loops(path) if k in changed else path for k, path in enumerate(expected)]
    assert spliced(*drawn, loops=loops, padding=padding) == expected


MOTHER, FATHER = ((0, 0), (0, 1), (0, 2), (0, 3)), ((1, 0), (1, 1), (1, 2), (1, 3), (1, 4))


@pytest.mark.parametrize(
    ("wanted", "first", "second"),
    [
        ([True, True], (*MOTHER[:2], *FATHER[3:]), (*FATHER[:3], *MOTHER[2:])),
        ([True, False], (*MOTHER[:2], *FATHER[3:]), FATHER),
        ([False, True], MOTHER, (*FATHER[:3], *MOTHER[2:])),
        ([False, False], MOTHER, FATHER),
    ],
)
def test_each_of_the_two_children_can_be_wanted_alone(wanted: list[bool], first: Cells, second: Cells) -> None:
    assert spliced((2, 5), [MOTHER, FATHER], [[0, 1]], [[1, 2]], [wanted], loops=True) == [first, second]


def test_a_child_may_be_longer_than_both_parents_or_shorter() -> None:
    found = spliced((2, 5), [MOTHER, FATHER], [[0, 1]], [[3, 0]], [[True, True]], loops=True)
    assert found == [MOTHER + FATHER[1:], FATHER[:1]]


# Beside a path ----------------------------------------------------------------------------------


@given(data=st.data(), blocked=naive.maps(), padding=st.integers(0, 4))
@examples(100)
def test_obstacles_beside_a_path_count_once_each(data, blocked: np.ndarray, padding: int) -> None:
    paths = data.draw(st.lists(naive.paths_on(blocked.shape, 6), min_size=1, max_size=4))
    cols = blocked.shape[1]
    around = Context(blocked, "allow", 0, 0).beside
    found = compiled.measures.obstacles_beside(naive.packed(paths, cols, padding), around, cols)
    assert found.tolist() == [len(naive.obstacles_beside(blocked, path)) for path in paths]


# Libraries --------------------------------------------------------------------------------------


def sampled(problem: PathProblem, n: int, state: list[int], *, cap: int, loops: bool = True):
    """Draw paths through one cell of each line between start and goal."""
    it = problem.context
    lines = lines_between(it)
    words = np.array(state, np.uint64)
    return compiled.libraries.sample_from_libraries(
        n, 50, 1, 0, False, it.start, it.goal, np.concatenate(lines), np.cumsum([0, *map(len, lines)]),
        it.blocked, it.moves, it.rows, it.cols, *it.signs, 8, cap, True, loops, words,
    )  # fmt: skip


def test_the_same_words_give_the_same_bytes_and_others_do_not() -> None:
    problem = PathProblem(np.zeros((9, 9), bool))
    first, again, other = (sampled(problem, 6, [1, 2, 3, k], cap=40)[0].tobytes() for k in (4, 4, 5 << 40))
    assert first == again != other


def test_a_longer_sample_begins_with_the_shorter_one() -> None:
    problem = PathProblem(np.zeros((9, 9), bool))
    few, many = (naive.unpacked(sampled(problem, n, [1, 2, 3, 4], cap=40)[0], 9) for n in (4, 40))
    assert many[:4] == few


@pytest.mark.parametrize("n", [0, 1, 400])
def test_there_is_room_for_paths_that_go_to_and_fro(n: int) -> None:
    problem = PathProblem(np.zeros((30, 30), bool), start=(29, 0), goal=(0, 0))  # each path is some 300 cells long
    found, failed = sampled(problem, n, [1, 2, 3, 4], cap=240)
    paths = naive.unpacked(found, 30)
    assert (len(paths), failed) == (n, 0)
    assert all(naive.steps_singly(path) and (path[0], path[-1]) == problem.ends for path in paths)


@pytest.mark.parametrize("col", range(9))
def test_a_gap_that_needs_more_insertions_than_allowed_fails(col: int) -> None:
    it = PathProblem(np.zeros((3, 9), bool), start=(2, 0), goal=(0, 0)).context
    needed = max(col - 1, 0)  # cells strictly between the ends' column and this one
    for cap in {needed, max(needed - 1, 0)}:
        found, failed = compiled.libraries.sample_from_libraries(
            1, 1, 1, 0, False, it.start, it.goal, np.array([9 + col], np.int32), np.array([0, 1]),
            it.blocked, it.moves, it.rows, it.cols, *it.signs, 8, cap, True, True, np.array([1, 2, 3, 4], np.uint64),
        )  # fmt: skip
        assert (len(found), failed) == ((1, 0) if cap >= needed else (0, 1))


# Some paths in the places of others -------------------------------------------------------------


@given(data=st.data())
@examples(100)
def test_paths_take_the_places_of_others_and_the_array_is_no_wider_than_needed(data) -> None:
    several = st.lists(naive.paths_on((4, 5), 6), min_size=1, max_size=5)
    paths, others = data.draw(several), data.draw(several)
    places = data.draw(st.permutations(range(len(paths))))[: len(others)]
    packed, rows = naive.packed(paths, 5, 3), naive.packed(others, 5, 1)[: len(places)]
    found = compiled.reshaping.replaced(packed, np.array(places, np.int64), np.ascontiguousarray(rows))
    expected = list(paths)
    for place, other in zip(places, others, strict=False):
        expected[place] = other
    assert found.tolist() == naive.packed(expected, 5, 0).tolist()
