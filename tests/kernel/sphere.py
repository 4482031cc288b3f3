"""A plugin of thirty lines: the point nearest to the origin."""

from dataclasses import dataclass

import pathloom as pl


@dataclass(frozen=True, kw_only=True)
class Reals(pl.Representation):
    def decode(self, row):
        return row


@dataclass(frozen=True, kw_only=True)
class Space(pl.Problem):
    dimensions: pl.Count = 5
    representation = Reals()


@dataclass(frozen=True, kw_only=True)
class InABox(pl.Sampling):
    side: pl.Positive = 10.0

    def sample(self, problem, n, rng):
        return self.side * (rng.random((n, problem.dimensions)) - 0.5)


@dataclass(frozen=True, kw_only=True)
class SquaredDistance(pl.Objective):
    works_on = "reals"

    def measure(self, population, problem):
        return (population**2).sum(axis=1)


@dataclass(frozen=True, kw_only=True)
class Blend(pl.Crossover):
    def cross(self, population, pairs, problem, rng):
        children = population.copy()
        share = rng.random((len(pairs), 1))
        a, b = population[pairs[:, 0]], population[pairs[:, 1]]
        children[pairs[:, 0]], children[pairs[:, 1]] = share * a + (1 - share) * b, (1 - share) * a + share * b
        return children


@dataclass(frozen=True, kw_only=True)
class Jitter(pl.Mutation):
    sigma: pl.NonNegative = 0.3

    def apply(self, population, chosen, problem, rng):
        children = population.copy()
        children[chosen] += self.sigma * rng.standard_normal((len(chosen), population.shape[1]))
        return children


@pl.hookimpl
def register(add):
    for component in (Space, InABox, SquaredDistance, Blend, Jitter):
        add(component)
