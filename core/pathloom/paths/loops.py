"""Loops: what lies between two visits of one cell."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import compiled
from pathloom.kernel.operators import Repair
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class LoopRemoval(Repair):
    """Cut out whatever lies between two visits of one cell, and one of the two."""

    works_on: ClassVar[str] = "cells"

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        return np.asarray(compiled.reshaping.without_loops(population, path_problem(problem).context.blocked.size))
