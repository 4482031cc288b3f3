"""The validator, against clipping in fractions, and its contacts by hand."""

import naive
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from naive import POLICIES, examples

import pathloom as pl
from pathloom.exact import Contacts, contacts


@given(data=st.data(), problem=naive.problems())
@examples(200)
def test_a_path_is_valid_where_clipping_in_fractions_says_so(data, problem: pl.PathProblem) -> None:
    blocked = problem.context.occupied
    between = data.draw(st.lists(naive.cells_of(blocked.shape), max_size=3))
    path = [problem.start, *between, problem.goal]
    assert (pl.validate(path, problem) is None) == naive.path_free(blocked, path, problem.corners)


@given(data=st.data(), problem=naive.problems())
@examples(100)
def test_contacts_are_those_of_every_segment(data, problem: pl.PathProblem) -> None:
    blocked = problem.context.occupied
    a, b = (data.draw(naive.cells_of(blocked.shape)) for _ in range(2))
    assume(a != b)
    crossed = sum(bool(blocked[cell]) for cell in naive.crossed(blocked.shape, (a, b)))
    met = contacts([a, b], problem)
    assert met == Contacts(crossed, len(naive.touched(blocked, a, b)), naive.squeezed(blocked, a, b))


def problem_of(*rows: str, start=None, goal=None, corners: str = "allow") -> pl.PathProblem:
    grid = [[glyph == "#" for glyph in row] for row in rows]
    return pl.PathProblem(grid, start=start or (0, 0), goal=goal or (len(rows) - 1, len(rows[0]) - 1), corners=corners)


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        (("..", ".."), Contacts(0, 0, 0)),
        ((".#", ".."), Contacts(0, 1, 0)),
        ((".#", "#."), Contacts(0, 1, 1)),
        ((".#.", "#.#", ".#."), Contacts(0, 2, 2)),
        ((".#.", "...", ".#."), Contacts(0, 2, 0)),
        (("...", ".#.", "..."), Contacts(1, 0, 0)),
    ],
    ids=["open", "one corner", "a squeeze", "two squeezes", "a corner on each side", "through the middle"],
)
def test_corners_on_a_diagonal_are_counted(rows: tuple[str, ...], expected: Contacts) -> None:
    problem = problem_of(*rows)
    assert contacts([problem.start, problem.goal], problem) == expected


def test_a_path_along_a_wall_touches_nothing() -> None:
    problem = problem_of("....", "####", goal=(0, 3))
    assert contacts([(0, 0), (0, 3)], problem) == Contacts(0, 0, 0)
    assert pl.validate([(0, 0), (0, 3)], problem_of("....", "####", goal=(0, 3), corners="strict")) is None


def test_a_path_of_one_cell_touches_nothing() -> None:
    assert contacts([(0, 0)], problem_of(".#", "#.")) == Contacts()


@pytest.mark.parametrize(
    ("rows", "refusals"),
    [
        (("..", ".."), [None, None, None]),
        ((".#", ".."), [None, None, "touches an obstacle between [0, 0] and [1, 1]"]),
        ((".#", "#."), [None, *["squeezes between two obstacles between [0, 0] and [1, 1]"] * 2]),
    ],
    ids=["open", "one corner", "a squeeze"],
)
def test_each_policy_refuses_what_it_forbids(rows: tuple[str, ...], refusals: list[str | None]) -> None:
    problems = [problem_of(*rows, corners=corners) for corners in POLICIES]
    assert [pl.validate([(0, 0), (1, 1)], problem) for problem in problems] == refusals


@pytest.mark.parametrize(
    ("path", "refusal"),
    [
        ([(0, 0), (2, 4)], None),
        ([(0, 0), (0, 4), (2, 4)], "crosses an obstacle between [0, 0] and [0, 4]"),
        ([(0, 0), (0, 2), (2, 4)], "stands on an obstacle at [0, 2]"),
        ([(0, 0), (1, -1), (2, 4)], "leaves the map at [1, -1]"),
        ([(0, 0), (3, 3), (2, 4)], "leaves the map at [3, 3]"),
        ([(0, 1), (2, 4)], "leads from [0, 1] to [2, 4], not from [0, 0] to [2, 4]"),
        ([(0, 0), (2, 3)], "leads from [0, 0] to [2, 3], not from [0, 0] to [2, 4]"),
        ([(2, 4), (0, 0)], "leads from [2, 4] to [0, 0], not from [0, 0] to [2, 4]"),
        ([], "a path is an integer array of shape (k, 2); got float64 (0,)"),
        (np.empty((0, 2), int), "a path is an integer array of shape (k, 2); got int64 (0, 2)"),
        ([(0, 0, 0), (2, 4, 0)], "a path is an integer array of shape (k, 2); got int64 (2, 3)"),
        ([(0.0, 0.0), (2.0, 4.0)], "a path is an integer array of shape (k, 2); got float64 (2, 2)"),
    ],
)
def test_a_path_that_was_tampered_with_is_refused_with_the_place(path, refusal: str | None) -> None:
    problem = problem_of("..#..", ".....", ".....")
    assert pl.validate(path, problem) == refusal


def test_a_planned_path_is_refused_once_a_cell_of_it_is_moved() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    _, path = pl.any_angle_path(problem)
    assert pl.validate(path, problem) is None
    for k in range(1, len(path) - 1):
        tampered = path.copy()
        tampered[k] = (2, 0)
        assert pl.validate(tampered, problem) == "stands on an obstacle at [2, 0]"


def test_a_planned_path_is_refused_once_a_turn_of_it_is_left_out() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    _, path = pl.any_angle_path(problem)
    for k in range(1, len(path) - 1):
        assert "crosses an obstacle" in pl.validate(np.delete(path, k, axis=0), problem)


def test_obstacles_grown_by_the_radius_count() -> None:
    grid = np.zeros((5, 5), bool)
    grid[2, 2] = True
    path = [(4, 0), (1, 0), (1, 4), (0, 4)]
    assert pl.validate(path, pl.PathProblem(grid)) is None
    assert pl.validate(path, pl.PathProblem(grid, radius=0.6)) == "crosses an obstacle between [1, 0] and [1, 4]"


def test_cells_of_any_integer_type_are_fine() -> None:
    problem = pl.PathProblem(np.zeros((20, 20), bool))
    for dtype in (np.uint8, np.int8, np.int16, np.uint32, np.int64):
        assert pl.validate(np.array([(19, 0), (15, 5), (0, 19)], dtype), problem) is None
