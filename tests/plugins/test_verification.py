"""What a planner answers is held against the exact validator, whatever the planner believes."""

from dataclasses import dataclass

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.run import run


@dataclass(frozen=True, kw_only=True)
class Straight(pl.Repair):
    """Join start and goal, through whatever is between."""

    def apply(self, population, problem, rng):
        return np.array([[row[0], row[row >= 0][-1]] for row in population], np.int32)


@dataclass(frozen=True, kw_only=True)
class ThroughTheWall(pl.Sampling):
    """Straight from start to goal."""

    def sample(self, problem, n, rng):
        return np.tile(problem.representation.encode([np.array(problem.ends)]), (n, 1))


@pytest.fixture
def problem():
    return pl.PathProblem(pl.load_map("iga-map1"), corners="allow")


def test_a_refinement_that_collides_is_undone_and_that_is_said(problem):
    result = pl.plan(problem, pl.compose("imga", refinement=Straight(), archive="none"), seed=1)
    assert result.found
    assert result.path.tolist() == result.unrefined.tolist()
    assert "the refined path crosses an obstacle between [9, 0] and [0, 9]; its points were restored" in result.reason
    assert pl.validate(result.path, problem) is None


def test_a_search_that_believes_in_a_colliding_path_has_found_nothing(problem):
    planner = pl.compose("imga", sampling=ThroughTheWall(), crossover=None, mutation=None)
    result = pl.plan(problem, planner, seed=1)
    assert (result.status, result.path) == ("not-found", None)
    assert result.reason == "the best path of the search crosses an obstacle between [9, 0] and [0, 9]"
    assert result.metrics == {}


def test_start_and_goal_in_one_cell_are_a_path_of_length_zero():
    problem = pl.PathProblem(pl.load_map("iga-map1"), start=(9, 0), goal=(9, 0))
    result = pl.plan(problem, "imga", optimum=True)
    assert result.path.tolist() == [[9, 0]]
    assert (result.length, result.gap) == (0.0, {"grid": 0.0, "any_angle": 0.0, "any_angle_bound": 0.0})
    assert result.to_dict()["fitness"] is None  # 1 / 0, which JSON cannot say


def test_an_unreachable_goal_is_said_before_any_search():
    result = pl.plan(pl.PathProblem([[0, 1, 0]]), "imga", optimum=True)
    assert (result.status, result.budget, result.history) == ("unreachable", {}, {})
    with pytest.raises(pl.ProblemError, match="cannot be reached"):
        pl.iterate(pl.PathProblem([[0, 1, 0]]), "imga")


def test_a_result_survives_its_json(problem):
    result = pl.plan(problem, "imga", seed=3, optimum=True)
    again = pl.Result.from_json(result.to_json())
    assert again.to_json() == result.to_json()
    assert again.path.tolist() == result.path.tolist()
    with pytest.raises(pl.PathloomError, match="does not hold its map"):
        again.plot()
    with pytest.raises(pl.PathloomError, match="no document of schema"):
        pl.Result.from_json('{"schema": "other/1"}')


@dataclass(frozen=True, kw_only=True)
class OnlyTheFitter(pl.Probability):
    """Certain for individuals above the mean, never below."""

    def rates(self, fitness, progress):
        assert 0.0 <= progress <= 1.0
        return (fitness > fitness.mean()).astype(float)


def test_a_pair_is_crossed_with_the_rate_of_its_fitter_parent_and_a_mutant_with_its_own(problem):
    crossed, mutated = [], []

    @dataclass(frozen=True, kw_only=True)
    class Witness(pl.Crossover):
        def cross(self, population, pairs, problem, rng):
            crossed.append(pairs)
            return population

    @dataclass(frozen=True, kw_only=True)
    class Mutant(pl.Mutation):
        def apply(self, population, chosen, problem, rng):
            mutated.append(chosen)
            return population

    planner = pl.compose(
        "imga", crossover=Witness(probability=OnlyTheFitter()), mutation=Mutant(probability=OnlyTheFitter())
    )
    fitness = np.linspace(0.0, 1.0, 10)
    planner.vary(np.zeros((10, 3), np.int32), fitness, problem, 0.5, np.random.default_rng(0))
    assert (crossed[0].max(axis=1) >= 5).all()
    assert mutated[0].tolist() == [5, 6, 7, 8, 9]


def test_a_run_without_a_first_individual_says_who_found_none():
    problem = pl.PathProblem(pl.load_map("maze-21:1:s1"))
    finished = run(problem, pl.compose("imga", sampling={"tries": 7}), 0)
    assert finished.outcome.solution is None
    assert finished.outcome.reason == "'median-insertion' found no first individual in 7 tries"
