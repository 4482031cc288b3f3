"""Kernels of trees and curves against their twins: fractions, brute force, and scipy's splines."""

import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import naive
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from naive import HALF, POLICIES, Cell, examples
from scipy.interpolate import BSpline

from pathloom import compiled
from pathloom.paths.context import POLICIES as NUMBERS

UNIT = 4095
Point = tuple[int, int]
"""Row and column in steps of 1/4095 of a cell."""


# Twins ------------------------------------------------------------------------------------------


def in_cells(point: Point) -> tuple[Fraction, Fraction]:
    return Fraction(point[0], UNIT), Fraction(point[1], UNIT)


def meeting(a: Point, b: Point, cell: Cell) -> tuple[str, list[tuple[Fraction, Fraction]]]:
    """Clip a segment to a cell's square: "inside", "border" or "apart", and the ends of what is left of it."""
    (r0, c0), (r1, c1) = in_cells(a), in_cells(b)
    enter, leave, inside = Fraction(0), Fraction(1), True
    for start, d, centre in ((r0, r1 - r0, cell[0]), (c0, c1 - c0, cell[1])):
        near, far = centre - HALF - start, centre + HALF - start
        if d == 0:
            if not near <= 0 <= far:
                return "apart", []
            inside = inside and near < 0 < far
            continue
        first, last = sorted((near / d, far / d))
        enter, leave = max(enter, first), min(leave, last)
    if enter > leave:
        return "apart", []
    ends = [(r0 + t * (r1 - r0), c0 + t * (c1 - c0)) for t in (enter, leave)]
    return ("inside" if inside and (enter < leave or a == b) else "border"), ends


def open_free(blocked: np.ndarray, a: Point, b: Point, corners: str) -> bool:
    """Hold a segment between points of the lattice against every obstacle."""
    touched: dict[tuple[Fraction, Fraction], int] = {}
    for cell in np.argwhere(blocked).tolist():
        how, ends = meeting(a, b, tuple(cell))
        if how == "inside" or (how == "border" and corners == "strict"):
            return False
        if how == "border":
            touched[ends[0]] = touched.get(ends[0], 0) + 1
    return corners != "no-squeeze" or all(times < 2 for times in touched.values())


def crossed_in_turn(a: Point, b: Point, shape: tuple[int, int]) -> list[Cell]:
    """Return the cells whose inside a segment crosses, in the order in which it enters them."""
    found = []
    for cell in np.ndindex(*shape):
        how, ends = meeting(a, b, cell)
        if how == "inside":
            r, c = in_cells(a)
            found.append((max(abs(ends[0][0] - r), abs(ends[0][1] - c)), cell))
    return [cell for _, cell in sorted(found)]


def cell_of(point: Point) -> Cell:
    return tuple(math.floor(x + HALF) for x in in_cells(point))


def nearest(nodes: list[Point], r: int, c: int) -> int:
    return min(range(len(nodes)), key=lambda k: ((nodes[k][0] - r) ** 2 + (nodes[k][1] - c) ** 2, k))


def rounded(x: float) -> int:
    return math.floor(x + 0.5) if x >= 0 else -math.floor(0.5 - x)


