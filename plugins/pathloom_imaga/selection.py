"""Section 2.3: roulette with the best put in, and selection by three stages."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Floats, Indices
from pathloom.kernel.selection import ByLayers, Roulette


@dataclass(frozen=True, kw_only=True)
class GreedyRoulette(Roulette):
    """Choose all but one by the roulette wheel, eqs. (17) and (18), and put the fittest in as well.

    This is one half of what the paper calls greedy; that the fittest is also set
    aside untouched is a matter of survival.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.3, eqs. (17) and (18)"

    def select(self, fitness: Floats, n: int, rng: np.random.Generator) -> Indices:
        chosen = super().select(fitness, n, rng)
        chosen[:1] = np.argmax(fitness)
        return chosen


@dataclass(frozen=True, kw_only=True)
class ThreeStage(ByLayers):
    """Copy the fittest third twice and the middle third once, and drop the rest."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.3, fig. 5"
