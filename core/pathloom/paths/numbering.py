"""The papers' cell numbers: left to right, bottom to top. Converted here, at the edge, and nowhere else."""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.errors import ProblemError


@dataclass(frozen=True)
class Numbering:
    """Cell numbers that begin at the bottom left with ``first``, on a map of rows × cols cells.

    ``first`` 1: the labels in the figures of Li et al. 2021, Zhang et al. 2023
    and Liu et al. 2024, N = x + cols (y − 1) with x and y from 1. The formulas that
    these papers print differ from their figures and from each other. ``first`` 0:
    Hao et al. 2021, eqs. (1) and (2), p = (x − 1) + (y − 1) cols.
    """

    rows: int
    cols: int
    first: Literal[0, 1] = 1

    def cells(self, numbers: ArrayLike) -> NDArray[np.int64]:
        """Return the cells (k, 2), rows from the top and columns, of k numbers.

        Raises
        ------
        ProblemError
            If a number is none of this map's.
        """
        index = np.asarray(numbers, dtype=np.int64).ravel() - self.first
        self._check(numbers, (index >= 0) & (index < self.rows * self.cols))
        return np.stack((self.rows - 1 - index // self.cols, index % self.cols), axis=1)

    def numbers(self, cells: ArrayLike) -> NDArray[np.int64]:
        """Return the numbers (k,) of cells (k, 2).

        Raises
        ------
        ProblemError
            If a cell lies outside the map.
        """
        row, col = np.asarray(cells, dtype=np.int64).reshape(-1, 2).T
        self._check(cells, (row >= 0) & (row < self.rows) & (col >= 0) & (col < self.cols))
        return self.first + (self.rows - 1 - row) * self.cols + col

    def _check(self, found: Any, inside: NDArray[np.bool_]) -> None:
        if not inside.all():
            last = self.first + self.rows * self.cols - 1
            raise ProblemError(f"cells: found {found!r}, allowed those of the map, numbers {self.first} to {last}")