def grown(blocked, corners, root, goal, step, reach, bias, by_sample, samples, words):
    """Grow a tree as the definition has it; return nodes, parents, samples drawn, index of the goal or −1."""
    stream = (word >> 11 for word in naive.xoshiro(words))
    draw = (value * 2.0**-53 for value in stream)
    rows, cols = blocked.shape
    nodes, parents = [root], [-1]
    for drawn in range(1, samples + 1):
        sample = tuple(math.floor(next(draw) * (side * UNIT)) - UNIT // 2 for side in (rows, cols))
        target = goal if next(draw) < bias else sample
        near = nearest(nodes, *(sample if by_sample else target))
        at = nodes[near]
        far = math.sqrt((target[0] - at[0]) ** 2 + (target[1] - at[1]) ** 2)
        if far > step:
            share = step / far
            target = tuple(x + rounded((y - x) * share) for x, y in zip(at, target, strict=True))
        if target == at or not open_free(blocked, at, target, corners):
            continue
        nodes.append(target)
        parents.append(near)
        apart = (goal[0] - target[0]) ** 2 + (goal[1] - target[1]) ** 2
        if apart and apart <= reach * reach and open_free(blocked, target, goal, corners):
            nodes.append(goal)
            parents.append(len(nodes) - 2)
        if nodes[-1] == goal:
            return nodes, parents, drawn, len(nodes) - 1
    return nodes, parents, samples, -1


def straightened(points: list, sees) -> list:
    """Jump from each point to the last one in sight."""
    kept = [0]
    while kept[-1] < len(points) - 1:
        at = kept[-1]
        kept.append(max([k for k in range(at + 1, len(points)) if sees(points[at], points[k])], default=at + 1))
        kept[-1] = max(kept[-1], at + 1)
    return [points[k] for k in kept]


def over_cells(blocked, points: list[Point], corners: str) -> list[Cell]:
    path = [cell_of(points[0])]
    for a, b in pairwise(points):
        there = cell_of(b)
        if there == path[-1]:
            continue
        if naive.segment_free(blocked, path[-1], there, corners):
            path.append(there)
        else:
            path += crossed_in_turn(a, b, blocked.shape)[1:]
    return path


# What is drawn ----------------------------------------------------------------------------------

fifths_and_thirds = st.sampled_from([k * UNIT // 15 for k in (-7, -6, -5, -3, 0, 3, 5, 6, 7)])
"""Coarse offsets from a cell's centre, so that segments pass through corners."""


@st.composite
def scenes(draw: st.DrawFn, points: int, max_side: int = 6):
    """Draw a map, a corner policy and points of the lattice on it."""
    blocked, corners = draw(naive.maps(max_side)), draw(st.sampled_from(POLICIES))
    offsets = fifths_and_thirds if draw(st.booleans()) else st.integers(-2047, 2047)
    cells = naive.cells_of(blocked.shape)
    drawn = [draw(cells) for _ in range(points)]
    return blocked, corners, [(r * UNIT + draw(offsets), c * UNIT + draw(offsets)) for r, c in drawn]


def flat(blocked: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(blocked, np.uint8).ravel()


# Segments between points ------------------------------------------------------------------------


@given(drawn=scenes(points=8))
@examples(250)
def test_a_segment_between_any_points_is_free_exactly_where_fractions_say_so(drawn) -> None:
    blocked, corners, points = drawn
    first, second = np.array(points[:4], np.int64), np.array(points[4:], np.int64)
    free = compiled.trees.open_segments_free(flat(blocked), blocked.shape[1], first, second, NUMBERS[corners])
    expected = [open_free(blocked, a, b, corners) for a, b in zip(points[:4], points[4:], strict=True)]
    assert free.tolist() == expected


def test_between_centres_of_free_cells_it_is_the_segment_test_of_paths() -> None:
    rng = np.random.default_rng(6)
    for _ in range(30):
        scene = rng.random(rng.integers(2, 6, 2)) < 0.4
        free = naive.free_cells(scene)
        pairs = [(a, b) for a in free for b in free]
        first, second = (np.array([pair[k] for pair in pairs], np.int64).reshape(-1, 2) * UNIT for k in range(2))
        for corners in POLICIES:
            found = compiled.trees.open_segments_free(flat(scene), scene.shape[1], first, second, NUMBERS[corners])
            assert found.tolist() == [naive.segment_free(scene, a, b, corners) for a, b in pairs]


def test_long_segments_look_at_no_fewer_cells_than_they_cross() -> None:
    rng = np.random.default_rng(5)
    blocked = rng.random((40, 60)) < 0.01
    points = (rng.random((400, 2)) * (40, 60) * UNIT).astype(np.int64) - 2047
    pairs = list(zip(points[:200].tolist(), points[200:].tolist(), strict=True))
    for corners in POLICIES:
        free = compiled.trees.open_segments_free(flat(blocked), 60, points[:200], points[200:], NUMBERS[corners])
        assert free.tolist() == [open_free(blocked, tuple(a), tuple(b), corners) for a, b in pairs]
        assert 20 < free.sum() < 180


def test_no_point_of_the_lattice_lies_on_a_border() -> None:
    assert compiled.trees.UNIT % 2 == 1
    assert compiled.trees.UNIT == UNIT == 2 * compiled.trees.HALF + 1


# Trees ------------------------------------------------------------------------------------------


def clouds() -> Iterator[tuple[np.ndarray, int, int]]:
    """Yield nodes all over a map, in one corner of it, in a row, and many in few places."""
    rng = np.random.default_rng(2)
    for rows, cols in ((9, 9), (40, 3), (1, 50), (200, 300)):
        whole = np.array([rows, cols]) * UNIT
        for n in (1, 2, 31, 33, 150, 1500):
            yield (rng.random((n, 2)) * whole).astype(np.int64) - 2047, rows, cols
            yield (rng.random((n, 2)) * np.minimum(whole, 2 * UNIT)).astype(np.int64) - 2047, rows, cols
            yield rng.integers(0, 4, (n, 2)) * np.minimum(UNIT, whole // 5) - 2047, rows, cols


def test_the_nearest_node_is_that_of_a_search_through_all_and_the_oldest_of_several() -> None:
    rng = np.random.default_rng(3)
    for nodes, rows, cols in clouds():
        points = (rng.random((60, 2)) * (rows, cols) * UNIT).astype(np.int64) - 2047
        points[:20] = nodes[rng.integers(len(nodes), size=20)]
        points[20:30] = rng.integers(0, 2, (10, 2)) * (np.array([rows, cols]) * UNIT - UNIT)
        found = compiled.trees.nearest_nodes(nodes, points, rows, cols)
        squared = ((points[:, None].astype(object) - nodes[None]) ** 2).sum(axis=2).astype(np.int64)
        assert found.tolist() == squared.argmin(axis=1).tolist()


@given(
    drawn=scenes(points=0, max_side=7),
    ends=st.data(),
    words=naive.words,
    step=st.sampled_from([0.3, 0.9, 1.7, 5.0]),
    reach=st.sampled_from([0.0, 1.0, 4.0]),
    bias=st.sampled_from([0.0, 0.05, 0.4, 1.0]),
    by_sample=st.booleans(),
)
@examples(120)
def test_a_tree_grows_as_its_definition_has_it(drawn, ends, words, step, reach, bias, by_sample) -> None:
    blocked, corners, _ = drawn
    cells = naive.cells_of(blocked.shape)
    start, goal = ends.draw(cells), ends.draw(cells)
    blocked[start] = blocked[goal] = False
    assume(start != goal)
    samples, rows, cols = 90, *blocked.shape
    nodes, parents = np.empty((samples + 2, 2), np.int64), np.empty(samples + 2, np.int32)
    nodes[0], parents[0] = np.array(start) * UNIT, -1
    to = (goal[0] * UNIT, goal[1] * UNIT)
    count, used, reached = compiled.trees.grow(
        flat(blocked), rows, cols, NUMBERS[corners], *to, step * UNIT, reach * UNIT, bias, by_sample,
        nodes, parents, 1, samples, np.array(words, np.uint64),
    )  # fmt: skip
    root = (start[0] * UNIT, start[1] * UNIT)
    twin = grown(blocked, corners, root, to, step * UNIT, reach * UNIT, bias, by_sample, samples, words)
    assert [tuple(node) for node in nodes[:count].tolist()] == twin[0]
    assert parents[:count].tolist() == twin[1]
    assert (used, reached) == twin[2:]


@given(drawn=scenes(points=7))
@examples(150)
def test_a_polyline_goes_straight_on_to_the_last_point_in_sight(drawn) -> None:
    blocked, corners, points = drawn
    found = compiled.trees.straightened(np.array(points, np.int64), flat(blocked), blocked.shape[1], NUMBERS[corners])
    expected = straightened(points, lambda a, b: open_free(blocked, a, b, corners))
    assert [tuple(point) for point in found.tolist()] == expected


@given(scene=naive.maps(), drawn=st.data(), corners=st.sampled_from(POLICIES))
@examples(100)
def test_paths_over_cells_go_straight_on_to_the_last_cell_in_sight(scene, drawn, corners) -> None:
    scene.flat[0] = False
    free = naive.free_cells(scene)
    paths = [tuple(drawn.draw(st.lists(st.sampled_from(free), min_size=1, max_size=7))) for _ in range(3)]
    cols = scene.shape[1]
    found = compiled.trees.straightened_paths(naive.packed(paths, cols, 1), flat(scene), cols, NUMBERS[corners])
    expected = [tuple(straightened(list(p), lambda a, b: naive.segment_free(scene, a, b, corners))) for p in paths]
    assert naive.unpacked(found, cols) == expected


@given(drawn=scenes(points=6))
@examples(150)
def test_a_free_polyline_becomes_a_legal_path_over_its_cells(drawn) -> None:
    blocked, corners, points = drawn
    points = [p for p in points if not blocked[cell_of(p)]]
    assume(points)
    kept = points[:1]
    for point in points[1:]:
        if open_free(blocked, kept[-1], point, corners):
            kept.append(point)
    found = compiled.trees.cells_of_points(np.array(kept, np.int64), flat(blocked), blocked.shape[1], NUMBERS[corners])
    path = [divmod(cell, blocked.shape[1]) for cell in found.tolist()]
    assert path == over_cells(blocked, kept, corners)
    assert naive.path_free(blocked, path, corners)


def test_a_polyline_through_a_corner_steps_from_cell_to_cell_across_it() -> None:
    blocked = np.zeros((3, 2), bool)
    blocked[1, 0] = True  # in the way of the segment between the centres, which is (0, 0) to (2, 1)
    a = np.array([410, 1229])
    points = np.stack((a, a + 2 * (UNIT - 2 * a)))  # to four times as far as the corner at (½, ½)
    for mirror_r, mirror_c in np.ndindex(2, 2):
        scene = blocked[:: 1 - 2 * mirror_r, :: 1 - 2 * mirror_c]
        there = np.where((mirror_r, mirror_c), np.array([2, 1]) * UNIT - points, points)
        found = compiled.trees.cells_of_points(np.ascontiguousarray(there), flat(scene), 2, NUMBERS["allow"])
        expected = [(0, 0), (1, 1), (2, 1)]
        mirrored = [(2 - r if mirror_r else r, 1 - c if mirror_c else c) for r, c in expected]
        assert [divmod(cell, 2) for cell in found.tolist()] == mirrored


# Splines ----------------------------------------------------------------------------------------


def clamped(n: int, degree: int) -> np.ndarray:
    """Return the knots 0 … n − degree, the ends degree + 1 times."""
    return np.concatenate([np.zeros(degree), np.arange(n - degree + 1), np.full(degree, n - degree)])


def bernstein(degree: int, t: np.ndarray) -> np.ndarray:
    return np.array([math.comb(degree, j) * t**j * (1 - t) ** (degree - j) for j in range(degree + 1)]).T


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 7])
def test_the_pieces_of_a_spline_are_scipy_s_spline(degree: int) -> None:
    rng = np.random.default_rng(degree)
    for n in (degree + 1, degree + 2, degree + 5, 30):
        control = rng.random((n, 2)) * 20
        pieces = compiled.curves.spline_pieces(control, degree)
        spline = BSpline(clamped(n, degree), control, degree)
        t = np.linspace(0, 1, 9)
        for i, piece in enumerate(pieces):
            np.testing.assert_allclose(bernstein(degree, t) @ piece, spline(i + t), atol=1e-12)


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_the_basis_is_a_partition_of_unity_and_never_negative(degree: int) -> None:
    n = degree + 6
    basis = [compiled.curves.spline_pieces(np.stack((np.eye(n)[i], np.ones(n)), axis=1), degree) for i in range(n)]
    weights = np.array([b[:, :, 0] for b in basis])  # of each control point, in each Bézier point of each piece
    assert (weights >= 0).all()
    np.testing.assert_allclose(weights.sum(axis=0), 1.0, atol=1e-14)
    np.testing.assert_allclose(basis[0][:, :, 1], 1.0, atol=1e-14)
    assert weights[0, 0, 0] == weights[-1, -1, -1] == 1.0  # clamped: the ends are control points
    assert (np.count_nonzero(weights.max(axis=2), axis=0) == degree + 1).all()  # local support


# Curves against obstacles -----------------------------------------------------------------------


def on_piece(piece: np.ndarray, n: int = 4001) -> np.ndarray:
    return bernstein(len(piece) - 1, np.linspace(0, 1, n)) @ piece


def depth(points: np.ndarray, blocked: np.ndarray) -> float:
    """Return how deep the deepest of some points lies in an obstacle or off the map; negative: how far away."""
    ringed = np.argwhere(np.pad(blocked, 1, constant_values=True)) - 1
    away = np.abs(points[:, None] - ringed[None]).max(axis=2)
    return float(0.5 - away.min())


def squeezed_corners(blocked: np.ndarray) -> np.ndarray:
    both = (blocked[:-1, :-1] & blocked[1:, 1:]) | (blocked[:-1, 1:] & blocked[1:, :-1])
    return np.argwhere(both) + 0.5


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_a_piece_is_free_where_it_keeps_off_and_collides_where_it_does_not(degree: int) -> None:
    rng = np.random.default_rng(degree)
    free_ones = 0
    for k in range(250):
        shape = rng.integers(3, 9, 2)
        blocked = rng.random(shape) < 0.15
        piece = rng.random((degree + 1, 2)) * (shape - 1)
        corners = POLICIES[k % 3]
        points = on_piece(piece)
        free, samples, length, _ = compiled.curves.sampled(
            piece[None], np.zeros(1, bool), flat(blocked), *map(int, shape), NUMBERS[corners], 1e-3
        )
        coarse, *_ = compiled.curves.sampled(
            piece[None], np.zeros(1, bool), flat(blocked), *map(int, shape), NUMBERS[corners], 50.0
        )
        assert coarse[0] == free[0]  # whatever the samples are for
        inside = depth(points, blocked)
        near = squeezed_corners(blocked)
        close = np.hypot(*(points[:, None] - near[None]).T).min() if len(near) else np.inf
        if inside > 1e-6:
            assert not free[0]
        elif inside < -1e-2 and (corners != "no-squeeze" or close > 1e-2):
            assert free[0]
        if free[0]:
            free_ones += 1
            assert inside <= (0.0 if corners == "strict" else 1e-9)
            np.testing.assert_array_equal(samples[[0, -1]], piece[[0, -1]])
            assert length == pytest.approx(np.hypot(*np.diff(points, axis=0).T).sum(), rel=2e-5)
            back = np.abs(points[:, None] - samples[None]).sum(axis=2).argmin(axis=0)
            assert (np.diff(back) >= 0).all()  # in the order of the curve
    assert free_ones > 20


def test_chords_depart_from_the_curve_by_no_more_than_the_tolerance() -> None:
    piece = np.array([[0.0, 0.0], [9.0, 1.0], [-3.0, 8.0], [6.0, 9.0]]) + 5
    for tolerance in (1.0, 0.1, 1e-3, 1e-5):
        _, samples, _, _ = compiled.curves.sampled(
            piece[None], np.zeros(1, bool), np.zeros(400, np.uint8), 20, 20, 2, tolerance
        )
        dense = on_piece(piece, 3001)
        away = min_distance(dense, samples)
        assert away.max() <= tolerance
        assert len(samples) < 3 + 12 / math.sqrt(tolerance)


def min_distance(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    """Return the distance of each point from a polyline."""
    a, d = line[:-1], np.diff(line, axis=0)
    t = np.clip(((points[:, None] - a) * d).sum(axis=2) / (d * d).sum(axis=1), 0, 1)
    return np.hypot(*(points[:, None] - a - t[:, :, None] * d).T).min(axis=0)


def test_touching_counts_from_a_billionth_of_a_cell_on() -> None:
    blocked = np.zeros((5, 5), bool)
    blocked[2, 2] = True
    for offset, strict, allow in ((1e-8, True, True), (0.0, False, True), (-1e-10, False, True), (-1e-8, False, False)):
        row = 1.5 - offset  # along the upper border of the obstacle
        piece = np.array([[row, 1.0], [row, 2.0], [row, 2.5], [row, 3.0]])
        for corners, expected in (("strict", strict), ("no-squeeze", allow), ("allow", allow)):
            free, *_ = compiled.curves.sampled(
                piece[None], np.zeros(1, bool), flat(blocked), 5, 5, NUMBERS[corners], 1e-3
            )
            assert free.tolist() == [expected], (offset, corners)


def test_between_two_obstacles_that_share_a_corner_only_allow_lets_through() -> None:
    blocked = np.zeros((4, 4), bool)
    blocked[1, 1] = blocked[2, 2] = True
    piece = np.array([[2.0, 1.0], [1.7, 1.3], [1.3, 1.7], [1.0, 2.0]])
    for corners, expected in (("strict", False), ("no-squeeze", False), ("allow", True)):
        free, *_ = compiled.curves.sampled(piece[None], np.zeros(1, bool), flat(blocked), 4, 4, NUMBERS[corners], 1e-3)
        assert free.tolist() == [expected]


def test_curvature_is_that_of_the_second_derivative_and_infinite_at_corners() -> None:
    nothing = (np.zeros(900, np.uint8), 30, 30, 2, 1e-3)
    rng = np.random.default_rng(8)
    for _ in range(40):
        control = np.cumsum(rng.random((9, 2)), axis=0) * 3 + 1
        pieces = compiled.curves.spline_pieces(control, 3)
        *_, curvature = compiled.curves.sampled(pieces, np.zeros(6, bool), *nothing)
        spline = BSpline(clamped(9, 3), control, 3)
        u = np.linspace(0, 6, 20001)
        (vr, vc), (ar, ac) = spline.derivative()(u).T, spline.derivative(2)(u).T
        assert curvature == pytest.approx(np.max(np.abs(vr * ac - vc * ar) / np.hypot(vr, vc) ** 3), rel=0.02)
    corner = np.array([[[0.0, 0.0], [3.0, 0.0]], [[3.0, 0.0], [3.0, 4.0]]])
    *_, length, curvature = compiled.curves.sampled(corner, np.zeros(2, bool), *nothing)
    assert (length, curvature) == (7.0, math.inf)
    there_and_back = np.array([[[1.0, 1.0], [9.0, 1.0], [1.0, 1.0]]])
    *_, length, curvature = compiled.curves.sampled(there_and_back, np.zeros(1, bool), *nothing)
    assert length == pytest.approx(8.0)
    assert curvature == math.inf


# Clearance --------------------------------------------------------------------------------------


def clearance(points: np.ndarray, blocked: np.ndarray) -> float:
    """Return the least distance of a polyline to an obstacle's square, by sampling it finely."""
    best = math.inf
    for a, b in pairwise(points if len(points) > 1 else points[[0, 0]]):
        dense = a + (b - a) * np.linspace(0, 1, 2001)[:, None]
        beyond = np.maximum(np.abs(dense[:, None] - np.argwhere(blocked)[None]) - 0.5, 0)
        best = min(best, np.hypot(*beyond.T).min(initial=math.inf))
    return best


def test_clearance_is_the_least_distance_to_an_obstacle() -> None:
    from scipy.ndimage import distance_transform_edt

    rng = np.random.default_rng(4)
    for k in range(150):
        shape = tuple(rng.integers(2, 12, 2).tolist())
        blocked = rng.random(shape) < (0.02, 0.1, 0.3)[k % 3]
        points = rng.random((rng.integers(1, 5), 2)) * (np.array(shape) - 1)
        distance = distance_transform_edt(~blocked).ravel() if blocked.any() else np.full(blocked.size, np.inf)
        found = compiled.curves.clearance(points, flat(blocked), distance, *shape)
        assert found == pytest.approx(clearance(points, blocked), abs=2e-3)
