"""mealpy: its GA over the coordinates of way-points."""

import math
from contextlib import suppress
from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve, Until
from pathloom.bench.peers.way_points import GENERATIONS, POPULATION, WayPoints
from pathloom.paths.problem import PathProblem


class Enough(Exception):  # noqa: N818 - no error
    """Leaves a search that can be told neither a target nor a processor time."""


class MealpyGa(Peer):
    """`BaseGA` with its own tournaments, crossover and mutation, within the ranges that it recommends."""

    name = "mealpy BaseGA"
    distribution: ClassVar[str] = "mealpy"
    about = "6 way-points as floats, length + penalty, 100 × 200, pc 0.9, pm 0.05"

    def prepare(self, problem: PathProblem) -> Solve:
        from mealpy import GA, FloatVar

        ways = WayPoints(problem)

        def solve(seed: int, seconds: float = math.inf, target: float = 0.0) -> Answer:
            until = Until(seconds, target)
            best: list[Any] = [math.inf, None]
            length = math.inf

            def cost(vector: Any) -> float:
                nonlocal length
                value = ways.cost(vector)
                if value < best[0]:
                    best[:] = value, np.array(vector)
                    length = ways.length(vector) if target > 0.0 else math.inf
                if until.over(length):
                    raise Enough
                return value

            ga = GA.BaseGA(epoch=GENERATIONS, pop_size=POPULATION, pc=0.9, pm=0.05)
            task = {"obj_func": cost, "bounds": FloatVar(lb=ways.low, ub=ways.high), "minmax": "min", "log_to": None}
            first = ways.first(POPULATION, np.random.default_rng(seed))
            with suppress(Enough):
                ga.solve(task, seed=seed, starting_solutions=first)
            return None if best[1] is None else ways.answer(best[1])

        return solve
