"""Section 3.4.3: mutation between two points."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Indices, Mutation, Population, Problem, Share, Whole
from pathloom.paths.insertion import mutate_between
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class TwoPointMidpoint(Mutation):
    """Delete what lies between two random genes, and join them by inserting midpoints.

    The two are drawn so that at least one gene lies between them. A path that
    cannot be joined stays.
    """

    source: ClassVar[str] = "Liu et al. 2024, section 3.4.3"
    works_on: ClassVar[str] = "cells"

    rate: Share = 0.05
    reach: Literal[4, 8] = 8
    """Among how many neighbours a midpoint in an obstacle gives way."""
    tries: Count = 10
    """How many pairs of genes are drawn until two can be joined. Not in the paper."""
    insertions: Whole = 0
    """Most insertions; 0: 4 (height + width). Not in the paper."""
    loops: bool = False
    """Keep loops that the mutation creates; section 3.5 cuts them out later."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return mutate_between(
            population, chosen, path_problem(problem), rng, beyond=False,
            tries=self.tries, insertions=self.insertions, reach=self.reach, loops=self.loops,
        )  # fmt: skip
