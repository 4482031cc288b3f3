"""No selection, where something else makes the fitter prevail."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Floats, Indices, Selection


@dataclass(frozen=True, kw_only=True)
class KeepAll(Selection):
    """Every individual becomes a parent, once."""

    source: ClassVar[str] = "Hao et al. 2020, abstract: migration takes the place of selection"

    def select(self, fitness: Floats, n: int, rng: np.random.Generator) -> Indices:
        return np.arange(n) % len(fitness)
