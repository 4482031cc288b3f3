"""Section 3.4.1: adaptive probabilities of crossover and mutation."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import ConfigError, Floats, Probability, Share, compiled


@dataclass(frozen=True, kw_only=True)
class SincAdaptive(Probability):
    """P = P_min + sinc((f - f_avg) / (f_max - f_avg)) (f_avg / f_max) (P_max - P_min); P_max below the average.

    With sinc(x) = sin(πx) / (πx), eq. (8). The same for crossover, eq. (6), where
    f is that of the fitter parent, and mutation, eq. (7). The text under eq. (6)
    writes f_min for the mean f_avg. Where all are as fit the probability is P_max.
    """

    source: ClassVar[str] = "Liu et al. 2024, section 3.4, eqs. (6) to (10)"

    low: Share = 0.5
    """P_min, which the fittest gets."""
    high: Share = 0.8
    """P_max."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.low > self.high:
            raise ConfigError(f"{self.name}: low is a number of at most high, {self.high!r}; got {self.low!r}")

    def rates(self, fitness: Floats, progress: float) -> Floats:
        return np.asarray(compiled.probabilities.sinc(fitness, self.low, self.high))
