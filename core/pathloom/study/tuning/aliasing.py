"""What a design cannot tell apart: main effects, and the joint effects of two factors."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from pathloom.kernel.evaluation import Floats


@dataclass(frozen=True)
class Alias:
    """How much of a factor's main effect could as well be a joint effect of two others."""

    factor: int
    pair: tuple[int, int]
    share: float
    """Share of the factor's contrasts that the pair's joint contrasts make up; 1: not to be told apart."""


def interaction_aliases(design: ArrayLike) -> Iterator[Alias]:
    """Yield each factor with each pair of others that it is confounded with, in a design (n, k) of levels."""
    levels = np.asarray(design)
    mains = [_span(column) for column in levels.T]
    for a, b in combinations(range(levels.shape[1]), 2):
        joint = _joint(mains[a], mains[b])
        for factor in range(levels.shape[1]):
            if factor not in (a, b) and mains[factor].shape[1]:
                share = float(((joint.T @ mains[factor]) ** 2).sum() / mains[factor].shape[1])
                if share > 1e-9:
                    yield Alias(factor, (a, b), min(share, 1.0))


def _span(column: ArrayLike) -> Floats:
    """Return an orthonormal basis of what a factor's levels can make up, the mean aside."""
    values = np.asarray(column)
    return _basis(np.column_stack([values == level for level in np.unique(values)]).astype(np.float64), ())


def _joint(one: Floats, other: Floats) -> Floats:
    """Return an orthonormal basis of the joint effects of two factors, their main effects aside."""
    products = (one[:, :, np.newaxis] * other[:, np.newaxis]).reshape(len(one), -1)
    return _basis(products, (one, other))


def _basis(columns: Floats, without: tuple[Floats, ...]) -> Floats:
    mean = np.full((len(columns), 1), 1.0 / np.sqrt(len(columns)))
    taken = _orthonormal(np.hstack((mean, *without)))
    return _orthonormal(columns - taken @ (taken.T @ columns))


def _orthonormal(columns: Floats) -> Floats:
    vectors, sizes, _ = np.linalg.svd(columns, full_matrices=False)
    return np.asarray(vectors[:, sizes > 1e-9])
