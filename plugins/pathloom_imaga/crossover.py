"""Section 2.4: single-point crossover."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import msgspec
import numpy as np

from pathloom import Crossover, Indices, Population, Problem
from pathloom.paths.exchange import exchange_at_position
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class PositionalSinglePoint(Crossover):
    """Cut both parents at the same position and exchange the tails; join each child by median insertion.

    In the paper's example the parents are equally long, so that the joint fits by
    itself; paths seldom are. The position is one inside the shorter parent.
    """

    name: ClassVar[str] = "single-point"
    source: ClassVar[str] = "Zhang et al. 2023, section 2.4, fig. 7"
    works_on: ClassVar[str] = "cells"

    reach: Literal[4, 8] = 4
    """Neighbours among which a midpoint in an obstacle gives way, as in the paper's sampling."""
    insertions: Annotated[int, msgspec.Meta(ge=-1)] = -1
    """Most insertions at the joint; −1: 4 (height + width). Not in the paper."""
    loops: bool = False
    """Keep loops that the exchange creates. Not in the paper."""

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return exchange_at_position(
            population, pairs, path_problem(problem), rng,
            insertions=self.insertions, reach=self.reach, loops=self.loops,
        )  # fmt: skip
