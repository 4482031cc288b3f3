"""Orthogonal arrays, what is mixed up in them, and main effects read off them."""

from itertools import combinations, product

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pathloom as pl
from pathloom.study.tuning.aliasing import interaction_aliases
from pathloom.study.tuning.arrays import ARRAYS, choose_array
from pathloom.study.tuning.effects import aliases, correlations, main_effects
from pathloom.study.tuning.levels import level_effects


@pytest.mark.parametrize("array", ARRAYS.values(), ids=ARRAYS)
def test_any_two_columns_have_every_combination_equally_often(array):
    for a, b in combinations(range(len(array.widths)), 2):
        pairs, counts = np.unique(array.levels[:, (a, b)], axis=0, return_counts=True)
        assert len(pairs) == array.widths[a] * array.widths[b]
        assert len(set(counts.tolist())) == 1


def test_arrays_have_the_sizes_of_their_names():
    assert {name: (len(array.levels), array.widths) for name, array in ARRAYS.items()} == {
        "L9": (9, (3,) * 4),
        "L18": (18, (2, *(3,) * 7)),
        "L27": (27, (3,) * 13),
    }


def test_l9_is_as_it_is_printed():
    printed = ["1111", "1222", "1333", "2123", "2231", "2312", "3132", "3213", "3321"]
    assert ["".join(str(level + 1) for level in row) for row in ARRAYS["L9"].levels] == printed


@pytest.mark.parametrize(
    ("counts", "name", "rows"),
    [
        ([3], "full", 3),
        ([2, 2, 2], "full", 8),
        ([3, 3], "full", 9),
        ([3, 3, 3], "L9", 9),
        ([3, 2, 3, 3], "L9", 9),
        ([3] * 5, "L18", 18),
        ([2] + [3] * 7, "L18", 18),
        ([3] * 8, "L27", 27),
        ([3] * 13, "L27", 27),
    ],
)
def test_the_smallest_array_that_fits_is_taken(counts, name, rows):
    found, levels = choose_array(counts)
    assert (found, levels.shape) == (name, (rows, len(counts)))
    assert [int(column.max()) + 1 for column in levels.T] == counts


@naive.examples(40)
@given(st.lists(st.sampled_from([2, 3]), min_size=1, max_size=8))
def test_factors_in_a_chosen_array_can_be_told_apart(counts):
    _, levels = choose_array(counts)
    if len(counts) > 1:
        assert not aliases(levels)
        assert np.abs(correlations(levels) - np.eye(len(counts))).max() < 1e-12
    level_effects(levels, np.zeros((len(levels), 2)))


@pytest.mark.parametrize(
    ("counts", "name", "message"),
    [
        ([4, 2], None, "found 4 levels, allowed 2 or 3"),
        ([1], None, "found 1 levels"),
        ([3] * 14, None, "14 factors .* do not fit: L27 has 13 columns"),
        ([3] * 5, "L9", "do not fit: L9 has 4 columns"),
        ([3], "L8", "none is called 'L8'"),
    ],
)
def test_what_does_not_fit_is_refused(counts, name, message):
    with pytest.raises(pl.ConfigError, match=message):
        choose_array(counts, name)


def test_all_combinations_take_any_number_of_levels():
    assert choose_array([4, 2], "full")[1].tolist() == [list(row) for row in product(range(4), range(2))]


# Aliasing.


def test_in_l9_every_main_effect_is_the_joint_effect_of_two_others():
    found = {(it.factor, it.pair): it.share for it in interaction_aliases(ARRAYS["L9"].levels)}
    assert len(found) == 4 * 3
    assert list(found.values()) == pytest.approx([1.0] * 12)


def test_in_all_combinations_nothing_is_mixed_up():
    assert not list(interaction_aliases(list(product(range(3), repeat=3))))


