"""Representation: how individuals are written in one array, a row each."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pathloom.kernel.component import Component

Population: TypeAlias = NDArray[Any]
"""Individuals as the rows of an array (n, width); what a row means, the representation says."""


@dataclass(frozen=True, kw_only=True)
class Representation(Component, ABC):
    """The meaning of a population's rows, and the few things a loop must do to them."""

    kind: ClassVar[str] = "representation"

    @abstractmethod
    def decode(self, row: NDArray[Any]) -> Any:
        """Return the individual that a row (width,) stands for."""

    def stack(self, first: Population, second: Population) -> Population:
        """Return the rows of both populations in one."""
        return np.concatenate((first, second))

    def replaced(self, population: Population, places: NDArray[np.intp], rows: Population) -> Population:
        """Return the population with other individuals, ``rows`` (k, width), in some of its places (k,)."""
        out = population.copy()
        out[places] = rows
        return out

    def distinct(self, population: Population) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return the indices (d,) of the first of each distinct individual, and for every row which of those it is."""
        _, first, which = np.unique(population, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(first)
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        return first[order], place[which.ravel()]

    def newcomers(self, population: Population, before: Population) -> NDArray[np.intp]:
        """Return, in order, the indices of the individuals, distinct ones, that were not there before."""
        known = {row.tobytes() for row in before}
        return np.array([k for k, row in enumerate(population) if row.tobytes() not in known], np.intp)
