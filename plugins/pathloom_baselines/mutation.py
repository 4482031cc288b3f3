"""Mutation, as plain genetic algorithms on grids have it: of a single gene, or between two."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Indices, Mutation, Population, Problem, Whole
from pathloom.paths.insertion import mutate_between, mutate_neighbour
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class SingleGene(Mutation):
    """Move a random interior node to a random free neighbour, if it then still joins the nodes beside it."""

    source: ClassVar[str] = "Holland 1975; common practice on grids"
    works_on: ClassVar[str] = "cells"
    needs: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return mutate_neighbour(population, chosen, path_problem(problem), rng, insertions=0)


@dataclass(frozen=True, kw_only=True)
class TwoPoint(Mutation):
    """Delete the nodes from one random interior position to another, and join the ends by median insertion."""

    source: ClassVar[str] = "common practice on grids"
    works_on: ClassVar[str] = "cells"

    tries: Count = 20
    """How many pairs of positions are drawn until the ends can be joined; then the parent stays."""
    insertions: Whole = 0
    """Most insertions; 0: 4 (height + width)."""
    reach: Literal[4, 8] = 8
    """Among how many neighbours a midpoint in an obstacle gives way."""
    loops: bool = False
    """Keep whatever lies between two visits of one cell."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return mutate_between(
            population, chosen, path_problem(problem), rng, beyond=True,
            tries=self.tries, insertions=self.insertions, reach=self.reach, loops=self.loops,
        )  # fmt: skip
