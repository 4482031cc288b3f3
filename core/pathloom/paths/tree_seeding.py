"""Perturbed trees: diverse feasible paths on any map, at any size."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Count, Positive
from pathloom.kernel.operators import Sampling
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class PerturbedTrees(Sampling):
    """Join two randomly perturbed shortest-path trees, from start and from goal, at random way-points.

    Never fails where a path exists. Paths are 8-connected and free of loops.
    """

    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    spread: Positive = 1.0
    """Prices of cells are drawn from [1, 1 + spread]."""
    pairs: Count = 1
    """From how many pairs of trees the paths come, each over prices of its own."""
    detour: Annotated[float, msgspec.Meta(ge=1.0)] = 1.5
    """Way-points may cost at most this many times the direct way through the trees."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        if not it.reachable:
            return np.empty((0, 1), np.int32)
        return np.asarray(
            compiled.seeding.sample_from_trees(
                n, min(self.pairs, n), it.moves, it.cols, it.start, it.goal, it.reachable_cells, self.spread,
                self.detour, rng.bit_generator.random_raw(4),
            )
        )  # fmt: skip
