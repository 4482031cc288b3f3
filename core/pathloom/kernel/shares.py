"""Shares: how much each of several parts gets, in any unit."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError


def check_shares(name: str, parts: Sequence[object], shares: Sequence[float], what: str) -> None:
    """Refuse to have no parts, or shares that are not one a part with a sum above zero.

    Raises
    ------
    ConfigError
        Where they are refused. ``what`` is the kind of the parts.
    """
    if not parts:
        raise ConfigError(f"{name}: parts is a list of at least one {what}; got none")
    if shares and len(shares) != len(parts):
        raise ConfigError(f"{name}: wanted {len(parts)} shares, one a part; got {len(shares)}")
    if shares and not 0.0 < sum(shares) < math.inf:
        raise ConfigError(f"{name}: shares add up to a number in (0, inf); got {sum(shares):g}")


def cumulative(parts: Sequence[object], shares: Sequence[float]) -> NDArray[np.float64]:
    """Return the cumulative shares (k,) of k parts, 1 at the end; no shares: all the same."""
    total = np.cumsum(shares or [1.0] * len(parts))
    return np.asarray(total / total[-1])
