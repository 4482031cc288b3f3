"""What the runs of one variant on one instance were like."""

from dataclasses import dataclass

import numpy as np
from scipy import stats

from pathloom.kernel.evaluation import Floats
from pathloom.study.statistics.metrics import Metric


@dataclass(frozen=True)
class Rate:
    """How many of so many runs found a path, and what that says of the rate: the Wilson interval."""

    found: int
    runs: int
    low: float
    high: float

    @property
    def share(self) -> float | None:
        """The share of the runs, or None of no runs."""
        return self.found / self.runs if self.runs else None

    @classmethod
    def of(cls, found: int, runs: int, confidence: float = 0.95) -> "Rate":
        """Return the rate with its interval. Source: E. B. Wilson (1927), J. Am. Stat. Assoc. 22, 209."""
        if runs == 0:
            return cls(0, 0, 0.0, 1.0)
        interval = stats.binomtest(found, runs).proportion_ci(confidence, method="wilson")
        return cls(found, runs, float(interval.low), float(interval.high))


@dataclass(frozen=True)
class Spread:
    """Values of the runs that have one; how many have none is said beside, and they count in the last median."""

    known: int
    """Runs with a value."""
    missing: int
    """Runs that failed, or missed the target."""
    best: float | None
    lower: float | None
    """A quarter of the known values is better."""
    median: float | None
    upper: float | None
    worst: float | None
    median_of_all: float | None
    """Median with the missing ones as worse than any; None where it falls among them."""


def spreads(costs: Floats, metric: Metric) -> list[Spread]:
    """Return the spread of each row of costs (n, runs), with inf for failures and nan for places to be left out."""
    finite = np.isfinite(costs)
    known, missing = finite.sum(axis=1), np.isposinf(costs).sum(axis=1)
    ordered = np.sort(np.where(finite, costs, np.inf), axis=1)
    five = [_quantile(ordered, known, share) * metric.sign for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
    everyone = _quantile(ordered, known + missing, 0.5) * metric.sign
    columns = [[float(v) if np.isfinite(v) else None for v in column] for column in (*five, everyone)]
    return [
        Spread(int(k), int(m), *values)
        for k, m, *values in zip(known.tolist(), missing.tolist(), *columns, strict=True)
    ]


def _quantile(ordered: Floats, counts: Floats, share: float) -> Floats:
    """Return a quantile of the first so many of each row, linear between two; nan of none."""
    place = np.maximum(share * (counts - 1), 0.0)
    below = np.floor(place).astype(np.intp)
    above = np.minimum(below + 1, np.maximum(counts.astype(np.intp) - 1, 0))
    low, high = (np.take_along_axis(ordered, at[:, np.newaxis], axis=1)[:, 0] for at in (below, above))
    with np.errstate(invalid="ignore"):
        between = low + (place - below) * (high - low)
    return np.where(counts == 0, np.nan, np.where(place == below, low, between))
