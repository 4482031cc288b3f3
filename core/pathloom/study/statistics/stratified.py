"""Van Elteren's test: two variants by their runs on a few instances, each instance for itself.

Too few instances can show nothing about instances in general, but many runs can
about these. Of values that are only 0 and 1 it is the test of Cochran, Mantel and Haenszel.

Source: P. H. van Elteren (1960), Bull. Int. Stat. Inst. 37, 351: the locally best weights, 1 / (N + 1).
"""

import numpy as np
from scipy import stats

from pathloom.kernel.evaluation import Floats


def stratified_rank_sum(one: Floats, other: Floats) -> float:
    """Return the two-sided p of runs of costs (instances, runs), nan in places to be left out; 1 if all are equal."""
    beyond, spread = 0.0, 0.0
    for here, there in zip(one, other, strict=True):
        x, y = here[~np.isnan(here)], there[~np.isnan(there)]
        n, m = len(x), len(y)
        if not (n and m):
            continue
        ranks = stats.rankdata(np.concatenate((x, y)))
        beyond += (ranks[:n].sum() - n * (n + m + 1) / 2.0) / (n + m + 1)
        spread += n * m * ranks.var(ddof=1) / (n + m) / (n + m + 1) ** 2  # ties included
    return float(2.0 * stats.norm.sf(abs(beyond) / np.sqrt(spread))) if spread > 0.0 else 1.0


def weight(one: Floats, other: Floats) -> float:
    """Return how much the runs of all instances weigh together, each pair of samples n m / (N + 1)."""
    n, m = (~np.isnan(one)).sum(axis=1), (~np.isnan(other)).sum(axis=1)
    return float((n * m / (n + m + 1)).sum())
