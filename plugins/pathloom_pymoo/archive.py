"""Archive: the trade-offs of all generations, and the one among them that weights prefer."""

import numpy as np
from numpy.typing import NDArray

from pathloom import Floats, Indices, Population, Representation
from pathloom.kernel.front import Front


def merged(front: Front, population: Population, values: Floats, representation: Representation) -> tuple[Front, bool]:
    """Return the front of what was kept and some more individuals, and whether that is a new one.

    Of individuals with the same values the one that came first is kept.
    """
    import moocore

    news = moocore.is_nondominated(values)  # first among themselves: most of them fall out here
    if len(front):
        news &= _not_beaten(values, front.values)
    if not news.any():
        return front, False
    more = news.nonzero()[0]
    everything = np.concatenate((front.values, values[more]))
    kept = moocore.is_nondominated(everything).nonzero()[0]
    kept = kept[np.lexsort(everything[kept].T[::-1])]
    rows = representation.stack(front.population, population.take(more, 0)) if len(front) else population.take(more, 0)
    return Front(rows.take(kept, 0), everything.take(kept, 0)), True


def _not_beaten(values: Floats, kept: Floats) -> NDArray[np.bool_]:
    """Return for each row of values (n, m) whether none of the kept ones (k, m) is at least as good everywhere."""
    as_good = np.asarray((kept <= values[:, np.newaxis]).all(axis=2))
    return np.asarray(~as_good.any(axis=1))


def compromise(values: Floats, weights: Floats) -> int:
    """Return the row of a front (n, m) with the least weighted sum, each objective scaled to [0, 1] over the front.

    The first of several.
    """
    low, high = values.min(axis=0), values.max(axis=0)
    span = np.where(high > low, high - low, 1.0)
    return int(np.argmin(((values - low) / span) @ weights))


def new_values(values: Floats, known: Floats) -> Indices:
    """Return the first row of each different values (n, m) that nobody has among the known ones (k, m)."""
    everything = np.concatenate((known, values))
    _, first = np.unique(everything, axis=0, return_index=True)
    return np.sort(first[first >= len(known)]) - len(known)
