"""Search: what planners have in common that judge individuals by objectives and remember the best one."""

import time
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError
from pathloom.kernel.component import Component, members
from pathloom.kernel.counting import count, total
from pathloom.kernel.evaluation import Fitness, Floats, Objective, ReciprocalOfSum, Terms, Weighting, measure
from pathloom.kernel.operators import Repair
from pathloom.kernel.planner import Outcome, Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.kernel.state import Deme, Individual, State, generator


@dataclass(frozen=True, kw_only=True)
class Search(Planner, ABC):
    """A planner that makes one fitness of several objectives, whatever makes its individuals."""

    objectives: Terms
    """What is minimised, with weights."""
    weighting: Weighting | None = None
    """Rule for the weights, in place of the numbers beside the objectives."""
    fitness: Fitness = ReciprocalOfSum()
    """Makes one number of the objectives' values."""
    refinement: Repair | None = None
    """Improves the answer at the end."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.weighting is not None:
            self.weighting.check(self.objectives)

    @property
    def terms(self) -> Terms:
        return self.objectives

    def weights(self, problem: Problem) -> Floats:
        """Return the weights (m,) of the objectives."""
        return self._weights if self.weighting is None else self.weighting.weights(self.objectives, problem)

    def weighed(self, problem: Problem) -> Terms:
        """Return the objectives with the weights that they have on this problem."""
        if self.weighting is None:
            return self.objectives
        weights = self.weights(problem).tolist()
        return Terms(replace(term, weight=weight) for term, weight in zip(self.objectives, weights, strict=True))

    @cached_property
    def _weights(self) -> Floats:
        return self.objectives.weights

    def evaluate(self, population: Population, problem: Problem) -> Deme:
        """Return the population with its values and fitness, and count the evaluations.

        Each distinct individual is measured once; all count.
        """
        count("evaluations", len(population))
        distinct, which = problem.representation.distinct(population)
        values = measure(self._measured, population.take(distinct, 0), problem)
        fitness = self.fitness.combine(values, self.weights(problem))
        return Deme(population, values.take(which, 0), fitness.take(which), distinct)

    @cached_property
    def _measured(self) -> list[Objective]:
        return list(self.objectives.objectives())

    def fitness_of(self, row: NDArray[Any], problem: Problem) -> tuple[dict[str, float], float | None]:
        deme = self.evaluate(row[np.newaxis], problem)
        return dict(zip(self.objectives.labels, deme.values[0].tolist(), strict=True)), float(deme.fitness[0])

    def result(self, state: State) -> Outcome:
        if state.answer is None:
            return Outcome(None, reason=self.nothing(state))
        row = self.solution(state, state.answer)
        if self.refinement is not None:
            row = self.refinement.apply(row[np.newaxis], state.problem, generator(state.random))[0]
        return Outcome(row, state.answer)

    def solution(self, state: State, answer: Individual) -> NDArray[Any]:
        """Return the row that stands for the answer, before refinement."""
        return answer.row

    @abstractmethod
    def nothing(self, state: State) -> str:
        """Say why there is no answer."""

    @staticmethod
    def fittest(best: Individual | None, deme: Deme, generation: int) -> Individual | None:
        """Return the best individual so far, or a fitter one of this generation."""
        if len(deme) == 0:
            return best
        row = deme.best()
        fitness = float(deme.fitness[row])
        if best is not None and fitness <= best.fitness:
            return best
        return Individual(deme.population[row], deme.values[row], fitness, generation)

    @staticmethod
    def recorded(
        before: State, deme: Deme, best: Individual | None, generation: int, rng: np.random.Generator,
        counts: dict[str, int], began: float,
    ) -> dict[str, Any]:  # fmt: skip
        """Return the fields of the state that follows ``before``, history and counts carried on.

        The history begins with the first individual; a later generation without
        any has no fitness, which is written as 0.
        """
        n = len(deme)
        distinct = deme.distinct
        if distinct is None:
            distinct = before.problem.representation.distinct(deme.population)[0]
        evaluations = before.evaluations + counts.pop("evaluations", 0)
        history = before.history
        if best is not None:
            top = mean = diversity = 0.0
            if n:
                top, mean, diversity = deme.fitness.item(deme.best()), float(deme.fitness.sum()) / n, len(distinct) / n
            history = history.extended(evaluations, best.fitness, top, mean, diversity)
        return {
            "problem": before.problem,
            "random": rng.bit_generator.state,
            "generation": generation,
            "evaluations": evaluations,
            "demes": (deme,),
            "best": best,
            "answer": best,
            "history": history,
            "counts": total(before.counts, counts) if counts else before.counts,
            "seconds": before.seconds + time.perf_counter() - began,
        }

    def check_representation(self, problem: Problem) -> None:
        """Refuse parts that work on another representation than the problem's: see `check_representation`."""
        check_representation(self, self.objectives, problem)


def check_representation(planner: Planner, objectives: Terms, problem: Problem) -> None:
    """Refuse parts of a planner that work on another representation than the problem's.

    Raises
    ------
    ConfigError
        Which part it is, and what the problem has.
    """
    given = problem.representation.name
    parts: list[Component] = [part for _, part in members(planner)] + list(objectives.objectives())
    for part in parts:
        parts += [inner for _, inner in members(part)]
        if part.works_on and part.works_on != given:
            raise ConfigError(f"{part.kind} {part.name!r} works on {part.works_on!r}; the problem has {given!r}")
