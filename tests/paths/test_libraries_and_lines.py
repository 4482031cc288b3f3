"""Lines of cells across the way, and paths through one cell of each of several libraries."""

import itertools

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, Cell, Cells, examples

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.paths.insertion import sample_through
from pathloom.paths.lines import lines_between

Libraries = list[list[Cell]]


def open_map(rows: int, cols: int, start: Cell, goal: Cell) -> pl.PathProblem:
    return pl.PathProblem(np.zeros((rows, cols), bool), start=start, goal=goal)


def sampled(problem: pl.PathProblem, libraries: Libraries, n: int, seed: int = 0, **options):
    """Return the paths and the counts; options as for `sample_through`."""
    cols = problem.context.cols
    ids = [np.array([r * cols + c for r, c in cells], np.int32) for cells in libraries]
    with counting() as counts:
        found = sample_through(
            problem, ids, n, np.random.default_rng(seed), **{"tries": 20, "insertions": 0, **options}
        )
    assert found.dtype == np.int32
    assert found.flags.c_contiguous
    return naive.unpacked(found, cols), counts


# Lines ------------------------------------------------------------------------------------------


def strictly_between(a: int, b: int) -> list[int]:
    return list(range(a + 1, b)) if a < b else list(range(a - 1, b, -1))


def twin_of_lines(problem: pl.PathProblem) -> Libraries:
    (r0, c0), (r1, c1) = problem.ends
    free = naive.free_cells(problem.context.occupied)
    if abs(c1 - c0) > abs(r1 - r0):
        return [[cell for cell in free if cell[1] == c] for c in strictly_between(c0, c1)]
    return [[cell for cell in free if cell[0] == r] for r in strictly_between(r0, r1)]


def lines(problem: pl.PathProblem) -> Libraries:
    return [[divmod(cell, problem.context.cols) for cell in line.tolist()] for line in lines_between(problem.context)]


@given(problem=naive.problems(max_side=8))
@examples(120)
def test_lines_are_the_free_cells_of_each_row_or_column_between_the_ends(problem: pl.PathProblem) -> None:
    assert lines(problem) == twin_of_lines(problem)
    assert all(line.dtype == np.int32 for line in lines_between(problem.context))


@pytest.mark.parametrize(
    ("start", "goal", "rows", "cols"),
    [
        ((4, 1), (0, 3), [3, 2, 1], []),
        ((0, 3), (4, 1), [1, 2, 3], []),
        ((1, 0), (3, 4), [], [1, 2, 3]),
        ((3, 4), (1, 0), [], [3, 2, 1]),
        ((0, 0), (4, 4), [1, 2, 3], []),
        ((2, 6), (2, 3), [], [5, 4]),
        ((4, 2), (1, 2), [3, 2], []),
        ((2, 2), (3, 3), [], []),
        ((2, 2), (2, 2), [], []),
    ],
    ids=["up", "down", "right", "left", "diagonal", "one row", "one column", "adjacent", "one cell"],
)
def test_lines_come_in_the_order_of_the_way(start: Cell, goal: Cell, rows: list[int], cols: list[int]) -> None:
    expected = [[(r, c) for c in range(7)] for r in rows] + [[(r, c) for r in range(5)] for c in cols]
    assert lines(open_map(5, 7, start, goal)) == expected


def test_a_line_that_is_blocked_is_empty() -> None:
    problem = pl.PathProblem([[0, 0], [1, 1], [0, 1], [0, 0]], start=(3, 0), goal=(0, 0))
    assert lines(problem) == [[(2, 0)], []]


def test_lines_hold_free_cells_that_cannot_be_reached_too() -> None:
    problem = pl.PathProblem([[0, 1, 0], [0, 1, 0], [0, 1, 0]], start=(2, 0), goal=(0, 0))
    assert lines(problem) == [[(1, 0), (1, 2)]]


# Paths through libraries ------------------------------------------------------------------------


