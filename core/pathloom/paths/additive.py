"""Additive objectives: those whose value on an 8-connected path is a sum of prices.

    constant + Σ over steps    step[cell left, direction]
             + Σ over steps    cell[cell entered]
             + Σ over interior turn[zone of the cell, direction in, direction out]

For such objectives, and weighted sums of them, optima on cell paths can be found
by search over (cell, heading): `pathloom.exact.additive`, `pathloom.exact.front`.

An objective says so by a method ``prices(problem)``; nothing else is asked of it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, Self, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom import compiled
from pathloom.errors import PluginError
from pathloom.kernel.evaluation import Floats, Objective, Terms
from pathloom.kernel.representation import Population
from pathloom.paths.context import STEPS
from pathloom.paths.problem import PathProblem

HEADINGS: NDArray[np.int64] = np.array(STEPS, np.int64)
"""(8, 2): the directions of a step as (row, column), clockwise from north."""
STEP_LENGTHS: Floats = np.hypot(*HEADINGS.T)
"""(8,): 1 and √2 in turn."""
_BACK = (np.arange(8) + 4) % 8


@dataclass(frozen=True, kw_only=True, eq=False)
class Prices:
    """What an additive objective charges for, on one problem. Prices are finite and not negative."""

    constant: float = 0.0
    """What a path costs before its first step, the price of its first cell included. It may be negative."""
    step: Floats = field(default_factory=lambda: np.zeros((1, 8)))
    """(1, 8) by direction, or (cells, 8) by the cell left and direction."""
    cell: Floats = field(default_factory=lambda: np.zeros(0))
    """(cells,) by the cell entered, the goal included; (0,): nothing."""
    turn: Floats = field(default_factory=lambda: np.zeros((1, 8, 8)))
    """(zones, 8, 8) by direction in and direction out, also where both are the same.

    Paths without loops never go straight back. That entry is set to the dearest
    one of its zone, so that no search gains by what no such path does.
    """
    zone: NDArray[np.integer[Any]] = field(default_factory=lambda: np.zeros(0, np.int32))
    """(cells,), which zone a cell belongs to; (0,): all to the first one."""

    def __post_init__(self) -> None:
        step = np.atleast_2d(_floats(self.step))
        turn = _floats(self.turn).reshape((-1, *np.shape(self.turn)[-2:])).copy()
        cell, zone = _floats(self.cell), np.ascontiguousarray(self.zone, np.int32)
        shapes = (step.shape[1:] == (8,), turn.shape[1:] == (8, 8), cell.ndim == 1, zone.ndim == 1)
        if not all(shapes) or (zone.size and not 0 <= zone.min() <= zone.max() < len(turn)):
            found = f"step {step.shape}, cell {cell.shape}, turn {turn.shape}, zone {zone.shape}"
            raise PluginError(f"wanted prices step (1 or cells, 8), cell (cells,), turn (zones, 8, 8); got {found}")
        turn[:, np.arange(8), _BACK] = 0.0
        turn[:, np.arange(8), _BACK] = turn.max(axis=(1, 2), initial=0.0)[:, np.newaxis]
        for prices in (step, cell, turn):
            if not (np.isfinite(prices).all() and (prices >= 0.0).all()):
                raise PluginError("prices are finite numbers, zero or more")
        for name, value in (("step", step), ("cell", cell), ("turn", turn), ("zone", zone)):
            object.__setattr__(self, name, value)

    @classmethod
    def of_visiting(cls, cell: ArrayLike, problem: PathProblem) -> Self:
        """Return prices (cells,) charged for every cell of the path."""
        price = _floats(cell)
        return cls(constant=float(price[problem.context.start]), cell=price)

    @classmethod
    def of_leaving(cls, cell: ArrayLike, problem: PathProblem) -> Self:
        """Return prices (cells,) charged for every cell of the path but the last."""
        price = _floats(cell)
        return cls(constant=float(price[problem.context.start] - price[problem.context.goal]), cell=price)

    @property
    def tables(self) -> tuple[Floats, Floats, Floats, NDArray[np.integer[Any]]]:
        """The arrays as the kernels take them: step, cell, turn, zone."""
        return self.step, self.cell, self.turn, self.zone

    @property
    def loops_never_pay(self) -> bool:
        """Whether no path becomes dearer by cutting out what lies between two visits of a cell.

        So it is if no turn costs more than any sequence of turns from the same
        heading to the same heading, made anywhere. For what is cut out between two
        steps is such a sequence, with steps and cells that cost nothing at best,
        and the turn in its place does not go straight back.
        """
        least, most = self.turn.min(axis=0), self.turn.max(axis=0)
        for via in range(8):  # Floyd and Warshall, over headings
            least = np.minimum(least, least[:, via, np.newaxis] + least[via])
        most[np.arange(8), _BACK] = 0.0
        return bool((most <= least * (1.0 + 1e-12)).all())

    def along(self, population: Population, problem: PathProblem) -> Floats:
        """Return what each path (n,) costs; nan for one with other steps than to one of the 8 neighbours."""
        found = compiled.headings.price(population, problem.context.cols, *self.tables)
        return np.asarray(self.constant + found)


@runtime_checkable
class Additive(Protocol):
    """What an objective has that may be additive."""

    def prices(self, problem: PathProblem) -> Prices | None:
        """Return the prices that add up to the objective's value on 8-connected paths without loops.

        ``None``: it is not additive with these parameters.
        """


def prices_of(objective: Objective, problem: PathProblem) -> Prices | None:
    """Return the prices of an objective, or ``None`` where it is not additive.

    Raises
    ------
    PluginError
        If the prices have other shapes than the problem's cells ask for, or are negative or not finite.
    """
    if not isinstance(objective, Additive):
        return None
    cells = problem.context.blocked.size
    try:
        prices = objective.prices(problem)
        if prices is not None:
            fits = (len(prices.step) in (1, cells), prices.cell.size in (0, cells), prices.zone.size in (0, cells))
            if not all(fits):
                raise PluginError(f"wanted one price for each of {cells} cells")
    except PluginError as error:
        raise PluginError(f"objective {objective.name!r}: {error}") from None
    return prices


def additive_terms(terms: Terms, problem: PathProblem) -> list[Prices] | None:
    """Return the prices of every term, or ``None`` where one of them is not additive."""
    found = [prices_of(term.objective, problem) for term in terms]
    return None if any(prices is None for prices in found) else [prices for prices in found if prices is not None]


def weighted(prices: Sequence[Prices], weights: Sequence[float] | Floats) -> Prices:
    """Return the prices of a weighted sum; weights are zero or more."""
    constant, step, cell = 0.0, np.zeros((1, 8)), np.zeros(0)
    turn = np.zeros((1, 8, 8))
    zone: NDArray[np.integer[Any]] = np.zeros(0, np.int32)
    for one, weight in zip(prices, np.asarray(weights, float).tolist(), strict=True):
        constant += weight * one.constant
        step = step + weight * one.step
        cell = _sum(cell, weight * one.cell)
        if one.zone.size:  # zones of the sum: pairs of zones
            zone = one.zone + len(one.turn) * zone if zone.size else one.zone
            turn = (turn[:, np.newaxis] + weight * one.turn).reshape(-1, 8, 8)
        else:
            turn = turn + weight * one.turn[:1]
    return Prices(constant=constant, step=step, cell=cell, turn=turn, zone=zone)


def price_of_turns(measured: Callable[[Population, int], Floats]) -> Floats:
    """Return the table (8, 8) of turns that ``measured(population, cols)`` charges.

    It is asked once, for the 64 paths of three cells through the middle of a map of 5 × 5.
    """
    ids = HEADINGS @ np.array([5, 1])
    before, after = np.repeat(12 - ids, 8), np.tile(12 + ids, 8)
    paths = np.stack((before, np.full(64, 12), after), axis=1).astype(np.int32)
    return np.asarray(measured(paths, 5), np.float64).reshape(8, 8)


def _floats(values: Any) -> Floats:
    return np.ascontiguousarray(values, np.float64)


def _sum(first: Floats, second: Floats) -> Floats:
    if first.size and second.size:
        return first + second
    return first if first.size else second
