"""Memetic: evolution whose individuals learn, and pass on what they have learned."""

from dataclasses import dataclass

import numpy as np

from pathloom.kernel.component import Count
from pathloom.kernel.evolution import Control, Evolution
from pathloom.kernel.operators import Repair
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Deme, State
from pathloom.kernel.survival import replaced


@dataclass(frozen=True, kw_only=True)
class Memetic(Control):
    """Let every child learn, and keep what makes it fitter (Moscato 1989; Lamarckian).

    A repair is tried on all children and another, dearer one on the best of
    them. What comes out is measured like any individual and takes the child's
    place unless it is less fit: no repair can do harm, whatever the objectives. The
    first generation is the first population and what it has learned.
    """

    learning: Repair | None = None
    """Tried on every child."""
    polish: Repair | None = None
    """Tried on the fittest children."""
    elite: Count = 3
    """How many children are polished."""

    def advance(self, planner: Evolution, state: State, which: int, rng: np.random.Generator) -> Deme:
        deme, problem = state.demes[which], state.problem
        children = deme
        if state.generation > 0:
            parents = planner.selection.select(deme.fitness, len(deme), rng)
            population, fitness = deme.population.take(parents, 0), deme.fitness.take(parents)
            children = planner.evaluate(
                planner.vary(population, fitness, problem, planner.progress(state), rng), problem
            )
        if self.learning is not None:
            learned = planner.evaluate(self.learning.apply(children.population, problem, rng), problem)
            children = _fitter(children, np.arange(len(children)), learned, problem)
        if self.polish is not None:
            best = self._best(children, problem)
            polished = planner.evaluate(self.polish.apply(children.population.take(best, 0), problem, rng), problem)
            children = _fitter(children, best, polished, problem)
        return planner.survival.survive(deme, children, problem, rng)

    def _best(self, deme: Deme, problem: Problem) -> np.ndarray:
        """Return the rows of the fittest individuals that differ, the fittest first."""
        ranked = np.argsort(-deme.fitness, kind="stable")
        different, _ = problem.representation.distinct(deme.population.take(ranked, 0))
        return ranked[different[: self.elite]]


def _fitter(deme: Deme, places: np.ndarray, others: Deme, problem: Problem) -> Deme:
    """Return the deme with those of the others that are no less fit than who has their place."""
    rows = np.flatnonzero(others.fitness >= deme.fitness[places])
    return deme if len(rows) == 0 else replaced(deme, places[rows], others, rows, problem)
