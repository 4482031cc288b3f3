"""Random initialisation, as plain genetic algorithms on grids have it."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Population, Problem, Sampling, Whole, compiled, count
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class RandomWalk(Sampling):
    """Walk at random over free cells until the goal is met, and cut out the loops.

    Slow on large maps, which is what papers hold against random initialisation.
    """

    source: ClassVar[str] = "Holland 1975; common practice on grids"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    steps: Whole = 0
    """Steps after which a walk is given up; 0: 100 times the number of free cells."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        steps = self.steps or 100 * (len(it.reachable_cells) + 2)
        found, failed = compiled.walks.sample_by_walking(
            n, steps, it.start, it.goal, it.moves, it.cols, rng.bit_generator.random_raw(4)
        )
        count("samples failed", failed)
        return np.asarray(found)
