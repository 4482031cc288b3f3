"""Repair of detours."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Population, Problem, Repair, compiled
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class DetourRemoval(Repair):
    """Cut out whatever lies between two nodes of a path that are one step apart, loops included."""

    source: ClassVar[str] = "our reconstruction from one sentence in Li et al. 2021, section 5.2"
    works_on: ClassVar[str] = "cells"

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        return np.asarray(compiled.crossing.without_detours(population, it.moves, it.cols))
