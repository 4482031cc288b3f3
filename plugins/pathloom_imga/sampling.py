"""Section 4.1: the first population, by heuristic median insertion."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Population, Problem, Sampling, Whole
from pathloom.paths.insertion import or_fallback, sample_by_insertion
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class MedianInsertion(Sampling):
    """Join start, one random free cell and goal by inserting midpoints until the path is continuous."""

    source: ClassVar[str] = "Li et al. 2021, section 4.1, eqs. (2) and (3)"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    reading: Literal["guarded", "as-printed"] = "guarded"
    """``as-printed`` takes any free neighbour of a midpoint in an obstacle, the ends of the gap too, and keeps
    loops; it seldom ends on dense maps. ``guarded`` never inserts an end of the gap, prefers neighbours that
    shrink it, and cuts loops out, which section 3.3 forbids."""
    tries: Count = 1000
    """Failures in a row after which no more individuals are looked for. Not in the paper."""
    insertions: Whole = 0
    """Most insertions in one gap, since midpoints beside obstacles can go round in circles; 0: 4 (height + width).
    Not in the paper."""
    fallback: Sampling | None = None
    """What makes the population where not one individual was found. Not in the paper."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        guarded = self.reading == "guarded"
        found = sample_by_insertion(
            path_problem(problem), n, rng,
            tries=self.tries, insertions=self.insertions, guarded=guarded, loops=not guarded,
        )  # fmt: skip
        return or_fallback(found, n, self.fallback, problem, rng)