def test_in_l18_joint_effects_are_spread_over_columns_and_that_of_the_first_two_is_free():
    found = {(it.factor, it.pair): it.share for it in interaction_aliases(ARRAYS["L18"].levels)}
    assert not any(pair == (0, 1) for _, pair in found)  # what L18 is known for
    whole = {(factor, *pair) for (factor, pair), share in found.items() if share > 0.99}
    assert {tuple(sorted(it)) for it in whole} == {(1, 3, 4)}


def test_columns_that_are_mixed_up_are_taken_last():
    assert 4 not in ARRAYS["L18"].columns_for([3] * 6)
    assert max(it.share for it in interaction_aliases(choose_array([3] * 5)[1])) < 0.99
    assert not list(interaction_aliases(choose_array([3] * 4, "L27")[1]))


def test_in_l27_three_factors_leave_their_joint_effects_to_other_columns():
    levels = ARRAYS["L27"].levels
    assert not list(interaction_aliases(levels[:, (0, 1, 4)]))
    shares = {it.share for it in interaction_aliases(levels[:, (0, 1, 2)])}
    assert list(shares) == pytest.approx([1.0] * len(shares))


# Main effects of levels.


def test_level_effects_of_an_orthogonal_array_are_means_of_levels():
    rng = np.random.default_rng(1)
    design, trials = ARRAYS["L18"].levels, rng.normal(size=(18, 4))
    found = level_effects(design, trials)
    for column, means in zip(design.T, found.means, strict=True):
        assert means == pytest.approx([trials[column == level].mean() for level in np.unique(column)])
    assert found.mean == pytest.approx(trials.mean())


def test_level_effects_find_what_the_trials_were_made_with_in_unbalanced_columns_too():
    design = choose_array([3, 2, 3, 2])[1]
    truth = np.array([0.0, 2.0, 1.0])[design[:, 0]] + np.array([0.0, -1.0])[design[:, 1]] + 5.0
    found = level_effects(design, np.column_stack((truth - 0.1, truth + 0.1)))
    assert np.diff(found.means[0]) == pytest.approx([2.0, -1.0])
    assert np.diff(found.means[1]) == pytest.approx([-1.0])
    assert found.best().tolist()[:2] == [1, 0]
    assert found.best(least=True).tolist()[:2] == [0, 1]
    assert found.predict([1, 0, 0, 0])[0] == pytest.approx(7.0)


def test_a_best_level_in_the_middle_escapes_the_linear_model_only():
    design = np.array(list(product((-1, 0, 1), repeat=2)))
    trials = np.repeat((1.0 - design[:, :1] ** 2), 2, axis=1)
    assert level_effects(design, trials).best()[0] == 0
    assert main_effects(design, trials).slopes == pytest.approx([0.0, 0.0])


def test_standard_errors_of_levels_and_predictions_are_spreads_over_many_experiments():
    rng, design = np.random.default_rng(2), choose_array([3, 2, 3, 3])[1]
    found = [level_effects(design, rng.normal(1.0, 0.3, (9, 5))) for _ in range(1500)]
    for factor in range(4):
        spread = np.std([it.means[factor] for it in found], axis=0)
        assert np.mean([it.errors[factor] for it in found], axis=0) == pytest.approx(spread, rel=0.08)
    predicted = np.array([it.predict([2, 1, 0, 1]) for it in found])
    assert predicted[:, 1].mean() == pytest.approx(predicted[:, 0].std(), rel=0.08)
    # A factor that does nothing is called one that does as often as the level says.
    called = np.mean([it.p < 0.05 for it in found], axis=0)
    assert called == pytest.approx([0.05] * 4, abs=0.02)


def test_single_trials_have_effects_and_no_test():
    found = level_effects(ARRAYS["L9"].levels, np.arange(9.0)[:, np.newaxis])
    assert np.isfinite(np.concatenate(found.means)).all()
    assert np.isnan(found.p).all()


def test_settings_too_few_for_the_levels_are_refused():
    with pytest.raises(pl.ConfigError, match="do not tell the levels of 2 factors apart"):
        level_effects([[0, 0], [1, 1], [2, 2]], np.ones((3, 2)))
