"""Vectors as paths, the length of a path inside obstacles, and the cells along a curve: each against its twin."""

import math
from fractions import Fraction
from itertools import pairwise

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import HALF, Cell, Cells, examples

from pathloom import compiled

# Vectors ----------------------------------------------------------------------------------------


def place(gene: float, cells: int) -> int:
    """Return which of the cells, each an equal part of [0, 1], a gene lies in; the outer ones reach to infinity."""
    return next((k for k in range(cells - 1) if Fraction(gene) * cells < k + 1), cells - 1)


def without_repeats(path: list[Cell]) -> Cells:
    return tuple(cell for k, cell in enumerate(path) if k == 0 or cell != path[k - 1])


def on_lines(genes: list[float], start: Cell, goal: Cell, shape: tuple[int, int], by_rows: bool) -> Cells:
    axis = 0 if by_rows else 1
    step = 1 if goal[axis] > start[axis] else -1
    between = range(start[axis] + step, goal[axis], step)
    across = [place(gene, shape[1 - axis]) for gene in genes]
    crossings = [(line, c) if by_rows else (c, line) for line, c in zip(between, across, strict=True)]
    return without_repeats([start, *crossings, goal])


def on_points(genes: list[float], start: Cell, goal: Cell, shape: tuple[int, int]) -> Cells:
    if start == goal:
        return (start,)
    points = [(place(r, shape[0]), place(c, shape[1])) for r, c in zip(genes[::2], genes[1::2], strict=True)]
    return without_repeats([start, *points, goal])


genes = st.floats(-0.25, 1.25) | st.sampled_from([0.0, 0.25, 0.5, 0.75, 1.0])
shapes = st.tuples(st.integers(1, 9), st.integers(1, 9))


def flat(cell: Cell, cols: int) -> int:
    return cell[0] * cols + cell[1]


@given(data=st.data(), shape=shapes, by_rows=st.booleans())
@examples(200)
def test_one_gene_a_line_says_where_the_path_crosses_it(data, shape, by_rows):
    start, goal = (data.draw(naive.cells_of(shape)) for _ in range(2))
    axis = 0 if by_rows else 1
    d = max(abs(goal[axis] - start[axis]), 1) - 1
    vectors = data.draw(st.lists(st.lists(genes, min_size=d, max_size=d), min_size=1, max_size=4))
    if start[axis] == goal[axis] and start != goal:
        return  # of no use: there is no line to cross
    found = compiled.decoding.through_lines(
        np.array(vectors).reshape(len(vectors), d), flat(start, shape[1]), flat(goal, shape[1]), *shape, by_rows
    )
    assert naive.unpacked(found, shape[1]) == [on_lines(v, start, goal, shape, by_rows) for v in vectors]


@given(data=st.data(), shape=shapes, points=st.integers(0, 5))
@examples(200)
def test_two_genes_say_where_a_point_lies(data, shape, points):
    start, goal = (data.draw(naive.cells_of(shape)) for _ in range(2))
    vectors = data.draw(st.lists(st.lists(genes, min_size=2 * points, max_size=2 * points), min_size=1, max_size=4))
    found = compiled.decoding.through_points(
        np.array(vectors).reshape(len(vectors), 2 * points), flat(start, shape[1]), flat(goal, shape[1]), *shape
    )
    assert found.shape[1] == points + 2
    assert naive.unpacked(found, shape[1]) == [on_points(v, start, goal, shape) for v in vectors]


# Violations -------------------------------------------------------------------------------------


def share_inside(a: Cell, b: Cell, cell: Cell) -> Fraction:
    """Return which share of the segment from a to b lies inside a cell: clip it to the square."""
    enter, leave = Fraction(0), Fraction(1)
    for begin, end, centre in zip(a, b, cell, strict=True):
        d = end - begin
        if d == 0:
            if not centre - HALF < begin < centre + HALF:
                return Fraction(0)
            continue
        first, last = sorted(((centre - HALF - begin) / Fraction(d), (centre + HALF - begin) / Fraction(d)))
        enter, leave = max(enter, first), min(leave, last)
    return max(leave - enter, Fraction(0))


