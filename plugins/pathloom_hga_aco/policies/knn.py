"""Nearest neighbours."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from pathloom import Count, LearnedPolicy


def inverse_square(distances: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the weights of neighbours at distances (n, k): eq. (5).

    It divides by nought where an example is met exactly; such examples then vote alone.
    """
    met = distances == 0.0
    with np.errstate(divide="ignore"):
        weights = 1.0 / distances**2
    return np.where(met.any(axis=1, keepdims=True), met.astype(np.float64), weights)


@dataclass(frozen=True, kw_only=True)
class Knn(LearnedPolicy):
    """Vote of the nearest examples, each with a weight of one over the distance squared."""

    source: ClassVar[str] = "Song et al. 2021, section 3.1, eqs. (4) and (5)"
    in_files: ClassVar[frozenset[str]] = frozenset({f"{__name__}.inverse_square"})

    neighbours: Count = 5
    """The paper gives no number."""
    weights: Literal["inverse-square", "inverse", "uniform"] = "inverse-square"
    """What a neighbour counts by: its distance squared, its distance, or nothing."""

    def estimator(self, seed: int) -> Any:
        from sklearn.neighbors import KNeighborsClassifier

        weights = {"inverse-square": inverse_square, "inverse": "distance", "uniform": "uniform"}[self.weights]
        # By brute force, which is quick for some thousand examples and keeps no tree that a file could tamper with.
        return KNeighborsClassifier(self.neighbours, weights=weights, algorithm="brute")
