"""String pulling: every path pulled taut around what it passes."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Population, Problem, Repair, Whole, compiled
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class StringPulling(Repair):
    """Drop points whose neighbours see each other, and move the others to where they lengthen the path least.

    A point moves from cell to neighbouring cell as long as both segments stay
    free and get shorter together: the path ends up taut, on the same side of
    every obstacle that it cannot jump over within a cell.
    """

    source: ClassVar[str] = "after the taut strings of Lee and Preparata 1984; cell by cell, our own"
    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    sweeps: Whole = 20
    """How many times all points of a path are moved, at most; 0: points are only dropped."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        return np.asarray(compiled.tightening.pulled(population, it.blocked, it.cols, it.policy, self.sweeps))
