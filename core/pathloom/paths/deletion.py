"""Deletion of points whose neighbours see each other."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Whole
from pathloom.kernel.operators import Repair
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.cell_paths import Path
from pathloom.paths.collision import Collision, Exact
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


def delete_points(population: Population, problem: PathProblem, collision: Collision, passes: int) -> Population:
    """Drop, along each path, every interior point whose neighbours see each other.

    A point that is dropped leaves its predecessor to look at the next one. By
    the triangle inequality a path never gets longer; nor does it get more turns,
    since a point only stays where the path bends behind the one kept before it.
    ``passes``: how often; 0: until nothing changes.
    """
    if type(collision) is Exact:  # a class that inherits from it may test otherwise
        it = problem.context
        return np.asarray(compiled.segments.delete_points(population, it.blocked, it.cols, it.policy, passes))
    decode = problem.representation.decode
    return problem.representation.encode([_shortened(decode(row), problem, collision, passes) for row in population])


def _shortened(path: Path, problem: PathProblem, collision: Collision, passes: int) -> Path:
    done = 0
    while passes == 0 or done < passes:
        kept = [path[0]]
        for i in range(1, len(path) - 1):
            if not collision.free(kept[-1], path[i + 1], problem):
                kept.append(path[i])
        shorter = np.array([*kept, path[-1]] if len(path) > 1 else kept)
        done += 1
        if len(shorter) == len(path):
            break
        path = shorter
    return path


@dataclass(frozen=True, kw_only=True)
class PointDeletion(Repair):
    """Drop every interior point when the segment between its neighbours is free."""

    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    collision: Collision = Exact()
    """Test of the segment that would take the place of the point."""
    passes: Whole = 1
    """How many times along the path; 0: until nothing changes."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        return delete_points(population, path_problem(problem), self.collision, self.passes)
