"""Initialisation, as plain genetic algorithms on grids have it: at random, or greedy."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Population, Problem, Sampling, Share, Whole, compiled, count
from pathloom.paths.insertion import or_fallback, sample_through
from pathloom.paths.lines import lines_between
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class RandomWalk(Sampling):
    """Walk at random over free cells until the goal is met, and cut out the loops.

    Slow on large maps, which is what papers hold against random initialisation.
    """

    source: ClassVar[str] = "Holland 1975; common practice on grids"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    steps: Whole = 0
    """Steps after which a walk is given up; 0: 100 times the number of free cells."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        steps = self.steps or 100 * (len(it.reachable_cells) + 2)
        found, failed = compiled.walks.sample_by_walking(
            n, steps, it.start, it.goal, it.moves, it.cols, rng.bit_generator.random_raw(4)
        )
        count("samples failed", failed)
        return np.asarray(found)


@dataclass(frozen=True, kw_only=True)
class RandomPerRow(Sampling):
    """Draw a free cell of each row between start and goal, and close the gaps by median insertion.

    Columns where start and goal lie further apart in columns. A path that cannot
    be closed is dropped and drawn again. Common programs look round a midpoint in
    an obstacle always in the same order, which draws paths to one side; here the
    order is random.
    """

    source: ClassVar[str] = "common practice on grids"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    reach: Literal[4, 8] = 8
    """Among how many neighbours a midpoint in an obstacle gives way; common programs look at 4."""
    tries: Count = 10_000
    """Failures in a row after which no more individuals are looked for."""
    insertions: Whole = 0
    """Most insertions in one gap; 0: 4 (height + width)."""
    loops: bool = False
    """Keep whatever lies between two visits of one cell."""
    fallback: Sampling | None = None
    """What makes the population where not one individual was found."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        found = sample_through(
            it, lines_between(it.context), n, rng,
            tries=self.tries, insertions=self.insertions, reach=self.reach, loops=self.loops,
        )  # fmt: skip
        return or_fallback(found, n, self.fallback, problem, rng)


@dataclass(frozen=True, kw_only=True)
class GreedyWalk(Sampling):
    """Step to the free neighbour that is nearest to the goal, or every now and then to a random cell.

    Loops are cut out. A concave obstacle that faces the goal can hold a walk for
    any number of steps.
    """

    source: ClassVar[str] = "common practice on grids"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    greed: Share = 0.5
    """Probability that a step heads for the goal."""
    steps: Whole = 0
    """Steps after which a walk is given up; 0: 20 (height + width)."""
    tries: Count = 100
    """Walks given up in a row after which no more are begun; those found are then repeated."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        anywhere = np.flatnonzero(it.blocked == 0).astype(np.int32)
        found, failed = compiled.walks.sample_by_greedy_walks(
            n, self.steps or 20 * (it.rows + it.cols), self.tries, self.greed, False,
            it.start, it.goal, anywhere, it.moves, it.cols, rng.bit_generator.random_raw(4),
        )  # fmt: skip
        count("samples failed", failed)
        if 0 < len(found) < n:
            count("samples repeated", n - len(found))
            return np.resize(found, (n, found.shape[1]))
        return np.asarray(found)