def violation(blocked: np.ndarray, path: Cells, corners: str) -> float:
    obstacles = [(r, c) for r, c in np.argwhere(blocked).tolist()]
    inside = sum(math.dist(a, b) * float(sum(share_inside(a, b, o) for o in obstacles)) for a, b in pairwise(path))
    return inside + sum(not naive.segment_free(blocked, a, b, corners) for a, b in pairwise(path))


def violations(blocked: np.ndarray, paths: list[Cells], corners: str) -> np.ndarray:
    cells = np.ascontiguousarray(blocked, np.uint8).ravel()
    cols = blocked.shape[1]
    return compiled.decoding.violations(naive.packed(paths, cols, 2), cells, cols, naive.POLICIES.index(corners))


@given(data=st.data(), blocked=naive.maps(8), corners=st.sampled_from(naive.POLICIES))
@examples(150)
def test_a_violation_is_the_length_inside_obstacles_and_the_number_of_refused_segments(data, blocked, corners):
    paths = data.draw(st.lists(naive.paths_on(blocked.shape, 5), min_size=1, max_size=5))
    expected = [violation(blocked, path, corners) for path in paths]
    assert violations(blocked, paths, corners) == pytest.approx(expected, rel=1e-12, abs=0)


@pytest.mark.parametrize("corners", naive.POLICIES)
def test_it_is_zero_exactly_where_every_segment_is_free(corners):
    rng = np.random.default_rng(4)
    cells = [divmod(k, 7) for k in range(42)]
    for _ in range(3):
        blocked = rng.random((6, 7)) < 0.15
        pairs = [(a, b) for a in cells for b in cells if a != b]
        free = [naive.segment_free(blocked, a, b, corners) for a, b in pairs]
        assert ((violations(blocked, pairs, corners) == 0.0) == free).all()


def test_a_path_that_only_breaks_the_rule_about_corners_violates_it_all_the_same():
    blocked = np.array([[0, 1], [1, 0]], bool)
    squeeze = [((0, 0), (1, 1))]
    assert violations(blocked, squeeze, "allow").tolist() == [0.0]
    assert violations(blocked, squeeze, "no-squeeze").tolist() == [1.0]
    assert violations(blocked, squeeze, "strict").tolist() == [1.0]
    assert violations(blocked, [((0, 0), (0, 1))], "allow").tolist() == [1.5]  # half a cell, and one segment


# Curves -----------------------------------------------------------------------------------------


def bernstein(piece: list[Cell], t: Fraction) -> tuple[Fraction, ...]:
    """Return the point of a Bézier curve at t, as a sum of Bernstein polynomials."""
    n = len(piece) - 1
    shares = [math.comb(n, i) * t**i * (1 - t) ** (n - i) for i in range(n + 1)]
    return tuple(sum(s * p[x] for s, p in zip(shares, piece, strict=True)) for x in (0, 1))


def chained(pieces: list[list[Cell]]) -> list[list[Cell]]:
    """Return pieces of which each begins where the one before ends."""
    return [[before[-1], *piece[1:]] if k else piece for k, (before, piece) in enumerate(pairwise([[], *pieces]))]


@st.composite
def chains(draw: st.DrawFn, shape: tuple[int, int]) -> list[list[Cell]]:
    degree, many = draw(st.integers(1, 4)), draw(st.integers(1, 3))
    piece = st.lists(naive.cells_of(shape), min_size=degree + 1, max_size=degree + 1)
    return chained(draw(st.lists(piece, min_size=many, max_size=many)))


