"""Variants against each other in one metric.

Inference is per instance: the runs of a variant on one map are one observation,
their median (of a yes or no: their mean). Over several instances, two
variants are compared by Wilcoxon's signed rank test of these, more by Friedman's
test and then pair by pair with Holm's correction. Fewer instances than could ever
show anything so are taken as they are: runs are compared within each, by van
Elteren's stratified rank sum test. On a single instance there is nothing to pair,
since equal seeds do not make equal luck: runs are compared by the rank sum test
(success by Fisher's exact test), and Kruskal's and Wallis' for more than two.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from pathloom.kernel.evaluation import Floats
from pathloom.study.statistics.detectable import (
    detectable_a12,
    detectable_difference,
    detectable_rate,
    detectable_shift,
)
from pathloom.study.statistics.effects import Bootstrap, Estimate, a12_by_instance, differences
from pathloom.study.statistics.metrics import Metric
from pathloom.study.statistics.multiple import holm
from pathloom.study.statistics.ranking import Ranking, friedman, rank, runs_of
from pathloom.study.statistics.signed_rank import least_p, signed_rank
from pathloom.study.statistics.stratified import stratified_rank_sum, weight

Test = Literal["signed rank", "stratified rank sum", "rank sum", "Fisher", "none"]


@dataclass(frozen=True)
class Pair:
    """One variant against another."""

    one: str
    other: str
    test: Test
    """``none``: nothing to compare."""
    instances: int
    """On which both have values."""
    p: float
    adjusted: float
    """p after Holm's correction within the metric."""
    difference: Estimate
    """By how much one's value is more than the other's: median over the instances; on one, of the medians over runs."""
    a12: Estimate
    """Chance that a run of one is better than a run of the other, ties counting half; mean over the instances."""
    wins: int
    """Instances on which one is better than the other."""
    ties: int
    detectable: float | None
    """Smallest difference that would have been seen four times in five; None if none, or without any spread."""
    detectable_a12: float | None = None
    """The same as an A12, where runs are compared."""


@dataclass(frozen=True)
class Comparison:
    """All variants in one metric."""

    metric: Metric
    instances: int
    """On which all variants have values."""
    omnibus: Literal["Friedman", "Kruskal-Wallis"] | None
    """The test whether any differ; None with two variants, or too few instances that all know."""
    p: float | None
    pairs: tuple[Pair, ...]
    ranking: Ranking | None
    """On two instances and more."""


@dataclass(frozen=True)
class Settings:
    """How to compare."""

    alpha: float = 0.05
    confidence: float = 0.95
    resamples: int = 1000
    """Of each bootstrap."""
    seed: int = 0
    baseline: str | None = None
    """Compare every other variant with this one only; else all pairs."""


def compare(names: Sequence[str], costs: Floats, metric: Metric, settings: Settings) -> Comparison:
    """Compare variants by their costs (variants, instances, runs): inf for failures, nan where there is no value."""
    centres = _centres(costs, metric)
    complete = ~np.isnan(centres).any(axis=0)
    few = centres[:, complete].T
    instances = int(complete.sum())
    single = int((~np.isnan(centres)).any(axis=0).sum()) == 1
    asked = _asked(names, settings.baseline)
    enough = least_p(instances) < settings.alpha / len(asked)
    found = []
    for i, j in asked:
        rng = np.random.default_rng([settings.seed, i, j, *metric.name.encode()])
        bootstrap = Bootstrap(rng, settings.confidence, settings.resamples)
        two = _Two((names[i], names[j]), costs[[i, j]], centres[[i, j]], metric, bootstrap)
        # What could have been seen is told for Holm's first step, the hardest.
        found.append(two.compared(settings.alpha / len(asked), single=single, enough=enough))
    adjusted = holm([pair.p for pair in found]).tolist()
    pairs = tuple(replace(pair, adjusted=p) for pair, p in zip(found, adjusted, strict=True))
    ranking = rank(names, few, settings.alpha) if instances > 1 else None
    if ranking is not None and settings.baseline is None:
        apart = {frozenset((pair.one, pair.other)) for pair in pairs if pair.adjusted < settings.alpha}
        alike = {(a, b): frozenset((a, b)) not in apart for a in names for b in names}
        ranking = replace(ranking, holm_groups=runs_of(list(ranking.ranks), alike))
    omnibus: Literal["Friedman", "Kruskal-Wallis"] | None = None
    p: float | None = None
    if len(names) > 2 and instances > 1 and enough:
        omnibus, p = "Friedman", friedman(few)
    elif len(names) > 2 and instances == 1:
        omnibus, p = "Kruskal-Wallis", _kruskal(costs[:, int(np.flatnonzero(complete)[0])])
    return Comparison(metric, instances, omnibus, p, pairs, ranking)


