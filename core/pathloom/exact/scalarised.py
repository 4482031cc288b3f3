"""Seeds from scalarised exact searches: optima of weighted sums, each a corner of the Pareto front."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, islice

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.kernel.component import Count
from pathloom.kernel.counting import count
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.additive import Prices, weighted
from pathloom.paths.pathwise import path_problem
from pathloom.paths.priced_sampling import PricedSampling
from pathloom.paths.problem import PathProblem

ASIDE = 1e-3
"""Least share of an objective: without any, an optimum might be better in it at no cost."""
TIE = 1e-10
"""Random price of a cell, in units of the dearest step: of equally good paths any may be found."""


@dataclass(frozen=True, kw_only=True)
class ByOptima(PricedSampling, ABC):
    """Base of samplings whose individuals are exact optima, each of another weighting; others fill up."""

    vectors: Count = 66
    """How many searches are made at most."""
    work: Count = 2_000_000
    """Limit of searches times cells of the map: on large maps fewer are made, or none."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        if not it.reachable:
            return np.empty((0, 1), np.int32)
        found = self.optima(it, n, min(self.vectors, self.work // it.context.blocked.size), rng)[:n]
        missing = n - len(found)
        count("samples by fallback", missing)
        if missing == 0:
            return found
        filled = self.rest.sample(problem, missing, rng)
        return it.representation.stack(found, filled) if len(found) else filled

    @abstractmethod
    def optima(self, problem: PathProblem, n: int, most: int, rng: np.random.Generator) -> Population:
        """Return distinct optima, n or so, after ``most`` searches at most."""


@dataclass(frozen=True, kw_only=True)
class Scalarised(ByOptima):
    """Find the cheapest 8-connected path under one weighting after the other; fill up with other samples.

    First under the objectives' own weights (with one search, ``vectors`` = 1, under
    no others), then for each objective almost alone, then under the weightings of a
    lattice on the simplex in random order, then under random ones. Objectives are
    scaled by their ranges among the paths found till then. What is not additive is
    left out, and counted.
    """

    def optima(self, problem: PathProblem, n: int, most: int, rng: np.random.Generator) -> Population:
        prices, own = self.priced(problem)
        search = Optima(problem, prices, rng)
        if prices:
            for weights in islice(weightings(np.array(own), self.vectors, search, rng), most):
                search.run(weights)
                if len(search.paths) >= n:
                    break
        return search.population


class Optima:
    """Optima of weighted sums: those found so far, and how far apart their values are."""

    def __init__(self, problem: PathProblem, prices: list[Prices], rng: np.random.Generator) -> None:
        self.problem, self.prices = problem, prices
        self.paths: list[Population] = []
        self._seen: set[bytes] = set()
        self._values: list[Floats] = []
        self._ties = rng.random(problem.context.blocked.size)

    @property
    def scale(self) -> Floats:
        """The range (m,) of each objective, or its value where all have the same; 1 where that is zero."""
        values = np.array(self._values)
        spread = np.ptp(values, axis=0)
        spread = np.where(spread > 0.0, spread, np.abs(values[0]))
        return np.where(spread > 0.0, spread, 1.0)

    @property
    def population(self) -> Population:
        """The distinct optima, in the order in which they were found."""
        width = max((len(path) for path in self.paths), default=1)
        population = np.full((len(self.paths), width), -1, np.int32)
        for row, path in zip(population, self.paths, strict=True):
            row[: len(path)] = path
        return population

    def run(self, weights: Floats, moves: NDArray[np.uint8] | None = None) -> None:
        """Find the optimum under these weights, and keep it if it is new; ``moves`` (cells,) are the legal steps.

        There has to be a way from start to goal.
        """
        it = self.problem.context
        step, cell, turn, zone = weighted(self.prices, weights).tables
        ties = TIE * (step.max() + cell.max(initial=0.0) + turn.max()) * self._ties
        cell = cell + ties if cell.size else ties
        walk = compiled.headings.cheapest(
            it.moves if moves is None else moves, it.cols, it.start, it.goal, step, cell, turn, zone
        )
        path = compiled.reshaping.without_loops(walk[np.newaxis], it.blocked.size)
        self._values.append(np.array([one.along(path, self.problem)[0] for one in self.prices]))
        if path.tobytes() not in self._seen:
            self._seen.add(path.tobytes())
            self.paths.append(path[0])


def weightings(own: Floats, most: int, search: Optima, rng: np.random.Generator) -> Iterator[Floats]:
    """Yield weightings (m,) without end, in the order of `Scalarised`; ``most`` sets how fine the lattice is."""
    m = len(own)
    yield own
    if m == 1:
        return
    for k in range(m):
        yield np.where(np.arange(m) == k, 1.0, ASIDE) / search.scale
    for share in rng.permutation(_lattice(m, most)):
        yield np.maximum(share, ASIDE) / search.scale
    while True:
        yield rng.dirichlet(np.ones(m)) / search.scale


def _lattice(m: int, most: int) -> Floats:
    """Return shares (k, m) in equal steps that add up to 1, at most so many, corners left out (Das and Dennis 1998)."""
    finest = np.empty((0, m))
    for parts in range(2, most + 1):
        bars = np.array(list(combinations(range(parts + m - 1), m - 1)))
        ends = np.full((len(bars), 1), -1), np.full((len(bars), 1), parts + m - 1)
        shares = (np.diff(np.hstack((ends[0], bars, ends[1])), axis=1) - 1) / parts
        if len(shares) > most:
            break
        finest = shares[shares.max(axis=1) < 1.0]
    return finest
