"""Statistics of studies against scipy, printed values, other packages, and values from the definition."""

from itertools import pairwise, product

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from pathloom.study.statistics import effects
from pathloom.study.statistics.curves import band, common_grid, ecdf, first_reached, performance_profile
from pathloom.study.statistics.describing import Rate, spreads
from pathloom.study.statistics.effects import Bootstrap, a12, a12_by_instance, size_of
from pathloom.study.statistics.metrics import METRICS
from pathloom.study.statistics.multiple import holm
from pathloom.study.statistics.ranking import average_ranks, critical_difference, friedman, rank, runs_of
from pathloom.study.statistics.signed_rank import least_p, signed_rank
from pathloom.study.statistics.stratified import stratified_rank_sum

SCORES = np.array(
    [
        [0.763, 0.768, 0.771, 0.798], [0.599, 0.591, 0.590, 0.569], [0.954, 0.971, 0.968, 0.967],
        [0.628, 0.661, 0.654, 0.657], [0.882, 0.888, 0.886, 0.898], [0.936, 0.931, 0.916, 0.931],
        [0.661, 0.668, 0.609, 0.685], [0.583, 0.583, 0.563, 0.625], [0.775, 0.838, 0.866, 0.875],
        [1.000, 1.000, 1.000, 1.000], [0.940, 0.962, 0.965, 0.962], [0.619, 0.666, 0.614, 0.669],
        [0.972, 0.981, 0.975, 0.975], [0.957, 0.978, 0.946, 0.970],
    ]
)  # fmt: skip
"""Scores of four methods on 14 problems, with ties; more is better."""
NAMES = ("plain", "m", "cf", "m+cf")
LITTLE = st.sampled_from([-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 3.0])


def bootstrap(seed: int = 0, **how: float) -> Bootstrap:
    return Bootstrap(np.random.default_rng(seed), **how)


# Rates and spreads.


def test_the_wilson_interval_is_that_of_the_formula():
    z, k, n = stats.norm.ppf(0.975), 7, 30
    centre, half = (k + z * z / 2) / (n + z * z), z / (n + z * z) * np.sqrt(k * (n - k) / n + z * z / 4)
    found = Rate.of(k, n)
    assert (found.low, found.high) == pytest.approx((centre - half, centre + half))
    assert Rate.of(30, 30).low == pytest.approx(30 / (30 + z * z))
    assert Rate.of(0, 0) == Rate(0, 0, 0.0, 1.0)
    assert Rate.of(0, 0).share is None