def joined(a: Cell, b: Cell, signs: Cell) -> Cells:
    """Return what median insertion makes of a gap on an empty map: the cells after a, to b."""
    if max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1:
        return (b,) if a != b else ()
    middle = tuple(s * ((s * p + s * q) // 2) for p, q, s in zip(a, b, signs, strict=True))
    return joined(a, middle, signs) + joined(middle, b, signs)


def twin_on_an_empty_map(problem, libraries, n, seed, *, tries, insertions, step, redraws, to_goal, loops):
    """Return the paths that the words of the generator lead to, and how many tries fail."""
    words = naive.xoshiro(np.random.default_rng(seed).bit_generator.random_raw(4).tolist())
    start, goal = problem.ends

    def near(a: Cell, b: Cell) -> bool:
        return step == 0 or max(abs(a[0] - b[0]), abs(a[1] - b[1])) < step

    def path() -> Cells | None:
        cells = [start]
        for library in filter(None, libraries):
            for _ in range(redraws):
                cell = library[(next(words) >> 32) * len(library) >> 32]
                if near(cells[-1], cell):
                    cells.append(cell)
                    break
            else:
                return None
        if to_goal and not near(cells[-1], goal):
            return None
        found = (start,)
        for a, b in itertools.pairwise([*cells, goal]):
            piece = joined(a, b, problem.context.signs)
            if len(piece) - 1 > insertions:
                return None
            found += piece
        return found if loops else naive.without_loops(found)

    paths, failed, in_a_row = [], 0, 0
    while len(paths) < n and in_a_row < tries:
        if made := path():
            paths.append(made)
            in_a_row = 0
        else:
            failed += 1
            in_a_row += 1
    return paths, failed


@st.composite
def libraries_on(draw: st.DrawFn, free: list[Cell]) -> Libraries:
    return draw(st.lists(st.lists(st.sampled_from(free), max_size=5), max_size=4))


@given(
    data=st.data(),
    shape=st.tuples(st.integers(1, 7), st.integers(1, 7)),
    seed=st.integers(0, 999),
    tries=st.sampled_from([1, 2, 9]),
    insertions=st.sampled_from([0, 1, 3]),
    step=st.integers(0, 7),
    redraws=st.integers(1, 4),
    to_goal=st.booleans(),
    loops=st.booleans(),
)
@examples(200)
def test_on_an_empty_map_paths_go_straight_through_the_cells_drawn(
    data, shape, seed, tries, insertions, step, redraws, to_goal, loops
) -> None:
    start, goal = (data.draw(naive.cells_of(shape)) for _ in range(2))
    problem = open_map(*shape, start, goal)
    libraries = data.draw(libraries_on(naive.free_cells(problem.context.occupied)))
    options = {"tries": tries, "step": step, "redraws": redraws, "to_goal": to_goal, "loops": loops}
    found, counts = sampled(problem, libraries, 5, seed, insertions=insertions, **options)
    if start == goal:
        assert (found, counts) == ([(start,)] * 5, {})
        return
    most = insertions or 4 * sum(shape)
    expected, failed = twin_on_an_empty_map(problem, libraries, 5, seed, insertions=most, **options)
    assert counts.get("samples failed", 0) == failed
    assert counts.get("samples repeated", 0) == (5 - len(expected) if expected else 0)
    assert found == [expected[k % len(expected)] for k in range(5 if expected else 0)]


def visits(path: Cells, libraries: Libraries, step: int, to_goal: bool) -> bool:
    """Say whether a path can be one through a cell of each library in turn, each near enough to the one before."""

    def near(i: int, j: int) -> bool:
        (r, c), (q, d) = path[i], path[j]
        return step == 0 or max(abs(r - q), abs(c - d)) < step

    reached = {0}
    for library in filter(None, libraries):
        reached = {j for i in reached for j in range(i, len(path)) if path[j] in library and near(i, j)}
    return any(not to_goal or near(i, -1) for i in reached)


@given(
    data=st.data(),
    problem=naive.problems(),
    seed=st.integers(0, 999),
    step=st.integers(0, 5),
    to_goal=st.booleans(),
    reach=st.sampled_from([4, 8]),
    guarded=st.booleans(),
    insertions=st.sampled_from([0, 2, 9]),
)
@examples(150)
def test_paths_are_legal_and_visit_the_libraries_in_order(
    data, problem, seed, step, to_goal, reach, guarded, insertions
) -> None:
    libraries = data.draw(libraries_on(naive.free_cells(problem.context.occupied)))
    options = {"step": step, "redraws": 3, "to_goal": to_goal, "reach": reach, "guarded": guarded}
    found, counts = sampled(problem, libraries, 5, seed, insertions=insertions, loops=True, **options)
    assert len(found) in (0, 5)
    assert found or counts["samples failed"] == 20
    for path in found:
        assert (path[0], path[-1]) == problem.ends
        assert naive.steps_singly(path)
        assert naive.path_free(problem.context.occupied, path, problem.corners)
        assert problem.start == problem.goal or visits(path, libraries, step, to_goal)
    cut, again = sampled(problem, libraries, 5, seed, insertions=insertions, **options)
    assert (cut, again) == ([naive.without_loops(path) for path in found], counts)


@pytest.mark.parametrize("corners", POLICIES)
def test_through_the_lines_of_a_map_paths_are_found_under_each_corner_policy(corners: str) -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners=corners)
    found, counts = sampled(problem, lines(problem), 30, tries=1000, redraws=5, loops=True)
    assert len(found) == 30
    assert "samples repeated" not in counts
    assert len(set(found)) > 10
    for path in found:
        assert pl.validate(path, problem) is None
        assert visits(path, lines(problem), 0, False)


def test_a_cell_may_lie_less_than_a_step_away_and_not_as_much() -> None:
    problem = open_map(1, 9, (0, 0), (0, 8))
    for step, allowed in ((3, False), (4, True)):
        found, counts = sampled(problem, [[(0, 3)]], 2, step=step)
        assert (len(found), "samples failed" in counts) == ((2, False) if allowed else (0, True))


def test_the_last_cell_may_be_far_from_the_goal_unless_that_is_limited_too() -> None:
    problem = open_map(1, 9, (0, 0), (0, 8))
    assert len(sampled(problem, [[(0, 2)]], 2, step=6)[0]) == 2
    assert len(sampled(problem, [[(0, 2)]], 2, step=7, to_goal=True)[0]) == 2
    assert sampled(problem, [[(0, 2)]], 2, step=6, to_goal=True) == ([], {"samples failed": 20})
    assert sampled(problem, [], 2, step=8, to_goal=True) == ([], {"samples failed": 20})
    assert len(sampled(problem, [], 2, step=9, to_goal=True)[0]) == 2


def test_a_cell_that_is_too_far_is_drawn_again() -> None:
    problem = open_map(1, 9, (0, 0), (0, 8))
    library = [(0, 1), (0, 7)]
    once, counts = sampled(problem, [library], 40, tries=99, step=2, redraws=1)
    often, no_counts = sampled(problem, [library], 40, tries=99, step=2, redraws=60)
    assert len(once) == len(often) == 40
    assert 20 <= counts["samples failed"] <= 65  # about every other draw
    assert no_counts == {}


def test_every_cell_of_a_library_is_drawn_sometimes() -> None:
    problem = open_map(5, 3, (2, 0), (2, 2))
    found, _ = sampled(problem, lines(problem), 60)
    assert {path[1] for path in found} >= {(1, 1), (2, 1), (3, 1)}
    assert {cell for path in found for cell in path if cell[1] == 1} == {(r, 1) for r in range(5)}


def test_empty_libraries_are_passed_over() -> None:
    problem = open_map(5, 5, (4, 0), (0, 4))
    with_gaps, _ = sampled(problem, [[], [(3, 3)], [], [(1, 1)], []], 3, loops=True)
    without, _ = sampled(problem, [[(3, 3)], [(1, 1)]], 3, loops=True)
    assert with_gaps == without
    assert all(path.index((3, 3)) < path.index((1, 1)) for path in without)


def test_without_libraries_start_and_goal_are_joined_directly() -> None:
    problem = open_map(1, 4, (0, 3), (0, 0))
    for libraries in ([], [[], []]):
        assert sampled(problem, libraries, 2) == ([((0, 3), (0, 2), (0, 1), (0, 0))] * 2, {})


def test_fewer_paths_than_wanted_are_repeated_in_turn_and_counted() -> None:
    problem = open_map(1, 9, (0, 0), (0, 8))
    seen = set()
    for seed in range(20):
        found, counts = sampled(problem, [[(0, 1), (0, 7)]], 8, seed, tries=1, step=2)
        repeated = counts.get("samples repeated", 0)
        assert counts.get("samples failed", 0) == (repeated > 0 or not found)  # the one that ended it
        assert len(found) in (0, 8)
        seen.add(repeated)
    assert len(seen) > 3


def test_repeats_keep_the_order_in_which_paths_were_found() -> None:
    problem = open_map(3, 9, (1, 0), (1, 8))
    for seed in range(30):
        found, counts = sampled(problem, [[(0, 1), (1, 1), (2, 1), (1, 7)]], 9, seed, tries=1, step=2)
        first = 9 - counts.get("samples repeated", 0)
        assert found == [found[k % first] for k in range(len(found))]


def test_tries_that_cannot_succeed_end_and_are_counted() -> None:
    problem = pl.PathProblem([[0, 1, 0], [0, 1, 0], [0, 1, 0]], start=(2, 0), goal=(0, 0))
    assert sampled(problem, [[(1, 2)]], 3, tries=7) == ([], {"samples failed": 7})
    assert sampled(problem, [[(1, 2)]], 0, tries=7) == ([], {})


def test_a_start_that_is_the_goal_is_the_whole_path_whatever_the_libraries() -> None:
    problem = open_map(3, 3, (1, 1), (1, 1))
    assert sampled(problem, [[(0, 0)], [(2, 2)]], 4) == ([((1, 1),)] * 4, {})


def test_libraries_may_hold_start_and_goal() -> None:
    problem = open_map(1, 3, (0, 0), (0, 2))
    straight = ((0, 0), (0, 1), (0, 2))
    assert sampled(problem, [[(0, 0)], [(0, 0)], [(0, 2)], [(0, 2)]], 1) == ([straight], {})
    back, _ = sampled(problem, [[(0, 2)], [(0, 0)]], 1, loops=True)
    assert back == [(*straight, (0, 1), (0, 0), (0, 1), (0, 2))]
    assert sampled(problem, [[(0, 2)], [(0, 0)]], 1)[0] == [straight]


def test_the_libraries_are_left_as_they_are_and_may_be_of_any_integer_type() -> None:
    problem = open_map(4, 4, (3, 0), (0, 3))
    cells = np.array([5, 6], np.int64)
    found = sample_through(problem, [cells], 2, np.random.default_rng(1), tries=5, insertions=0)
    again = sample_through(problem, [cells.astype(np.uint8)], 2, np.random.default_rng(1), tries=5, insertions=0)
    assert found.tobytes() == again.tobytes()
    assert cells.tolist() == [5, 6]
