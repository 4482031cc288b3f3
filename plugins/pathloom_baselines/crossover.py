"""Single-point crossover, as plain genetic algorithms on grids have it."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Crossover, Indices, Population, Problem
from pathloom.paths.exchange import exchange_tails
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class SinglePoint(Crossover):
    """Exchange the tails at a random node that both parents visit: a cut elsewhere would not join up."""

    source: ClassVar[str] = "Holland 1975; common practice on grids"
    works_on: ClassVar[str] = "cells"

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return exchange_tails(population, pairs, path_problem(problem), rng)
