"""Kernels on segments, against clipping in fractions and by hand."""

import math

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, Cell, Cells, examples

from pathloom import compiled
from pathloom.paths.context import POLICIES as NUMBERS
from pathloom.paths.context import Context


def free(blocked: np.ndarray, pairs: list[tuple[Cell, Cell]], corners: str) -> list[bool]:
    cols = blocked.shape[1]
    ids = np.array([[r * cols + c for r, c in pair] for pair in pairs], np.int32).reshape(-1, 2)
    first, second = (np.ascontiguousarray(ids[:, k]) for k in (0, 1))
    flat = np.ascontiguousarray(blocked, np.uint8).ravel()
    return compiled.segments.segments_free(flat, cols, first, second, NUMBERS[corners]).tolist()


def clearances(blocked: np.ndarray, paths: list[Cells], padding: int = 0) -> np.ndarray:
    it = Context(blocked, "allow", 0, 0)
    population = naive.packed(paths, it.cols, padding)
    return compiled.measures.clearances(population, it.blocked, it.distance, it.rows, it.cols)


def flagged(flag: np.ndarray, paths: list[Cells], padding: int = 0) -> list[float]:
    cols = flag.shape[1]
    population = naive.packed(paths, cols, padding)
    return compiled.measures.flagged_cells(population, np.ascontiguousarray(flag, np.uint8).ravel(), cols).tolist()


def deleted(blocked: np.ndarray, paths: list[Cells], corners: str, passes: int, padding: int = 0) -> list[Cells]:
    cols = blocked.shape[1]
    population = naive.packed(paths, cols, padding)
    flat = np.ascontiguousarray(blocked, np.uint8).ravel()
    shorter = compiled.segments.delete_points(population, flat, cols, NUMBERS[corners], passes)
    assert shorter.dtype == np.int32
    return naive.unpacked(shorter, cols)


def drawn(*rows: str) -> np.ndarray:
    return np.array([[glyph == "#" for glyph in row] for row in rows])


@given(data=st.data(), blocked=naive.maps(), corners=st.sampled_from(POLICIES))
@examples(150)
def test_segments_are_free_where_clipping_in_fractions_says_so(data, blocked: np.ndarray, corners: str) -> None:
    cell = naive.cells_of(blocked.shape)
    pairs = data.draw(st.lists(st.tuples(cell, cell), max_size=12))
    assert free(blocked, pairs, corners) == [naive.segment_free(blocked, a, b, corners) for a, b in pairs]


@pytest.mark.parametrize("corners", POLICIES)
def test_every_segment_of_a_map_agrees_with_its_twin(corners: str) -> None:
    blocked = np.random.default_rng(4).random((7, 8)) < 0.25
    cells = [divmod(k, 8) for k in range(56)]
    pairs = [(a, b) for a in cells for b in cells]
    assert free(blocked, pairs, corners) == [naive.segment_free(blocked, a, b, corners) for a, b in pairs]


@pytest.mark.parametrize("corners", POLICIES)
def test_a_segment_of_one_point_is_free_where_its_cell_is(corners: str) -> None:
    blocked = drawn(".#", "#.")
    assert free(blocked, [((0, 0), (0, 0)), ((0, 1), (0, 1)), ((1, 1), (1, 1))], corners) == [True, False, True]


@pytest.mark.parametrize("corners", POLICIES)
def test_a_map_of_one_cell_has_one_segment(corners: str) -> None:
    assert free(drawn("."), [((0, 0), (0, 0))], corners) == [True]
    assert free(drawn("#"), [((0, 0), (0, 0))], corners) == [False]


@pytest.mark.parametrize("corners", POLICIES)
def test_on_a_map_of_one_row_or_column_an_obstacle_between_blocks(corners: str) -> None:
    row = drawn("....#..")
    pairs = [((0, 0), (0, 3)), ((0, 3), (0, 0)), ((0, 3), (0, 5)), ((0, 6), (0, 5)), ((0, 4), (0, 6))]
    assert free(row, pairs, corners) == [True, True, False, True, False]
    assert free(row.T, [(a[::-1], b[::-1]) for a, b in pairs], corners) == [True, True, False, True, False]


@pytest.mark.parametrize(
    ("blocked", "expected"),
    [
        (drawn("..", ".."), {"allow": True, "no-squeeze": True, "strict": True}),
        (drawn(".#", ".."), {"allow": True, "no-squeeze": True, "strict": False}),
        (drawn(".#", "#."), {"allow": True, "no-squeeze": False, "strict": False}),
    ],
    ids=["open", "graze", "squeeze"],
)
def test_the_policies_differ_at_corners_only(blocked: np.ndarray, expected: dict[str, bool]) -> None:
    found = {corners: free(blocked, [((0, 0), (1, 1)), ((1, 1), (0, 0))], corners) for corners in POLICIES}
    assert found == {corners: [answer] * 2 for corners, answer in expected.items()}


def test_a_corner_in_the_middle_of_a_long_segment_counts_as_one_at_its_end() -> None:
    # (0, 0) to (2, 6) has slope 1/3 and passes through the corners (½, 1½) and (1½, 4½)
    graze = drawn("..#....", ".......", ".......")
    assert [free(graze, [((0, 0), (2, 6))], corners)[0] for corners in POLICIES] == [True, True, False]
    squeeze = drawn(".......", ".....#.", "....#..")
    assert [free(squeeze, [((0, 0), (2, 6))], corners)[0] for corners in POLICIES] == [True, False, False]


