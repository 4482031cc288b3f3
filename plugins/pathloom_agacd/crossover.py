"""Section 4.6: single-point crossover."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from pathloom import Collision, Crossover, Indices, PathProblem, Population, Problem, Share, compiled, count
from pathloom.paths.cell_paths import cells_of
from pathloom.paths.exchange import exchange_tails
from pathloom.paths.pathwise import path_problem
from pathloom_agacd.collision import LinearTrial, count_refused, tests_of


@dataclass(frozen=True, kw_only=True)
class SinglePoint(Crossover):
    """Cut both parents at a random place each, and join the head of one to the tail of the other.

    The paper names the operator and says no more, but that children which collide
    are removed. Here a parent stays in the place of a child that would collide.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.6"
    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    rate: Share = 0.7
    join: Literal["straight", "common-node"] = "straight"
    """Join the halves by the straight segment, or cut only at a node that both parents visit."""
    collision: Collision | None = LinearTrial()
    """Test of the straight segment; empty: none, and ``drop-colliding`` is to remove the children that collide."""

    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        if self.join == "common-node":
            return exchange_tails(population, pairs, it, rng)
        pairs, state = np.ascontiguousarray(pairs), rng.bit_generator.random_raw(4)
        tests, on = tests_of(self.collision, it.context), it.context
        if tests is None:
            assert self.collision is not None, "no test is one that the kernels know"
            return _cut_and_join(population, pairs, it, self.collision, state)
        children, failed, refused = compiled.trial.cut_and_join(
            population, pairs, on.blocked, on.rows, on.cols, *tests, state
        )
        count("crossover failed", failed)
        count_refused(refused)
        return np.asarray(children)


def _cut_and_join(
    population: Population, pairs: Indices, problem: PathProblem, collision: Collision, state: NDArray[Any]
) -> Population:
    """Do what the kernel of this name does, with a collision test that only Python can do."""
    it = problem.context
    at, joints = compiled.trial.draw_cuts(population, pairs, state)
    a, b = (cells_of(joints[:, end], it.cols) for end in (0, 1))
    wanted = collision.segments_free(a, b, problem).reshape(-1, 2) & (at >= 0)
    count("crossover failed", int((~wanted).sum()))
    return np.asarray(compiled.exchange.splice(population, pairs, at, wanted, it.blocked.size, False))
