"""Survival that no paper owns."""

from dataclasses import dataclass

import numpy as np

from pathloom.kernel.component import Count
from pathloom.kernel.operators import Survival
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Deme


@dataclass(frozen=True, kw_only=True)
class Replacement(Survival):
    """The children replace their parents."""

    def survive(self, parents: Deme, children: Deme, problem: Problem, rng: np.random.Generator) -> Deme:
        return children


@dataclass(frozen=True, kw_only=True)
class KeepBest(Survival):
    """The children replace their parents, but the best parents take the places of the worst children."""

    elites: Count = 1
    """How many parents are kept."""

    def survive(self, parents: Deme, children: Deme, problem: Problem, rng: np.random.Generator) -> Deme:
        elites = min(self.elites, len(parents))
        best = np.argsort(-parents.fitness, kind="stable")[:elites]
        kept = np.argsort(-children.fitness, kind="stable")[: len(children) - elites]
        stack = problem.representation.stack
        return Deme(
            stack(parents.population[best], children.population[kept]),
            np.concatenate((parents.values[best], children.values[kept])),
            np.concatenate((parents.fitness[best], children.fitness[kept])),
        )


@dataclass(frozen=True, kw_only=True)
class BestOfBoth(Survival):
    """Parents and children compete; the fittest of both make up the next generation."""

    def survive(self, parents: Deme, children: Deme, problem: Problem, rng: np.random.Generator) -> Deme:
        population = problem.representation.stack(parents.population, children.population)
        values = np.concatenate((parents.values, children.values))
        fitness = np.concatenate((parents.fitness, children.fitness))
        best = np.argsort(-fitness, kind="stable")[: len(parents)]
        return Deme(population[best], values[best], fitness[best])
