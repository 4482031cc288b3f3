"""pymoo as its user writes it: an `ElementwiseProblem` over way-points, collisions as a constraint."""

import math
from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve, Until
from pathloom.bench.peers.way_points import GENERATIONS, POPULATION, Floats, WayPoints
from pathloom.paths.problem import PathProblem


class PymooGa(Peer):
    """`GA` with its own crossover and mutation for real vectors, and a sampling about the straight line."""

    name = "pymoo GA"
    distribution: ClassVar[str] = "pymoo"
    about = "6 way-points, length, collisions as a constraint, SBX and PM, 100 × 200"
    objectives: ClassVar[int] = 1

    def algorithm(self, sampling: Any) -> Any:
        """Return the algorithm."""
        from pymoo.algorithms.soo.nonconvex.ga import GA

        return GA(pop_size=POPULATION, sampling=sampling)

    def prepare(self, problem: PathProblem) -> Solve:
        from pymoo.core.problem import ElementwiseProblem
        from pymoo.core.sampling import Sampling

        ways, objectives = WayPoints(problem), self.objectives

        class Paths(ElementwiseProblem):  # type: ignore[misc]  # pymoo ships no types
            def __init__(self) -> None:
                super().__init__(n_var=len(ways.low), n_obj=objectives, n_ieq_constr=1, xl=ways.low, xu=ways.high)

            def _evaluate(self, x: Floats, out: dict[str, Any], *_: Any, **__: Any) -> None:
                length, met = ways.measure(x)
                out["F"] = [length, _turning(ways.path(x))][:objectives]
                out["G"] = [met]

        class AboutTheLine(Sampling):  # type: ignore[misc]
            def _do(self, problem: Any, n: int, *_: Any, random_state: Any = None, **__: Any) -> Floats:
                return ways.first(n, random_state)

        def solve(seed: int, seconds: float = math.inf, target: float = 0.0) -> Answer:
            until = Until(seconds, target)
            algorithm = self.algorithm(AboutTheLine())
            algorithm.setup(Paths(), termination=("n_gen", GENERATIONS), seed=seed, verbose=False)
            while algorithm.has_next():
                algorithm.next()
                best = _shortest(algorithm.opt)
                if until.over(math.inf if best is None else best.F[0]):
                    break
            best = _shortest(algorithm.opt)
            return None if best is None else ways.answer(best.X)

        return solve


class PymooNsga2(PymooGa):
    """`NSGA2` with length and turning; the answer is the shortest path of the front."""

    name = "pymoo NSGA-II"
    about = "as pymoo GA, with turning as the second objective; the shortest of the front"
    objectives: ClassVar[int] = 2

    def algorithm(self, sampling: Any) -> Any:
        from pymoo.algorithms.moo.nsga2 import NSGA2

        return NSGA2(pop_size=POPULATION, sampling=sampling)


def _shortest(front: Any) -> Any:
    """Return the individual without collisions whose first objective is least."""
    feasible = [] if front is None else [individual for individual in front if individual.CV[0] <= 0.0]
    return min(feasible, key=lambda individual: individual.F[0], default=None)


def _turning(path: Any) -> float:
    """Return the sum of all turns, in radians."""
    steps = np.diff(path, axis=0)
    headings = np.arctan2(*steps[np.any(steps != 0, axis=1)].T)
    return float(np.abs((np.diff(headings) + np.pi) % (2 * np.pi) - np.pi).sum())
