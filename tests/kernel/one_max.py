"""A plugin of thirty lines: bit strings with as many ones as possible."""

from dataclasses import dataclass

import numpy as np

import pathloom as pl


@dataclass(frozen=True, kw_only=True)
class Bits(pl.Representation):
    def decode(self, row):
        return "".join("01"[bit] for bit in row)


@dataclass(frozen=True, kw_only=True)
class OneMax(pl.Problem):
    size: pl.Count = 40
    representation = Bits()


@dataclass(frozen=True, kw_only=True)
class RandomBits(pl.Sampling):
    works_on = "bits"

    def sample(self, problem, n, rng):
        return rng.integers(0, 2, size=(n, problem.size), dtype=np.int8)


@dataclass(frozen=True, kw_only=True)
class Zeros(pl.Objective):
    def measure(self, population, problem):
        return (population == 0).sum(axis=1)


@dataclass(frozen=True, kw_only=True)
class Uniform(pl.Crossover):
    def cross(self, population, pairs, problem, rng):
        children = population.copy()
        swap = rng.random((len(pairs), population.shape[1])) < 0.5
        a, b = population[pairs[:, 0]], population[pairs[:, 1]]
        children[pairs[:, 0]], children[pairs[:, 1]] = np.where(swap, b, a), np.where(swap, a, b)
        return children


@dataclass(frozen=True, kw_only=True)
class Flip(pl.Mutation):
    def apply(self, population, chosen, problem, rng):
        children = population.copy()
        children[chosen, rng.integers(population.shape[1], size=len(chosen))] ^= 1
        return children


@pl.hookimpl
def register(add):
    for component in (OneMax, RandomBits, Zeros, Uniform, Flip):
        add(component)
