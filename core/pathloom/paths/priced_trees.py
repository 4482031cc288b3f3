"""Priced trees: perturbed trees that go where the objectives are small, not only where the way is short."""

from dataclasses import dataclass
from typing import Annotated

import msgspec
import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Count, NonNegative
from pathloom.kernel.counting import count
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.additive import weighted
from pathloom.paths.pathwise import path_problem
from pathloom.paths.priced_sampling import PricedSampling


@dataclass(frozen=True, kw_only=True)
class PricedTrees(PricedSampling):
    """Join two randomly perturbed trees of cheapest ways, from start and from goal, at random way-points.

    As `PerturbedTrees`, but a step costs what it adds to the weighted sum of the
    objectives, turns included, times a random factor for each cell. What is not
    additive is left out, and counted. Paths are 8-connected and free of loops.
    """

    spread: NonNegative = 1.0
    """Factors of cells are drawn from [1, 1 + spread]."""
    detour: Annotated[float, msgspec.Meta(ge=1.0)] = 1.5
    """Way-points may cost at most this many times the direct way."""
    cells: Count = 100_000
    """Size of map from which on, since cells times headings are searched, ``rest`` makes the individuals,
    as it does where no objective is additive."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        prices, weights = self.priced(it)
        if not prices or it.context.blocked.size >= self.cells:
            count("samples by fallback", n)
            return self.rest.sample(problem, n, rng)
        tables = weighted(prices, weights).tables
        on = it.context
        return np.asarray(
            compiled.priced.sample_from_priced_trees(
                n, on.moves, on.cols, on.start, on.goal, *tables, self.spread, self.detour,
                rng.bit_generator.random_raw(4),
            )
        )  # fmt: skip
