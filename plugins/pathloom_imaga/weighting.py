"""Section 2.2: the weights ρ of the fitness, which the paper does not give."""

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from pathloom import Floats, Problem, Terms, Weighting, compiled
from pathloom.kernel.evaluation import measure
from pathloom.paths.pathwise import path_problem


@dataclass(frozen=True, kw_only=True)
class ReferenceScaled(Weighting):
    """Multiply the number beside each objective by its value on a shortest 8-connected path.

    On that path every term of weighted reciprocals then counts as much as its
    number says, whatever its unit. An objective that is zero there keeps its number.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.2, eq. (12): ρ, which is left open"

    def weights(self, terms: Terms, problem: Problem) -> Floats:
        return _scaled(terms, problem)


@lru_cache(maxsize=1)  # a run asks for the same again and again
def _scaled(terms: Terms, problem: Problem) -> Floats:
    it = path_problem(problem).context
    path = compiled.search.octile_path(it.moves, it.cols, it.start, it.goal)
    reference = measure(list(terms.objectives()), path[np.newaxis], problem)[0]
    weights = terms.weights * np.where(reference > 0, reference, 1.0)
    weights.setflags(write=False)
    return weights
