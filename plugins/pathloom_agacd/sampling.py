"""Section 4.3: the first population, by walks with prior knowledge and random perturbation."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Population, Problem, Sampling, Share, Whole, compiled, count
from pathloom.paths.pathwise import path_problem
from pathloom.paths.tree_seeding import PerturbedTrees


@dataclass(frozen=True, kw_only=True)
class GoalBiasedGreedyWalk(Sampling):
    """Step to the free neighbour nearest to a target, drawn anew for each step: the goal, or any free cell.

    Printed, the walk ends at the goal or never: a concave obstacle that faces the
    goal can hold it for any number of steps.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.3"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    bias: Share = 0.5
    """Probability that the target is the goal."""
    loops: Literal["cut", "keep"] = "cut"
    """Nearly every walk visits cells twice; the paper neither forbids nor removes that."""
    steps: Whole = 0
    """Steps after which a walk is given up; 0: 20 (height + width). Not in the paper."""
    tries: Count = 20
    """Walks given up in a row after which no more are begun. Not in the paper."""
    fallback: Sampling | None = PerturbedTrees()
    """What draws the individuals that are then missing; empty: those found are repeated. Not in the paper."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        free = np.flatnonzero(it.blocked == 0).astype(np.int32)
        found, failed = compiled.walks.sample_by_greedy_walks(
            n, self.steps or 20 * (it.rows + it.cols), self.tries, self.bias, self.loops == "keep",
            it.start, it.goal, free, it.moves, it.cols, rng.bit_generator.random_raw(4),
        )  # fmt: skip
        count("samples failed", failed)
        missing = n - len(found)
        if missing == 0:
            return np.asarray(found)
        if self.fallback is not None:
            count("samples by fallback", missing)
            return problem.representation.stack(found, self.fallback.sample(problem, missing, rng))
        if len(found):
            count("samples repeated", missing)
            return np.resize(found, (n, found.shape[1]))
        return np.asarray(found)
