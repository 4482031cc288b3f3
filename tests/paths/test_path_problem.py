"""PathProblem: what it takes, what it refuses and how it says so."""

import math
import pickle
from fractions import Fraction

import numpy as np
import pytest

import pathloom as pl

EMPTY = np.zeros((4, 6), bool)


def refusal(grid=EMPTY, **options) -> str:
    with pytest.raises(pl.ProblemError) as caught:
        pl.PathProblem(grid, **options)
    message = str(caught.value)
    assert "\n" not in message
    return message


def test_the_usual_problem_goes_from_bottom_left_to_top_right_and_is_strict() -> None:
    problem = pl.PathProblem(EMPTY)
    assert problem.ends == ((3, 0), (0, 5))
    assert (problem.corners, problem.radius) == ("strict", 0.0)


@pytest.mark.parametrize(
    ("name", "cell"),
    [("bottom-left", (3, 0)), ("bottom-right", (3, 5)), ("top-left", (0, 0)), ("top-right", (0, 5))],
)
def test_corners_have_names(name: str, cell: tuple[int, int]) -> None:
    assert pl.PathProblem(EMPTY, start=name, goal=name).ends == (cell, cell)


@pytest.mark.parametrize(
    "cell",
    [(2, 1), [2, 1], np.array([2, 1]), (np.int64(2), np.uint8(1)), np.array([2, 1], np.uint16), (2.0, 1.0)],
    ids=["tuple", "list", "array", "numpy integers", "short integers", "whole floats"],
)
def test_cells_come_in_as_any_pair_of_whole_numbers_and_are_kept_as_ints(cell) -> None:
    start = pl.PathProblem(EMPTY, start=cell).start
    assert start == (2, 1)
    assert [type(number) for number in start] == [int, int]


@pytest.mark.parametrize("radius", [0, 0.25, np.float32(0.25), np.int64(1)])
def test_a_radius_is_kept_as_a_float(radius) -> None:
    found = pl.PathProblem(EMPTY, radius=radius).radius
    assert found == radius
    assert type(found) is float


def test_anything_that_makes_a_grid_is_one() -> None:
    assert pl.PathProblem([[0, 0], [1, 0]], start=(0, 0)).grid == pl.OccupancyGrid([[0, 0], [1, 0]])


@pytest.mark.parametrize("end", ["start", "goal"])
@pytest.mark.parametrize(("cell", "shown"), [((4, 0), "4,0"), ((0, 6), "0,6"), ((-1, 2), "-1,2"), ((0, -1), "0,-1")])
def test_an_end_outside_the_map_is_refused_with_the_ranges(end: str, cell, shown: str) -> None:
    expected = f"{end}: found cell {shown} outside the map, allowed rows 0 to 3 and columns 0 to 5"
    assert refusal(**{end: cell}) == expected


@pytest.mark.parametrize(
    "cell", [None, 3, (1,), (1, 2, 3), (0.5, 1), (math.nan, 0), (math.inf, 0), (True, 0), ("1", "2"), (None, 1)]
)
def test_an_end_that_is_no_cell_is_refused(cell) -> None:
    expected = f"start: found {cell!r}, allowed (row, column) or the name of a corner"
    assert refusal(start=cell) == expected


def test_a_misspelt_corner_is_refused_with_what_was_meant() -> None:
    assert refusal(start="botom-left") == (
        "start: found 'botom-left', allowed ROW,COL or a corner; did you mean 'bottom-left'?"
    )


def test_a_corner_unlike_any_is_refused_with_the_names_of_all() -> None:
    assert refusal(goal="middle").endswith("known: bottom-left, bottom-right, top-left, top-right")


