"""The genetic algorithm over control points of Bézier curves."""

import math
from dataclasses import replace
from types import SimpleNamespace

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

import pathloom as pl
from pathloom.exact.curves import validate_curve
from pathloom.kernel.counting import counting
from pathloom.kernel.run import run
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.vectors.planner import Judge
from pathloom_baselines.bezier import BezierGa

EMPTY = pl.PathProblem(np.zeros((12, 15), bool), start=(11, 0), goal=(0, 14))
CLUTTERED = pl.PathProblem(pl.load_map("random-20:75:s3", corners="allow"), corners="allow")


def genes_on(problem, planner, n, seed):
    sides = problem.grid.shape
    points = np.random.default_rng(seed).integers(sides, size=(n, planner.points, 2))
    return points.reshape(n, -1).astype(float)


def bernstein(piece, t):
    n = len(piece) - 1
    t = t[:, np.newaxis]
    return sum(math.comb(n, i) * t**i * (1 - t) ** (n - i) * piece[i] for i in range(n + 1))


# Curves -----------------------------------------------------------------------------------------


def test_pieces_are_cubic_and_join_with_one_tangent_and_one_speed():
    planner = BezierGa(points=6)
    genes = genes_on(EMPTY, planner, 20, 0)
    pieces = planner._pieces(genes, EMPTY)
    assert pieces.shape == (20, 3, 4, 2)
    assert (pieces[:, 0, 0] == EMPTY.start).all()
    assert (pieces[:, -1, -1] == EMPTY.goal).all()
    assert (pieces[:, 1:, 0] == pieces[:, :-1, 3]).all()
    assert (pieces[:, 1:, 1] - pieces[:, 1:, 0] == pieces[:, :-1, 3] - pieces[:, :-1, 2]).all()
    assert (pieces[:, :, 1:3].reshape(20, -1) == genes).all()


def test_a_single_curve_has_all_control_points():
    planner = BezierGa(points=5, form="single")
    genes = genes_on(EMPTY, planner, 4, 1)
    pieces = planner._pieces(genes, EMPTY)
    assert pieces.shape == (4, 1, 7, 2)
    assert (pieces[:, 0, 1:-1].reshape(4, -1) == genes).all()


@pytest.mark.parametrize(
    ("fields", "fault"),
    [({"points": 5}, "points is even, two for each piece; got 5"), ({"form": "single", "points": 12}, "at most 11")],
)
def test_what_makes_no_curve_is_refused(fields, fault):
    with pytest.raises(pl.ConfigError, match=fault):
        BezierGa(**fields)


@pytest.mark.parametrize("planner", [BezierGa(), BezierGa(points=2), BezierGa(points=6, form="single")], ids=repr)
def test_values_are_the_length_of_the_curve_and_the_mean_shortage_of_the_safe_distance(planner):
    genes = genes_on(CLUTTERED, planner, 12, 2)
    found, _ = planner.evaluate_genes(genes, CLUTTERED)
    t = np.linspace(0, 1, 3000)
    for pieces, (length, shortage), cost in zip(
        planner._pieces(genes, CLUTTERED), found.values, found.costs, strict=True
    ):
        fine = np.concatenate([bernstein(piece, t) for piece in pieces])
        assert length == pytest.approx(np.hypot(*np.diff(fine, axis=0).T).sum(), rel=1e-3)
        points = pl.compiled.decoding.sample_curve(pieces, 0.25)
        away = CLUTTERED.context.distance.reshape(20, 20)[tuple(np.rint(points).astype(int).T)]
        assert shortage == pytest.approx(np.maximum(0.0, 1.5 - away).mean() / 1.5)
        assert cost == pytest.approx(length * (1 + shortage))


