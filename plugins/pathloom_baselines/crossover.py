"""Crossover of paths on grids: tails exchanged where both parents come by."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Count, Crossover, Indices, Population, Problem, compiled, count
from pathloom.paths.exchange import exchange_tails
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class SinglePoint(Crossover):
    """Exchange the tails at a random node that both parents visit: a cut elsewhere would not join up."""

    source: ClassVar[str] = "Holland 1975; common practice on grids"
    works_on: ClassVar[str] = "cells"

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        return exchange_tails(population, pairs, path_problem(problem), rng)


@dataclass(frozen=True, kw_only=True)
class BestMeeting(Crossover):
    """Exchange the tails at every node that both parents visit, and keep the two shortest different children.

    The shortest takes the place of the first parent. Loops are cut out first.
    What MPMGA's improved crossover does is not known; this is one that improves.
    Children tried are counted, but are no evaluations: only their length is looked at.
    """

    source: ClassVar[str] = "our reconstruction of Hao et al. 2020, of which only the abstract was at hand"
    works_on: ClassVar[str] = "cells"

    points: Count = 10
    """Most common nodes that are tried, drawn at random where there are more."""
    beside: bool = True
    """Where there is no common node, exchange the tails between nodes that are one step apart."""

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        children, failed, tried = compiled.crossing.cross_where_shortest(
            population, np.ascontiguousarray(pairs), it.moves, it.cols, self.points, self.beside,
            rng.bit_generator.random_raw(4),
        )  # fmt: skip
        count("crossover without a common cell", failed)
        count("children tried", tried)
        return np.asarray(children)
