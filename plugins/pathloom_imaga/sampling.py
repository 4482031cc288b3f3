"""Section 2.1: the first population, by restricted uniform random search and median insertion."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import msgspec
import numpy as np

from pathloom import Count, Population, Problem, Sampling, Whole
from pathloom.kernel.component import MOST
from pathloom.paths.insertion import or_fallback, sample_through
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem
from pathloom_imaga.libraries import libraries
from pathloom_imaga.step_length import StepLength

Step = Annotated[int, msgspec.Meta(ge=2, le=MOST)]


@dataclass(frozen=True, kw_only=True)
class RestrictedUniform(Sampling):
    """Draw one cell from each library of nodes, none far from the one before, and insert midpoints between them."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.1, eqs. (2) to (7)"
    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    step: Step = 3
    """Limit of eq. (5), a strict one: consecutive nodes lie at most step − 1 rows and columns apart. Not in the
    paper. With 2 hardly a draw succeeds; the more, the longer the paths."""
    prior: StepLength | None = None
    """Chooses the step by a model of the length of the first paths, in place of ``step``."""
    redraws: Count = 50
    """How often a node is drawn again from its library before the path is dropped. Not in the paper."""
    goal_in_reach: bool = True
    """Hold the step from the last node to the goal to the limit too; eq. (5) is printed for the nodes alone."""
    reach: Literal[4, 8] = 4
    """Neighbours among which a midpoint in an obstacle gives way; the paper moves it among 4."""
    tries: Count = 1000
    """Failures in a row after which no more individuals are looked for. Not in the paper."""
    insertions: Whole = 0
    """Most insertions in one gap; 0: 4 (height + width). Not in the paper."""
    fallback: Sampling | None = None
    """What makes the population where not one individual was found. Not in the paper."""

    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        step = self.step if self.prior is None else self.prior.step(self, it, rng)
        found = self.draw(it, n, step, self.tries, rng)
        return or_fallback(found, n, self.fallback, problem, rng)

    def draw(self, problem: PathProblem, n: int, step: int, tries: int, rng: np.random.Generator) -> Population:
        """Return n paths whose nodes keep to a step, or none where ``tries`` in a row failed."""
        return sample_through(
            problem, libraries(problem.context), n, rng,
            tries=tries, insertions=self.insertions, step=step, redraws=self.redraws,
            to_goal=self.goal_in_reach, reach=self.reach,
        )  # fmt: skip