@given(problem=naive.problems(9), seed=st.integers(0, 10**6), form=st.sampled_from(["pieces", "single"]))
@examples(80)
def test_a_curve_is_legal_exactly_where_the_cells_that_it_crosses_are(problem, seed, form):
    planner = BezierGa(form=form, points=4)
    genes = genes_on(problem, planner, 6, seed)
    found, legal = planner.evaluate_genes(genes, problem)
    for row, ok, violation in zip(found.paths, legal, found.violations, strict=True):
        path = problem.representation.decode(row)
        assert ok == (violation == 0.0) == (pl.validate(path, problem) is None)
        assert naive.steps_singly(map(tuple, path.tolist()))


@pytest.mark.parametrize("corners", naive.POLICIES)
def test_the_polyline_of_an_answer_is_free_and_as_long_as_the_curve(corners):
    problem = pl.PathProblem(pl.load_map("random-20:40:s3", corners=corners), corners=corners)
    planner = replace(BezierGa(), termination=(MaxGenerations(limit=20),))
    for seed in range(4):
        state = run(problem, planner, seed).state
        polyline = planner.polyline(state)
        assert validate_curve(polyline, problem) is None
        assert np.hypot(*np.diff(polyline, axis=0).T).sum() == pytest.approx(state.answer.values[0])
        assert (polyline[0].tolist(), polyline[-1].tolist()) == ([19.0, 0.0], [0.0, 19.0])


def test_a_plan_reports_the_curve_and_the_cells_that_it_crosses():
    result = pl.plan(CLUTTERED, "bezier-ga", seed=0)
    assert result.found
    assert result.metrics["polyline_length"] < result.length  # the cells' way goes round every corner
    assert result.curve.length == pytest.approx(result.metrics["polyline_length"], rel=1e-3)
    assert not result.curve.fallback
    steps = np.abs(np.diff(result.path, axis=0)).max(axis=1)
    assert (steps == 1).all()


def test_start_and_goal_in_one_cell_are_one_point():
    problem = pl.PathProblem(np.zeros((4, 4), bool), start=(2, 1), goal=(2, 1))
    result = pl.plan(problem, replace(BezierGa(), termination=(MaxGenerations(limit=2),)))
    assert result.path.tolist() == [[2, 1]]
    assert result.metrics["polyline_length"] == 0.0


def test_where_no_curve_is_free_there_is_no_polyline_either():
    wall = np.zeros((5, 5), bool)
    wall[2] = True
    problem = pl.PathProblem(wall)
    planner = replace(BezierGa(), termination=(MaxGenerations(limit=2),))
    finished = run(problem, planner, 0)
    assert finished.outcome.solution is None
    assert planner.polyline(finished.state) is None


# Operators --------------------------------------------------------------------------------------


def test_first_control_points_are_centres_of_cells_about_the_straight_way():
    planner = BezierGa(population=3000, points=4)
    genes = planner.first_genes(EMPTY, np.random.default_rng(0)).reshape(3000, 4, 2)
    assert (genes == np.rint(genes)).all()
    assert (genes >= 0).all()
    assert (genes < EMPTY.grid.shape).all()
    assert genes[:, 1].mean(axis=0) == pytest.approx([11 - 11 * 0.4, 14 * 0.4], abs=0.2)
    assert genes[:, 1].std(axis=0) == pytest.approx([0.15 * 12, 0.15 * 15], abs=0.2)


def test_points_are_exchanged_one_by_one_within_pairs():
    planner = BezierGa(points=2)
    genes = np.arange(4000 * 4, dtype=float).reshape(4000, 2, 2)
    children = planner._crossed(genes, np.random.default_rng(0))
    mine = (children == genes).all(axis=2)
    other = genes.reshape(2000, 2, 2, 2)[:, ::-1].reshape(4000, 2, 2)
    assert (mine | (children == other).all(axis=2)).all()
    assert (mine[::2] == mine[1::2]).all()
    assert 1 - mine.mean() == pytest.approx(0.4, abs=0.02)  # crossed with 0.8, exchanged with 0.5
    assert mine.all(axis=1).mean() == pytest.approx(0.2 + 0.8 / 4, abs=0.03)
    assert (replace(planner, crossing=0.0)._crossed(genes, np.random.default_rng(0)) == genes).all()


