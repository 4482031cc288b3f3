"""Way-points: a path as a vector of numbers, as one writes it for a library that evolves vectors."""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pathloom.bench.peer import Answer
from pathloom.paths.problem import PathProblem

Floats = NDArray[np.float64]

POINTS = 6
"""Way-points between start and goal."""
POPULATION, GENERATIONS = 100, 200
"""Of every genetic algorithm here."""


class WayPoints:
    """Paths over so many cells, their rows and columns in one vector (2 · points).

    A path costs its length, and a penalty for every obstacle cell that it meets.
    Plain numpy, as a user's program would be, and exact.
    """

    def __init__(self, problem: PathProblem, points: int = POINTS) -> None:
        self._occupied, self._corners = problem.context.occupied, problem.corners
        self._ends = np.array(problem.ends)
        rows, cols = self._occupied.shape
        self.low = np.zeros(2 * points)
        self.high = np.tile([rows - 1.0, cols - 1.0], points)
        self._penalty: float = (rows + cols) / 4.0

    def path(self, vector: Floats) -> NDArray[np.int64]:
        """Return the cells (points + 2, 2) from start to goal, way-points rounded to cells."""
        cells = np.rint(np.clip(vector, self.low, self.high)).astype(np.int64).reshape(-1, 2)
        return np.vstack((self._ends[:1], cells, self._ends[1:]))

    def measure(self, vector: Floats) -> tuple[float, int]:
        """Return the length and the number of obstacle cells met."""
        path = self.path(vector)
        met = sum(_met(a, b, self._occupied, self._corners) for a, b in pairwise(path))
        return float(np.hypot(*np.diff(path, axis=0).T).sum()), met

    def cost(self, vector: Floats) -> float:
        """Return what is minimised."""
        length, met = self.measure(vector)
        return length + self._penalty * met

    def length(self, vector: Floats) -> float:
        """Return the length of a path that meets no obstacle; of another, inf."""
        length, met = self.measure(vector)
        return math.inf if met else length

    def answer(self, vector: Floats) -> Answer:
        """Return the path if it meets no obstacle."""
        return self.path(vector) if self.length(vector) < math.inf else None

    def first(self, n: int, rng: np.random.Generator) -> Floats:
        """Return vectors (n, 2 · points) along the straight line, scattered about it."""
        share = np.linspace(0.0, 1.0, len(self.low) // 2 + 2)[1:-1, np.newaxis]
        line = (self._ends[0] + share * (self._ends[1] - self._ends[0])).ravel()
        return np.asarray(np.clip(line + rng.normal(0.0, 0.2 * self.high.max(), (n, len(line))), self.low, self.high))


def sees(a: NDArray[np.int64], b: NDArray[np.int64], problem: PathProblem) -> bool:
    """Say whether the segment between two cells is free."""
    return not _met(a, b, problem.context.occupied, problem.corners)


def _met(a: NDArray[np.int64], b: NDArray[np.int64], occupied: NDArray[np.bool_], corners: str) -> int:
    """Return how many obstacle cells a segment crosses, or touches where it must not.

    Between two crossings of grid lines, halves of rows and columns, the segment
    is inside one cell: that of the middle. Where it crosses two lines at once it
    passes through a corner.
    """
    step = b - a
    halves = [(np.arange(n) + 0.5) / n for n in np.abs(step)]
    at = np.sort(np.concatenate(([0.0], *halves, [1.0])))
    middles = (0.5 * (at[1:] + at[:-1]))[np.diff(at) > 1e-12]
    inside = np.rint(a + middles[:, np.newaxis] * step).astype(np.int64)
    met = int(occupied[*inside.T].sum())
    if corners == "allow" or not step.all():
        return met
    through = at[1:][np.diff(at) <= 1e-12]
    corner = np.floor(a + through[:, np.newaxis] * step).astype(np.int64)
    four = [occupied[corner[:, 0] + r, corner[:, 1] + c] for r, c in ((0, 0), (1, 1), (0, 1), (1, 0))]
    touched = np.any(four, axis=0) if corners == "strict" else (four[0] & four[1]) | (four[2] & four[3])
    return met + int(touched.sum())
