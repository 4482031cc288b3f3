"""Seeds from perturbed trees: legal on any map, and unlike each other."""

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, examples

import pathloom as pl
from pathloom.paths.tree_seeding import PerturbedTrees

MAPS = [
    "random-20:75",
    "random-30:20%:s4",
    "blocks-40:30%",
    "rooms-30:6",
    "maze-31:1",
    "maze-30:2",
    "empty-12",
    "iga-map1",
]


def assert_legal(population: np.ndarray, problem: pl.PathProblem) -> None:
    assert population.dtype == np.int32
    for path in naive.unpacked(population, problem.context.cols):
        assert pl.validate(path, problem) is None
        assert naive.steps_singly(path)
        assert len(set(path)) == len(path)


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("name", MAPS)
def test_seeds_are_legal_on_every_kind_of_map(name: str, corners: str) -> None:
    problem = pl.PathProblem(pl.load_map(name, corners=corners), corners=corners)
    found = PerturbedTrees().sample(problem, 30, np.random.default_rng(5))
    assert len(found) == 30
    assert_legal(found, problem)


@given(problem=naive.problems(max_side=8), seed=st.integers(0, 9), spread=st.sampled_from([0.01, 1.0, 50.0]))
@examples(60)
def test_seeds_exist_exactly_where_the_goal_can_be_reached(problem: pl.PathProblem, seed: int, spread: float) -> None:
    found = PerturbedTrees(spread=spread, detour=3.0).sample(problem, 6, np.random.default_rng(seed))
    assert len(found) == (6 if problem.reachable else 0)
    assert_legal(found, problem)


@pytest.mark.parametrize(
    ("name", "least"), [("random-20:75", 30), ("rooms-30:6", 30), ("empty-12", 30), ("maze-30:2", 20)]
)
def test_seeds_have_many_shapes(name: str, least: int) -> None:
    problem = pl.PathProblem(pl.load_map(name))
    found = PerturbedTrees().sample(problem, 50, np.random.default_rng(5))
    assert len(problem.representation.distinct(found)[0]) >= least


def test_in_a_perfect_maze_of_narrow_corridors_there_is_one_way_only() -> None:
    problem = pl.PathProblem(pl.load_map("maze-31:1"))
    found = PerturbedTrees().sample(problem, 20, np.random.default_rng(5))
    _, path = pl.octile_path(problem)
    assert found.tolist() == problem.representation.encode([path] * 20).tolist()


def test_the_same_seed_gives_the_same_bytes_and_another_gives_others() -> None:
    problem = pl.PathProblem(pl.load_map("random-20:75"))
    first, second, other = (PerturbedTrees().sample(problem, 9, np.random.default_rng(k)).tobytes() for k in (1, 1, 2))
    assert first == second
    assert first != other


def test_way_points_that_may_cost_more_give_longer_paths() -> None:
    problem = pl.PathProblem(np.zeros((25, 25), bool))
    mean = {}
    for detour in (1.0, 1.3, 2.0):
        found = PerturbedTrees(detour=detour).sample(problem, 200, np.random.default_rng(0))
        mean[detour] = float(pl.compiled.measures.lengths(found, 25).mean())
    assert mean[1.0] < mean[1.3] < mean[2.0]


@pytest.mark.parametrize("field", [{"spread": 0.0}, {"spread": -1.0}, {"detour": 0.9}])
def test_parameters_out_of_range_are_refused(field: dict[str, float]) -> None:
    with pytest.raises(pl.ConfigError, match=f"perturbed-trees: {next(iter(field))}"):
        PerturbedTrees(**field)
