"""Algorithm 2: a path goes straight on to the last of its points in sight."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import Collision, Population, Problem, Repair, compiled
from pathloom.paths.cell_paths import cells_of
from pathloom.paths.collision import Exact
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class GreedyParentShortcut(Repair):
    """Go from the start to the last point of the path in sight, from there to the last one in sight, and so on.

    The algorithm is printed with one collision test twice and two meanings of
    X_init. The text settles what is meant (section 4.2): from the far end back,
    parent by parent, until one is found that the point at hand sees; that one is
    the next to stand on.
    """

    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})
    source: ClassVar[str] = "Song et al. 2021, section 4.2, algorithm 2"

    collision: Collision = Exact()
    """Says whether two points see each other; what the exact test finds blocked is out of sight in any case."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        if type(self.collision) is Exact:
            on = it.context
            return np.asarray(compiled.trees.straightened_paths(population, on.blocked, on.cols, on.policy))
        return it.representation.encode([self._straightened(row[row >= 0], it) for row in population])

    def _straightened(self, ids: NDArray[np.int32], problem: PathProblem) -> NDArray[np.int64]:
        cells = cells_of(ids, problem.context.cols)
        kept = [0]
        while (at := kept[-1]) < len(cells) - 1:
            ahead = cells[at + 2 :]
            here = np.broadcast_to(cells[at], ahead.shape)
            seen = self.collision.segments_free(here, ahead, problem) & Exact().segments_free(here, ahead, problem)
            kept.append(at + 2 + int(np.flatnonzero(seen)[-1]) if seen.any() else at + 1)
        return cells[kept]
