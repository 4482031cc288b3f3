"""Band search: the shortest path through the neighbourhoods of a path's points."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Count, Population, Problem, Repair, compiled
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class BandSearch(Repair):
    """Move all points of a path at once, each within its neighbourhood, to where the path is shortest.

    Dynamic programming over one layer of cells a point, a point being passed
    over or doubled where that is shorter; then superfluous points are dropped
    and it begins anew, until nothing gets shorter.
    """

    source: ClassVar[str] = "our own"
    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    radius: Count = 2
    """How many rows and columns a neighbourhood reaches."""
    rounds: Count = 5
    """How often it begins anew, at most."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        return np.asarray(
            compiled.tightening.through_band(population, it.blocked, it.cols, it.policy, self.radius, self.rounds)
        )
