"""RRT and S-RRT: legal paths on any map, the same for the same seed, and what the paper claims of the two."""

import dataclasses
import math
import pickle

import numpy as np
import pytest
from kernel.one_max import OneMax
from naive import POLICIES

import pathloom as pl
from pathloom import compiled
from pathloom.exact.curves import validate_curve
from pathloom.kernel.counting import counting
from pathloom.kernel.run import iterate, run
from pathloom.paths.curves import BSpline
from pathloom.testing.problems import views
from pathloom.testing.symmetry import alike, features
from pathloom_hga_aco.rrt import Rrt
from pathloom_hga_aco.s_rrt import SRrt
from pathloom_hga_aco.shortcut import GreedyParentShortcut

PLANNERS = [Rrt(), SRrt()]
both = pytest.mark.parametrize("planner", PLANNERS, ids=["rrt", "s-rrt"])
each_policy = pytest.mark.parametrize("corners", POLICIES)
UNIT = compiled.trees.UNIT


def problem_on(name, corners="strict", **ends):
    return pl.PathProblem(pl.load_map(name, corners=corners), corners=corners, **ends)


def polyline_is_free(points, problem):
    it = problem.context
    lattice = np.rint(points * UNIT).astype(np.int64)
    assert np.abs(lattice / UNIT - points).max() == 0.0
    return compiled.trees.open_segments_free(it.blocked, it.cols, lattice[:-1], lattice[1:], it.policy).all()


# Paths ------------------------------------------------------------------------------------------

MAPS = ("iga-map1", "random-20:75", "blocks-20:20%", "blocks-50:20%", "rooms-50:8", "maze-21:1", "maze-20:2")


@both
@each_policy
@pytest.mark.parametrize("name", MAPS)
def test_paths_polylines_and_curves_are_free_on_all_kinds_of_maps(planner, corners, name):
    problem = problem_on(name, corners)
    for seed in range(3):
        result = pl.plan(problem, planner, seed=seed, smooth="b-spline")
        assert result.found, result.reason
        assert pl.validate(result.path, problem) is None
        assert validate_curve(result.curve.points, problem) is None
        polyline = planner.polyline(run(problem, planner, seed).state)
        assert polyline[[0, -1]].tolist() == [list(end) for end in problem.ends]
        assert polyline_is_free(polyline, problem)
        assert result.metrics["polyline_nodes"] == len(polyline)
        assert result.metrics["polyline_length"] == pytest.approx(sum(map(math.dist, polyline, polyline[1:])))


@both
@each_policy
def test_any_two_cells_of_a_map_that_is_no_square_are_joined(planner, corners):
    rng = np.random.default_rng(3)
    for k in range(40):
        shape = rng.integers(1, 12, 2)
        occupied = rng.random(shape) < (0.0, 0.2, 0.35)[k % 3]
        occupied.flat[rng.integers(occupied.size)] = False
        free = np.argwhere(~occupied)
        start, goal = (tuple(map(int, free[rng.integers(len(free))])) for _ in range(2))
        problem = pl.PathProblem(occupied, start=start, goal=goal, corners=corners)
        if corners == "allow" and not pl.PathProblem(occupied, start=start, goal=goal, corners="no-squeeze").reachable:
            continue  # the only way leads through a point, which a random branch does not meet
        result = pl.plan(problem, planner, seed=k)
        assert result.status == ("found" if problem.reachable else "unreachable")
        if result.found:
            assert pl.validate(result.path, problem) is None


@both
def test_start_and_goal_may_be_one_cell_or_neighbours(planner):
    one = pl.plan(problem_on("iga-map1", start=(9, 0), goal=(9, 0)), planner)
    assert one.path.tolist() == [[9, 0]]
    assert (one.length, one.budget["evaluations"], one.metrics["polyline_length"]) == (0.0, 1, 0.0)
    assert one.curve is None or one.curve.points.tolist() == [[9.0, 0.0]]
    for goal in ((9, 1), (8, 0), (8, 1)):
        problem = pl.PathProblem(np.zeros((10, 10), bool), start=(9, 0), goal=goal)
        result = pl.plan(problem, planner, seed=4)
        assert pl.validate(result.path, problem) is None
        assert result.length < 12


def test_the_goal_alone_as_target_leads_straight_there():
    problem = pl.PathProblem(np.zeros((30, 12), bool), start=(29, 0), goal=(2, 9))
    result = pl.plan(problem, Rrt(goal_bias=1.0))
    assert result.metrics["polyline_length"] == pytest.approx(math.dist(*problem.ends), abs=1e-3)
    assert result.metrics["polyline_nodes"] == math.ceil(math.dist(*problem.ends) / 1.7) + 1
    straight = pl.plan(problem, SRrt(goal_bias=1.0))
    assert straight.path.tolist() == [[29, 0], [2, 9]]


