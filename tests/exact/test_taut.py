"""The shortest way in the plane, against a visibility graph of all corners in fractions."""

import math
from fractions import Fraction
from itertools import pairwise

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, Cell, examples

import pathloom as pl
from pathloom.exact import taut_length, taut_way
from pathloom.exact.taut import taut_distances


class Plane:
    """The obstacle squares in coordinates of half cells: the cell (r, c) has its centre at (2 r + 1, 2 c + 1)."""

    def __init__(self, blocked: np.ndarray, squeezing: bool) -> None:
        self.blocked = np.pad(blocked, 1, constant_values=True)
        self.squeezing = squeezing

    def closed(self, row: int, col: int) -> bool:
        return bool(self.blocked[row + 1, col + 1])

    def free(self, p: Cell, q: Cell) -> bool:
        """Say whether a segment stays out of the inside of obstacles and between them, cell by cell."""
        d = q[0] - p[0], q[1] - p[1]
        times = {Fraction(0), Fraction(1)}
        for a, by in zip(p, d, strict=True):
            times |= {Fraction(k - a, by) for k in range(min(a, a + by), max(a, a + by) + 1) if by and k % 2 == 0}
        ordered = sorted(times)
        for s, t in pairwise(ordered):
            y, x = (a + (s + t) / 2 * by for a, by in zip(p, d, strict=True))
            rows = {math.floor(y / 2), math.ceil(y / 2) - 1}  # two of them on the line between two rows
            cols = {math.floor(x / 2), math.ceil(x / 2) - 1}
            if all(self.closed(r, c) for r in rows for c in cols):
                return False
        stops = [(p[0] + t * d[0], p[1] + t * d[1]) for t in ordered[1:-1]]
        return all(self.passes(y, x, d, d) for y, x in stops)

    def passes(self, y, x, came: Cell, goes: Cell) -> bool:
        """Say whether a way may come to a point in one direction and leave it in another: not through a squeeze."""
        if y % 2 or x % 2 or self.squeezing:
            return True
        i, j = int(y) // 2, int(x) // 2
        quadrants = {(s, t): self.closed(i + min(s, 0), j + min(t, 0)) for s in (-1, 1) for t in (-1, 1)}
        if quadrants[-1, -1] != quadrants[1, 1] or quadrants[-1, 1] != quadrants[1, -1]:
            return True
        if quadrants[1, 1] == quadrants[1, -1]:
            return True
        beside = [q for q, closed in quadrants.items() if not closed]
        return any(
            all(-v * q >= 0 and w * q >= 0 for v, w, q in zip(came, goes, quadrant, strict=True)) for quadrant in beside
        )

    def distance(self, start: Cell, goal: Cell) -> float:
        """Search over corners and the directions in which they are reached."""
        ends = [(2 * r + 1, 2 * c + 1) for r, c in (start, goal)]
        rows, cols = self.blocked.shape
        points = [*ends, *((y, x) for y in range(0, 2 * rows - 2, 2) for x in range(0, 2 * cols - 2, 2))]
        seen: dict[Cell, list[Cell]] = {}

        def edges(state):
            p, came = state
            if p not in seen:
                seen[p] = [q for q in points if q != p and self.free(p, q)]
            for q in seen[p]:
                goes = q[0] - p[0], q[1] - p[1]
                if came is None or self.passes(*p, came, goes):
                    yield (q, goes), math.hypot(*goes) / 2

        found = naive.dijkstra((ends[0], None), edges)
        return min((far for (p, _), far in found.items() if p == ends[1]), default=math.inf)


@given(problem=naive.problems(max_side=5))
@examples(60)
def test_the_way_in_the_plane_is_as_short_as_its_twin(problem: pl.PathProblem) -> None:
    plane = Plane(problem.context.occupied, squeezing=problem.corners == "allow")
    expected = plane.distance(problem.start, problem.goal)
    length, way = taut_way(problem)
    assert length == pytest.approx(expected, rel=1e-12)
    assert (way is None) == (expected == math.inf)
    if way is not None:
        assert (way[[0, -1]] == problem.ends).all()
        assert np.hypot(*np.diff(way, axis=0).T).sum() == pytest.approx(expected, rel=1e-12)
        corners = [tuple(int(v) for v in 2 * point + 1) for point in way]
        assert all(plane.free(p, q) for p, q in pairwise(corners) if p != q)


@given(problem=naive.problems(max_side=9))
@examples(80)
def test_no_path_over_cells_is_shorter(problem: pl.PathProblem) -> None:
    blocked = problem.context.occupied
    best = naive.any_angle_distances(blocked, problem.start, problem.corners).get(problem.goal, math.inf)
    assert taut_length(problem) <= best


@given(problem=naive.problems(max_side=9), data=st.data())
@examples(80)
def test_distances_of_all_cells_are_those_of_a_search_to_each(problem: pl.PathProblem, data) -> None:
    before, after = taut_distances(problem)
    cell = data.draw(st.sampled_from(naive.free_cells(problem.context.occupied)))
    flat = cell[0] * problem.context.cols + cell[1]
    for found, end in ((before, problem.start), (after, problem.goal)):
        there = pl.PathProblem(problem.grid, start=end, goal=cell, corners=problem.corners)
        assert found[flat] == pytest.approx(taut_way(there)[0], rel=1e-12)


@given(problem=naive.problems(max_side=9), share=st.floats(0.5, 2.0))
@examples(60)
def test_a_limit_changes_no_distance_of_a_cell_on_a_way_so_short(problem: pl.PathProblem, share: float) -> None:
    before, after = taut_distances(problem)
    through = before + after
    if not problem.reachable:
        return
    upper = share * through.min()
    for full, limited in zip((before, after), taut_distances(problem, upper), strict=True):
        assert limited[through <= upper] == pytest.approx(full[through <= upper], rel=1e-12)
        assert (limited >= full - 1e-9).all()


@given(problem=naive.problems(max_side=12))
@examples(60)
def test_the_way_back_is_as_long(problem: pl.PathProblem) -> None:
    back = pl.PathProblem(problem.grid, start=problem.goal, goal=problem.start, corners=problem.corners)
    assert taut_way(problem)[0] == pytest.approx(taut_way(back)[0], rel=1e-12)


def test_a_way_bends_at_corners_of_obstacles() -> None:
    grid = np.zeros((3, 5), bool)
    grid[1:, 2] = True
    _, way = taut_way(pl.PathProblem(grid, start=(2, 0), goal=(2, 4)))
    assert way.tolist() == [[2, 0], [0.5, 1.5], [0.5, 2.5], [2, 4]]


def test_a_way_squeezes_between_two_obstacles_under_allow_only() -> None:
    grid = [[0, 1], [1, 0]]
    lengths = [taut_length(pl.PathProblem(grid, start=(0, 0), goal=(1, 1), corners=corners)) for corners in POLICIES]
    assert lengths == [pytest.approx(math.sqrt(2)), math.inf, math.inf]


def test_a_start_that_is_the_goal_is_no_way_off() -> None:
    assert taut_length(pl.PathProblem(np.zeros((3, 3), bool), start=(1, 1), goal=(1, 1))) == 0.0
