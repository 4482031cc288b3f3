"""Section 2.4: mutation of a single node within its four neighbours."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import Indices, Mutation, Population, Problem
from pathloom.paths.insertion import mutate_neighbour
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class D4GeneMedian(Mutation):
    """Move a random interior node to a free one of its 4 neighbours, eqs. (21) and (22), and join both sides.

    The paper draws neighbours until one is free, or a number of tries is over;
    drawing among the free ones alone is the same without the tries.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.4, eqs. (21) and (22)"
    works_on: ClassVar[str] = "cells"

    insertions: Annotated[int, msgspec.Meta(ge=-1)] = -1
    """Most insertions on each side; −1: 4 (height + width). Not in the paper."""
    loops: bool = False
    """Keep loops that the mutation creates. Not in the paper."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        return mutate_neighbour(population, chosen, it, rng, insertions=self.insertions, reach=4, loops=self.loops)