@both
def test_no_branch_is_longer_than_a_step_but_the_last_which_may_be_as_long_as_the_tolerance(planner):
    problem = problem_on("random-20:75")
    for step, tolerance in ((1.7, 1.0), (0.6, 3.0)):
        grown = dataclasses.replace(planner, step_length=step, tolerance=tolerance, denoise=False)
        state = run(problem, grown, 5).state
        branches = np.hypot(*(state.points[1:] - state.points[state.parents[1:]]).T)
        assert branches[:-1].max() <= step + 2 / UNIT
        assert branches[-1] <= step * tolerance + 2 / UNIT
        assert state.points[-1].tolist() == list(problem.goal)
        assert state.parents[0] == -1
        assert (state.parents[1:] < np.arange(1, len(state.nodes))).all()


# Runs -------------------------------------------------------------------------------------------


@both
def test_the_same_seed_gives_the_same_bytes_and_another_seed_another_tree(planner):
    problem = problem_on("rooms-50:8")
    one, same, other = (pl.plan(problem, planner, seed=s, smooth="b-spline") for s in (3, 3, 4))
    assert one.path.tobytes() == same.path.tobytes()
    assert one.curve.points.tobytes() == same.curve.points.tobytes()
    assert (one.metrics, one.history) == (same.metrics, same.history)
    assert one.path.tobytes() != other.path.tobytes()


