"""Seeds that keep their distance: scalarised optima among the paths that stay clear of obstacles."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from pathloom.exact.scalarised import ByOptima, Optima, weightings
from pathloom.grid.connectivity import labels
from pathloom.kernel.component import Count
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.representation import Population
from pathloom.paths.additive import STEP_LENGTHS, Prices
from pathloom.paths.context import STEPS
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class Aloof(ByOptima):
    """Find the cheapest paths that stay at least so far from obstacles, for several distances.

    No weighted sum of additive objectives leads to the wide end of a front over
    clearance. Distances are spread evenly from the least one that excludes a cell to
    the greatest at which there is a way, and none at all is one more; at each of them,
    in turn, the additive objectives are weighted as `Scalarised` does, length where
    there is none.

    Only where an objective is not additive: else `Scalarised` finds the corners of the
    front, and ``rest`` makes all individuals here.

    This is the ε-constraint method (Haimes, Lasdon and Wismer 1971), with the
    distance of cells from obstacles as the constraint.
    """

    distances: Count = 24
    """How many distances there are at most; so few that there are two searches for each."""
    work: Count = 6_000_000

    def optima(self, problem: PathProblem, n: int, most: int, rng: np.random.Generator) -> Population:
        prices, own = self.priced(problem)
        if len(prices) == len(self.terms):
            return np.empty((0, 1), np.int32)
        if not prices:
            prices, own = [Prices(step=STEP_LENGTHS)], [1.0]
        search = Optima(problem, prices, rng)
        for distance, weights in islice(self._tries(problem, np.array(own), search, most, rng), most):
            search.run(weights, moves_at(problem, distance))
            if len(search.paths) >= n:
                break
        return search.population

    def _tries(
        self, problem: PathProblem, own: Floats, search: Optima, most: int, rng: np.random.Generator
    ) -> Iterator[tuple[float, Floats]]:
        """Yield distances with weightings: all distances under the first weighting, all under the second, and so on."""
        levels = [*distances(problem, min(self.distances, max(most // 2 - 1, 1)))[::-1], 0.0]
        for weights in weightings(own, max(most // len(levels), 2), search, rng):
            for level in levels:
                yield level, weights


def distances(problem: PathProblem, n: int) -> list[float]:
    """Return up to n distances at which there is a way, the greatest one among them, in rising order.

    A distance is that of a cell's centre to the nearest obstacle's centre.
    """
    it = problem.context
    limit = min(it.distance[it.start], it.distance[it.goal])
    known = np.unique(it.distance[np.isfinite(it.distance) & (it.distance > 0.0) & (it.distance <= limit)])
    low, high = 0, len(known)  # at known[low] there is a way, unless there is none at all; at known[high] none
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if connected(problem, known[middle]) else (low, middle)
    if low == 0:
        return []
    wanted = np.linspace(known[0], known[low], min(n, low) + 1)[1:]
    return sorted({float(known[i]) for i in np.searchsorted(known[: low + 1], wanted - 1e-9)})


def connected(problem: PathProblem, distance: float) -> bool:
    """Say whether there is a way over cells that are at least so far from obstacles."""
    it = problem.context
    found = labels((it.distance < distance).reshape(it.rows, it.cols), it.corners).ravel()
    return bool(found[it.start] and found[it.start] == found[it.goal])


def moves_at(problem: PathProblem, distance: float) -> NDArray[np.uint8]:
    """Return the legal steps (cells,) between cells that are at least so far from obstacles."""
    it = problem.context
    far = (it.distance >= distance).reshape(it.rows, it.cols)
    around = np.pad(far, 1)
    kept = np.zeros_like(far, np.uint8)
    for d, (dr, dc) in enumerate(STEPS):
        both = far & around[1 + dr : 1 + dr + it.rows, 1 + dc : 1 + dc + it.cols]
        kept |= both.astype(np.uint8) << np.uint8(d)
    return np.asarray(it.moves & kept.ravel())
