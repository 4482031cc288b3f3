"""Cell paths: the representation of paths as sequences of cells."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.kernel.component import Count
from pathloom.kernel.representation import Population, Representation

Path: TypeAlias = NDArray[np.int64]
"""(k, 2), rows and columns of k cells from start to goal."""


def flat_ids(cells: NDArray[Any], cols: int) -> NDArray[np.int32]:
    """Return the flat ids (k,) of cells (k, 2), whatever their integer type."""
    wide = cells.astype(np.int64, copy=False)
    return (wide[:, 0] * cols + wide[:, 1]).astype(np.int32)


def cells_of(ids: NDArray[Any], cols: int) -> Path:
    """Return the cells (k, 2) of flat ids (k,)."""
    wide = ids.astype(np.int64, copy=False)
    return np.stack((wide // cols, wide % cols), axis=1)


@dataclass(frozen=True, kw_only=True)
class CellPaths(Representation):
    """Paths as rows of flat cell ids, int32 (n, width), padded with −1.

    Consecutive cells are joined by straight segments between their centres.
    """

    name: ClassVar[str] = "cells"

    rows: Count
    cols: Count

    def decode(self, row: NDArray[Any]) -> Path:
        """Return the cells (k, 2) of one row."""
        return cells_of(row[row >= 0], self.cols)

    def encode(self, paths: Sequence[NDArray[np.integer[Any]]]) -> Population:
        """Return the population of some paths, each (k, 2)."""
        width = max((len(p) for p in paths), default=1)
        population = np.full((len(paths), width), -1, np.int32)
        for row, path in zip(population, paths, strict=True):
            row[: len(path)] = flat_ids(path, self.cols)
        return population

    def stack(self, first: Population, second: Population) -> Population:
        width = max(first.shape[1], second.shape[1])
        both = np.full((len(first) + len(second), width), -1, np.int32)
        both[: len(first), : first.shape[1]] = first
        both[len(first) :, : second.shape[1]] = second
        return both

    def replaced(self, population: Population, places: NDArray[np.intp], rows: Population) -> Population:
        return np.asarray(compiled.reshaping.replaced(population, places, np.ascontiguousarray(rows)))

    def distinct(self, population: Population) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        return compiled.identity.distinct(population)  # type: ignore[no-any-return]

    def newcomers(self, population: Population, before: Population) -> NDArray[np.intp]:
        return np.asarray(compiled.identity.newcomers(population, before))
