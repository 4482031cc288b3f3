"""OMPL from its wheel: planners by samples, with our compiled test of motions."""

import math
import time
from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve
from pathloom.paths.problem import PathProblem

MOST = 60.0
"""Seconds after which a planner that was given no limit gives up."""


class Ompl(Peer):
    """A geometric planner over the map as a plane, its answer simplified."""

    distribution: ClassVar[str] = "ompl"

    def __init__(self, name: str, planner: str, about: str) -> None:
        self.name, self._planner = name, planner
        self.about = (
            f"RealVectorStateSpace(2), {about}, simplifySolution; motions tested exactly by a compiled kernel; "
            "under allow no samples hit the ways without width between two corners"
        )

    def prepare(self, problem: PathProblem) -> Solve:
        return Search(problem, self._planner)


class Optimal(Ompl):
    """A planner that goes on to shorten its path."""

    anytime: ClassVar[bool] = True


RRT_CONNECT = Ompl("OMPL RRTConnect", "RRTConnect", "ends with the first path")
BITSTAR = Optimal("OMPL BIT*", "BITstar", "PathLengthOptimizationObjective")
INFORMED = Optimal("OMPL Informed RRT*", "InformedRRTstar", "PathLengthOptimizationObjective")


class Search:
    """Plans on one problem, and tells how much of its time was spent in our tests of motions."""

    def __init__(self, problem: PathProblem, planner: str) -> None:
        from ompl import base, geometric, util

        from pathloom.bench.motion import motion_free

        util.setLogLevel(util.LOG_NONE)
        self.callback = 0.0
        """Seconds that the last run spent in Python's part: tests of states and motions."""
        self._planner = getattr(geometric, planner)
        self._ends = problem.ends
        self._base, self._geometric, self._util = base, geometric, util
        it = problem.context
        self._space = base.RealVectorStateSpace(2)
        bounds = base.RealVectorBounds(2)
        bounds.setLow(-0.5)
        for axis, size in enumerate((it.rows, it.cols)):
            bounds.setHigh(axis, size - 0.5)
        self._space.setBounds(bounds)
        spent = self._spent = [0.0]

        def valid(state: Any) -> bool:
            began = time.perf_counter()
            r, c = state[0], state[1]
            free = motion_free(it.blocked, it.rows, it.cols, r, c, r, c, it.policy)
            spent[0] += time.perf_counter() - began
            return bool(free)

        class Motions(base.MotionValidator):  # type: ignore[misc]  # OMPL ships no types
            def checkMotion(self, a: Any, b: Any, *_: Any) -> bool:  # noqa: N802 - OMPL's name
                began = time.perf_counter()
                free = motion_free(it.blocked, it.rows, it.cols, a[0], a[1], b[0], b[1], it.policy)
                spent[0] += time.perf_counter() - began
                return bool(free)

        self._valid, self._motions = valid, Motions

    def __call__(self, seed: int, seconds: float = math.inf, target: float = 0.0) -> Answer:
        """Solve for as long as there is time, and simplify the answer."""
        self._util.RNG.setSeed(seed + 1)  # it has no seed 0
        self._spent[0] = 0.0
        setup = self._geometric.SimpleSetup(self._space)
        info = setup.getSpaceInformation()
        setup.setStateValidityChecker(self._valid)
        info.setMotionValidator(self._motions(info))
        setup.setStartAndGoalStates(*map(self._state, self._ends))
        objective = self._base.PathLengthOptimizationObjective(info)
        if target > 0.0:
            objective.setCostThreshold(self._base.Cost(target))
        setup.setOptimizationObjective(objective)
        setup.setPlanner(self._planner(info))
        limit = min(seconds, MOST)
        setup.solve(limit)
        answer = None
        if setup.haveExactSolutionPath():
            setup.simplifySolution(limit)
            path = setup.getSolutionPath()
            states = (path.getState(k) for k in range(path.getStateCount()))
            answer = np.array([(state[0], state[1]) for state in states])
        self.callback = self._spent[0]
        return answer

    def _state(self, cell: tuple[int, int]) -> Any:
        state = self._space.allocState()
        state[0], state[1] = map(float, cell)
        return state
