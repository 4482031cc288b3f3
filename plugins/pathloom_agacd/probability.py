"""Sections 4.6 and 4.7: probabilities that follow an individual's fitness and the generation."""

import math
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Floats, Probability, Share, compiled


@dataclass(frozen=True, kw_only=True)
class ExponentialFall(Probability):
    """Crossover, eqs. (26) and (27): less for the fitter half, none for the best, and falling as e^(−t/T)."""

    source: ClassVar[str] = "Hao et al. 2021, section 4.6, eqs. (26)-(27)"

    low: Share = 0.65
    """pc_low: where all are as fit, and only there."""
    high: Share = 0.7
    """pc_high: below the mean."""
    middle: Literal["low", "high"] = "high"
    """From which of the two the probability falls above the mean."""

    def rates(self, fitness: Floats, progress: float) -> Floats:
        above = self.high if self.middle == "high" else self.low
        return np.asarray(compiled.probabilities.falling(fitness, self.low, above, self.high, math.exp(-progress)))


@dataclass(frozen=True, kw_only=True)
class ExponentialRise(Probability):
    """Mutation, eqs. (28) and (29): less for the fitter half, none for the best, and rising as e^(t/T), up to 1."""

    source: ClassVar[str] = "Hao et al. 2021, section 4.7, eqs. (28)-(29)"

    low: Share = 0.15
    """pm_low: from where the probability falls above the mean."""
    high: Share = 0.3
    """pm_high: below the mean, and where all are as fit. Above 1/e = 0.368 it passes 1 before the end."""
    middle: Literal["low", "high"] = "low"
    """From which of the two the probability falls above the mean; the crossover's is printed with the high one."""

    def rates(self, fitness: Floats, progress: float) -> Floats:
        above = self.low if self.middle == "low" else self.high
        return np.asarray(compiled.probabilities.falling(fitness, self.high, above, self.high, math.exp(progress)))
