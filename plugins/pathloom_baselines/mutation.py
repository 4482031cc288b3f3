"""Mutation of a single gene, as plain genetic algorithms on grids have it."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Indices, Mutation, Population, Problem
from pathloom.paths.insertion import mutate_neighbour
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class SingleGene(Mutation):
    """Move a random interior node to a random free neighbour, if it then still joins the nodes beside it."""

    source: ClassVar[str] = "Holland 1975; common practice on grids"
    works_on: ClassVar[str] = "cells"
    needs: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return mutate_neighbour(population, chosen, path_problem(problem), rng, insertions=0)