@pytest.mark.parametrize(("end", "other"), [("start", "goal"), ("goal", "start")])
def test_an_end_on_an_obstacle_is_refused_with_the_nearest_free_cell(end: str, other: str) -> None:
    grid = [[1, 1, 1, 0], [1, 1, 1, 1], [0, 1, 1, 1]]
    message = refusal(grid, **{end: (1, 2), other: (2, 0)})
    assert message == f"{end}: cell 1,2 is an obstacle; the nearest free cell is 0,3"


@pytest.mark.parametrize(("end", "other"), [("start", "goal"), ("goal", "start")])
def test_an_end_that_the_radius_swallows_is_refused_with_the_radius(end: str, other: str) -> None:
    message = refusal([[0, 0, 0, 0, 1]], radius=2, **{end: (0, 2), other: (0, 0)})
    assert message == (
        f"{end}: cell 0,2 is closer to an obstacle than the radius 2 cells; the nearest free cell is 0,1"
    )


def test_a_disc_that_only_touches_an_obstacle_may_stand() -> None:
    assert pl.PathProblem([[0, 0, 0, 0, 1]], start=(0, 2), goal=(0, 0), radius=1.5).reachable
    assert "0,2 is closer" in refusal([[0, 0, 0, 0, 1]], start=(0, 2), goal=(0, 0), radius=1.501)


def test_a_radius_is_in_metres_where_the_map_has_a_place_in_the_world() -> None:
    grid = pl.OccupancyGrid([[0, 0, 0, 0, 1]], resolution=0.1, origin=(0, 0, 0))
    assert "than the radius 0.2 m;" in refusal(grid, start=(0, 2), goal=(0, 0), radius=0.2)


def test_a_radius_is_in_metres_where_the_map_has_a_resolution_only() -> None:
    grid = pl.OccupancyGrid([[0, 0, 0, 0, 1]], resolution=0.1)
    assert "than the radius 0.2 m;" in refusal(grid, start=(0, 2), goal=(0, 0), radius=0.2)


def test_a_map_without_a_free_cell_is_named_as_such() -> None:
    assert refusal([[1, 1]]) == "start: cell 0,0 is closed, as is every cell of the map"


@pytest.mark.parametrize(
    "radius",
    [-1, -1e-9, math.nan, math.inf, np.float64("nan"), True, "1", None, 1j, Fraction(1, 2), 10**400],
    ids=lambda radius: repr(radius)[:20],
)
def test_a_radius_that_is_no_length_is_refused(radius) -> None:
    assert refusal(radius=radius) == f"radius: found {radius!r}, allowed a number in [0, inf)"


@pytest.mark.parametrize(
    ("corners", "hint"),
    [
        ("strickt", "; did you mean 'strict'?"),
        ("no_squeeze", "; did you mean 'no-squeeze'?"),
        ("anything", ""),
        (None, ""),
    ],
)
def test_an_unknown_corner_policy_is_refused_with_a_hint(corners, hint: str) -> None:
    assert refusal(corners=corners) == f"corners: found {corners!r}, allowed strict, no-squeeze, allow{hint}"


def test_an_unreachable_goal_is_no_error() -> None:
    assert not pl.PathProblem([[0, 1, 0]]).reachable


def test_problems_are_equal_by_what_they_say() -> None:
    problem = pl.PathProblem(EMPTY, start="top-left")
    assert problem == pl.PathProblem(EMPTY.copy(), start=(0, 0))
    assert hash(problem) == hash(pl.PathProblem(EMPTY.copy(), start=(0, 0)))
    assert problem != pl.PathProblem(EMPTY, start="top-left", corners="allow")


def test_a_problem_travels_without_what_it_worked_out() -> None:
    problem = pl.PathProblem(EMPTY, radius=0.5, corners="allow")
    assert problem.context.moves.any()
    assert problem.representation.cols == 6
    arrived = pickle.loads(pickle.dumps(problem))
    assert arrived == problem
    assert set(vars(arrived)) == {"grid", "start", "goal", "radius", "corners"}
    assert arrived.context.moves.tobytes() == problem.context.moves.tobytes()
