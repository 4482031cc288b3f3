"""Gene pool: one child of all parents, the shortest path over the points of every one."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import Population, Problem, Repair, Whole, compiled
from pathloom.kernel.component import MOST
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class GenePool(Repair):
    """Put in place of the longest path the shortest one over the points of all paths, and cells near them.

    Recombination of the whole population at once, and the best there is: any two
    points that see each other may follow one another.
    """

    source: ClassVar[str] = "Mühlenbein and Voigt 1995, Gene pool recombination in genetic algorithms"
    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    halo: Whole = 2
    """How many rows and columns around a point belong to the pool as well."""
    room: Annotated[int, msgspec.Meta(ge=2, le=MOST)] = 20_000
    """The most cells that the pool holds; those near the shortest paths come first."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        if len(population) == 0:
            return population
        it = path_problem(problem).context
        lengths = compiled.measures.lengths(population, it.cols)
        order = np.argsort(lengths, kind="stable")
        child = compiled.pooling.pooled(population, order, it.blocked, it.cols, it.policy, self.halo, self.room)
        return problem.representation.replaced(population, order[-1:], child[np.newaxis])
