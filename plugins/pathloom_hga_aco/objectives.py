"""Sections 5.1 and 5.3.1: smoothness. Length, eqs. (19) and (20), and clearance, eq. (16), are the kernel's own."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import msgspec
import numpy as np

from pathloom import Floats, NonNegative, Objective, PathProblem, Population, Problem, compiled
from pathloom.paths.additive import Prices, price_of_turns
from pathloom.paths.pathwise import path_problem

Price = Annotated[
    tuple[NonNegative, NonNegative, NonNegative, NonNegative, NonNegative],
    msgspec.Meta(description="a price for each of five classes"),
]


@dataclass(frozen=True, kw_only=True)
class AngleTablePenalty(Objective):
    """Σ w_k, eqs. (21) to (25): a penalty for every interior node by its included angle, 180° being straight on.

    Eq. (24) as printed charges 0 for 45° and 10000 for straight on, so that f2
    would be the smaller the straighter a path is, and next to nothing for any;
    eq. (23) as printed takes 180° and 135° behind a step along an axis for each
    other. Both are turned round here.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.3.1, eqs. (21) to (25)"
    works_on: ClassVar[str] = "cells"

    price: Price = (0.0, 10.0, 100.0, 10_000.0, 10_000.0)
    """For 180°, 135°, 90°, 45° and 0°, which the paper leaves out. An angle between two of them, which takes longer
    steps, costs as much as the smaller one."""
    reading: Literal["corrected", "as-printed"] = "corrected"
    """``as-printed``: eqs. (23) and (24) to the letter, for which the price stands in reverse: for 45°, 90°, 135°,
    180°, and for whatever is not in the table."""
    base: NonNegative = 0.0
    """What a path without a turn costs. With 0 eq. (25) divides by zero, unless the fitness has a floor."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        return self.base + self._penalties(population, path_problem(problem).context.cols)

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices(constant=self.base, turn=price_of_turns(self._penalties))

    def _penalties(self, population: Population, cols: int) -> Floats:
        if self.reading == "as-printed":
            return self._as_printed(population, cols)
        return np.asarray(compiled.angles.included_angles(population, cols) @ np.array(self.price))

    def _as_printed(self, population: Population, cols: int) -> Floats:
        row, col = np.divmod(population.astype(np.int64), cols)
        one = np.diff(row) ** 2 + np.diff(col) ** 2  # d1², eq. (21)
        two = (row[:, 2:] - row[:, :-2]) ** 2 + (col[:, 2:] - col[:, :-2]) ** 2  # d2², eq. (22)
        costs = np.full(two.shape, self.price[4])
        printed = (((1, 1), (2, 1)), ((1, 2), (2, 4)), ((1, 4), (2, 5)), ((1, 5), (2, 8)))  # eq. (23), squared
        for price, angle in zip(self.price, printed, strict=False):  # eq. (24)
            for d1, d2 in angle:
                costs[(one[:, :-1] == d1) & (two == d2)] = price
        return np.asarray(costs.sum(axis=1, where=population[:, 2:] >= 0))


@dataclass(frozen=True, kw_only=True)
class MeanTurnAngle(Objective):
    """Eqs. (17) and (18): the sum of all turns over the number of steps, in radians.

    Eq. (17) as printed takes π less each turn, which is greatest straight on, and
    ends one node too late. Not additive: it is a mean.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.1, eqs. (17) and (18)"
    works_on: ClassVar[str] = "cells"

    reading: Literal["corrected", "as-printed"] = "corrected"
    """``as-printed``: the mean of π less each turn."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        steps = (population >= 0).sum(axis=1) - 1
        total = compiled.measures.turns(population, path_problem(problem).context.cols)[:, 1]
        if self.reading == "as-printed":
            total = np.pi * np.maximum(steps - 1, 0) - total
        return np.asarray(total / np.maximum(steps, 1))
