"""Survival that no paper owns."""

from dataclasses import dataclass

import numpy as np

from pathloom.kernel.component import Count
from pathloom.kernel.operators import Indices, Survival
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Deme


def replaced(deme: Deme, places: Indices | slice, other: Deme, rows: Indices | slice, problem: Problem) -> Deme:
    """Return the deme with individuals of another one, k ``rows``, in k of its places."""
    values, fitness = deme.values.copy(), deme.fitness.copy()
    values[places], fitness[places] = other.values[rows], other.fitness[rows]
    where = np.arange(len(deme))[places] if isinstance(places, slice) else places
    population = problem.representation.replaced(deme.population, where, other.population[rows])
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
        if elites == 1:  # the usual number, without sorting
            best, worst = int(parents.fitness.argmax()), int(children.fitness.argmin())
            return replaced(children, slice(worst, worst + 1), parents, slice(best, best + 1), problem)
        ranked = np.argsort(-parents.fitness, kind="stable")
        return replaced(
            children, np.argsort(children.fitness, kind="stable")[:elites], parents, ranked[:elites], problem
        )


@dataclass(frozen=True, kw_only=True)
class BestOfBoth(Survival):
    """Parents and children compete; the fittest of both make up the next generation."""

    distinct: bool = False
    """Let equal individuals in only where there are not enough others."""

    def survive(self, parents: Deme, children: Deme, problem: Problem, rng: np.random.Generator) -> Deme:
        population = problem.representation.stack(parents.population, children.population)
        values = np.concatenate((parents.values, children.values))
        fitness = np.concatenate((parents.fitness, children.fitness))
        best = np.argsort(-fitness, kind="stable")
        if self.distinct:
            first, _ = problem.representation.distinct(population.take(best, 0))
            again = np.ones(len(best), np.bool_)
            again[first] = False
            best = np.concatenate((best[first], best[again]))
        best = best[: len(parents)]
        return Deme(population[best], values[best], fitness[best])
