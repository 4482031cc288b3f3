"""Section 5.3.2: mutation by searching anew, towards the start or from the goal."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Indices, Mutation, NonNegative, Population, Problem, Share, compiled, count
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class TwoWayReverseSearch(Mutation):
    """Pick a random interior cell, search anew from it back to the start, and from the goal back to it; keep one.

    Which one is the fitter an operator cannot know: of the two it keeps the
    shorter. The control ``family-competition`` asks for `both`, and keeps the
    fitter. How is searched the paper does not say: here by guided walks round
    the part that stays.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.3.2, fig. 9"
    works_on: ClassVar[str] = "cells"

    rate: Share = 0.2
    pull: NonNegative = 3.0
    """k: a step that leads to a distance d from the target is drawn in proportion to exp(-k d), d in cells."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        if len(chosen) == 0:
            return population
        mutants, cols = self.both(population, chosen, problem, rng), path_problem(problem).context.cols
        first, second = (compiled.measures.lengths(np.ascontiguousarray(m), cols) for m in mutants)
        rows = np.where((first <= second)[:, np.newaxis], *mutants)
        return problem.representation.replaced(population, chosen, rows)

    def both(
        self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator
    ) -> tuple[Population, Population]:
        """Return both mutants (k, width) of the chosen individuals (k,): searched to the start, and from the goal."""
        it = path_problem(problem).context
        found, failed = compiled.guided.search_again(
            population, chosen, self.pull, it.moves, it.cols, rng.bit_generator.random_raw(4)
        )
        count("mutation failed", failed)
        return found[: len(chosen)], found[len(chosen) :]
