"""Operators written for one path at a time: what they return is checked, counted and put in its row."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.counting import counting

RNG = np.random.default_rng(0)
PROBLEM = pl.PathProblem([[0, 0, 0, 0], [0, 1, 1, 0], [0, 0, 0, 0]])
UP = np.array([(2, 0), (0, 0), (0, 3)])
DOWN = np.array([(2, 0), (2, 3), (0, 3)])
STEPS = np.array([(2, 0), (1, 0), (0, 0), (0, 1), (0, 2), (0, 3)])
PARENTS = PROBLEM.representation.encode([UP, DOWN])

BAD = {
    "leaves the map below": [(2, 0), (3, 0), (0, 3)],
    "leaves the map on the left": [(2, 0), (2, -1), (0, 3)],
    "leaves the map on the right": [(2, 0), (2, 4), (0, 3)],
    "loses the start": [(2, 1), (2, 3), (0, 3)],
    "loses the goal": [(2, 0), (2, 3), (1, 3)],
    "stands on an obstacle": [(2, 0), (1, 1), (0, 3)],
    "runs through an obstacle": [(2, 0), (0, 3)],
    "touches a corner": [(2, 0), (2, 2), (1, 3), (0, 3)],
    "is empty": np.empty((0, 2), int),
}
BROKEN = {
    "floats": (UP.astype(float), "got float64 (3, 2)"),
    "booleans": (UP.astype(bool), "got bool (3, 2)"),
    "flat ids": (np.array([8, 0, 3]), "got int64 (3,)"),
    "triples": (np.zeros((3, 3), int), "got int64 (3, 3)"),
    "nothing": (None, "got object ()"),
}


@dataclass(frozen=True, kw_only=True)
class ChangeTo(pl.PathMutation):
    path: Any = None

    def mutate(self, path, problem, rng):
        return path if self.path is None else np.asarray(self.path)


@dataclass(frozen=True, kw_only=True)
class CrossTo(pl.PathCrossover):
    first: Any = None
    second: Any = None

    def cross_one(self, mother, father, problem, rng):
        return (mother if self.first is None else self.first), (father if self.second is None else self.second)


@dataclass(frozen=True, kw_only=True)
class RepairTo(pl.PathRepair):
    path: Any = None

    def repair(self, path, problem, rng):
        return self.path


@dataclass(frozen=True, kw_only=True)
class Draw(pl.PathSampling):
    """Draw one path after the other, over and over."""

    paths: Any = ()

    def sample_one(self, problem, rng):
        return self.paths[int(rng.integers(len(self.paths)))]


@dataclass(frozen=True, kw_only=True)
class Nodes(pl.PathObjective):
    def measure_one(self, path, problem):
        return float(len(path))


def paths_of(population: np.ndarray) -> list[list[list[int]]]:
    return [PROBLEM.representation.decode(row).tolist() for row in population]


def mutated(path, problem=PROBLEM, parents=PARENTS, chosen=(0,)) -> tuple[np.ndarray, dict[str, int]]:
    with counting() as counts:
        children = ChangeTo(path=path).apply(parents, np.array(chosen, np.intp), problem, RNG)
    return children, counts


def test_a_mutated_path_takes_its_parents_row() -> None:
    children, counts = mutated(STEPS)
    assert paths_of(children) == [STEPS.tolist(), DOWN.tolist()]
    assert children.dtype == np.int32
    assert counts == {}


def test_a_shorter_child_is_padded() -> None:
    parents = PROBLEM.representation.encode([STEPS, DOWN])
    children, _ = mutated(UP, parents=parents)
    assert children.tolist() == [[8, 0, 3, -1, -1, -1], [8, 11, 3, -1, -1, -1]]


def test_only_the_chosen_are_mutated_and_the_parents_stay_as_they_were() -> None:
    before = PARENTS.copy()
    children, _ = mutated(STEPS, chosen=(1,))
    assert paths_of(children) == [UP.tolist(), STEPS.tolist()]
    np.testing.assert_array_equal(PARENTS, before)


def test_nobody_chosen_is_nobody_changed() -> None:
    children, counts = mutated(STEPS, chosen=())
    assert children is PARENTS
    assert counts == {}


def test_no_change_is_no_failure() -> None:
    children, counts = mutated(None)
    assert paths_of(children) == paths_of(PARENTS)
    assert counts == {}


@pytest.mark.parametrize("path", BAD.values(), ids=BAD)
def test_a_mutated_path_that_is_not_legal_keeps_its_parent_and_is_counted(path) -> None:
    children, counts = mutated(path, chosen=(0, 1))
    assert paths_of(children) == paths_of(PARENTS)
    assert counts == {"mutation failed": 2}


@pytest.mark.parametrize(("path", "says"), BROKEN.values(), ids=BROKEN)
def test_what_is_no_path_is_an_error_that_names_the_component(path, says: str) -> None:
    @dataclass(frozen=True, kw_only=True)
    class Jitter(pl.PathMutation):
        def mutate(self, unused, problem, rng):
            return path

    with pytest.raises(pl.PluginError) as caught:
        Jitter().apply(PARENTS, np.array([0]), PROBLEM, RNG)
    assert str(caught.value) == f"mutation 'jitter': wanted a path as an int array of shape (k, 2); {says}"


def test_a_list_of_pairs_is_a_path() -> None:
    @dataclass(frozen=True, kw_only=True)
    class AsList(pl.PathMutation):
        def mutate(self, path, problem, rng):
            return STEPS.tolist()

    assert paths_of(AsList().apply(PARENTS, np.array([0]), PROBLEM, RNG))[0] == STEPS.tolist()


def test_cells_that_follow_themselves_are_named_once() -> None:
    children, _ = mutated(np.repeat(UP, 3, axis=0))
    assert paths_of(children)[0] == UP.tolist()


def test_a_mutation_that_writes_into_its_path_spares_the_parent() -> None:
    @dataclass(frozen=True, kw_only=True)
    class Overwrite(pl.PathMutation):
        def mutate(self, path, problem, rng):
            path[1] = (2, 3)
            return path

    before = PARENTS.copy()
    children = Overwrite().apply(PARENTS, np.array([0]), PROBLEM, RNG)
    assert paths_of(children) == [DOWN.tolist()] * 2
    np.testing.assert_array_equal(PARENTS, before)


@pytest.mark.parametrize("dtype", [np.uint8, np.int8, np.int16, np.uint64])
def test_a_path_of_short_integers_arrives_as_it_was_returned(dtype) -> None:
    problem = pl.PathProblem(np.zeros((100, 90), bool))
    parents = problem.representation.encode([np.array(problem.ends)])
    wanted = [[99, 0], [50, 44], [0, 89]]
    children, counts = mutated(np.array(wanted, dtype), problem, parents)
    assert problem.representation.decode(children[0]).tolist() == wanted
    assert counts == {}


@pytest.mark.parametrize("dtype", [np.uint8, np.int16])
def test_a_path_of_short_integers_that_collides_is_noticed(dtype) -> None:
    blocked = np.zeros((200, 200), bool)
    blocked[100, 1:] = True
    problem = pl.PathProblem(blocked)
    good = np.array([(199, 0), (0, 0), (0, 199)])
    parents = problem.representation.encode([good])
    children, counts = mutated(np.array([(199, 0), (199, 100), (0, 100), (0, 199)], dtype), problem, parents)
    assert problem.representation.decode(children[0]).tolist() == good.tolist()
    assert counts == {"mutation failed": 1}


def crossed(first, second) -> tuple[list, dict[str, int]]:
    with counting() as counts:
        children = CrossTo(first=first, second=second).cross(PARENTS, np.array([[1, 0]]), PROBLEM, RNG)
    return paths_of(children), counts


def test_children_take_the_rows_of_mother_and_father() -> None:
    children, counts = crossed(STEPS, UP)
    assert children == [UP.tolist(), STEPS.tolist()]
    assert counts == {}


@pytest.mark.parametrize("path", BAD.values(), ids=BAD)
def test_a_child_that_is_not_legal_costs_itself_only(path) -> None:
    children, counts = crossed(np.asarray(path), STEPS)
    assert children == [STEPS.tolist(), DOWN.tolist()]
    assert counts == {"crossover failed": 1}


def test_no_pairs_give_the_population_back() -> None:
    nobody = np.empty((0, 2), np.intp)
    assert CrossTo(first=STEPS).cross(PARENTS, nobody, PROBLEM, RNG) is PARENTS


def test_a_repair_changes_every_path() -> None:
    with counting() as counts:
        repaired = RepairTo(path=STEPS).apply(PARENTS, PROBLEM, RNG)
    assert paths_of(repaired) == [STEPS.tolist()] * 2
    assert counts == {}


def test_a_repair_with_nothing_to_do_returns_none() -> None:
    with counting() as counts:
        assert paths_of(RepairTo().apply(PARENTS, PROBLEM, RNG)) == paths_of(PARENTS)
    assert counts == {}


@pytest.mark.parametrize("path", BAD.values(), ids=BAD)
def test_a_repair_that_breaks_a_path_is_undone_and_counted(path) -> None:
    with counting() as counts:
        assert paths_of(RepairTo(path=np.asarray(path)).apply(PARENTS, PROBLEM, RNG)) == paths_of(PARENTS)
    assert counts == {"repair failed": 2}


def test_samples_are_drawn_until_there_are_enough() -> None:
    sampled = Draw(paths=(UP, STEPS)).sample(PROBLEM, 5, np.random.default_rng(1))
    assert len(sampled) == 5
    assert {tuple(map(tuple, path)) for path in paths_of(sampled)} <= {
        tuple(map(tuple, p.tolist())) for p in (UP, STEPS)
    }


@pytest.mark.parametrize("path", [None, *map(np.asarray, BAD.values())], ids=["none", *BAD])
def test_a_sampling_that_fails_again_and_again_is_given_up(path) -> None:
    with counting() as counts:
        sampled = Draw(paths=(path,), tries=7).sample(PROBLEM, 5, RNG)
    assert sampled.shape == (0, 1)
    assert counts == {"samples failed": 7}


def test_failures_count_in_a_row_only() -> None:
    with counting() as counts:
        sampled = Draw(paths=(None, UP), tries=30).sample(PROBLEM, 200, np.random.default_rng(3))
    assert len(sampled) == 200
    assert counts["samples failed"] > 30


def test_a_sampling_that_draws_no_paths_is_an_error_that_names_it() -> None:
    with pytest.raises(pl.PluginError, match="sampling 'draw': wanted a path as an int array"):
        Draw(paths=(UP.astype(float),)).sample(PROBLEM, 5, RNG)


def test_an_objective_sees_each_path_without_its_padding() -> None:
    population = PROBLEM.representation.encode([UP, STEPS])
    assert Nodes().measure(population, PROBLEM).tolist() == [3.0, 6.0]


def test_nobody_is_measured_as_nothing() -> None:
    assert Nodes().measure(PARENTS[:0], PROBLEM).shape == (0,)
