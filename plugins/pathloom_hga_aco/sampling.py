"""Section 5.3: the first population, of which the paper says nothing."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import NonNegative, Population, Problem, Sampling, compiled
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class GuidedWalk(Sampling):
    """Walk at random, drawn to the goal, to no cell twice; step back where there is no way on.

    A walk is that of an ant which finds no pheromone. It always arrives.
    """

    source: ClassVar[str] = "not in Song et al. 2021, section 5.3; the walk of their ants, eq. (29)"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    pull: NonNegative = 2.0
    """k: a step that leads to a distance d from the goal is drawn in proportion to exp(-k d), d in cells."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        return np.asarray(
            compiled.guided.sample_by_guided_walks(
                n, it.start, it.goal, self.pull, it.moves, it.cols, rng.bit_generator.random_raw(4)
            )
        )
