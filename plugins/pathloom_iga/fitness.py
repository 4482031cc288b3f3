"""Section 3.3, eq. (5): the fitness function."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import ConfigError, Fitness, Floats, NonNegative


@dataclass(frozen=True, kw_only=True)
class ReciprocalLengthPlusConstant(Fitness):
    """F = 1 / L + C, with L the weighted sum of the objectives.

    The paper calls C a "large positive number" and does not give it. Under
    roulette selection a large one leaves no pressure at all: a path of 28 cells
    is selected 1.79 times as often as one of 50 with C = 0, 1.52 times with 0.01,
    1.13 with 0.1, 1.015 with 1 and 1.0016 with 10.
    """

    source: ClassVar[str] = "Liu et al. 2024, section 3.3, eq. (5)"

    constant: NonNegative = 0.01
    """C. Lengths on the paper's maps are 14 to 55 cells, their reciprocals 0.02 to 0.07."""
    reading: Literal["plus", "over-length", "minus-length"] = "plus"
    """1 / L + C as printed; C / L, which changes no roulette; or C - L."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.reading == "over-length" and self.constant == 0.0:
            raise ConfigError(f"{self.name}: constant is a number in (0, inf) over a length; got 0.0")

    def combine(self, values: Floats, weights: Floats) -> Floats:
        length = values @ weights
        if self.reading == "minus-length":
            return np.asarray(self.constant - length)
        with np.errstate(divide="ignore"):
            if self.reading == "over-length":
                return np.asarray(self.constant / length)
            return np.asarray(1.0 / length + self.constant)
