"""How large a difference is: A12 and the median difference, with bootstrap intervals.

Everything here takes costs: less is better, and a failure costs infinitely much.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from pathloom.kernel.evaluation import Floats

MANY = 2000
"""Runs beyond which A12 is as good as normally distributed."""
WORK = 4_000_000
"""Values that a bootstrap draws, roughly: so large samples are drawn less often, and a hundred times at least."""


@dataclass(frozen=True)
class Estimate:
    """A value with its interval; None where failures leave none."""

    value: float | None
    low: float | None
    high: float | None


def a12(one: ArrayLike, other: ArrayLike) -> Floats:
    """Return the chance that a run of one costs less than a run of the other, ties counting half.

    Source: A. Vargha, H. D. Delaney (2000), J. Educ. Behav. Stat. 25, 101, eq. (3).

    Parameters
    ----------
    one, other
        (..., n) and (..., m) costs; infinite ones are worse than any. No nan.
    """
    x, y = np.asarray(one, np.float64), np.asarray(other, np.float64)
    n, m = x.shape[-1], y.shape[-1]
    ranks = stats.rankdata(np.concatenate((y, x), axis=-1), axis=-1)
    won = ranks[..., :m].sum(axis=-1) - m * (m + 1) / 2.0  # pairs in which y ranks behind x
    return np.asarray(won / (n * m))


def a12_by_instance(one: Floats, other: Floats) -> Floats:
    """Return A12 on each instance of costs (instances, runs), with nan in places to be left out; nan where none are."""
    x, y = np.sort(one, axis=1), np.sort(other, axis=1)  # nan goes last
    n, m = (~np.isnan(x)).sum(axis=1), (~np.isnan(y)).sum(axis=1)
    found = np.full(len(x), np.nan)
    for size in {(a, b) for a, b in zip(n.tolist(), m.tolist(), strict=True) if a and b}:
        alike = (n == size[0]) & (m == size[1])
        found[alike] = a12(x[alike, : size[0]], y[alike, : size[1]])
    return found


def size_of(effect: float) -> str:
    """Return Vargha's and Delaney's word for an A12: from .56, .64 and .71 on small, medium and large."""
    beyond = max(effect, 1.0 - effect)
    return "large" if beyond >= 0.71 else "medium" if beyond >= 0.64 else "small" if beyond >= 0.56 else "negligible"


@dataclass(frozen=True)
class Bootstrap:
    """Intervals by percentiles over samples drawn again from the one that there is."""

    rng: np.random.Generator
    confidence: float = 0.95
    resamples: int = 1000

    def mean(self, values: Floats) -> Estimate:
        """Return the mean of values (n,)."""
        return self._estimate(_mean, values)

    def a12(self, one: Floats, other: Floats) -> Estimate:
        """Return A12 of the runs of one instance; of very many, its interval is normal."""
        return (
            self._estimate(_a12, one, other) if len(one) + len(other) <= MANY else _delong(one, other, self.confidence)
        )

    def median_difference(self, one: Floats, other: Floats, *, paired: bool) -> Estimate:
        """Return by how much one costs more than the other; an end of which failures leave nothing to say is None.

        Paired: the median of the differences. Else: the difference of the medians.
        """
        if paired:
            held, most = _held(differences(one, other))
            return _known(self._estimate(_median, held), most)
        held, most = _held(np.concatenate((one, other)))
        return _known(self._estimate(_between_medians, held[: len(one)], held[len(one) :]), 2.0 * most)

    def _estimate(self, statistic: Callable[..., Floats], *samples: Floats) -> Estimate:
        value = float(statistic(*samples))
        if min(map(len, samples)) < 2 or not self.resamples:
            return Estimate(value, None, None)
        if all((sample == sample[0]).all() for sample in samples):
            return Estimate(value, value, value)
        size = sum(map(len, samples))
        interval = stats.bootstrap(
            list(samples),
            statistic,
            n_resamples=min(self.resamples, max(100, WORK // size)),
            batch=max(1, WORK // size),
            vectorized=True,
            confidence_level=self.confidence,
            method="percentile",
            random_state=self.rng,
        ).confidence_interval
        return Estimate(value, float(interval.low), float(interval.high))


def differences(one: Floats, other: Floats) -> Floats:
    """Return differences of costs; two failures are equal."""
    with np.errstate(invalid="ignore"):
        return np.where(one == other, 0.0, one - other)


def _mean(sample: Floats, axis: int = -1) -> Floats:
    return np.asarray(sample.mean(axis=axis))


def _median(sample: Floats, axis: int = -1) -> Floats:
    return np.asarray(np.median(sample, axis=axis))


def _between_medians(one: Floats, other: Floats, axis: int = -1) -> Floats:
    return np.asarray(np.median(one, axis=axis) - np.median(other, axis=axis))


def _a12(one: Floats, other: Floats, axis: int = -1) -> Floats:
    return a12(np.moveaxis(one, axis, -1), np.moveaxis(other, axis, -1))


def _delong(one: Floats, other: Floats, confidence: float) -> Estimate:
    """Return A12 with a normal interval. Source: E. R. DeLong et al. (1988), Biometrics 44, 837."""
    every = np.concatenate((one, other))
    n, m = len(one), len(other)
    ranks = stats.rankdata(every)
    # For each run the share of the other sample that it wins against.
    wins = 1.0 - (ranks[:n] - stats.rankdata(one)) / m
    losses = (ranks[n:] - stats.rankdata(other)) / n
    value = float(wins.mean())
    half = float(stats.norm.ppf(0.5 + confidence / 2.0) * np.sqrt(wins.var(ddof=1) / n + losses.var(ddof=1) / m))
    return Estimate(value, max(0.0, value - half), min(1.0, value + half))


def _held(values: Floats) -> tuple[Floats, float]:
    """Return values with infinite ones so large that no mean with one can pass for a finite value, and the largest."""
    finite = np.abs(values[np.isfinite(values)])
    most = float(finite.max(initial=0.0))
    beyond = 8.0 * (most + 1.0)
    return np.nan_to_num(values, posinf=beyond, neginf=-beyond), most


def _known(estimate: Estimate, most: float) -> Estimate:
    """Return an estimate without the values that stand for infinity."""
    return Estimate(
        *(
            None if value is None or abs(value) > most * (1.0 + 1e-12) else value
            for value in (estimate.value, estimate.low, estimate.high)
        )
    )