@naive.examples(60)
@given(st.lists(st.one_of(LITTLE, st.just(np.inf), st.just(np.nan)), min_size=1, max_size=9))
def test_spreads_are_quantiles_of_the_known_and_count_the_missing(costs):
    (found,) = spreads(np.array([costs]), METRICS["length"])
    known = [c for c in costs if np.isfinite(c)]
    assert (found.known, found.missing) == (len(known), costs.count(np.inf))
    if known:
        five = (found.best, found.lower, found.median, found.upper, found.worst)
        assert five == pytest.approx(np.quantile(known, (0, 0.25, 0.5, 0.75, 1)))
    else:
        assert found.median is None
    everyone = sorted(c for c in costs if not np.isnan(c))
    middle = [everyone[(len(everyone) - 1) // 2], everyone[len(everyone) // 2]] if everyone else [np.inf]
    expected = np.mean(middle)
    assert found.median_of_all == (pytest.approx(expected) if np.isfinite(expected) else None)


def test_the_best_of_what_is_to_be_large_is_the_largest():
    (found,) = spreads(-np.array([[0.1, 0.3, 0.2]]), METRICS["fitness"])
    assert (found.best, found.median, found.worst) == pytest.approx((0.3, 0.2, 0.1))


# Tests.


@naive.examples(80)
@given(st.lists(LITTLE, min_size=1, max_size=9))
def test_the_signed_rank_test_goes_through_all_signs(differences):
    found = np.array(differences)
    ranks = stats.rankdata(np.abs(found))[found != 0]
    sums = [sum(r for r, s in zip(ranks, signs, strict=True) if s) for signs in product((0, 1), repeat=len(ranks))]
    seen = stats.rankdata(np.abs(found))[found > 0].sum()
    below, above = np.mean(np.array(sums) <= seen + 1e-9), np.mean(np.array(sums) >= seen - 1e-9)
    assert signed_rank(found).p == pytest.approx(min(1.0, 2 * min(below, above)))


def test_the_signed_rank_test_is_scipys_where_there_are_no_ties():
    rng = np.random.default_rng(3)
    for n in (5, 11, 30, 50):
        found = rng.normal(0.3, 1.0, n)
        assert signed_rank(found).p == pytest.approx(stats.wilcoxon(found, method="exact").pvalue)


def test_the_signed_rank_test_of_many_differences_is_scipys_normal_one():
    found = np.random.default_rng(4).normal(0.1, 1.0, 500).round(1)
    assert not signed_rank(found).exact
    assert signed_rank(found).p == pytest.approx(stats.wilcoxon(found, zero_method="pratt").pvalue)


def test_exact_and_normal_distribution_agree_where_they_meet():
    found = np.random.default_rng(5).normal(0.1, 1.0, 200).round(1)
    assert signed_rank(found).exact
    assert signed_rank(found).p == pytest.approx(stats.wilcoxon(found, zero_method="pratt").pvalue, rel=0.02)


def test_infinite_differences_rank_beyond_all_others():
    assert signed_rank([1.0, -2.0, np.inf, np.inf]).p == signed_rank([1.0, -2.0, 9.0, 9.0]).p
    assert signed_rank(np.append(np.ones(300), np.inf)).p < 1e-50


def test_all_zero_differences_show_nothing():
    assert signed_rank(np.zeros(9)).p == 1.0
    assert least_p(5) == 0.0625


def test_holm_is_that_of_statsmodels():
    found = holm([0.01, 0.04, 0.03, 0.005, 0.5, 0.04])
    assert found == pytest.approx([0.05, 0.12, 0.12, 0.03, 0.5, 0.12])
    assert holm([]).shape == (0,)


def test_the_stratified_test_of_zeros_and_ones_is_that_of_cochran_mantel_and_haenszel():
    tables = [((8, 2), (5, 5)), ((9, 6), (4, 11)), ((3, 4), (2, 6))]  # p of statsmodels' StratifiedTable
    one, other = np.full((3, 15), np.nan), np.full((3, 15), np.nan)
    for row, (first, second) in enumerate(tables):
        for runs, (yes, no) in ((one, first), (other, second)):
            runs[row, : yes + no] = [1.0] * yes + [0.0] * no
    # CMH weighs by n m / N and N - 1, van Elteren by 1 / (N + 1): equal where all strata are of one size.
    same = np.array([[1.0] * 8 + [0.0] * 2, [1.0] * 3 + [0.0] * 7]), np.array([[1.0] * 5 + [0.0] * 5, [0.0] * 10])
    a, n, m = (same[0].sum(axis=1), 10, 10)
    total = a + same[1].sum(axis=1)
    statistic = (a - total / 2).sum() ** 2 / (total * (20 - total) * n * m / (20**2 * 19)).sum()
    assert stratified_rank_sum(*same) == pytest.approx(stats.chi2.sf(statistic, 1))
    assert stratified_rank_sum(one, other) == pytest.approx(0.019499737, rel=0.1)


def test_the_stratified_test_of_one_instance_is_the_rank_sum_test():
    rng = np.random.default_rng(6)
    x, y = rng.normal(0, 1, 20).round(1), rng.normal(0.5, 1, 25).round(1)
    expected = stats.mannwhitneyu(x, y, method="asymptotic", use_continuity=False).pvalue
    assert stratified_rank_sum(x[np.newaxis], y[np.newaxis]) == pytest.approx(expected)


# Effects.


@naive.examples(60)
@given(st.lists(st.one_of(LITTLE, st.just(np.inf)), min_size=1, max_size=7),
       st.lists(st.one_of(LITTLE, st.just(np.inf)), min_size=1, max_size=7))  # fmt: skip
def test_a12_counts_the_pairs_that_are_won(one, other):
    won = [1.0 if x < y else 0.5 if x == y else 0.0 for x in one for y in other]
    assert float(a12(one, other)) == pytest.approx(np.mean(won))
    wide = np.full((1, 8), np.nan), np.full((1, 8), np.nan)
    wide[0][0, : len(one)], wide[1][0, : len(other)] = one, other
    assert a12_by_instance(*wide)[0] == pytest.approx(np.mean(won))


def test_a12_is_mann_and_whitneys_count_of_pairs():
    rng = np.random.default_rng(7)
    x, y = rng.normal(size=30), rng.normal(size=40)
    assert float(a12(x, y)) == pytest.approx(stats.mannwhitneyu(y, x).statistic / 1200)


def test_the_interval_of_very_many_runs_is_that_of_the_bootstrap():
    rng = np.random.default_rng(9)
    x, y = rng.normal(0.0, 1.0, 1200).round(1), rng.normal(0.2, 1.0, 1500).round(1)
    drawn, normal = bootstrap()._estimate(effects._a12, x, y), bootstrap().a12(x, y)
    assert normal.value == pytest.approx(drawn.value)
    assert (normal.low, normal.high) == pytest.approx((drawn.low, drawn.high), abs=0.003)


def test_words_for_effects_are_those_of_vargha_and_delaney():
    assert [size_of(e) for e in (0.5, 0.56, 0.64, 0.71, 0.29)] == ["negligible", "small", "medium", "large", "large"]


def test_bootstrap_intervals_are_the_same_for_the_same_seed():
    x, y = np.random.default_rng(1).normal(size=(2, 20))
    assert bootstrap().a12(x, y) == bootstrap().a12(x, y)
    assert bootstrap().a12(x, y) != bootstrap(1).a12(x, y)


def test_bootstrap_intervals_cover_what_they_estimate():
    rng = np.random.default_rng(8)
    covered = 0
    for number in range(200):
        found = bootstrap(number, resamples=300).mean(rng.normal(1.0, 2.0, 40))
        covered += found.low <= 1.0 <= found.high
    assert stats.binomtest(covered, 200, 0.95).pvalue > 1e-4  # percentiles of 40 cover a little less than 95 %


def test_median_differences_are_medians_of_differences_or_differences_of_medians():
    x, y = np.array([1.0, 5.0, 9.0]), np.array([1.5, 4.0, 2.0])
    assert bootstrap().median_difference(x, y, paired=True).value == pytest.approx(1.0)
    assert bootstrap().median_difference(x, y, paired=False).value == pytest.approx(3.0)


def test_a_median_among_failures_is_none():
    fails = np.array([np.inf, np.inf, 1.0])
    for paired in (True, False):
        assert bootstrap().median_difference(fails, np.ones(3), paired=paired).value is None
        assert bootstrap().median_difference(fails, fails, paired=True).value == 0.0
    some = bootstrap().median_difference(np.array([2.0, 2.0, 2.0, np.inf]), np.ones(4), paired=True)
    assert (some.value, some.low, some.high) == (1.0, 1.0, None)


# Ranks.


def test_average_ranks_count_who_is_better_and_half_of_who_is_equal():
    ranks = [[1 + sum(o > s for o in row) + (sum(o == s for o in row) - 1) / 2 for s in row] for row in SCORES]
    assert average_ranks(-SCORES) == pytest.approx(np.mean(ranks, axis=0))


def test_friedman_is_scipys_and_shows_nothing_where_all_are_equal():
    assert friedman(-SCORES) == pytest.approx(stats.friedmanchisquare(*SCORES.T).pvalue)
    assert friedman(np.ones((5, 3))) == 1.0


@pytest.mark.parametrize(("variants", "q"), [(2, 1.960), (3, 2.343), (4, 2.569), (5, 2.728), (10, 3.164)])
def test_critical_differences_are_those_of_nemenyis_table(variants, q):
    assert critical_difference(variants, 14) == pytest.approx(
        q * np.sqrt(variants * (variants + 1) / (6 * 14)), abs=1e-3
    )


def test_groups_are_those_that_scikit_posthocs_cannot_tell_apart():
    # Its Nemenyi p: plain and m 0.0887, plain and m+cf 0.0617, cf and m+cf 0.170, m and cf 0.227, others above 0.97.
    found = rank(NAMES, -SCORES, alpha=0.1)
    assert list(found.ranks) == ["m+cf", "m", "cf", "plain"]
    assert found.groups == (("m+cf", "m", "cf"), ("cf", "plain"))
    assert rank(NAMES, -SCORES, alpha=0.08).groups == (("m+cf", "m", "cf"), ("m", "cf", "plain"))
    assert rank(NAMES, -SCORES, alpha=0.05).groups == (("m+cf", "m", "cf", "plain"),)


def test_groups_hold_only_variants_of_which_no_two_differ():
    names = "abcd"
    differ = {("a", "c"), ("b", "d")}
    alike = {(x, y): (x, y) not in differ and (y, x) not in differ for x in names for y in names}
    assert runs_of(names, alike) == (("a", "b"), ("b", "c"), ("c", "d"))
    assert runs_of(names, dict.fromkeys(alike, True)) == (("a", "b", "c", "d"),)
    assert runs_of(names, dict.fromkeys(alike, False)) == ()


# Curves.


@naive.examples(60)
@given(st.lists(st.floats(0, 10), max_size=8), st.lists(st.floats(0, 10), min_size=1, max_size=4))
def test_targets_are_reached_by_the_first_answer_that_is_good_enough(values, targets):
    at = [10 * (k + 1) for k in range(len(values))]
    expected = [next((e for e, v in zip(at, values, strict=True) if v <= t), np.inf) for t in targets]
    assert first_reached(at, values, targets).tolist() == expected


def test_the_ecdf_rises_with_every_target_and_never_counts_those_that_are_missed():
    found = ecdf([[10, 20, np.inf], [10, 40, 50]])
    assert found.at.tolist() == [10, 20, 40, 50]
    assert found.shares == pytest.approx([2 / 6, 3 / 6, 4 / 6, 5 / 6])


def test_the_performance_profile_is_that_of_hand():
    costs = np.array([[1.0, 2.0], [3.0, 1.0], [np.inf, 5.0], [np.inf, np.inf]])
    found = performance_profile(("a", "b"), costs)
    assert found["a"].at.tolist() == [1.0, 3.0]
    assert found["a"].shares.tolist() == [0.25, 0.5]
    assert found["b"].at.tolist() == [1.0, 2.0]
    assert found["b"].shares.tolist() == [0.5, 0.75]


def test_bands_are_quantiles_of_the_best_so_far():
    runs = [([1, 5], [9.0, 4.0]), ([2, 3], [8.0, 10.0]), ([1, 4], [7.0, 1.0])]
    found = band(runs, [0.5, 1, 2, 4, 9], (0.0, 0.5, 1.0))
    assert np.isnan(found.median[0])
    assert np.isnan(found.high[1])
    assert found.median[1:].tolist() == [9.0, 8.0, 8.0, 4.0]
    assert found.low[1:].tolist() == [7.0, 7.0, 1.0, 1.0]
    assert found.high[2:].tolist() == [9.0, 9.0, 8.0]


def test_the_common_grid_spans_all_runs_and_rises():
    grid = common_grid([[3, 500], [7, 9000]])
    assert (grid[0], grid[-1]) == (3, 9000)
    assert all(a < b for a, b in pairwise(grid))
    assert common_grid([]).shape == (0,)
