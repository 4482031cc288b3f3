"""Decoders: real vectors, as swarms move them, read as paths."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.kernel.component import Component, Count
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.representation import Population
from pathloom.paths.context import Context
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class Decoder(Component, ABC):
    """What a vector of genes in [0, 1] says: a way from start to goal, which may collide.

    A gene is a place along one of the map's two axes: 0 is the outer border of the
    first row or column, 1 that of the last.
    """

    kind: ClassVar[str] = "decoder"
    works_on: ClassVar[str] = "cells"
    limits: ClassVar[str] = ""
    """What it cannot say, as the end of a sentence that says that nothing was found."""

    @abstractmethod
    def straight(self, problem: PathProblem) -> Floats:
        """Return the genes (d,) of the straight way, which may be none at all."""

    @abstractmethod
    def axes(self, problem: PathProblem) -> NDArray[np.intp]:
        """Return of each gene (d,) whether it is a place among the rows, 0, or the columns, 1."""

    @abstractmethod
    def decode(self, genes: Floats, problem: PathProblem) -> Population:
        """Return the paths (n, width) of genes (n, d); their width does not depend on the genes."""


@dataclass(frozen=True, kw_only=True)
class Rows(Decoder):
    """One gene for each row strictly between start and goal: the column in which the path crosses it.

    Columns and rows change places where start and goal lie further apart in
    columns. A path that ever has to turn back cannot be said in this way.
    """

    source: ClassVar[str] = "common practice on grids"
    limits: ClassVar[str] = "; one gene a row can only say paths that never turn back"

    def straight(self, problem: PathProblem) -> Floats:
        it = problem.context
        points = _between(it, _lines(it))
        return points[:, 1] if _by_rows(it) else points[:, 0]

    def axes(self, problem: PathProblem) -> NDArray[np.intp]:
        it = problem.context
        return np.full(_lines(it), 1 if _by_rows(it) else 0)

    def decode(self, genes: Floats, problem: PathProblem) -> Population:
        it = problem.context
        return np.asarray(
            compiled.decoding.through_lines(_packed(genes), it.start, it.goal, it.rows, it.cols, _by_rows(it))
        )


@dataclass(frozen=True, kw_only=True)
class Waypoints(Decoder):
    """Row and column of some points anywhere on the map, which the path visits in their order.

    A point is read as the cell that it lies in; two in one cell count as one.
    """

    source: ClassVar[str] = "common practice"

    count: Count = 6
    """Number of points between start and goal, half the number of genes."""

    def straight(self, problem: PathProblem) -> Floats:
        return _between(problem.context, self.count).ravel()

    def axes(self, problem: PathProblem) -> NDArray[np.intp]:
        return np.arange(2 * self.count) % 2

    def decode(self, genes: Floats, problem: PathProblem) -> Population:
        it = problem.context
        return np.asarray(compiled.decoding.through_points(_packed(genes), it.start, it.goal, it.rows, it.cols))


def _packed(genes: Floats) -> Floats:
    return np.ascontiguousarray(genes, np.float64)


def _by_rows(it: Context) -> bool:
    """Whether start and goal lie at least as far apart in rows as in columns."""
    return abs(it.goal // it.cols - it.start // it.cols) >= abs(it.goal % it.cols - it.start % it.cols)


def _lines(it: Context) -> int:
    """Return the number of rows strictly between start and goal, or of columns where those are more."""
    apart = abs(it.goal // it.cols - it.start // it.cols), abs(it.goal % it.cols - it.start % it.cols)
    return max(*apart, 1) - 1


def _between(it: Context, count: int) -> Floats:
    """Return points (count, 2), evenly spaced from start to goal, as shares of height and width."""
    ends = np.array([divmod(it.start, it.cols), divmod(it.goal, it.cols)])
    share = np.arange(1, count + 1)[:, np.newaxis] / (count + 1)
    return np.asarray((ends[0] + share * (ends[1] - ends[0]) + 0.5) / (it.rows, it.cols))


def violations(paths: Population, problem: PathProblem) -> Floats:
    """Return how far each path is from being legal, (n,): 0 where it is, and nowhere else.

    Its length inside obstacles, in cells, plus the number of its segments that
    the exact test refuses.
    """
    it = problem.context
    return np.asarray(compiled.decoding.violations(paths, it.blocked, it.cols, it.policy))
