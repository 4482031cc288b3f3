"""Section 3.2: the first population, by midpoint interpolation between one cell of each row."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Population, Problem, Sampling, Whole
from pathloom.paths.insertion import or_fallback, sample_in_turn
from pathloom.paths.lines import lines_between
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class RowWise(Sampling):
    """Draw a free cell of each row between start and goal, and join them by inserting midpoints.

    The paper's way goes upwards; here it goes wherever the goal lies. Cells that
    cannot be reached are left out. The paper has no rule for a midpoint in an
    obstacle, and hardly an individual goes without one: a random free neighbour
    takes its place.
    """

    source: ClassVar[str] = "Liu et al. 2024, section 3.2, eqs. (2) to (4)"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    lines: Literal["longer", "rows"] = "longer"
    """``longer``: columns where start and goal lie further apart in columns than in rows; ``rows``: never, as in the
    paper, whose fig. 2 has 7 rows and 9 columns between the ends. Between corners of a square the two are the same."""
    reach: Literal[4, 8] = 8
    """Among how many neighbours a midpoint in an obstacle gives way."""
    redraws: Count = 20
    """How often the cell of a row is drawn until it can be joined to the one before. 1: a row that cannot be joined
    fails the individual. Not in the paper."""
    tries: Count = 1000
    """Failures in a row after which no more individuals are looked for. Not in the paper."""
    insertions: Whole = 0
    """Most insertions in one gap, since midpoints beside obstacles can go round in circles; 0: 4 (height + width).
    Not in the paper."""
    loops: bool = False
    """Keep loops, which section 3.5 cuts out of later generations."""
    fallback: Sampling | None = None
    """What makes the population where not one individual was found. Not in the paper."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        reached = it.context.component.ravel()
        # no path leads through cells that cannot be reached
        lines = [line[reached[line]] for line in lines_between(it.context, self.lines)]
        found = sample_in_turn(
            it, lines, n, rng,
            tries=self.tries, redraws=self.redraws, insertions=self.insertions, reach=self.reach, loops=self.loops,
        )  # fmt: skip
        return or_fallback(found, n, self.fallback, problem, rng)
