"""Wilcoxon's signed rank test, exact with ties and with zeros.

scipy has its exact distribution without ties, or by going through all signs of
few differences. Ranks that are shared are halves, so that counting the ways in
which twice their sum comes about is as exact and takes n additions of arrays.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from pathloom.kernel.evaluation import Floats

EXACT = 200
"""Up to so many differences the distribution is counted; beyond, it is normal for every purpose."""


@dataclass(frozen=True)
class SignedRank:
    """The test of differences around zero."""

    n: int
    """Differences."""
    zeros: int
    """Of them zero: ranked with the others and then left out (J. W. Pratt 1959)."""
    statistic: float
    """Sum of the ranks of positive differences."""
    p: float
    """Two-sided; the probability given the ranks as they are."""
    exact: bool


def signed_rank(differences: ArrayLike) -> SignedRank:
    """Test whether differences (n,) lie around zero. Infinite ones rank beyond all others; nan is not allowed."""
    found = np.asarray(differences, np.float64)
    ranks = stats.rankdata(np.abs(found))
    other = found != 0.0
    zeros = int(len(found) - other.sum())
    positive = float(ranks[found > 0.0].sum())
    if not other.any():
        return SignedRank(len(found), zeros, 0.0, 1.0, exact=True)
    if len(found) <= EXACT:
        twice = np.rint(2.0 * ranks[other]).astype(np.int64)
        return SignedRank(len(found), zeros, positive, _exact(twice, round(2.0 * positive)), exact=True)
    p = float(stats.wilcoxon(np.nan_to_num(found, posinf=1e300, neginf=-1e300), zero_method="pratt").pvalue)
    return SignedRank(len(found), zeros, positive, p, exact=False)


def least_p(n: int) -> float:
    """Return the least p that n differences can give: all of one sign, none zero."""
    return min(1.0, 2.0 ** (1 - n))


def _exact(twice_ranks: "np.ndarray[tuple[int], np.dtype[np.int64]]", twice_sum: int) -> float:
    chances = sign_chances(twice_ranks)
    below, above = chances[: twice_sum + 1].sum(), chances[twice_sum:].sum()
    return float(min(1.0, 2.0 * min(below, above)))


def sign_chances(ranks: "np.ndarray[tuple[int], np.dtype[np.int64]]") -> Floats:
    """Return the chance of each sum of those whole ranks that a fair coin each picks."""
    chances = np.zeros(int(ranks.sum()) + 1)
    chances[0] = 1.0
    for rank in ranks.tolist():
        moved = np.zeros_like(chances)
        moved[rank:] = chances[: len(chances) - rank]
        chances = 0.5 * (chances + moved)
    return chances
