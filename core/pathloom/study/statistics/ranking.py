"""Who stands where over all instances, and who cannot be told apart.

Source: J. Demšar (2006), J. Mach. Learn. Res. 7, 1, section 3.2.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from pathloom.kernel.evaluation import Floats


@dataclass(frozen=True)
class Ranking:
    """Variants by their average rank."""

    ranks: dict[str, float]
    """From the best on; 1 is best."""
    instances: int
    critical: float
    """Nemenyi's critical difference of two average ranks."""
    groups: tuple[tuple[str, ...], ...]
    """Neighbours in rank that lie within the critical difference, largest groups, two members at least."""
    holm_groups: tuple[tuple[str, ...], ...] = ()
    """The same by pairwise tests with Holm's correction: no two of a group differ."""


def average_ranks(costs: Floats) -> Floats:
    """Return the average rank of each column of costs (instances, variants); 1 costs least, ties share."""
    return np.asarray(stats.rankdata(costs, axis=1).mean(axis=0))


def friedman(costs: Floats) -> float:
    """Return p of Friedman's test of costs (instances, k ≥ 3); 1 if all variants are equal on every instance."""
    if len(costs) < 2 or (costs == costs[:, :1]).all():
        return 1.0
    return float(stats.friedmanchisquare(*costs.T).pvalue)


def critical_difference(variants: int, instances: int, alpha: float = 0.05) -> float:
    """Return Nemenyi's critical difference, from the studentized range of so many variants."""
    q = stats.studentized_range.ppf(1.0 - alpha, variants, np.inf) / np.sqrt(2.0)
    return float(q * np.sqrt(variants * (variants + 1) / (6.0 * instances)))


def rank(names: Sequence[str], costs: Floats, alpha: float = 0.05) -> Ranking:
    """Rank variants by their costs (instances, variants); infinite ones rank worst."""
    means = average_ranks(costs)
    order = np.argsort(means, kind="stable")
    ranks = {names[i]: float(means[i]) for i in order}
    critical = critical_difference(len(names), len(costs), alpha)
    close = {(a, b): abs(ranks[a] - ranks[b]) < critical for a in ranks for b in ranks}
    return Ranking(ranks, len(costs), critical, runs_of(list(ranks), close))


def runs_of(ordered: Sequence[str], alike: Mapping[tuple[str, str], bool]) -> tuple[tuple[str, ...], ...]:
    """Return the largest runs of neighbours of which any two are alike; runs of one are left out."""
    found: list[tuple[int, int]] = []
    for start in range(len(ordered)):
        end = start + 1
        while end < len(ordered) and all(alike[ordered[i], ordered[end]] for i in range(start, end)):
            end += 1
        if end - start > 1 and not any(end <= last for _, last in found):
            found.append((start, end))
    return tuple(tuple(ordered[start:end]) for start, end in found)