@both
def test_a_state_can_be_pickled_and_grown_on_from(planner):
    problem = problem_on("maze-21:1")
    planner = dataclasses.replace(planner, chunk=500, trees=2)
    states = list(iterate(problem, planner, 7))
    assert len(states) > 8
    middle = pickle.loads(pickle.dumps(states[len(states) // 2]))
    assert middle.samples % 500 == 0
    while not planner.done(middle):
        middle = planner.step(middle)
    assert middle.way.tobytes() == states[-1].way.tobytes()
    assert middle.evaluations == states[-1].evaluations == len(states[-1].history.best) == 2
    shares = [planner.progress(state) for state in states]
    assert shares == sorted(shares)
    assert (shares[0], shares[-1]) == (0.0, 1.0)


@both
def test_the_population_is_the_path_that_was_just_found_or_nobody(planner):
    problem = problem_on("maze-21:1")
    *before, last = iterate(problem, planner, 7)
    assert {state.population.shape for state in before} == {(0, 1)}
    assert (len(last.population), last.history.evaluations) == (1, (1,))
    assert pl.validate(problem.representation.decode(last.population[0]), problem) is None


@both
def test_a_tree_that_is_given_up_is_no_path_and_that_is_said(planner):
    problem = problem_on("maze-41:1")
    result = pl.plan(problem, dataclasses.replace(planner, samples=1500, chunk=400))
    assert (result.status, result.path, result.curve) == ("not-found", None, None)
    assert result.reason.startswith("1500 samples made a tree of ")
    assert result.reason.endswith(" nodes that has not reached the goal")
    assert result.budget["generations"] == 4
    assert result.budget["counts"] == {"trees without a path": 1}
    twice = pl.plan(problem, dataclasses.replace(planner, samples=1500, trees=2))
    assert twice.reason.startswith("2 trees, of the last of which 1500 samples made")
    assert twice.budget["counts"] == {"trees without a path": 2}


@both
def test_a_goal_behind_walls_is_refused_before_any_tree_grows(planner):
    assert pl.plan(pl.PathProblem([[0, 1, 0]]), planner).status == "unreachable"


@both
def test_more_trees_find_no_longer_paths_and_any_termination_ends_them(planner):
    problem = problem_on("random-20:75")
    lengths = []
    for trees in (1, 4, 16):
        result = pl.plan(problem, dataclasses.replace(planner, trees=trees), seed=2)
        assert result.budget["evaluations"] == trees
        lengths.append(result.metrics["polyline_length"])
    assert lengths == sorted(lengths, reverse=True)
    assert lengths[-1] < lengths[0]
    few = dataclasses.replace(planner, trees=1000, termination=(pl.compose("imga").termination[0],))
    assert pl.plan(problem, few).budget["generations"] == 50


def test_the_best_of_several_trees_is_the_one_that_is_shortest_when_it_is_straightened():
    problem = problem_on("random-20:75")
    planner = SRrt(trees=12)
    ways = [s.way for s in iterate(problem, planner, 6) if s.way is not None]
    refined = [planner.refined(way, problem) / UNIT for way in ways]
    lengths = [sum(map(math.dist, points, points[1:])) for points in refined]
    assert lengths == sorted(lengths, reverse=True)
    assert (
        planner.result(list(iterate(problem, planner, 6))[-1]).solution.tolist()
        == planner.path(ways[-1], problem).tolist()
    )


def test_the_nearest_to_the_sample_is_another_tree_than_the_nearest_to_the_goal():
    problem = problem_on("blocks-20:20%")
    found = [pl.plan(problem, Rrt(nearest=nearest, goal_bias=0.4), seed=1) for nearest in ("target", "sample")]
    assert all(result.found for result in found)
    assert found[0].path.tolist() != found[1].path.tolist()


def test_denoising_leaves_the_nodes_of_the_way_and_nothing_else():
    problem = problem_on("blocks-20:20%")
    kept, whole = (run(problem, SRrt(denoise=denoise), 3).state for denoise in (True, False))
    assert kept.nodes.tolist() == kept.way.tolist() == whole.way.tolist()
    assert kept.parents.tolist() == list(range(-1, len(kept.way) - 1))
    assert len(whole.nodes) > len(kept.nodes)
    assert whole.nodes.tolist()[0] == kept.nodes.tolist()[0]


@both
def test_a_problem_of_another_kind_is_refused(planner):
    with pytest.raises(pl.ConfigError, match="works on 'cells'; the problem has 'bits'"):
        planner.start(OneMax(), np.random.default_rng(0))


def test_s_rrt_makes_its_own_curve_unless_another_is_asked_for_or_none():
    problem = problem_on("blocks-20:20%")
    own, other = pl.plan(problem, "s-rrt"), pl.plan(problem, "s-rrt", smooth="cubic-bezier")
    assert (
        own.curve.points.tolist()
        == BSpline().smooth(SRrt().polyline(run(problem, SRrt(), 0).state), problem).points.tolist()
    )
    assert other.curve.points.tolist() != own.curve.points.tolist()
    assert pl.plan(problem, pl.compose("s-rrt", smoothing="none")).curve is None
    assert pl.plan(problem, "rrt").curve is None


# The shortcut -----------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, kw_only=True)
class SeesAll(pl.Collision):
    """Nothing is in the way."""

    def segments_free(self, a, b, problem):
        return np.ones(len(a), np.bool_)


@dataclasses.dataclass(frozen=True, kw_only=True)
class SeesNear(pl.Collision):
    """Nothing within five rows and columns is in the way."""

    def segments_free(self, a, b, problem):
        return np.abs(np.asarray(a) - b).max(axis=1) <= 5


@each_policy
def test_a_shortcut_by_any_test_keeps_to_what_is_free(corners):
    problem = problem_on("random-20:75", corners)
    paths = pl.compose("imga").sampling.sample(problem, 30, np.random.default_rng(0))
    exact = GreedyParentShortcut().apply(paths, problem, np.random.default_rng(0))
    all_seeing = GreedyParentShortcut(collision=SeesAll()).apply(paths, problem, np.random.default_rng(0))
    assert all_seeing.tolist() == exact.tolist()  # what is blocked is out of sight in any case
    near = GreedyParentShortcut(collision=SeesNear()).apply(paths, problem, np.random.default_rng(0))
    for row in near:
        path = problem.representation.decode(row)
        assert pl.validate(path, problem) is None
        assert np.abs(np.diff(path, axis=0)).max() <= 5
    lengths = [compiled.measures.lengths(p, 20) for p in (paths, near, exact)]
    assert (lengths[1] <= lengths[0] + 1e-9).all()
    assert (lengths[2] <= lengths[0] + 1e-9).all()
    assert (exact >= 0).sum() < (near >= 0).sum() < (paths >= 0).sum()


# What the paper claims --------------------------------------------------------------------------

SCENES = ("blocks-20:10%", "blocks-20:20%", "blocks-20:20%:s1")


@pytest.mark.parametrize("name", SCENES)
def test_over_20_runs_s_rrt_is_a_tenth_shorter_with_a_fifth_of_the_nodes_and_smooth(name):
    problem = problem_on(name)
    plain, smooth = ([pl.plan(problem, planner, seed=seed) for seed in range(20)] for planner in PLANNERS)
    assert all(result.found for result in (*plain, *smooth))
    longer, shorter = (np.mean([r.metrics["polyline_length"] for r in runs]) for runs in (plain, smooth))
    many, few = (np.mean([r.metrics["polyline_nodes"] for r in runs]) for runs in (plain, smooth))
    assert shorter < 0.9 * longer
    assert 17 < many < 25
    assert 3 <= few <= 6
    best = pl.any_angle_path(problem)[0]
    assert np.median([r.length for r in smooth]) < 1.05 * best
    for result in smooth:
        assert validate_curve(result.curve.points, problem) is None
        assert not result.curve.fallback
        assert result.curve.length <= result.metrics["polyline_length"] + 1e-9
        assert math.isfinite(result.curve.max_curvature)


# Symmetry ---------------------------------------------------------------------------------------


@both
def test_trees_have_no_favourite_direction(planner):
    found = []
    for turn, view in enumerate(views()):
        paths = [run(view.problem, planner, 1000 * turn + seed).outcome.solution for seed in range(120)]
        found.append(np.concatenate([features(view.back(path[np.newaxis]), 12) for path in paths]))
    alike(found)


def test_counting_stays_within_a_run():
    with counting() as counts:
        pl.plan(problem_on("iga-map1"), "s-rrt")
    assert counts == {"evaluations": 1}  # that of the answer
