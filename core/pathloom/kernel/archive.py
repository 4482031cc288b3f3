"""Archive: what a run remembers as its answer, where that is not simply its fittest individual."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom.kernel.component import Component
from pathloom.kernel.counting import count
from pathloom.kernel.evaluation import Objective
from pathloom.kernel.operators import Indices, Repair
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Deme, Individual


@dataclass(frozen=True, kw_only=True)
class Archive(Component, ABC):
    """Keeps the individual that the planner will answer with."""

    kind: ClassVar[str] = "archive"

    @abstractmethod
    def update(
        self,
        kept: Individual | None,
        deme: Deme,
        newcomers: Indices,
        generation: int,
        problem: Problem,
        refinement: Repair | None,
        rng: np.random.Generator,
    ) -> Individual | None:
        """Return the kept individual, or a better one of this generation.

        ``newcomers``: indices of the individuals that the generation before did not have.
        """


@dataclass(frozen=True, kw_only=True)
class BestRefined(Archive):
    """Refine every new individual of every generation and keep the one that is then best by one objective.

    The search itself is not touched: refined individuals do not go back into
    the population. They are counted as ``refined``, not as evaluations.
    """

    objective: Objective
    """What the refined individuals are compared by."""

    def update(
        self,
        kept: Individual | None,
        deme: Deme,
        newcomers: Indices,
        generation: int,
        problem: Problem,
        refinement: Repair | None,
        rng: np.random.Generator,
    ) -> Individual | None:
        if len(newcomers) == 0:
            return kept
        refined = deme.population[newcomers]
        if refinement is not None:
            refined = refinement.apply(refined, problem, rng)
        count("refined", len(newcomers))
        merits = -self.objective.measure(refined, problem)
        top = int(np.argmax(merits))
        if kept is not None and merits[top] <= kept.merit:
            return kept
        row = newcomers[top]
        return Individual(
            deme.population[row], deme.values[row], float(deme.fitness[row]), generation, float(merits[top])
        )