@given(data=st.data(), shape=shapes, step=st.sampled_from([0.25, 0.5, 0.1]))
@examples(60)
def test_points_lie_on_the_curve_and_no_further_apart_than_a_step(data, shape, step):
    chain = data.draw(chains(shape))
    points = compiled.decoding.sample_curve(np.array(chain, float), step)
    on_curve = []
    for piece in chain:
        longest = max(math.dist(a, b) for a, b in pairwise(piece))
        parts = max(math.ceil((len(piece) - 1) * longest / step), 1)
        on_curve += [bernstein(piece, Fraction(i, parts)) for i in range(parts + 1)]
    for (r, c), (q, d) in pairwise(on_curve):
        assert math.dist((r, c), (q, d)) <= step * (1 + 1e-12)
    inner = [p for p in on_curve if all((2 * x).denominator > 1 or x.denominator == 1 for x in p)]
    exact = np.array(inner, float)
    distances = np.hypot(*(points[:, np.newaxis] - exact).transpose(2, 0, 1))
    assert distances.min(axis=1).max() < 1e-12  # each point is one of those
    assert distances.min(axis=0).max() < 1e-12  # and none is missing


def cells_met(points: np.ndarray) -> list[set[Cell]]:
    """Return for each chord between points, none longer than a cell, the cells whose inside it crosses."""
    met = []
    for a, b in pairwise([tuple(map(Fraction, p)) for p in points.tolist()]):
        here = tuple(round(x) for x in a)
        about = [(here[0] + dr, here[1] + dc) for dr in (-1, 0, 1) for dc in (-1, 0, 1)]
        met.append({cell for cell in about if share_inside(a, b, cell) > Fraction(1, 10**7)} or {here})
    return met


@given(data=st.data(), shape=shapes)
@examples(40)
def test_the_cells_along_a_curve_are_those_that_its_chords_cross(data, shape):
    chain = data.draw(chains(shape))
    pieces = np.array(chain, float)
    table = np.arange(shape[0] * shape[1], dtype=float) % 3
    paths, lengths, shortage = compiled.decoding.along_curves(pieces[np.newaxis], shape[1], 0.25, table, 1.5)
    (path,) = naive.unpacked(paths, shape[1])
    points = compiled.decoding.sample_curve(pieces, 0.25)
    assert path[0] == chain[0][0]
    assert path[-1] == chain[-1][-1]
    assert naive.steps_singly(path)
    if len(points) > 1:
        assert set(path) == set().union(*cells_met(points))
    assert lengths[0] == pytest.approx(sum(math.dist(a, b) for a, b in pairwise(points.tolist())), rel=1e-12)
    short = [max(0.0, 1.5 - table[flat((round(r), round(c)), shape[1])]) / 1.5 for r, c in points.tolist()]
    assert shortage[0] == pytest.approx(sum(short) / len(short), rel=1e-12, abs=1e-15)


def test_a_straight_way_through_corners_takes_diagonal_steps_in_all_four_directions():
    for start, goal in (((0, 0), (4, 4)), ((4, 4), (0, 0)), ((0, 4), (4, 0)), ((4, 0), (0, 4))):
        line = np.linspace(start, goal, 4)
        paths, lengths, _ = compiled.decoding.along_curves(line[np.newaxis, np.newaxis], 5, 0.25, np.zeros(25), 1.0)
        assert paths.shape == (1, 5)
        assert lengths[0] == pytest.approx(4 * math.sqrt(2))


def test_a_curve_from_every_side_crosses_the_same_cells():
    rng = np.random.default_rng(2)
    for _ in range(200):
        piece = rng.integers(0, 7, size=(1, 1, 4, 2)).astype(float)
        views = [piece, piece * [-1, 1] + [6, 0], piece * [1, -1] + [0, 6], piece[..., ::-1].copy()]
        back = [lambda r, c: (r, c), lambda r, c: (6 - r, c), lambda r, c: (r, 6 - c), lambda r, c: (c, r)]
        found = []
        for view, turn in zip(views, back, strict=True):
            paths, _, _ = compiled.decoding.along_curves(np.ascontiguousarray(view), 7, 0.25, np.zeros(49), 1.0)
            found.append([turn(r, c) for r, c in naive.unpacked(paths, 7)[0]])
        assert found[1:] == found[:1] * 3
