"""Particle swarm optimisation."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from pathloom import ConfigError, Fidelity, Floats, NonNegative, Positive, Swarm
from pathloom.paths.vectors.planner import Judge, Vectors, VectorState
from pathloom_baselines.swarms import DECODED


@dataclass(frozen=True)
class Flight:
    """What particles remember."""

    velocities: Floats
    """(n, d)."""
    own: Vectors
    """Where each was best so far."""


@dataclass(frozen=True, kw_only=True)
class Pso(Swarm):
    """PSO: particles drawn to where they were best and to where any was best."""

    name: ClassVar[str] = "pso"
    reference: ClassVar[str] = (
        "J. Kennedy, R. Eberhart (1995), Particle Swarm Optimization, Proc. ICNN'95, vol. 4, 1942-1948, "
        "doi:10.1109/ICNN.1995.488968; inertia: Y. Shi, R. Eberhart (1998), A modified particle swarm optimizer; "
        "constriction: M. Clerc, J. Kennedy (2002), IEEE Trans. Evol. Comput. 6(1), 58-73"
    )
    bibtex: ClassVar[str] = """\
@inproceedings{kennedy1995pso,
  author    = {Kennedy, James and Eberhart, Russell},
  title     = {Particle Swarm Optimization},
  booktitle = {Proceedings of ICNN'95, International Conference on Neural Networks},
  volume    = {4},
  pages     = {1942--1948},
  year      = {1995},
  doi       = {10.1109/ICNN.1995.488968}
}
"""
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        *DECODED,
        "100 particles, 500 iterations; 20 to 50 particles are as usual.",
        "The inertia weight falls in a straight line from 0.9 to 0.4 over the budget.",
        "A component that would leave [0, 1] stays on the border, and its velocity becomes 0.",
        "All particles move, then all are valued, then what was best is renewed.",
    )

    form: Literal["inertia", "constriction"] = "inertia"
    """``inertia``: v ← w v + …; ``constriction``: v ← χ (v + …), which needs ``cognitive`` + ``social`` above 4, such
    as 2.05 each."""
    inertia_first: NonNegative = 0.9
    """w in the first iteration."""
    inertia_last: NonNegative = 0.4
    """w at the end of the budget."""
    cognitive: NonNegative = 2.0
    """c1, the pull of the particle's own best."""
    social: NonNegative = 2.0
    """c2, the pull of the swarm's best."""
    fastest: Positive = 0.2
    """Greatest velocity in each dimension, as a share of the range."""
    bounds: Literal["clip", "reflect", "random"] = "clip"
    """What becomes of a component that leaves [0, 1]: it stops on the border; it comes back as far as it went out, and
    its velocity turns round; or it is drawn anew, and its velocity becomes 0."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.form == "constriction" and self.cognitive + self.social <= 4.0:
            raise ConfigError(
                f"{self.name}: constriction needs cognitive + social above 4, such as 2.05 each; "
                f"got {self.cognitive:g} + {self.social:g}"
            )

    @property
    def constriction(self) -> float:
        """χ (Clerc and Kennedy 2002), 0.7298 for 2.05 + 2.05."""
        pull = self.cognitive + self.social
        return 2.0 / abs(2.0 - pull - math.sqrt(pull * pull - 4.0 * pull))

    def remember(self, vectors: Vectors) -> Flight:
        return Flight(np.zeros_like(vectors.genes), vectors)

    def move(self, state: VectorState, judge: Judge, rng: np.random.Generator) -> tuple[Vectors, Any]:
        flight: Flight = state.memory
        x, own = state.vectors.genes, flight.own
        v = self._velocities(x, flight.velocities, own.genes, own.genes[own.best()], self.progress(state), rng)
        x, v = self._bounded(x + v, v, rng)
        vectors = judge(x)
        return vectors, Flight(v, own.replaced(vectors.better(own), vectors))

    def _velocities(
        self, x: Floats, v: Floats, own: Floats, best: Floats, progress: float, rng: np.random.Generator
    ) -> Floats:
        r1, r2 = rng.random((2, *x.shape))  # for each dimension
        pull = self.cognitive * r1 * (own - x) + self.social * r2 * (best - x)
        if self.form == "constriction":
            v = self.constriction * (v + pull)
        else:
            v = (self.inertia_first + (self.inertia_last - self.inertia_first) * progress) * v + pull
        return np.clip(v, -self.fastest, self.fastest)

    def _bounded(self, x: Floats, v: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
        outside = (x < 0.0) | (x > 1.0)
        inside = np.clip(x, 0.0, 1.0)
        if self.bounds == "reflect":
            return np.clip(2.0 * inside - x, 0.0, 1.0), np.where(outside, -v, v)
        if self.bounds == "random":
            inside = np.where(outside, rng.random(x.shape), x)
        return inside, np.where(outside, 0.0, v)
