"""The smallest effect that a study could have seen: with the chance of 80 % that is customary.

Of few values by simulation: what was seen is centred, drawn again, and shifted
until the test sees it. Both rank tests count pairwise sums (or differences)
above zero, so that the shift at which a sample is first seen is one of these
sums, and no search is needed. Eight values or so give a rough figure, as they say
little of the tails: the shift told is seen in 60 to 85 % of studies then. Of many
values the chance of the test is normal, and Noether's sample sizes, turned round,
say the same without drawing.

Source: G. E. Noether (1987), J. Am. Stat. Assoc. 82, 645, sections 3.1 and 3.2.
"""

import numpy as np
from scipy import stats

from pathloom.kernel.evaluation import Floats
from pathloom.study.statistics.signed_rank import least_p, sign_chances

POWER = 0.8
DRAWN = 500
"""Samples of a simulation."""
FEW = 50
"""Up to so many paired differences, or the square of it in pairs of runs, samples are drawn."""
MOST = 400
"""From so many values on, as many quantiles stand for them."""


def detectable_shift(differences: Floats, alpha: float, rng: np.random.Generator, power: float = POWER) -> float | None:
    """Return the smallest common shift of paired differences that the signed rank test would have seen.

    None if no shift could have been seen, with so few differences, or if most of
    them are equal, so that there is no spread to go by.

    Parameters
    ----------
    differences
        (n,); infinite ones are left out.
    alpha
        Level of the two-sided test.
    """
    held = differences[np.isfinite(differences)]
    n = len(held)
    if n < 2 or least_p(n) > alpha:
        return None
    centred = held - np.median(held)
    if n <= FEW:
        drawn = rng.choice(centred, (DRAWN, n))
        rows, columns = np.triu_indices(n)
        sums = (drawn[:, rows] + drawn[:, columns]) / 2.0
        # The statistic is the count of sums above zero (J. W. Tukey): the shift at which it gets to be large enough.
        return _seen(-_largest(sums, _critical_sum(n, alpha)), power, held)
    centred = _few(centred)
    rows, columns = np.triu_indices(len(centred), 1)
    chance = 0.5 + _needed(alpha, power) / np.sqrt(3.0 * n)
    return _seen(-(centred[rows] + centred[columns]) / 2.0, chance, held) if chance < 1.0 else None


def detectable_a12(weight: float, alpha: float, power: float = POWER) -> float | None:
    """Return the smallest A12 above a half that a rank sum test would have seen; None if none.

    Parameters
    ----------
    weight
        n m / (n + m + 1) of n and m runs; summed over instances for the stratified test.
    """
    chance = 0.5 + _needed(alpha, power) / np.sqrt(12.0 * weight)
    return float(chance) if chance < 1.0 else None


def detectable_difference(
    one: Floats, other: Floats, alpha: float, rng: np.random.Generator, power: float = POWER
) -> float | None:
    """Return the smallest shift between two samples that the rank sum test would have seen; None if none.

    Infinite values are left out.
    """
    x, y = (sample[np.isfinite(sample)] for sample in (one, other))
    n, m = len(x), len(y)
    if min(n, m) < 2:
        return None
    both = np.concatenate((x, y))
    x, y = x - np.median(x), y - np.median(y)
    if n * m <= FEW**2:
        # Mann's and Whitney's count of pairs, by its normal distribution with the continuity correction.
        critical = n * m / 2.0 + 0.5 + stats.norm.ppf(1.0 - alpha / 2.0) * np.sqrt(n * m * (n + m + 1) / 12.0)
        if critical > n * m:
            return None
        pairs = rng.choice(x, (DRAWN, n))[:, :, np.newaxis] - rng.choice(y, (DRAWN, m))[:, np.newaxis]
        return _seen(-_largest(pairs.reshape(DRAWN, -1), int(np.ceil(critical))), power, both)
    chance = detectable_a12(n * m / (n + m + 1), alpha, power)
    return None if chance is None else _seen(-np.subtract.outer(_few(x), _few(y)).ravel(), chance, both)


def detectable_rate(found: int, n: int, m: int, alpha: float, power: float = POWER) -> float | None:
    """Return the smallest difference from the rate of so many found of n + m that n and m runs would have shown.

    Source: J. Cohen (1988), Statistical Power Analysis, section 6.2: the arcsine of the rate has a spread of its own.
    """
    pooled = found / (n + m)
    angle, apart = 2.0 * np.arcsin(np.sqrt(pooled)), _needed(alpha, power) * np.sqrt(1.0 / n + 1.0 / m)
    others = [np.sin(turned / 2.0) ** 2 for turned in (angle - apart, angle + apart) if 0.0 <= turned <= np.pi]
    return float(min(abs(other - pooled) for other in others)) if others else None


def _critical_sum(n: int, alpha: float) -> int:
    """Return the least sum of positive ranks that the two-sided test calls significant."""
    chances = sign_chances(np.arange(1, n + 1))
    above = np.cumsum(chances[::-1])[::-1]
    return int(np.flatnonzero(2.0 * above <= alpha * (1.0 + 1e-12))[0])


def _largest(sums: Floats, count: int) -> Floats:
    """Return of each row the value that so many are at least as large as."""
    place = sums.shape[1] - count
    return np.asarray(np.partition(sums, place, axis=1)[:, place])


def _seen(shifts: Floats, share: float, values: Floats) -> float | None:
    """Return the shift that suffices for such a share; None if it is none at all."""
    shift = float(np.quantile(shifts, share))
    return shift if shift > 1e-12 * max(1.0, float(np.abs(values).max())) else None


def _needed(alpha: float, power: float) -> float:
    return float(stats.norm.ppf(1.0 - alpha / 2.0) + stats.norm.ppf(power))


def _few(values: Floats) -> Floats:
    if len(values) <= MOST:
        return values
    return np.quantile(values, (np.arange(MOST) + 0.5) / MOST)
