"""Section 3.4.2: crossover at a common gene."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Crossover, Indices, Population, Problem, Share, compiled
from pathloom.paths.exchange import exchange_tails
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class CommonNode(Crossover):
    """Exchange the tails behind a random gene that both parents have; without one, keep the parents."""

    source: ClassVar[str] = "Liu et al. 2024, section 3.4.2"
    works_on: ClassVar[str] = "cells"

    rate: Share = 0.8
    loops: bool = False
    """Keep loops that the exchange creates; section 3.5 cuts them out later."""
    densify: bool = False
    """Cross the parents written cell by cell. Not in the paper: its deletion of points, in each generation, leaves few
    genes that two parents could have in common."""

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        if not self.densify:
            return exchange_tails(population, pairs, it, rng, loops=self.loops)
        stack = it.representation.stack
        dense = compiled.reshaping.cell_by_cell(population, it.context.cols)
        children = exchange_tails(dense, pairs, it, rng, loops=self.loops)
        n = len(population)
        both = stack(dense, children)
        crossed = (both[:n] != both[n:]).any(axis=1)
        return np.ascontiguousarray(stack(population, children)[np.arange(n) + n * crossed])
