"""The exact searches as planners, to be compared with others in the same way."""

import math
import time
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom.exact.any_angle import WORK, Known, any_angle_search
from pathloom.exact.octile import octile_path
from pathloom.kernel.component import Count
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.planner import Fidelity, Outcome
from pathloom.kernel.problem import Problem
from pathloom.kernel.search import Search
from pathloom.kernel.state import State
from pathloom.kernel.termination import Termination
from pathloom.paths.objectives import Length
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True)
class Searched(State):
    """The state after an exact search: all there is."""

    length: float = math.inf
    """Length in cells of the path found."""
    bound: float = math.inf
    """No path is shorter, in cells."""


@dataclass(frozen=True, kw_only=True)
class ExactPlanner(Search, ABC):
    """Base of planners that find the shortest path in one go.

    They go by length alone; the objectives are what the answer is judged by.
    """

    works_on: ClassVar[str] = "cells"

    objectives: Terms = Terms({"length": Length()})
    termination: tuple[Termination, ...] = ()

    @abstractmethod
    def search(self, problem: PathProblem) -> Known:
        """Return the shortest path, or the shortest known and how much shorter one could be."""

    def start(self, problem: Problem, rng: np.random.Generator) -> Searched:
        self.check_representation(problem)
        began = time.perf_counter()
        it = path_problem(problem)
        known = self.search(it)
        with counting() as counts:
            deme = self.evaluate(it.representation.encode([] if known.path is None else [known.path]), problem)
        first = State(problem, rng.bit_generator.state)
        best = self.fittest(None, deme, 0)
        fields = self.recorded(first, deme, best, 0, rng, counts, began)
        return Searched(**fields, length=known.length, bound=known.bound)

    def step(self, state: State) -> State:
        """Return the state as it is: nothing is left to do."""
        return state

    def done(self, state: State) -> bool:
        return True

    def progress(self, state: State) -> float:
        return 1.0

    def nothing(self, state: State) -> str:
        return "the goal cannot be reached"


@dataclass(frozen=True, kw_only=True)
class Dijkstra(ExactPlanner):
    """The shortest path of single steps to the eight neighbours."""

    reference: ClassVar[str] = (
        "E. W. Dijkstra (1959), A note on two problems in connexion with graphs, Numerische Mathematik 1, 269-271, "
        "doi:10.1007/BF01386390"
    )
    bibtex: ClassVar[str] = """\
@article{dijkstra1959note,
  author  = {Dijkstra, E. W.},
  title   = {A note on two problems in connexion with graphs},
  journal = {Numerische Mathematik},
  volume  = {1},
  pages   = {269--271},
  year    = {1959},
  doi     = {10.1007/BF01386390}
}
"""
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        "A step costs its length, 1 or the square root of 2.",
        "The octile distance to the goal guides the search (A*, Hart, Nilsson and Raphael 1968): the length is the "
        "same, and fewer cells are looked at.",
    )

    def search(self, problem: PathProblem) -> Known:
        length, path = octile_path(problem)
        return Known(length, path, length)


@dataclass(frozen=True, kw_only=True)
class AnyAngle(ExactPlanner):
    """The shortest path over cell centres at any angle, proven to be that.

    Where the search is given up, the answer is the shortest path known, and the
    result's reason says how much shorter one could be.
    """

    work: Count = WORK
    """Cells seen before the search is given up."""

    def search(self, problem: PathProblem) -> Known:
        return any_angle_search(problem, work=self.work)

    def result(self, state: State) -> Outcome:
        assert isinstance(state, Searched), "a state of this planner"
        outcome = super().result(state)
        if state.answer is None or state.bound >= state.length:
            return outcome
        reason = (
            f"not proven to be the shortest path: the search was given up after {self.work} cells seen; "
            f"no path is shorter than {state.bound:.6f} cells, {100 * (1.0 - state.bound / state.length):.3f} % less"
        )
        return Outcome(outcome.solution, outcome.found, reason)
