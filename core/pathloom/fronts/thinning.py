"""A few members that stand for a whole front."""

import numpy as np

from pathloom.fronts.choosing import normalised
from pathloom.fronts.result import ParetoResult


def thinned(result: ParetoResult, most: int) -> list[int]:
    """Return up to so many members, in order: knee, preferred, the best of each objective, then the farthest apart.

    Each next one is that farthest from those taken, in the normalised front.
    """
    n = len(result)
    if n <= most:
        return list(range(n))
    choice = result.choice
    first = [] if choice is None else [choice.preferred, choice.knee]
    taken = list(dict.fromkeys([i for i in first if i is not None] + result.values.argmin(axis=0).tolist()))[:most]
    scaled = normalised(result.values)
    apart = np.abs(scaled[:, None] - scaled[taken][None]).max(axis=2).min(axis=1)
    while len(taken) < most:
        taken.append(int(np.argmax(apart)))
        apart = np.minimum(apart, np.abs(scaled - scaled[taken[-1]]).max(axis=1))
    return sorted(taken)
