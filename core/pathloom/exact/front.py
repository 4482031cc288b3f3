"""The exact Pareto front of additive objectives on 8-connected paths."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.kernel.evaluation import Floats, Terms, measure
from pathloom.kernel.front import Front
from pathloom.kernel.representation import Population
from pathloom.paths.additive import Prices, additive_terms, weighted
from pathloom.paths.problem import PathProblem

LIMIT = 5_000_000
"""Labels before giving up: some eight seconds, and half a gigabyte."""
EXACT = 2.0**49
"""Greatest cost of a path in whole units; no label costs more than nine times as much, which float64 holds exactly."""
SAME = 1e-9
"""Share of a value by which two are told apart."""


def exact_front(problem: PathProblem, objectives: Terms, *, labels: int = LIMIT) -> Front | None:
    """Return one path of single steps for each vector of values that no other path dominates.

    Prices are rounded to whole multiples of a unit, the smallest in which no path
    costs more than 2⁴⁹ (on 100 × 100 cells, 10⁻¹⁰ of a step), so that sums are
    exact and equal values compare equal. On the front stands one path for each.

    Parameters
    ----------
    objectives
        Two and more; weights do not matter.
    labels
        Limit of the search.

    Returns
    -------
    The front, empty where there is no path; ``None`` past the limit, where an
    objective is not additive, and where a loop pays (see `pathloom.exact.additive`),
    so that the front over walks is not one over paths.

    Notes
    -----
    Label setting over (cell, heading) with bounds for each objective by search
    backwards, as NAMOA* (Mandow and Pérez de la Cruz 2010). A label is dropped,
    too, for one that entered the same cell in another direction, if its advantage
    is at least what its next turn may cost more.
    """
    prices = additive_terms(objectives, problem)
    if prices is None:
        return None
    it = problem.context
    whole = [_whole(one, it.blocked.size) for one in prices]
    simple = all(one.loops_never_pay for one in prices)
    tables = _stacked(whole, it.blocked.size, across=simple)
    walks, made = compiled.fronts.front(it.moves, it.cols, it.start, it.goal, *tables, labels)
    if made > labels:
        return None
    paths = compiled.reshaping.without_loops(walks, it.blocked.size)
    if not simple and any((one.along(walks, problem) != one.along(paths, problem)).any() for one in whole):
        return None
    return _front(paths, measure(list(objectives.objectives()), paths, problem))


def _whole(prices: Prices, cells: int) -> Prices:
    """Return prices in whole multiples of a power of two, so that no sum along a path without loops is rounded."""
    dearest = prices.step.max() + prices.cell.max(initial=0.0) + prices.turn.max()
    unit = 2.0 ** -math.floor(math.log2(EXACT / (cells * dearest))) if dearest > 0.0 else 1.0
    return Prices(
        step=np.round(prices.step / unit),
        cell=np.round(prices.cell / unit),
        turn=np.round(prices.turn / unit),
        zone=prices.zone,
    )


def _stacked(
    prices: Sequence[Prices], cells: int, *, across: bool
) -> tuple[Floats, Floats, Floats, Floats, NDArray[np.integer[Any]]]:
    """Return step, cell and turn of all objectives in common arrays, how turns compare, and the zones.

    Without ``across`` walks that entered a cell in different directions are not compared.
    """
    unit = np.eye(len(prices))
    common = [weighted(prices, weights) for weights in unit]  # all over the same zones
    step = np.stack([one.step for one in common])
    cell = np.stack([one.cell if one.cell.size else np.zeros(cells) for one in common])
    turn = np.stack([one.turn for one in common])
    more = (turn[:, :, :, np.newaxis] - turn[:, :, np.newaxis]).max(axis=-1)  # (m, zones, 8, 8)
    if not across:
        more = np.full_like(more, np.inf)
    return step, cell, turn, np.ascontiguousarray(np.moveaxis(more, 0, -1)), common[0].zone


def _front(population: Population, values: Floats) -> Front:
    """Return the front in lexicographic order, without what rounding took for a trade-off."""
    order = np.lexsort(values.T[::-1])
    values = values[order]
    limit = values + SAME * np.abs(values)
    kept = [k for k in range(len(values)) if not (values[:k] <= limit[k]).all(axis=1).any()]
    return Front(np.ascontiguousarray(population[order[kept]]), values[kept])
