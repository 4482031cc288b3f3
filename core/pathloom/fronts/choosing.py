"""Choosing one trade-off from a front. All objectives are minimised; rows dominate each other nowhere."""

import numpy as np
from numpy.typing import ArrayLike

from pathloom.fronts.indicators import SAME, non_dominated
from pathloom.kernel.evaluation import Floats


def normalised(values: Floats) -> Floats:
    """Return values (n, m) in [0, 1], from the front's ideal to its nadir; 0 where an objective does not vary."""
    ideal = values.min(axis=0)
    span = values.max(axis=0) - ideal
    varies = span > SAME
    return np.asarray(np.where(varies, (values - ideal) / np.where(varies, span, 1.0), 0.0))


def knee(values: Floats) -> int:
    """Return the row where giving up a little of one objective gains most of the others.

    It is the one that lies farthest from the plane through the extremes (1, 0, …),
    (0, 1, …), … of the normalised front, on the side of the ideal; of several the
    most balanced one. Source: Das 1999, On characterizing the knee of the Pareto
    curve, with that plane in place of the hull of the extremes.
    """
    scaled = normalised(values)
    return int(np.lexsort((scaled.max(axis=1).round(9), scaled.sum(axis=1).round(9)))[0])


def pseudo_weights(values: Floats) -> Floats:
    """Return for each row (n, m) how much it is worth to it to be good at each objective; rows sum to 1.

    w_k = (nadir_k − v_k) / (nadir_k − ideal_k), divided by their sum: what pymoo's
    PseudoWeights gives, and 0 for objectives that do not vary. On a front of one
    point all are equal.
    Source: Deb 2001, Multi-Objective Optimization Using Evolutionary Algorithms.
    """
    gains = np.where(np.ptp(values, axis=0) > SAME, 1.0 - normalised(values), 0.0)
    total = gains.sum(axis=1, keepdims=True)
    return np.asarray(np.where(total > 0, gains / np.where(total > 0, total, 1.0), 1.0 / values.shape[1]))


def preferred(values: Floats, weights: ArrayLike) -> int:
    """Return the row whose pseudo-weights are nearest to the wanted weights (m,), in the sum of differences.

    An objective with weight 0 is left out, as if the front had only the others:
    what is best by those, and of equals the knee.
    """
    wanted = np.asarray(weights, np.float64)
    asked = wanted > 0
    shown = values[:, asked].round(9)
    best = (shown[:, None] == non_dominated(shown)[None]).all(axis=2).any(axis=1).nonzero()[0]
    apart = np.abs(pseudo_weights(shown[best]) - wanted[asked] / wanted[asked].sum()).sum(axis=1).round(9)
    nearest = best[apart == apart.min()]
    return int(nearest[knee(values[nearest])])
