"""Figures of an evolution: they show what the states hold, and say so in one line where there is nothing to show."""

import numpy as np
import pytest

import pathloom as pl
from pathloom.draw.evolution import (
    convergence_figure,
    crossings,
    diversity_figure,
    heat_figure,
    probabilities_figure,
)
from pathloom.draw.evolution.lines import band
from pathloom.draw.study import Sheet


@pytest.fixture(scope="module")
def problem():
    return pl.PathProblem(pl.load_map("iga-map1"), corners="allow")


@pytest.fixture(scope="module")
def planner():
    return pl.compose("iga", population=20, termination=[{"use": "max-generations", "limit": 6}])


@pytest.fixture(scope="module")
def states(problem, planner):
    return list(pl.iterate(problem, planner, seed=1))


def lines(figure):
    return [np.asarray(line.get_ydata()) for line in figure.axes[0].get_lines()]


def test_the_heat_of_a_cell_is_the_share_of_paths_that_cross_its_interior() -> None:
    straight, diagonal = np.array([(0, 0), (0, 2)]), np.array([(0, 0), (2, 2), (0, 2)])
    expected = [[1.0, 0.5, 1.0], [0.0, 0.5, 0.5], [0.0, 0.0, 0.5]]
    np.testing.assert_array_equal(crossings([straight, diagonal], (3, 3)), expected)
    assert not crossings([], (3, 3)).any()


@pytest.mark.parametrize("dark", [False, True])
def test_the_heat_map_shows_the_population_of_its_state(states, problem, dark) -> None:
    figure = heat_figure(states[-1], sheet=Sheet(dark=dark))
    _, heat = figure.axes[0].get_images()
    decode = problem.representation.decode
    shares = crossings([decode(row) for row in states[-1].population], problem.grid.shape)
    np.testing.assert_array_equal(heat.get_array().filled(0.0), shares)
    assert shares[problem.ends[0]] == shares[problem.ends[1]] == 1.0


def test_probabilities_are_those_that_the_operators_give_for_each_state(states, planner) -> None:
    crossover, mutation = lines(probabilities_figure(planner, states))
    for state, crossed, mutated in zip(states, crossover, mutation, strict=True):
        progress = planner.progress(state)
        assert crossed == np.median(planner.crossover.rates(state.fitness, progress))
        assert mutated == np.median(planner.mutation.rates(state.fitness, progress))
    assert len(np.unique(crossover)) > 1  # the paper's are adaptive


def test_a_band_spans_most_runs_and_a_run_that_ended_stands_where_it_was() -> None:
    curve = band([[0.0, 1.0, 2.0], [1.0], [2.0, 3.0]])
    np.testing.assert_array_equal(curve.y, [1.0, 1.0, 2.0])
    np.testing.assert_allclose(curve.low, [0.2, 1.0, 1.2])
    np.testing.assert_allclose(curve.high, [1.8, 2.6, 2.8])


def test_convergence_and_diversity_take_histories_of_states_and_of_results(states, problem, planner) -> None:
    result = pl.plan(problem, planner, seed=1)
    for draw, column in ((convergence_figure, "best"), (diversity_figure, "diversity")):
        of_states, of_results = draw({"a": [states[-1].history]}), draw({"a": [result.history]})
        np.testing.assert_array_equal(lines(of_states), lines(of_results))
        np.testing.assert_array_equal(lines(of_states)[0], result.history[column])


def test_what_cannot_be_drawn_is_said_in_one_line(states, planner) -> None:
    dijkstra = pl.compose("dijkstra")
    for message, draw in (
        ("neither crossover nor mutation", lambda: probabilities_figure(dijkstra, states)),
        ("found no states", lambda: probabilities_figure(planner, [])),
        ("found no runs", lambda: convergence_figure({})),
        ("a: found a run without 'best'", lambda: convergence_figure({"a": [{"best": []}]})),
        ("a: found a run without 'diversity'", lambda: diversity_figure({"a": [{}]})),
    ):
        with pytest.raises(pl.PathloomError, match=message) as error:
            draw()
        assert "\n" not in str(error.value)


def test_a_figure_as_wide_as_a_column_holds_all_of_its_text(states, planner) -> None:
    for figure in (
        heat_figure(states[0], sheet=Sheet(title="heat")),
        probabilities_figure(planner, states, sheet=Sheet(title="probabilities")),
    ):
        around, (width, height) = figure.get_tightbbox(), figure.get_size_inches()
        assert width == 3.5
        assert min(around.x0, around.y0) >= 0
        assert around.x1 <= width
        assert around.y1 <= height
