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

    def first_of_each(self, population: Population) -> NDArray[np.intp]:
        """Return, in order, the index of the first of each distinct individual."""
        return np.sort(np.unique(population, axis=0, return_index=True)[1])

    def newcomers(self, population: Population, before: Population) -> NDArray[np.intp]:
        """Return, in order, the index of the first of each distinct individual that was not there before."""
        known = {row.tobytes() for row in before}
        first = self.first_of_each(population)
        return first[[population[k].tobytes() not in known for k in first]]
