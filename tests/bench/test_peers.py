"""Every peer that is installed, on small maps: its paths pass our validators."""

import random

import numpy as np
import pytest

import pathloom as pl
from pathloom.bench.measure import fault_of, length_of
from pathloom.bench.ours import EXACT, Ours, usual
from pathloom.bench.peers import PEERS, deap, pymoo_with_ours
from pathloom.bench.peers.way_points import WayPoints, sees
from pathloom.bench.suite import problem_on
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry

GRID_SEARCHES = ("scikit-image route_through_array", "networkx astar_path")


@pytest.fixture(params=PEERS)
def peer(request):
    found = PEERS[request.param]
    if found.version() is None:
        pytest.skip(f"{found.distribution} is not installed")
    return found


@pytest.mark.filterwarnings("default")  # those are theirs
@pytest.mark.parametrize("corners", ["allow", "no-squeeze", "strict"])
def test_a_peer_plans_under_each_corner_policy(peer, corners):
    problem = problem_on("random-10:5:s4", corners)  # its first individuals find a way already, on any machine
    path = peer.prepare(problem)(1, 0.2)
    assert path is not None
    assert fault_of(path, problem) == ""
    if path.dtype.kind in "iu":
        assert length_of(path) >= pl.any_angle_path(problem)[0] - 1e-9


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("name", GRID_SEARCHES)
def test_searches_of_the_grid_are_octile_optimal_or_find_nothing(name):
    if PEERS[name].version() is None:
        pytest.skip("not installed")
    problem = problem_on("random-20:25%:s1", "allow")
    assert length_of(PEERS[name].prepare(problem)(0)) == pytest.approx(pl.octile_path(problem)[0])
    closed = np.zeros((5, 5), bool)
    closed[2] = True
    assert PEERS[name].prepare(pl.PathProblem(closed, corners="allow"))(0) is None


def test_under_strict_networkx_knows_the_corners():
    if PEERS["networkx astar_path"].version() is None:
        pytest.skip("networkx is not installed")
    problem = problem_on("random-20:25%:s1", "strict")
    assert length_of(PEERS["networkx astar_path"].prepare(problem)(0)) == pytest.approx(pl.octile_path(problem)[0])


@pytest.mark.parametrize("ours", [*EXACT, *map(Ours, usual()[-2:])], ids=lambda peer: peer.name)
def test_ours_enter_as_the_others_do(ours):
    problem = problem_on("random-12:20", "strict")
    path = ours.prepare(problem)(0, 5.0)
    assert fault_of(path, problem) == ""
    np.testing.assert_array_equal(path, ours.prepare(problem)(0, 5.0))
    assert "context" not in vars(ours.planner if isinstance(ours, Ours) else ours)


def test_ours_end_where_the_path_is_short_enough():
    problem = problem_on("random-12:20", "allow")
    optimum, _ = pl.any_angle_path(problem)
    path = Ours("imga").prepare(problem)(0, 5.0, 1.3 * optimum)
    assert length_of(path) <= 1.3 * optimum


def test_loom_is_measured_as_soon_as_there_is_one():
    names = {entry.component.name for entry in default_registry().all_entries(Planner)}
    assert (usual()[0] == "loom") == ("loom" in names)


@pytest.mark.parametrize("corners", ["allow", "no-squeeze", "strict"])
def test_way_points_see_what_our_validator_sees(corners):
    problem = problem_on("random-20:30%:s2", corners)
    rng = np.random.default_rng(3)
    free = np.argwhere(~problem.grid.occupied)
    for a, b in free[rng.integers(len(free), size=(400, 2))]:
        between = pl.PathProblem(problem.grid, start=tuple(a), goal=tuple(b), corners=corners)
        assert sees(a, b, problem) == (pl.validate(np.array([a, b]), between) is None), (a, b)


def test_a_vector_costs_its_length_and_a_penalty_for_what_it_meets():
    grid = np.zeros((5, 5), bool)
    grid[2, 2] = True
    ways = WayPoints(pl.PathProblem(grid, start=(2, 0), goal=(2, 4), corners="allow"), points=1)
    assert ways.measure(np.array([2.0, 1.0])) == (4.0, 1)
    assert ways.cost(np.array([2.0, 1.0])) == 4.0 + 2.5
    assert ways.answer(np.array([2.0, 1.0])) is None
    assert ways.length(np.array([0.4, 2.0])) == pytest.approx(2 * 8**0.5)
    np.testing.assert_array_equal(ways.answer(np.array([0.4, 2.0])), [(2, 0), (0, 2), (2, 4)])


def test_the_adapters_rows_go_to_and_fro():
    population = np.array([[3, 1, -1], [4, 5, 6]], np.int32)
    rows = pymoo_with_ours.rows_of(population)
    assert rows.shape == (2, 1)
    np.testing.assert_array_equal(pymoo_with_ours.population_of(rows), population)


def test_walks_without_loops_and_shortened_are_still_walks():
    problem = problem_on("random-15:25%:s1", "strict")
    from pathloom.bench.peers.grid_graph import length, steps

    around = steps(problem)
    random.seed(2)
    for _ in range(20):
        path = deap.walk(*problem.ends, around)
        doubled = deap.without_loops([*path, *path[::-1][1:], *path[1:]])
        assert (doubled[0], doubled[-1]) == problem.ends
        assert len(set(doubled)) == len(doubled)
        assert fault_of(np.array(doubled), problem) == ""
        shorter = deap.shortened(path, problem)
        assert fault_of(shorter, problem) == ""
        assert length_of(shorter) <= length(path) + 1e-9
