"""The cheapest 8-connected path for additive objectives, and for weighted sums of them.

Search over (cell, heading) gives the optimum over all walks of legal steps, since
prices are not negative. A walk may visit a cell twice, a path does not; so the
optimum over walks bounds that over paths from below. Where cutting out loops
never costs anything (`Prices.loops_never_pay`: lengths, cells, numbers and sums of
angles of turns), the two are equal. Where a loop pays, because three easy turns
cost less than a sharp one, the bound may lie below what any path can reach.
"""

from typing import NamedTuple

import numpy as np

from pathloom import compiled
from pathloom.kernel.planner import Planner
from pathloom.kernel.search import Search
from pathloom.paths.additive import Prices, additive_terms, weighted
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem


class Optimum(NamedTuple):
    """A cheapest path."""

    cost: float
    """What the path costs; inf where there is none."""
    path: Path | None
    """(k, 2), without loops."""
    bound: float
    """What no path can undercut: the cost of the cheapest walk."""

    @property
    def proven(self) -> bool:
        """Whether the path is the cheapest one: it costs what the cheapest walk does, up to rounding."""
        return self.cost <= self.bound + 1e-9 * max(1.0, abs(self.bound))


def additive_path(problem: PathProblem, prices: Prices) -> Optimum:
    """Return a cheapest path of single steps that obey the problem's corner policy."""
    it = problem.context
    walk = compiled.headings.cheapest(it.moves, it.cols, it.start, it.goal, *prices.tables)[np.newaxis]
    if walk.size == 0:
        return Optimum(np.inf, None, np.inf)
    bound = float(prices.along(walk, problem)[0])
    path = compiled.reshaping.without_loops(walk, it.blocked.size)
    return Optimum(float(prices.along(path, problem)[0]), problem.representation.decode(path[0]), bound)


def additive_optimum(problem: PathProblem, planner: Planner) -> Optimum | None:
    """Return the least weighted sum of a planner's objectives on cell paths, under its own weights.

    It is the greatest fitness too where that falls as the sum rises: with
    `ReciprocalOfSum`, or one objective alone. ``None``: the planner weighs no
    objectives, or one that has a weight is not additive.
    """
    if not isinstance(planner, Search):
        return None
    weights = planner.weights(problem)
    terms = type(planner.terms)(term for term, weight in zip(planner.terms, weights, strict=True) if weight > 0.0)
    prices = additive_terms(terms, problem)
    return None if prices is None else additive_path(problem, weighted(prices, weights[weights > 0.0]))
