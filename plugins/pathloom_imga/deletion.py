"""Section 4.5: the delete operation."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Collision, Population, Problem, Repair, Whole
from pathloom.paths.collision import Exact
from pathloom.paths.deletion import delete_points
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class SequentialPointDeletion(Repair):
    """Delete, along the path, every node whose neighbours can be joined free of obstacles.

    The paper names neither the test of a segment nor the number of passes.
    """

    source: ClassVar[str] = "Li et al. 2021, section 4.5, fig. 5"
    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    collision: Collision = Exact()
    """Test of the joining segment."""
    passes: Whole = 1
    """How many times along the path; 0: until nothing changes."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        return delete_points(population, path_problem(problem), self.collision, self.passes)
