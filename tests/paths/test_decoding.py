"""Decoders: what vectors say, and when the paths that they stand for are legal."""

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

import pathloom as pl
from pathloom.paths.lines import lines_between
from pathloom.paths.vectors.decoding import Rows, Waypoints, violations

DECODERS = (Rows(), Waypoints(), Waypoints(count=1), Waypoints(count=9))


def decoded(decoder, genes, problem):
    paths = decoder.decode(np.asarray(genes, float), problem)
    return [problem.representation.decode(row).tolist() for row in paths]


@pytest.mark.parametrize("decoder", DECODERS, ids=repr)
@given(data=st.data(), problem=naive.problems(8))
@examples(100)
def test_a_path_is_legal_exactly_where_nothing_is_violated(decoder, data, problem):
    d = len(decoder.straight(problem))
    rng = np.random.default_rng(data.draw(st.integers(0, 10**6)))
    genes = np.clip(decoder.straight(problem) + 0.2 * rng.standard_normal((12, d)), 0.0, 1.0)
    paths = decoder.decode(genes, problem)
    found = violations(paths, problem)
    assert paths.dtype == np.int32
    assert paths.flags.c_contiguous
    for row, violation in zip(paths, found, strict=True):
        assert (violation == 0.0) == (pl.validate(problem.representation.decode(row), problem) is None)


@pytest.mark.parametrize("decoder", DECODERS, ids=repr)
@given(problem=naive.problems(9))
@examples(100)
def test_paths_lead_from_start_to_goal_and_repeat_no_cell_at_once(decoder, problem):
    straight, axes = decoder.straight(problem), decoder.axes(problem)
    assert straight.shape == axes.shape
    genes = np.random.default_rng(0).random((5, len(straight)))
    paths = decoder.decode(genes, problem)
    assert paths.shape == decoder.decode(genes[:1], problem).repeat(5, axis=0).shape
    for row in paths:
        path = problem.representation.decode(row)
        assert (path[0].tolist(), path[-1].tolist()) == tuple(map(list, problem.ends))
        assert (np.abs(np.diff(path, axis=0)).max(axis=1) > 0).all()


@pytest.mark.parametrize("decoder", DECODERS, ids=repr)
@given(problem=naive.problems(9))
@examples(60)
def test_the_straight_way_keeps_within_a_cell_of_the_line(decoder, problem):
    (path,) = decoded(decoder, decoder.straight(problem)[np.newaxis], problem)
    start, goal = np.array(problem.ends, float)
    for cell in path:
        t = np.linspace(0, 1, 2001)[:, np.newaxis]
        assert np.abs(start + t * (goal - start) - cell).max(axis=1).min() <= 0.51


@given(problem=naive.problems(9))
@examples(60)
def test_there_is_one_gene_for_each_line_between_start_and_goal(problem):
    lines = lines_between(problem.context)
    assert len(Rows().straight(problem)) == len(lines)
    (path,) = decoded(Rows(), np.full((1, len(lines)), 0.5), problem)
    cols = problem.context.cols
    for (r, c), line in zip(path[1:-1], lines, strict=True):
        assert r * cols + c in line or problem.context.occupied[r, c]
    if lines:
        assert set(Rows().axes(problem).tolist()) <= {0, 1}


@pytest.mark.parametrize(
    ("start", "goal", "genes", "path"),
    [
        ((0, 0), (3, 1), [0.0, 0.99], [[0, 0], [1, 0], [2, 4], [3, 1]]),
        ((3, 1), (0, 0), [0.0, 0.99], [[3, 1], [2, 0], [1, 4], [0, 0]]),
        ((1, 4), (2, 1), [0.26, 0.5], [[1, 4], [1, 3], [2, 2], [2, 1]]),
        ((2, 0), (2, 1), [], [[2, 0], [2, 1]]),
        ((2, 3), (2, 3), [], [[2, 3]]),
    ],
)
def test_rows_by_hand(start, goal, genes, path):
    problem = pl.PathProblem(np.zeros((4, 5), bool), start=start, goal=goal)
    assert decoded(Rows(), [genes], problem) == [path]


def test_waypoints_by_hand():
    problem = pl.PathProblem(np.zeros((4, 5), bool), start=(0, 0), goal=(3, 4))
    genes = [[0.0, 1.0, 0.5, 0.39, 0.74, 0.2], [0.1, 0.1, 0.1, 0.1, 1.0, 1.0]]
    assert decoded(Waypoints(count=3), genes, problem) == [[[0, 0], [0, 4], [2, 1], [3, 4]], [[0, 0], [3, 4]]]


def test_the_straight_way_is_cut_into_equal_parts():
    problem = pl.PathProblem(np.zeros((9, 5), bool), start=(8, 0), goal=(0, 4))
    points = Waypoints(count=3).straight(problem).reshape(3, 2) * (9, 5) - 0.5
    assert points == pytest.approx(np.array([[6, 1], [4, 2], [2, 3]]))
    assert Rows().straight(problem) * 5 - 0.5 == pytest.approx(np.arange(1, 8) / 2)


def test_genes_count_from_the_outer_border_so_that_every_cell_has_the_same_share():
    problem = pl.PathProblem(np.zeros((1, 5), bool), start=(0, 0), goal=(0, 4))
    genes = np.stack((np.zeros(1000), (np.arange(1000) + 0.5) / 1000), axis=1)
    cells = [path[1][1] if len(path) > 2 else None for path in decoded(Waypoints(count=1), genes, problem)]
    assert [cells.count(c) for c in (1, 2, 3)] == [200, 200, 200]