def test_of_an_odd_number_the_last_one_stays_alone():
    genes = np.arange(12, dtype=float).reshape(3, 2, 2)
    children = BezierGa(points=2, crossing=1.0)._crossed(genes, np.random.default_rng(0))
    assert (children[2] == genes[2]).all()


@pytest.mark.parametrize(("progress", "reach"), [(0.0, 6.0), (0.5, 3.5), (1.0, 1.0)])
def test_points_are_moved_to_free_cells_within_a_shrinking_reach(progress, reach):
    planner = BezierGa(points=2, mutating=1.0, tries=200)
    free = ~CLUTTERED.context.occupied
    genes = np.full((4000, 2, 2), 10.0)
    with counting() as counts:
        moved = planner._mutated(genes, CLUTTERED, progress, np.random.default_rng(0))
    assert "mutation failed" not in counts
    cells = {(int(r), int(c)) for r, c in moved.reshape(-1, 2)}
    everywhere = np.argwhere(free).tolist()
    assert cells == {(r, c) for r, c in everywhere if 0 < math.hypot(r - 10, c - 10) <= reach}
    few = replace(planner, mutating=0.1)._mutated(genes, CLUTTERED, progress, np.random.default_rng(0))
    assert (few != genes).any(axis=2).mean() == pytest.approx(0.1, abs=0.01)


def test_a_point_with_no_free_cell_about_it_stays_and_is_counted():
    enclosed = np.ones((9, 9), bool)
    enclosed[0] = False
    problem = pl.PathProblem(enclosed, start=(0, 0), goal=(0, 8))
    genes = np.full((5, 2, 2), 8.0)
    with counting() as counts:
        moved = BezierGa(points=2, mutating=1.0)._mutated(genes, problem, 1.0, np.random.default_rng(0))
    assert (moved == genes).all()
    assert counts["mutation failed"] == 10


@pytest.mark.parametrize(
    ("penalty", "generation", "elite"),
    [(7.0, 0, 1), (6.0, 0, 0), (6.0, 10, 1)],  # 14 against 10 + 7 · 0.6, 10 + 6 · 0.6, 10 + 6 · 2 · 0.6
)
def test_the_penalty_grows_with_the_share_that_collides_and_with_time(penalty, generation, elite):
    planner = BezierGa(points=2, penalty=penalty, termination=(MaxGenerations(limit=10),), population=2)
    judge = Judge(planner, EMPTY)
    both = judge(np.array([[9.0, 3.0, 5.0, 8.0], [3.0, 3.0, 1.0, 9.0]]))
    both = replace(both, costs=np.array([10.0, 14.0]), violations=np.array([1.0, 0.0]))
    state = SimpleNamespace(vectors=both, generation=generation, problem=EMPTY)
    after, _ = planner.move(state, judge, np.random.default_rng(0))
    assert after.genes[0].tolist() == both.genes[elite].tolist()


def test_tournaments_of_two_are_won_by_the_cheaper():
    planner = BezierGa(points=2, crossing=0.0, mutating=0.0, population=4000)
    judge = Judge(planner, EMPTY)
    genes = genes_on(EMPTY, planner, 4000, 0)
    genes[:, 0] = np.arange(4000) % 12
    both = judge(genes)
    both = replace(both, costs=genes[:, 0].copy(), violations=np.zeros(4000))
    after, _ = planner.move(SimpleNamespace(vectors=both, generation=0, problem=EMPTY), judge, np.random.default_rng(0))
    for k in range(12):  # the larger of two draws out of twelve, from below
        share = ((12 - k) ** 2 - (11 - k) ** 2) / 144
        assert (after.genes[1:, 0] == k).mean() == pytest.approx(share, abs=0.02)
