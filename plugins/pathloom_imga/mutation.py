"""Section 4.3.3: mutation of a single node within its eight neighbours."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import Indices, Mutation, Population, Problem, Share
from pathloom.paths.insertion import mutate_neighbour
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class D8GeneMedian(Mutation):
    """Move a random interior node to a random free neighbour and join both sides by median insertion.

    A node that has no such neighbour, or cannot be joined, stays: the paper then
    goes on to the next individual.
    """

    source: ClassVar[str] = "Li et al. 2021, section 4.3.3"
    works_on: ClassVar[str] = "cells"

    rate: Share = 0.2
    insertions: Annotated[int, msgspec.Meta(ge=-1)] = -1
    """Most insertions on each side; −1: 4 (height + width). Not in the paper."""
    loops: bool = False
    """Keep loops that the mutation creates; section 3.3 forbids them."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        return mutate_neighbour(population, chosen, it, rng, insertions=self.insertions, loops=self.loops)
