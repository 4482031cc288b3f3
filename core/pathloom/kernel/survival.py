"""Survival that no paper owns."""

from dataclasses import dataclass

import numpy as np

from pathloom.kernel.component import Count
from pathloom.kernel.operators import Indices, Survival
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Deme


def replaced(deme: Deme, places: Indices, other: Deme, rows: Indices, problem: Problem) -> Deme:
    """Return the deme with individuals of another one, ``rows`` (k,), in some of its places (k,)."""
    values, fitness = deme.values.copy(), deme.fitness.copy()
    values[places], fitness[places] = other.values[rows], other.fitness[rows]
    population = problem.representation.replaced(deme.population, places, other.population[rows])
    return Deme(population, values, fitness)


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
        elites = min(self.elites, len(parents), len(children))
        if elites == 1:
            best, worst = np.array([parents.fitness.argmax()]), np.array([children.fitness.argmin()])
        else:
            best = np.argsort(-parents.fitness, kind="stable")[:elites]
            worst = np.argsort(children.fitness, kind="stable")[:elites]
        return replaced(children, worst, parents, best, problem)


@dataclass(frozen=True, kw_only=True)
class BestOfBoth(Survival):
    """Parents and children compete; the fittest of both make up the next generation."""

    def survive(self, parents: Deme, children: Deme, problem: Problem, rng: np.random.Generator) -> Deme:
        population = problem.representation.stack(parents.population, children.population)
        values = np.concatenate((parents.values, children.values))
        fitness = np.concatenate((parents.fitness, children.fitness))
        best = np.argsort(-fitness, kind="stable")[: len(parents)]
        return Deme(population[best], values[best], fitness[best])
