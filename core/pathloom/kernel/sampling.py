"""Sampling that no paper owns."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pathloom.kernel.component import NonNegative
from pathloom.kernel.operators import Sampling
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.kernel.shares import check_shares, cumulative


@dataclass(frozen=True, kw_only=True)
class Mixed(Sampling):
    """Shares of the first population from several samplings.

    Who has a share has one individual at least, where there are enough. What one
    of them cannot supply, the next ones make up for.
    """

    parts: tuple[Sampling, ...]
    """The samplings, in order."""
    shares: tuple[NonNegative, ...] = ()
    """One for each part, in any unit; empty: equal shares."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_shares(self.name, self.parts, self.shares, "sampling")
        # What all of them give is given, and what one of them works on is needed.
        object.__setattr__(self, "gives", frozenset.intersection(*(part.gives for part in self.parts)))

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        due = np.cumsum(self._sizes(n))  # how many there are to be after each part
        population: Population | None = None
        for part, wanted in zip(self.parts, due.tolist(), strict=True):
            there = 0 if population is None else len(population)
            drawn = part.sample(problem, wanted - there, rng) if wanted > there or population is None else None
            if drawn is not None:
                population = drawn if population is None else problem.representation.stack(population, drawn)
        assert population is not None
        return population

    def _sizes(self, n: int) -> NDArray[np.int64]:
        """Return how many individuals (k,) each of k parts is to make of n."""
        until = cumulative(self.parts, self.shares)
        ends = np.rint(n * until).astype(np.int64)
        sizes = ends - np.concatenate(([0], ends[:-1]))
        left_out = (sizes == 0) & (np.diff(until, prepend=0.0) > 0.0)
        for part in left_out.nonzero()[0]:
            if sizes.max() > 1:
                sizes[sizes.argmax()] -= 1
                sizes[part] = 1
        return sizes
