"""Section 4.3.2: single-point crossover at a common node."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Crossover, Indices, Population, Problem, Share
from pathloom.paths.exchange import exchange_tails
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class CommonNode(Crossover):
    """Exchange the tails behind a random node that both parents visit; without one, keep the parents."""

    source: ClassVar[str] = "Li et al. 2021, section 4.3.2"
    works_on: ClassVar[str] = "cells"

    rate: Share = 0.8
    loops: bool = False
    """Keep loops that the exchange creates; section 3.3 forbids them."""

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return exchange_tails(population, pairs, path_problem(problem), rng, loops=self.loops)