@dataclass(frozen=True)
class _Two:
    """Two variants that are compared."""

    names: tuple[str, str]
    costs: Floats
    """(2, instances, runs)"""
    centres: Floats
    """(2, instances), nan where there is none."""
    metric: Metric
    bootstrap: Bootstrap

    def compared(self, level: float, *, single: bool, enough: bool) -> Pair:
        """Test and estimate: over instances where they are enough, else over the runs of several or of a single one."""
        both = np.asarray(~np.isnan(self.centres).any(axis=0))
        one, other = self.centres[:, both]
        nothing = Estimate(None, None, None)
        blank = Pair(
            *self.names, test="none", instances=len(one), p=1.0, adjusted=1.0, difference=nothing, a12=nothing,
            wins=int((one < other).sum()), ties=int((one == other).sum()), detectable=None,
        )  # fmt: skip
        if not both.any():
            return blank
        if not single:
            return self._over_instances(blank, both, level) if enough else self._within_instances(blank, both, level)
        x, y = (runs[~np.isnan(runs)] for runs in self.costs[:, int(np.flatnonzero(both)[0])])
        return self._over_runs(blank, x, y, level)

    def _over_instances(self, blank: Pair, both: NDArray[np.bool_], level: float) -> Pair:
        one, other = self.centres[:, both]
        apart = differences(one, other)
        chances = a12_by_instance(self.costs[0][both], self.costs[1][both])
        return replace(
            blank,
            test="signed rank",
            p=signed_rank(apart).p,
            difference=_valued(self.bootstrap.median_difference(one, other, paired=True), self.metric),
            a12=self.bootstrap.mean(chances),
            detectable=detectable_shift(apart, level, self.bootstrap.rng),
        )

    def _within_instances(self, blank: Pair, both: NDArray[np.bool_], level: float) -> Pair:
        one, other = self.costs[0][both], self.costs[1][both]
        rate = None
        if self.metric.yes_or_no:
            n, m = (int((~np.isnan(runs)).sum()) for runs in (one, other))
            rate = detectable_rate(int((one < 0.0).sum() + (other < 0.0).sum()), n, m, level)
        apart = replace(self.bootstrap, resamples=0).median_difference(*self.centres[:, both], paired=True)
        return replace(
            blank,
            test="stratified rank sum",
            p=stratified_rank_sum(one, other),
            difference=_valued(apart, self.metric),
            a12=Estimate(float(a12_by_instance(one, other).mean()), None, None),
            detectable=rate,
            detectable_a12=None if rate is not None else detectable_a12(weight(one, other), level),
        )

    def _over_runs(self, blank: Pair, x: Floats, y: Floats, level: float) -> Pair:
        effect = self.bootstrap.a12(x, y)
        if self.metric.yes_or_no:
            table = np.array([[(runs < 0.0).sum(), (runs == 0.0).sum()] for runs in (x, y)])
            p = float(stats.fisher_exact(table).pvalue)
            apart = Estimate(float(y.mean() - x.mean()), None, None)
            seen = detectable_rate(int(table[:, 0].sum()), len(x), len(y), level)
            return replace(blank, test="Fisher", p=p, difference=apart, a12=effect, detectable=seen)
        return replace(
            blank,
            test="rank sum",
            p=rank_sum(x, y),
            difference=_valued(self.bootstrap.median_difference(x, y, paired=False), self.metric),
            a12=effect,
            detectable=detectable_difference(x, y, level, self.bootstrap.rng),
            detectable_a12=detectable_a12(len(x) * len(y) / (len(x) + len(y) + 1), level),
        )


def rank_sum(one: Floats, other: Floats) -> float:
    """Return the two-sided p of the rank sum test; 1 if all costs are equal."""
    if np.unique(np.concatenate((one, other))).size == 1:
        return 1.0
    return float(stats.mannwhitneyu(one, other, alternative="two-sided").pvalue)


def _kruskal(costs: Floats) -> float:
    samples = [runs[~np.isnan(runs)] for runs in costs]
    if np.unique(np.concatenate(samples)).size == 1:
        return 1.0
    return float(stats.kruskal(*samples).pvalue)


def _asked(names: Sequence[str], baseline: str | None) -> list[tuple[int, int]]:
    if baseline is None:
        return list(combinations(range(len(names)), 2))
    base = list(names).index(baseline)
    return [(i, base) for i in range(len(names)) if i != base]


def _centres(costs: Floats, metric: Metric) -> Floats:
    """Return one cost for each variant and instance: the median over runs, of the success rate the mean."""
    known = ~np.isnan(costs)
    counts = known.sum(axis=2)
    if metric.yes_or_no:
        return np.where(counts > 0, np.where(known, costs, 0.0).sum(axis=2) / np.maximum(counts, 1), np.nan)
    ordered = np.sort(costs, axis=2)  # nan goes last, and stands first where there is nothing else
    lower, upper = np.maximum(counts - 1, 0) // 2, np.minimum(counts // 2, costs.shape[2] - 1)
    low, high = (np.take_along_axis(ordered, at[:, :, np.newaxis], axis=2)[:, :, 0] for at in (lower, upper))
    return np.asarray((low + high) / 2.0)


def _valued(estimate: Estimate, metric: Metric) -> Estimate:
    """Return an estimate of costs as one of values."""
    if metric.sign > 0:
        return estimate
    value, low, high = (None if v is None else -v + 0.0 for v in (estimate.value, estimate.low, estimate.high))
    return Estimate(value, high, low)
