"""Section 2.4: probabilities that adapt to fitness at both ends only."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import Floats, NonNegative, Probability, Share, compiled


@dataclass(frozen=True, kw_only=True)
class BandedAdaptive(Probability):
    """``base`` for the many in the middle, more for the least fit, less for the fittest, eqs. (19) and (20).

    The range of fitness is cut into ``thresh`` bands. With
    r = (max − f) / (max − min) the lowest band has base + swing · r and the
    highest base · r. At the edges of the bands the probability jumps.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.4, eqs. (19) and (20), fig. 6"

    base: Share = 0.8
    """0.8 for crossover, 0.2 for mutation."""
    swing: NonNegative = 0.2
    """What the least fit have more; 0.2 for both."""
    thresh: Annotated[int, msgspec.Meta(ge=2)] = 3
    """Number of bands. Not in the paper."""

    def rates(self, fitness: Floats, progress: float) -> Floats:
        return np.asarray(compiled.probabilities.banded(fitness, self.base, self.swing, self.thresh))
