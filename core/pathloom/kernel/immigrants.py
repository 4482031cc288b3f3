"""Random immigrants: newcomers from outside in place of the chosen."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom.kernel.operators import Indices, Mutation, Sampling
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population


@dataclass(frozen=True, kw_only=True)
class RandomImmigrants(Mutation):
    """Replace the chosen by new individuals of a sampling (Grefenstette 1992)."""

    source: ClassVar[str] = "Grefenstette 1992, Genetic algorithms for changing environments"

    sampling: Sampling
    """Where they come from."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        if len(chosen) == 0:
            return population
        new = self.sampling.sample(problem, len(chosen), rng)
        return problem.representation.replaced(population, chosen[: len(new)], new)
