"""Section 4.1: individuals that collide are removed."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Collision, Population, Problem, Repair, Sampling, count
from pathloom.paths.cell_paths import cells_of
from pathloom.paths.pathwise import path_problem
from pathloom_agacd.collision import LinearTrial
from pathloom_agacd.sampling import GoalBiasedGreedyWalk


@dataclass(frozen=True, kw_only=True)
class DropColliding(Repair):
    """Remove every individual with a segment that collides, and draw new ones in their places.

    The paper removes them and does not say who takes their places. Where no new
    ones can be drawn they stay, and are counted.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.1"
    works_on: ClassVar[str] = "cells"

    collision: Collision = LinearTrial()
    """Test of all segments."""
    refill: Sampling = GoalBiasedGreedyWalk()
    """What draws the new individuals."""

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "breaks", frozenset({"8-connected"}) - self.refill.gives)

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        rows, starts = np.nonzero(population[:, 1:] >= 0)
        a, b = (cells_of(population[rows, starts + end], it.context.cols) for end in (0, 1))
        colliding = np.unique(rows[~self.collision.segments_free(a, b, it)])
        count("colliding individuals dropped", len(colliding))
        if len(colliding) == 0:
            return population
        drawn = self.refill.sample(problem, len(colliding), rng)
        count("colliding individuals kept", len(colliding) - len(drawn))
        both = problem.representation.stack(population, drawn)
        order = np.arange(len(population))
        order[colliding[: len(drawn)]] = len(population) + np.arange(len(drawn))
        return np.ascontiguousarray(both[order])
