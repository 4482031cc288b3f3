"""Algorithms of pymoo that spread a population along reference directions."""

import math
from functools import lru_cache

import numpy as np

from pathloom import Floats


@lru_cache(maxsize=32)
def directions(objectives: int, most: int) -> Floats:
    """Return the finest even set of directions (k, m), k at most ``most`` (Das and Dennis 1998)."""
    from pymoo.util.ref_dirs import get_reference_directions

    partitions = 1
    while math.comb(partitions + objectives, objectives - 1) <= most:
        partitions += 1
    return np.asarray(get_reference_directions("das-dennis", objectives, n_partitions=partitions))
