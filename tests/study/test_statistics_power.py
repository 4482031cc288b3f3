"""Error rates by simulation: what is planted is found, what is not planted is not."""

import numpy as np
import pytest
from scipy import stats

from pathloom.study.statistics.comparing import Settings, compare
from pathloom.study.statistics.detectable import (
    detectable_a12,
    detectable_difference,
    detectable_rate,
    detectable_shift,
)
from pathloom.study.statistics.metrics import METRICS, SUCCESS
from pathloom.study.statistics.signed_rank import signed_rank

STUDIES = 200
LENGTH = METRICS["length"]
QUICK = Settings(resamples=0)


def planted(rng: np.random.Generator, shifts: tuple[float, ...], instances: int, runs: int = 5) -> np.ndarray:
    """Lengths of variants that differ by shifts, on instances that differ by far more, in whole steps with ties."""
    hard = rng.uniform(20, 60, instances)
    noise = rng.gamma(2.0, 1.0, (len(shifts), instances, runs))
    return hard[:, np.newaxis] + (noise + np.array(shifts)[:, np.newaxis, np.newaxis]).round(1)


@pytest.mark.parametrize(("instances", "runs"), [(12, 5), (3, 15), (1, 30)])
def test_a_null_is_shown_no_more_often_than_the_level(instances, runs):
    rng = np.random.default_rng(instances)
    shown = 0
    for _ in range(STUDIES):
        found = compare("ab", planted(rng, (0.0, 0.0), instances, runs), LENGTH, QUICK)
        shown += found.pairs[0].adjusted < 0.05
    assert stats.binomtest(shown, STUDIES, 0.05, alternative="greater").pvalue > 0.001
    assert shown > 0  # it is no test that never shows anything


def test_of_four_alike_any_difference_is_shown_no_more_often_than_the_level():
    rng = np.random.default_rng(1)
    any_pair = omnibus = 0
    for _ in range(STUDIES):
        found = compare("abcd", planted(rng, (0.0,) * 4, 12), LENGTH, QUICK)
        any_pair += min(pair.adjusted for pair in found.pairs) < 0.05
        omnibus += found.p < 0.05
    for shown in (any_pair, omnibus):
        assert stats.binomtest(shown, STUDIES, 0.05, alternative="greater").pvalue > 0.001


@pytest.mark.parametrize(("instances", "runs"), [(12, 5), (3, 15), (1, 30)])
def test_a_planted_effect_is_found_and_has_the_right_sign(instances, runs):
    rng = np.random.default_rng(2)
    shown = 0
    for _ in range(100):
        (pair,) = compare("ab", planted(rng, (0.0, 2.0), instances, runs), LENGTH, QUICK).pairs
        shown += pair.adjusted < 0.05 and pair.difference.value < 0 and pair.a12.value > 0.5
    assert shown >= 90


def test_a_planted_failure_rate_is_found_though_lengths_are_alike():
    rng = np.random.default_rng(3)
    found = np.where(rng.random((2, 15, 20)) < np.array([0.95, 0.6])[:, np.newaxis, np.newaxis], -1.0, 0.0)
    (pair,) = compare("ab", found, SUCCESS, QUICK).pairs
    assert pair.adjusted < 0.001
    assert pair.difference.value == pytest.approx(0.35, abs=0.1)


@pytest.mark.parametrize("n", [8, 20, 120])
@pytest.mark.parametrize("draw", ["normal", "laplace"])
def test_the_detectable_shift_is_seen_four_times_in_five(n, draw):
    rng = np.random.default_rng(n)
    seen, told = 0, [detectable_shift(getattr(rng, draw)(size=n), 0.05, rng) for _ in range(150)]
    shift = float(np.median(told))
    for _ in range(STUDIES):
        seen += signed_rank(getattr(rng, draw)(shift, 1.0, n)).p < 0.05
    least = 0.55 if n == 8 else 0.7  # so few values say little of how far tails reach
    assert least <= seen / STUDIES <= 0.9


@pytest.mark.parametrize("sizes", [(15, 15), (80, 60)])
def test_the_detectable_difference_of_two_samples_is_seen_four_times_in_five(sizes):
    n, m = sizes
    rng = np.random.default_rng(n)
    told = [detectable_difference(rng.normal(size=n), rng.normal(size=m), 0.05, rng) for _ in range(100)]
    shift, seen = float(np.median(told)), 0
    for _ in range(STUDIES):
        seen += stats.mannwhitneyu(rng.normal(shift, 1.0, n), rng.normal(size=m)).pvalue < 0.05
    assert 0.7 <= seen / STUDIES <= 0.9
    chance = stats.norm.cdf(shift / np.sqrt(2.0))  # A12 of two normal distributions that far apart
    assert detectable_a12(n * m / (n + m + 1), 0.05) == pytest.approx(chance, abs=0.04)


def test_the_detectable_rate_is_seen_four_times_in_five():
    rng = np.random.default_rng(4)
    apart = detectable_rate(140, 100, 100, 0.05)
    seen = 0
    for _ in range(STUDIES):
        a, b = rng.binomial(100, 0.7), rng.binomial(100, 0.7 + apart)
        seen += stats.fisher_exact(np.array([[a, 100 - a], [b, 100 - b]])).pvalue < 0.05
    assert 0.65 <= seen / STUDIES <= 0.9  # Fisher's test is a little cautious


def test_nothing_is_detectable_where_nothing_can_be_shown():
    rng = np.random.default_rng(5)
    assert detectable_shift(np.arange(5.0), 0.05, rng) is None
    assert detectable_shift(np.zeros(20), 0.05, rng) is None
    assert detectable_a12(0.5, 0.05) is None
    assert detectable_difference(np.array([1.0, 2.0]), np.array([1.0, 2.0]), 0.05, rng) is None
    assert detectable_rate(1, 1, 1, 0.05) is None
