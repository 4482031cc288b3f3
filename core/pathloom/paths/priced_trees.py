"""Priced trees: perturbed trees that go where the objectives are small, not only where the way is short."""

from dataclasses import dataclass, replace
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Count, NonNegative
from pathloom.kernel.counting import count
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.operators import Sampling
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.additive import prices_of, weighted
from pathloom.paths.objectives import Length, Turns, UnsafeCells
from pathloom.paths.pathwise import path_problem
from pathloom.paths.tree_seeding import PerturbedTrees

USUAL = Terms({"length": Length(), "unsafe-cells": UnsafeCells(), "turns": Turns()})
"""Stands for the planner's own objectives."""


@dataclass(frozen=True, kw_only=True)
class PricedTrees(Sampling):
    """Join two randomly perturbed trees of cheapest ways, from start and from goal, at random way-points.

    As `PerturbedTrees`, but a step costs what it adds to the weighted sum of the
    objectives, turns included, times a random factor for each cell. What is not
    additive is left out, and counted. Paths are 8-connected and free of loops.
    """

    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    objectives: Terms = USUAL
    """What is priced, by its weights. Left as it is, it stands for the objectives of the planner."""
    spread: NonNegative = 1.0
    """Factors of cells are drawn from [1, 1 + spread]."""
    detour: Annotated[float, msgspec.Meta(ge=1.0)] = 1.5
    """Way-points may cost at most this many times the direct way."""
    cells: Count = 100_000
    """Size of map from which on, since cells times headings are searched, ``rest`` makes the individuals."""
    rest: Sampling = PerturbedTrees()
    """Makes the individuals of large maps, and where no objective is additive."""

    def serving(self, objectives: Terms) -> "PricedTrees":
        mine = objectives if self.objectives == USUAL else self.objectives
        return replace(self, objectives=mine, rest=self.rest.serving(objectives))

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        priced = [(prices_of(term.objective, it), term.weight) for term in self.objectives]
        prices = [(one, weight) for one, weight in priced if one is not None]
        count("objectives not additive", len(priced) - len(prices))
        if not prices or it.context.blocked.size >= self.cells:
            count("samples by fallback", n)
            return self.rest.sample(problem, n, rng)
        tables = weighted([one for one, _ in prices], [weight for _, weight in prices]).tables
        on = it.context
        return np.asarray(
            compiled.priced.sample_from_priced_trees(
                n, on.moves, on.cols, on.start, on.goal, *tables, self.spread, self.detour,
                rng.bit_generator.random_raw(4),
            )
        )  # fmt: skip
