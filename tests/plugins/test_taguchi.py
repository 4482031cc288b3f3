"""Designed experiments: the arithmetic of AGACD's section 5.2.1, as printed and as least squares has it."""

from itertools import product

import numpy as np
import pytest

import pathloom as pl
from pathloom_agacd.experiment import CHOSEN, COEFFICIENTS, DESIGN, MEANS, TRIALS, planner_at
from pathloom_agacd.planner import Agacd
from pathloom_agacd.taguchi import aliases, correlations, level_means, main_effects


def test_the_rows_of_the_papers_table_have_the_printed_means():
    assert TRIALS.mean(axis=1) == pytest.approx(MEANS, abs=5.1e-5)
    assert TRIALS.mean() == pytest.approx(0.24416, abs=5e-6)


def test_the_printed_slopes_are_sums_over_all_nine_rows():
    printed = main_effects(DESIGN, TRIALS, "paper")
    assert printed.mean == pytest.approx(0.24416, abs=5e-6)
    assert printed.slopes == pytest.approx((0.006722, 0.008473, -0.008409, 0.005942, 0.016240), abs=1e-6)
    rounded = np.array(MEANS)[:, np.newaxis]
    assert main_effects(DESIGN, rounded, "paper").slopes == pytest.approx(COEFFICIENTS, abs=5e-6)


def test_the_printed_prediction_is_that_of_the_printed_slopes():
    printed = main_effects(DESIGN, TRIALS, "paper")
    assert tuple(printed.best) == CHOSEN
    assert printed.predict(CHOSEN) == pytest.approx(0.28995, abs=1e-5)
    assert max(printed.predict(corner) for corner in product((-1, 0, 1), repeat=5)) == printed.predict(CHOSEN)


def test_least_squares_takes_the_third_factors_slope_away_and_turns_the_choice():
    fitted = main_effects(DESIGN, TRIALS)
    assert fitted.mean == pytest.approx(0.244156, abs=1e-6)
    assert fitted.slopes == pytest.approx((0.010083, 0.012710, -0.000578, 0.008913, 0.024071), abs=1e-6)
    assert fitted.predict(CHOSEN) == pytest.approx(0.300511, abs=1e-6)


def test_where_factors_are_orthogonal_the_papers_slopes_are_two_thirds_of_least_squares():
    printed, fitted = main_effects(DESIGN, TRIALS, "paper"), main_effects(DESIGN, TRIALS)
    assert printed.slopes[[0, 1, 3]] == pytest.approx(fitted.slopes[[0, 1, 3]] * 6 / 9)
    assert printed.errors == pytest.approx(fitted.spread / np.sqrt(5) * np.sqrt(6) / 9)


def test_no_effect_of_the_papers_table_is_two_standard_errors():
    fitted = main_effects(DESIGN, TRIALS)
    assert fitted.spread == pytest.approx(0.0625, abs=5e-5)
    assert fitted.spread / np.sqrt(5) == pytest.approx(0.02795, abs=5e-6)
    assert fitted.errors == pytest.approx((0.011411, 0.011411, 0.013177, 0.011411, 0.013177), abs=1e-6)
    assert (np.abs(fitted.slopes) < 2 * fitted.errors).all()


def test_the_papers_fifth_factor_is_the_third_under_another_name():
    expected = np.eye(5)
    expected[2, 4] = expected[4, 2] = -0.5
    assert correlations(DESIGN) == pytest.approx(expected)
    assert aliases(DESIGN) == [(2, 4)]
    by_level = level_means(DESIGN, TRIALS)
    assert sorted(by_level[2]) == pytest.approx(sorted(by_level[4]))
    assert by_level[4] == pytest.approx((0.2195, 0.2447, 0.2682), abs=5e-5)


def test_the_first_factor_is_curved():
    assert level_means(DESIGN, TRIALS)[0] == pytest.approx((0.2281, 0.2561, 0.2483), abs=5.1e-5)


def test_least_squares_finds_the_slopes_that_the_trials_were_made_with():
    design = list(product((-1, 0, 1), repeat=3))
    truth = 2.0 + np.array(design) @ (0.5, -1.0, 0.0)
    fitted = main_effects(design, np.column_stack((truth - 0.1, truth + 0.1)))
    assert (fitted.mean, *fitted.slopes) == pytest.approx((2.0, 0.5, -1.0, 0.0))
    assert tuple(fitted.best)[:2] == (1, -1)
    assert fitted.predict((1, 1, 1)) == pytest.approx(1.5)


@pytest.mark.parametrize("divisor", ["ols", "paper"])
def test_standard_errors_are_the_spread_of_slopes_over_many_experiments(divisor):
    rng = np.random.default_rng(1)
    trials = rng.normal(1.0, 0.3, size=(2000, 9, 5))
    slopes = np.array([main_effects(DESIGN, tried, divisor).slopes for tried in trials])
    errors = np.mean([main_effects(DESIGN, tried, divisor).errors for tried in trials], axis=0)
    assert errors == pytest.approx(slopes.std(axis=0), rel=0.06)


def test_settings_tried_once_have_slopes_and_no_errors():
    fitted = main_effects(DESIGN, TRIALS[:, :1])
    assert np.isfinite(fitted.slopes).all()
    assert np.isnan(fitted.errors).all()


def test_factors_that_cannot_be_told_apart_are_refused():
    with pytest.raises(pl.ConfigError, match="do not tell the factors apart"):
        main_effects([[-1, -1], [0, 0], [1, 1]], np.ones((3, 2)))
    assert aliases([[-1, -1], [0, 0], [1, 1]]) == [(0, 1)]


def test_trials_that_do_not_go_with_the_design_are_refused():
    with pytest.raises(pl.ConfigError, match=r"\(9, 5\) does not go with trials of shape \(8, 5\)"):
        main_effects(DESIGN, TRIALS[:8])


def test_the_chosen_levels_are_the_planners_defaults():
    assert planner_at(CHOSEN) == Agacd()
    assert planner_at(DESIGN[0]).population == 40
