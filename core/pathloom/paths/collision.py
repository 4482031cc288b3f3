"""Collision: whether the straight segment between two cells is free."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom import compiled
from pathloom.kernel.component import Component
from pathloom.paths.cell_paths import flat_ids
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class Collision(Component, ABC):
    """A test of segments between cell centres."""

    kind: ClassVar[str] = "collision"

    @abstractmethod
    def segments_free(self, a: NDArray[Any], b: NDArray[Any], problem: PathProblem) -> NDArray[np.bool_]:
        """Return for each of k segments from a (k, 2) to b (k, 2), cells, whether it is free: (k,)."""

    def free(self, a: ArrayLike, b: ArrayLike, problem: PathProblem) -> bool:
        """Say whether the segment between two cells (row, column) is free."""
        return bool(self.segments_free(np.asarray([a]), np.asarray([b]), problem)[0])


@dataclass(frozen=True, kw_only=True)
class Exact(Collision):
    """The exact test in integers, under the problem's corner policy."""

    def segments_free(self, a: NDArray[Any], b: NDArray[Any], problem: PathProblem) -> NDArray[np.bool_]:
        it = problem.context
        first = flat_ids(a, it.cols)
        second = flat_ids(b, it.cols)
        return np.asarray(compiled.segments.segments_free(it.blocked, it.cols, first, second, it.policy))
