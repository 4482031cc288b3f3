"""Penalties for turns that are met in public programs for grids."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import Floats, NonNegative, Objective, PathProblem, Population, Problem
from pathloom.paths.additive import Prices, price_of_turns
from pathloom.paths.pathwise import path_problem

Price = Annotated[
    tuple[NonNegative, NonNegative, NonNegative], msgspec.Meta(description="a price for each of three classes")
]


@dataclass(frozen=True, kw_only=True)
class SmoothnessPenalty(Objective):
    """S: a penalty for every node by the angle between the way back and the way on, which is 180° straight on."""

    source: ClassVar[str] = "common practice on grids"
    works_on: ClassVar[str] = "cells"

    base: NonNegative = 0.0
    """What a straight path costs; public programs add nothing, and divide by zero."""
    price: Price = (3.0, 15.0, 20.0)
    """For angles between 91° and 170°, from there down to 46°, and below: on a grid 135°, 90°, 45° and 0°."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        return self.base + self._penalties(population, path_problem(problem).context.cols)

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices(constant=self.base, turn=price_of_turns(self._penalties))

    def _penalties(self, population: Population, cols: int) -> Floats:
        before, after, turning = _steps(population, cols)
        cross = before[0] * after[1] - before[1] * after[0]
        dot = -(before[0] * after[0] + before[1] * after[1])
        angle = np.degrees(np.arctan2(np.abs(cross), dot))
        which = (angle < 170.0).astype(np.intp) + (angle <= 91.0) + (angle <= 46.0)
        return np.asarray(np.array([0.0, *self.price])[which].sum(axis=1, where=turning))


@dataclass(frozen=True, kw_only=True)
class SmoothD2Legacy(Objective):
    """S by the squared distance between the nodes before and after: wrong, and here only to repeat old results.

    Straight on along an axis has the same distance, 4, as a right angle between
    two diagonals, and costs as much.
    """

    source: ClassVar[str] = "public programs for grids"
    works_on: ClassVar[str] = "cells"

    base: NonNegative = 0.0
    """What a path without a penalty costs."""
    price: Price = (5.0, 30.0, 5000.0)
    """For squared distances between 4 and 8, from there down to more than 1, and up to 1."""

    def measure(self, population: Population, problem: Problem) -> Floats:
        return self.base + self._penalties(population, path_problem(problem).context.cols)

    def prices(self, problem: PathProblem) -> Prices | None:
        return Prices(constant=self.base, turn=price_of_turns(self._penalties))

    def _penalties(self, population: Population, cols: int) -> Floats:
        before, after, inside = _steps(population, cols)
        squared = (before[0] + after[0]) ** 2 + (before[1] + after[1]) ** 2
        which = (squared < 8).astype(np.intp) + (squared <= 4) + (squared <= 1)
        return np.asarray(np.array([0.0, *self.price])[which].sum(axis=1, where=inside))


Steps = tuple[np.ndarray, np.ndarray]


def _steps(population: Population, cols: int) -> tuple[Steps, Steps, np.ndarray]:
    """Return the step into every node and the one out of it, as rows and columns, and which of them there are."""
    row, col = np.divmod(population.astype(np.int64), cols)
    dr, dc = np.diff(row), np.diff(col)
    return (dr[:, :-1], dc[:, :-1]), (dr[:, 1:], dc[:, 1:]), population[:, 2:] >= 0
