"""Re-routing: a mutation that stays sensible on maps of any size."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import compiled
from pathloom.kernel.component import NonNegative, Share, Unit, Whole
from pathloom.kernel.counting import count
from pathloom.kernel.operators import Indices, Mutation
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class Reroute(Mutation):
    """Replace a random stretch of a path by the cheapest way between its ends, under prices drawn anew each time.

    A step costs its length, a little more or less from cell to cell; a cell near an
    obstacle may cost extra, and so may a turn, by its number or its angle. Each
    extra is left out in one case of four. Near is what is beside an obstacle or,
    every other time, what is as near to one as the stretch comes. What comes out is
    a good compromise between the three, never the same one for long. The search
    stays close to the stretch, so that it takes the same time on every map. Outside
    the stretch a path of long segments keeps them.
    """

    works_on: ClassVar[str] = "cells"

    rate: Share = 0.5
    longest: Annotated[int, msgspec.Meta(ge=2, le=2**31 - 1)] = 100
    """Most steps of the stretch."""
    margin: Annotated[Whole, Unit("cells")] = 12
    """How far from the stretch's bounding box the new way may lead, at most; mostly it is less."""
    spread: NonNegative = 1.0
    """A cell stretches the length of a step by at most this share."""
    near: NonNegative = 1.0
    """Median price of a cell near an obstacle, in steps."""
    turn: NonNegative = 1.0
    """Median price of a turn, in steps; of one of 90° where the angle counts."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem).context
        changed, failed = compiled.rerouting.reroute(
            population, np.ascontiguousarray(chosen, np.int64), it.blocked, it.moves, it.distance,
            it.rows, it.cols, it.policy, self.longest, self.margin, self.spread, self.near, self.turn,
            rng.bit_generator.random_raw(4),
        )  # fmt: skip
        count("mutation failed", failed)
        return np.asarray(changed)