def test_a_wall_beside_a_straight_segment_is_not_touched() -> None:
    assert free(drawn("####", "....", "####"), [((1, 0), (1, 3))], "strict") == [True]


def test_everything_blocked_but_a_diagonal_leaves_it_to_allow() -> None:
    blocked = ~np.eye(5, dtype=bool)
    assert [free(blocked, [((0, 0), (4, 4))], corners)[0] for corners in POLICIES] == [True, False, False]


def test_no_segments_give_no_answers() -> None:
    assert free(drawn("..", ".."), [], "strict") == []


@given(data=st.data(), blocked=naive.maps(), corners=st.sampled_from(POLICIES), passes=st.integers(0, 3))
@examples(100)
def test_deletion_drops_the_points_that_its_twin_drops(data, blocked, corners: str, passes: int) -> None:
    paths = data.draw(st.lists(naive.paths_on(blocked.shape), min_size=1, max_size=3))
    expected = [naive.without_points(blocked, path, corners, passes) for path in paths]
    assert deleted(blocked, paths, corners, passes, padding=data.draw(st.integers(0, 5))) == expected


def test_a_second_pass_deletes_what_the_first_one_set_free() -> None:
    blocked = drawn("...", "#..", ".#.")
    path = ((2, 0), (1, 1), (1, 2), (0, 2))  # only without (1, 2) is (1, 1) on a straight line
    assert deleted(blocked, [path], "allow", 1) == [((2, 0), (1, 1), (0, 2))]
    assert deleted(blocked, [path], "allow", 2) == [((2, 0), (0, 2))]
    assert deleted(blocked, [path], "allow", 0) == [((2, 0), (0, 2))]


def test_deletion_trims_the_population_to_its_widest_row() -> None:
    blocked = np.zeros((1, 9), np.uint8).ravel()
    population = naive.packed([tuple((0, c) for c in range(9)), ((0, 0),)], 9, padding=20)
    before = population.copy()
    shorter = compiled.segments.delete_points(population, blocked, 9, 2, 1)
    assert shorter.tolist() == [[0, 8], [0, -1]]
    np.testing.assert_array_equal(population, before)


@given(data=st.data(), blocked=naive.maps())
@examples(120)
def test_clearance_is_the_least_distance_in_fractions(data, blocked: np.ndarray) -> None:
    paths = data.draw(st.lists(naive.paths_on(blocked.shape, 4), min_size=1, max_size=3))
    expected = [naive.clearance(blocked, path) for path in paths]
    assert clearances(blocked, paths, padding=data.draw(st.integers(0, 5))) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_clearance_finds_a_lone_obstacle_far_from_every_node(seed: int) -> None:
    rng = np.random.default_rng(seed)
    blocked = np.zeros((25, 40), bool)
    blocked[tuple(rng.integers((25, 40)))] = True
    paths = [tuple((int(r), int(c)) for r, c in rng.integers((25, 40), size=(3, 2))) for _ in range(20)]
    assert clearances(blocked, paths) == pytest.approx([naive.clearance(blocked, path) for path in paths], abs=1e-12)


def test_clearance_of_a_single_cell_is_its_distance_to_the_nearest_border() -> None:
    blocked = drawn("....", "....", "...#")
    assert clearances(blocked, [((0, 0),), ((2, 2),), ((2, 3),)]) == pytest.approx([math.hypot(1.5, 2.5), 0.5, 0.0])


def test_clearance_is_zero_where_a_corner_is_touched() -> None:
    assert clearances(drawn(".#", ".."), [((0, 0), (1, 1))]).tolist() == [0.0]


def test_clearance_without_obstacles_is_infinite() -> None:
    assert clearances(np.zeros((3, 3), bool), [((0, 0), (2, 2)), ((1, 1),)]).tolist() == [math.inf, math.inf]


@given(data=st.data(), flag=naive.maps())
@examples(120)
def test_flagged_cells_are_those_whose_inside_is_crossed(data, flag: np.ndarray) -> None:
    paths = data.draw(st.lists(naive.paths_on(flag.shape, 5), min_size=1, max_size=3))
    expected = [sum(bool(flag[cell]) for cell in naive.crossed(flag.shape, path)) for path in paths]
    assert flagged(flag, paths, padding=data.draw(st.integers(0, 5))) == expected


def test_a_diagonal_step_crosses_its_two_cells_and_not_the_two_beside_it() -> None:
    assert flagged(np.ones((2, 2), bool), [((0, 0), (1, 1))]) == [2.0]


def test_a_cell_that_is_crossed_twice_counts_once() -> None:
    assert flagged(np.ones((1, 3), bool), [((0, 0), (0, 2), (0, 0))]) == [3.0]


def test_a_path_of_one_cell_crosses_it() -> None:
    assert flagged(drawn("#."), [((0, 0),), ((0, 1),)]) == [1.0, 0.0]


def test_empty_populations_give_empty_answers() -> None:
    nobody = np.empty((0, 1), np.int32)
    blocked = np.zeros(4, np.uint8)
    assert compiled.segments.delete_points(nobody, blocked, 2, 2, 1).shape == (0, 1)
    assert compiled.measures.clearances(nobody, blocked, np.full(4, np.inf), 2, 2).shape == (0,)
    assert compiled.measures.flagged_cells(nobody, blocked, 2).shape == (0,)
