"""Adaptive probabilities of crossover and mutation, individual by individual."""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part


@part("f8(f8, f8, f8)")
def _share(value, low, high):
    """Return how far a value lies from ``high`` towards ``low``, in [0, 1]; infinite fitness is at the very top."""
    if value >= high:
        return 0.0
    if value <= low or not math.isfinite(high):
        return 1.0
    return (high - value) / (high - low)


@part("UniTuple(f8, 3)(f8[::1])")
def _spread(fitness):
    """Return the least, the mean and the greatest fitness; rounding never takes the mean beyond the others."""
    low, total, high = np.inf, 0.0, -np.inf
    for k in range(fitness.shape[0]):
        low = min(low, fitness[k])
        high = max(high, fitness[k])
        total += fitness[k]
    return low, min(max(total / max(fitness.shape[0], 1), low), high), high


@kernel("f8[::1](f8[::1], f8, f8, f8, f8)")
def falling(fitness, equal, above, below, factor):
    """Return rates that fall in a straight line from ``above`` at the mean to 0 at the best; ``below`` under the mean.

    ``equal`` where all are as fit. All are multiplied by ``factor`` and cut to [0, 1].
    """
    low, mean, high = _spread(fitness)
    rates = np.empty(fitness.shape[0])
    for k in range(fitness.shape[0]):
        if high <= low:
            rate = equal
        elif fitness[k] < mean:
            rate = below
        else:
            rate = above * _share(fitness[k], mean, high)
        rates[k] = min(1.0, max(0.0, rate * factor))
    return rates


@kernel("f8[::1](f8[::1], f8, f8, f8)")
def banded(fitness, base, swing, bands):
    """Return ``base`` in the middle, more below and less above, where the range is cut into so many bands.

    In the lowest band base + swing · r, in the highest base · r, with r = (max − f) / (max − min).
    """
    low, _, high = _spread(fitness)
    rates = np.empty(fitness.shape[0])
    for k in range(fitness.shape[0]):
        rate = base
        if high > low:
            r = _share(fitness[k], low, high)
            # Products instead of quotients: whoever stands on the edge of a band is not rounded into it.
            if fitness[k] <= low or bands * (fitness[k] - low) < high - low:
                rate = base + swing * r
            elif fitness[k] >= high or bands * (high - fitness[k]) < high - low:
                rate = base * r
        rates[k] = min(1.0, max(0.0, rate))
    return rates


@kernel("f8[::1](f8[::1], f8, f8)")
def sinc(fitness, low_rate, high_rate):
    """Return rates that fall along a sinc from the mean to ``low_rate`` at the best; ``high_rate`` under the mean."""
    low, mean, high = _spread(fitness)
    level = mean / high if mean > 0.0 and math.isfinite(high) else 0.0
    rates = np.empty(fitness.shape[0])
    for k in range(fitness.shape[0]):
        rate = high_rate
        if high > low and fitness[k] >= mean:
            x = math.pi * (1.0 - _share(fitness[k], mean, high))
            wave = 1.0 if x == 0.0 else math.sin(x) / x
            rate = low_rate + wave * level * (high_rate - low_rate)
        rates[k] = min(1.0, max(0.0, rate))
    return rates
