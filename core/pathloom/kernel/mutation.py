"""Mutation that no paper owns."""

from dataclasses import dataclass

import numpy as np

from pathloom.kernel.component import NonNegative
from pathloom.kernel.operators import Indices, Mutation
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.kernel.shares import check_shares, cumulative


@dataclass(frozen=True, kw_only=True)
class OneOf(Mutation):
    """Change each of the chosen by one of several mutations, drawn at random."""

    parts: tuple[Mutation, ...]
    """The mutations; their own rates do not count."""
    shares: tuple[NonNegative, ...] = ()
    """How often each is drawn, in any unit; empty: all the same."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_shares(self.name, self.parts, self.shares, "mutation")
        # What one of the parts loses is lost, and what one of them needs is needed.
        for name in ("breaks", "needs"):
            object.__setattr__(self, name, frozenset().union(*(getattr(part, name) for part in self.parts)))

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        drawn = np.searchsorted(cumulative(self.parts, self.shares), rng.random(len(chosen)), side="right")
        for k, part in enumerate(self.parts):
            if len(mine := chosen[drawn == k]):
                population = part.apply(population, mine, problem, rng)
        return population
