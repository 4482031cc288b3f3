"""Section 5.3.2: single-point crossover that looks for a gene which both parents have."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Crossover, Indices, Population, Problem, Share, compiled
from pathloom.paths.exchange import exchange_at_position, exchange_tails
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class SinglePointGeneAware(Crossover):
    """Exchange the tails behind a random cell that both parents visit, or else behind a random position.

    The paper does not say how tails are joined that begin apart: here by median
    insertion, and where that fails the parent stays. That the best of parents and
    offspring go on is the business of the control ``family-competition``.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.3.2, fig. 8"
    works_on: ClassVar[str] = "cells"

    rate: Share = 0.8
    reach: Literal[4, 8] = 8
    """Among how many neighbours a midpoint in an obstacle gives way."""

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        pairs = np.ascontiguousarray(pairs)
        common = compiled.guided.meet(population, pairs, it.context.blocked.size)
        children = exchange_tails(population, pairs[common], it, rng)
        if common.all():
            return children
        return exchange_at_position(children, pairs[~common], it, rng, insertions=-1, reach=self.reach)
