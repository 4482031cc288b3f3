"""Several tests at once."""

import numpy as np
from numpy.typing import ArrayLike

from pathloom.kernel.evaluation import Floats


def holm(p: ArrayLike) -> Floats:
    """Return p (m,) adjusted so that the chance of any false finding among them stays below the level.

    Source: S. Holm (1979), Scand. J. Stat. 6, 65.
    """
    found = np.asarray(p, np.float64)
    order = np.argsort(found, kind="stable")
    adjusted = np.empty_like(found)
    adjusted[order] = np.minimum(1.0, np.maximum.accumulate(found[order] * np.arange(len(found), 0, -1)))
    return adjusted
