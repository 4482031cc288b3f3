"""Repair that no paper owns."""

from dataclasses import dataclass

import numpy as np

from pathloom.kernel.operators import Repair
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population


@dataclass(frozen=True, kw_only=True)
class InTurn(Repair):
    """Several repairs, one after the other."""

    steps: tuple[Repair, ...] = ()
    """The repairs, in order."""

    def __post_init__(self) -> None:
        super().__post_init__()
        # What one of the steps loses is lost, and what one of them needs is needed.
        for name in ("breaks", "needs"):
            of_all = frozenset().union(*(getattr(step, name) for step in self.steps))
            object.__setattr__(self, name, of_all)

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        for step in self.steps:
            population = step.apply(population, problem, rng)
        return population
