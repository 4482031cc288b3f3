"""Seeds that keep their distance: scalarised optima among the paths that stay clear of obstacles."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom.exact.scalarised import Optima, weightings
from pathloom.grid.connectivity import labels
from pathloom.kernel.component import Count
from pathloom.kernel.counting import count
from pathloom.kernel.evaluation import Floats, Terms
from pathloom.kernel.operators import Sampling
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.additive import STEP_LENGTHS, Prices, prices_of
from pathloom.paths.context import STEPS
from pathloom.paths.pathwise import path_problem
from pathloom.paths.priced_trees import USUAL
from pathloom.paths.problem import PathProblem
from pathloom.paths.tree_seeding import PerturbedTrees


@dataclass(frozen=True, kw_only=True)
class Aloof(Sampling):
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

    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    objectives: Terms = USUAL
    """What is weighted. Left as it is, it stands for the objectives of the planner."""
    distances: Count = 24
    """How many distances there are at most; so few that there are two searches for each."""
    vectors: Count = 66
    """How many searches are made at most, over all distances."""
    work: Count = 6_000_000
    """Limit of searches times cells of the map: on large maps fewer are made, or none."""
    rest: Sampling = PerturbedTrees()
    """Makes the individuals that are still missing."""

    def serving(self, objectives: Terms) -> "Aloof":
        mine = objectives if self.objectives == USUAL else self.objectives
        return replace(self, objectives=mine, rest=self.rest.serving(objectives))

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        if not it.reachable:
            return np.empty((0, 1), np.int32)
        found = self._optima(it, n, rng)
        missing = n - len(found)
        count("samples by fallback", missing)
        if missing == 0:
            return found
        filled = self.rest.sample(problem, missing, rng)
        return it.representation.stack(found, filled) if len(found) else filled

    def _optima(self, problem: PathProblem, n: int, rng: np.random.Generator) -> Population:
        """Return up to n distinct optima."""
        priced = [(prices_of(term.objective, problem), term.weight) for term in self.objectives]
        prices = [one for one, _ in priced if one is not None]
        own = np.array([weight for one, weight in priced if one is not None])
        if len(prices) == len(priced):
            return np.empty((0, 1), np.int32)
        if not prices:
            prices, own = [Prices(step=STEP_LENGTHS)], np.ones(1)
        search = Optima(problem, prices, rng)
        most = min(self.vectors, self.work // problem.context.blocked.size)
        for distance, weights in islice(self._tries(problem, own, search, most, rng), most):
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
