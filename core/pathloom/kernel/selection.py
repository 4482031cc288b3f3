"""Selection and pairing that no paper owns."""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom.kernel.component import Count
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.operators import Indices, Pairing, Selection


@dataclass(frozen=True, kw_only=True)
class Roulette(Selection):
    """Choose with a probability in proportion to fitness.

    Infinite fitness takes the whole wheel; where fitness is negative the wheel
    starts at the least one; where all are equal every one has the same chance.
    """

    source: ClassVar[str] = "Holland 1975"

    def select(self, fitness: Floats, n: int, rng: np.random.Generator) -> Indices:
        wheel = fitness.cumsum()
        if not math.isfinite(wheel[-1]) or fitness[fitness.argmin()] < 0:
            infinite = np.isposinf(fitness)
            wheel = np.cumsum(infinite if infinite.any() else fitness - fitness.min(), dtype=np.float64)
        total = float(wheel[-1])
        if total <= 0:
            return rng.integers(len(fitness), size=n)
        wheel[-1] = math.inf  # the last one's share ends the wheel, whatever rounding says
        return np.asarray(wheel.searchsorted(rng.random(n) * total, side="right"))


@dataclass(frozen=True, kw_only=True)
class Tournament(Selection):
    """Choose the fittest of a few drawn at random."""

    source: ClassVar[str] = "Goldberg and Deb 1991"
    size: Count = 2
    """How many are drawn each time."""

    def select(self, fitness: Floats, n: int, rng: np.random.Generator) -> Indices:
        drawn = rng.integers(len(fitness), size=(n, self.size))
        return np.asarray(drawn[np.arange(n), np.argmax(fitness[drawn], axis=1)])


@dataclass(frozen=True, kw_only=True)
class ByLayers(Selection):
    """Copy the best third twice and the middle third once, and drop the rest.

    Where the number does not divide by three, the best of the bottom layer make
    up the difference.
    """

    def select(self, fitness: Floats, n: int, rng: np.random.Generator) -> Indices:
        ranked = np.argsort(-fitness, kind="stable")
        if len(ranked) < n:
            ranked = np.resize(ranked, n)
        third = n // 3
        return np.concatenate((ranked[:third], ranked[: 2 * third + n % 3]))


@dataclass(frozen=True, kw_only=True)
class RandomPairs(Pairing):
    """Shuffle, and let neighbours be pairs; of an odd number one stays alone."""

    def pair(self, fitness: Floats, rng: np.random.Generator) -> Indices:
        order = rng.permutation(len(fitness))
        return order[: len(order) // 2 * 2].reshape(-1, 2)


@dataclass(frozen=True, kw_only=True)
class ConsecutivePairs(Pairing):
    """Let the first be with the second, the third with the fourth, in the order of selection."""

    def pair(self, fitness: Floats, rng: np.random.Generator) -> Indices:
        return np.arange(len(fitness) // 2 * 2).reshape(-1, 2)
