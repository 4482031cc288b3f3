"""Section 4.3.1: selection by layers."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Floats, Indices, Selection


@dataclass(frozen=True, kw_only=True)
class ThreeLayer(Selection):
    """Copy the best third twice and the middle third once, and drop the rest.

    Where the number does not divide by three, the best of the bottom layer make
    up the difference. The paper's "M/3 + mod(M/3)" means ⌊M/3⌋ + (M mod 3).
    """

    source: ClassVar[str] = "Li et al. 2021, section 4.3.1, fig. 4"

    def select(self, fitness: Floats, n: int, rng: np.random.Generator) -> Indices:
        ranked = np.argsort(-fitness, kind="stable")
        if len(ranked) < n:
            ranked = np.resize(ranked, n)
        third = n // 3
        return np.concatenate((ranked[:third], ranked[: 2 * third + n % 3]))
