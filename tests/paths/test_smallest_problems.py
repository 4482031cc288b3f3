"""Start and goal in one cell or side by side, for every operator that there is."""

import naive
import numpy as np
import pytest
from naive import POLICIES

import pathloom as pl
from pathloom.paths.tree_seeding import PerturbedTrees
from pathloom_baselines.crossover import SinglePoint
from pathloom_baselines.mutation import SingleGene
from pathloom_baselines.sampling import RandomWalk
from pathloom_imga.crossover import CommonNode
from pathloom_imga.mutation import D8GeneMedian
from pathloom_imga.sampling import MedianInsertion

SAMPLINGS = [MedianInsertion(), MedianInsertion(reading="as-printed"), RandomWalk(), PerturbedTrees()]
CROSSOVERS = [CommonNode(), CommonNode(loops=True), SinglePoint()]
MUTATIONS = [D8GeneMedian(), D8GeneMedian(loops=True), SingleGene()]

ROOM = np.array([[0, 0, 1, 0, 0], [0, 0, 1, 0, 0], [0, 0, 0, 0, 0], [1, 0, 0, 1, 0]], bool)
ENDS = {
    "one cell": ((1, 1), (1, 1)),
    "side by side": ((1, 0), (1, 1)),
    "one above the other": ((1, 3), (0, 3)),
    "across a free corner": ((1, 0), (0, 1)),
    "across a closed corner": ((1, 1), (2, 2)),
}


@pytest.fixture(params=ENDS)
def ends(request):
    return ENDS[request.param]


@pytest.fixture(params=POLICIES)
def problem(request, ends) -> pl.PathProblem:
    return pl.PathProblem(ROOM, start=ends[0], goal=ends[1], corners=request.param)


def rng() -> np.random.Generator:
    return np.random.default_rng(11)


def assert_legal(population: np.ndarray, problem: pl.PathProblem) -> None:
    for path in naive.unpacked(population, problem.context.cols):
        assert pl.validate(path, problem) is None
        assert naive.steps_singly(path)


@pytest.mark.parametrize("sampling", SAMPLINGS, ids=str)
def test_samplings_find_as_many_paths_as_asked_for(sampling: pl.Sampling, problem: pl.PathProblem) -> None:
    found = sampling.sample(problem, 6, rng())
    assert len(found) == 6
    assert_legal(found, problem)


@pytest.mark.parametrize("sampling", SAMPLINGS, ids=str)
def test_a_start_that_is_the_goal_is_the_only_cell_of_shortest_samples(sampling: pl.Sampling) -> None:
    problem = pl.PathProblem(ROOM, start=(1, 1), goal=(1, 1))
    assert set(sampling.sample(problem, 6, rng()).ravel().tolist()) == {6}


@pytest.mark.parametrize("crossover", CROSSOVERS, ids=str)
def test_crossovers_keep_paths_legal(crossover: pl.Crossover, problem: pl.PathProblem) -> None:
    parents = PerturbedTrees(detour=4.0).sample(problem, 6, rng())
    children = crossover.cross(parents, np.array([[0, 3], [4, 1]]), problem, rng())
    assert len(children) == 6
    assert_legal(children, problem)


@pytest.mark.parametrize("mutation", MUTATIONS, ids=str)
def test_mutations_keep_paths_legal(mutation: pl.Mutation, problem: pl.PathProblem) -> None:
    parents = PerturbedTrees(detour=4.0).sample(problem, 6, rng())
    children = mutation.apply(parents, np.arange(6), problem, rng())
    assert len(children) == 6
    assert_legal(children, problem)


@pytest.mark.parametrize("operator", [*CROSSOVERS, *MUTATIONS], ids=str)
def test_paths_of_one_cell_stay_as_they_are(operator) -> None:
    problem = pl.PathProblem(ROOM, start=(1, 1), goal=(1, 1))
    parents = np.full((2, 1), 6, np.int32)
    if isinstance(operator, pl.Crossover):
        children = operator.cross(parents, np.array([[0, 1]]), problem, rng())
    else:
        children = operator.apply(parents, np.arange(2), problem, rng())
    assert children.tolist() == [[6], [6]]


@pytest.mark.parametrize("planner", ["imga", "ga-imga"])
def test_planners_solve_them(planner: str, problem: pl.PathProblem) -> None:
    result = pl.plan(problem, planner, seed=3)
    assert result.status == "found"
    assert pl.validate(result.path, problem) is None
    assert result.metrics["length"] >= pl.any_angle_path(problem)[0] - 1e-9


def test_a_start_that_is_the_goal_is_planned_as_one_cell() -> None:
    result = pl.plan(pl.PathProblem(ROOM, start=(1, 1), goal=(1, 1)), "imga")
    assert result.path.tolist() == [[1, 1]]
    assert result.metrics["length"] == 0.0


def test_a_map_of_one_cell_is_planned() -> None:
    result = pl.plan(pl.PathProblem([[0]]), "imga", optimum=True)
    assert result.path.tolist() == [[0, 0]]
    nothing = {"grid": 0.0, "any_angle": 0.0, "any_angle_bound": 0.0}
    assert result.optimum == nothing
    assert result.gap == nothing
