"""Binary tournaments of pymoo's algorithms, all of a generation at once."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from pathloom import Floats, Indices

Verdict: TypeAlias = NDArray[np.int64]
"""For each pair 1 where the first is better, −1 where the second is, 0 where neither is."""


def contestants(winners: int, size: int, rng: np.random.Generator) -> Indices:
    """Return who meets whom (winners, 2), as pymoo draws it: from permutations of all rows."""
    from pymoo.util.misc import random_permutations

    permutations = random_permutations(-(-2 * winners // size), size, random_state=rng)
    return np.asarray(permutations[: 2 * winners]).reshape(-1, 2)


def by_least(drawn: Indices, key: Floats) -> Verdict:
    """Judge pairs (k, 2) by a number (n,) that is to be small."""
    first, second = key.take(drawn[:, 0]), key.take(drawn[:, 1])
    return np.asarray((first < second).astype(np.int64) - (first > second))


def by_dominance(drawn: Indices, values: Floats) -> Verdict:
    """Judge pairs (k, 2) by which of the two dominates the other in values (n, m)."""
    first, second = values.take(drawn[:, 0], 0), values.take(drawn[:, 1], 0)
    better, worse = (first < second).any(axis=1), (first > second).any(axis=1)
    return np.asarray((better & ~worse).astype(np.int64) - (worse & ~better))


def winners(drawn: Indices, violation: Floats, verdicts: list[Verdict], rng: np.random.Generator) -> Indices:
    """Return the winner of each pair (k, 2): by the first verdict that is one, else either of the two.

    Where one of the two breaks a constraint only the violation (n,) counts.
    """
    verdict: Verdict = np.zeros(len(drawn), np.int64)
    for one in verdicts:
        verdict = np.where(verdict == 0, one, verdict)
    if violation.any():
        verdict = np.where(violation[drawn].any(axis=1), by_least(drawn, violation), verdict)
    first = np.where(verdict == 0, rng.random(len(drawn)) < 0.5, verdict > 0)
    return np.where(first, drawn[:, 0], drawn[:, 1])
