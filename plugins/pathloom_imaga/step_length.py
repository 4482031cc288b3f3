"""Section 2.1, eqs. (8) to (11): a prior model that chooses the step by the length that the first paths shall have."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import Component, Count, Positive, compiled, count
from pathloom.kernel.component import MOST
from pathloom.kernel.counting import counting
from pathloom.paths.problem import PathProblem

if TYPE_CHECKING:
    from pathloom_imaga.sampling import RestrictedUniform


@dataclass(frozen=True, kw_only=True)
class StepLength(Component, ABC):
    """A rule for the step of restricted uniform sampling."""

    kind: ClassVar[str] = "step-length"

    stretch: Positive = 1.4
    """Length wanted of the first paths, as a multiple of the distance from start to goal. Not in the paper."""

    @abstractmethod
    def step(self, sampling: "RestrictedUniform", problem: PathProblem, rng: np.random.Generator) -> int:
        """Return the step, at least 2."""

    def wanted(self, problem: PathProblem) -> float:
        """Return the length wanted, in cells."""
        (r0, c0), (r1, c1) = problem.ends
        return self.stretch * float(np.hypot(r1 - r0, c1 - c0))


@dataclass(frozen=True, kw_only=True)
class FittedStep(StepLength):
    """Draw a few paths with each of several steps, and fit the step as a quadratic of the mean length, eqs. (8)-(10).

    The paper fits once, on its own map; lengths differ so much from map to map
    that here every map has its own fit.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.1, eqs. (8) to (10)"

    largest: Annotated[int, msgspec.Meta(ge=2, le=MOST)] = 8
    """Steps from 2 to this one are tried."""
    samples: Count = 10
    """Paths drawn with each."""

    def step(self, sampling: "RestrictedUniform", problem: PathProblem, rng: np.random.Generator) -> int:
        steps, lengths = [], []
        with counting() as counts:
            for step in range(2, self.largest + 1):
                drawn = sampling.draw(problem, self.samples, step, self.samples, rng)
                if len(drawn):
                    steps.append(step)
                    lengths.append(compiled.measures.lengths(drawn, problem.context.cols).mean())
        count("calibration failed", counts.get("samples failed", 0))
        if len(set(lengths)) < 3:  # too few for a parabola
            return steps[0] if steps else self.largest
        wanted = min(max(self.wanted(problem), min(lengths)), max(lengths))  # no extrapolation
        a, b, c = np.polyfit(lengths, steps, 2)  # eq. (10)
        fitted = a * wanted**2 + b * wanted + c  # eq. (8)
        return int(min(max(round(fitted), steps[0]), self.largest))


@dataclass(frozen=True, kw_only=True)
class PublishedStep(StepLength):
    """The quadratic of eq. (11), times a factor.

    As printed it never exceeds 0.146, while a step is at least 2.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.1, eq. (11)"

    factor: Positive = 100.0
    """With 1 the formula is as printed; 100 is the power of ten that gives steps of 2.7 to 14.6. Not in the paper."""

    def step(self, sampling: "RestrictedUniform", problem: PathProblem, rng: np.random.Generator) -> int:
        x = self.wanted(problem)
        return max(2, round(self.factor * (-0.00064 * x**2 + 0.0519 * x - 0.9058)))
