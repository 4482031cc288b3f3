"""Variation: how offspring is made of selected parents, in one place for all planners that do so."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from pathloom.kernel.evaluation import Floats, Terms
from pathloom.kernel.operators import Crossover, Indices, Mutation, Repair
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population


class Variation(NamedTuple):
    """The operators that vary, in the order in which they act."""

    crossover: Crossover | None
    mutation: Mutation | None
    repair: Repair | None

    def serving(self, objectives: Terms) -> "Variation":
        """Return the operators as they serve a planner with these objectives."""
        crossover, mutation, repair = self
        return Variation(
            crossover and crossover.serving(objectives),
            mutation and mutation.serving(objectives),
            repair and repair.serving(objectives),
        )

    def offspring(
        self, population: Population, fitness: Floats, pair: Callable[[], Indices], problem: Problem, progress: float,
        rng: np.random.Generator,
    ) -> Population:  # fmt: skip
        """Return the offspring of selected parents; ``fitness`` (n,) is theirs, ``pair`` gives pairs (k, 2) of rows."""
        crossover, mutation, repair = self
        if crossover is not None:
            pairs = pair()
            crossed = rng.random(len(pairs)) < _pair_rates(crossover, pairs, fitness, progress)
            population = crossover.cross(population, pairs[crossed], problem, rng)
        if mutation is not None:
            # A child is mutated with the rate of the parent whose row it took: its own fitness is not known yet.
            adaptive = mutation.probability is not None
            rates = mutation.rates(fitness, progress) if adaptive else mutation.rate
            mutated = rng.random(len(population)) < rates
            population = mutation.apply(population, mutated.nonzero()[0], problem, rng)
        if repair is not None:
            population = repair.apply(population, problem, rng)
        return population


def _pair_rates(crossover: Crossover, pairs: Indices, fitness: Floats, progress: float) -> Floats | float:
    """Return how likely each pair is to be crossed: the rate of its fitter parent."""
    if crossover.probability is None:
        return crossover.rate
    first, second = pairs[:, 0], pairs[:, 1]
    fitter = np.where(fitness[first] >= fitness[second], first, second)
    return np.asarray(crossover.rates(fitness, progress)[fitter])
