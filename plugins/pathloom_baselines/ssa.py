"""Sparrow search."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import Fidelity, Floats, Indices, Share, Swarm, Whole
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.vectors.planner import Judge, Vectors, VectorState
from pathloom_baselines.swarms import DECODED, Frame

EPSILON = 1e-50
"""ε of eq. (5)."""
USUAL = 500
"""T, where nothing says how many iterations there will be."""


@dataclass(frozen=True, kw_only=True)
class Ssa(Swarm):
    """SSA: sparrows, of which some look for food, the others go where those found it, and some take fright."""

    name: ClassVar[str] = "ssa"
    reference: ClassVar[str] = (
        "J. Xue, B. Shen (2020), A novel swarm intelligence optimization approach: sparrow search algorithm, Systems "
        "Science & Control Engineering 8(1), 22-34, doi:10.1080/21642583.2019.1708830"
    )
    bibtex: ClassVar[str] = """\
@article{xue2020ssa,
  author  = {Xue, Jiankai and Shen, Bo},
  title   = {A novel swarm intelligence optimization approach: sparrow search algorithm},
  journal = {Systems Science \\& Control Engineering},
  volume  = {8},
  number  = {1},
  pages   = {22--34},
  year    = {2020},
  doi     = {10.1080/21642583.2019.1708830}
}
"""
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        *DECODED,
        "Genes lie in [0, 1]: eq. (4) sends the hindmost to places of the order of 1, whatever the range.",
        "Ranks count from 1. A step starts where the sparrow was best so far, and is kept if that is better, as in the "
        "authors' program.",
        "Scroungers follow the best place to which a producer has come in the same iteration.",
        "β of eq. (5) is drawn for each dimension, Q and K once for each sparrow, R2 once for all.",
        "In eq. (5) f is the weighted sum of the objectives plus the penalty for a violation.",
        "Scouts are 10 %; 10 % and 20 % are both in use. 500 iterations are ours.",
        "Eq. (3) shrinks positions towards coordinate 0, and eqs. (3) to (5) shift rows and columns alike, so that "
        "results depend on which corner of the map is 0, 0, and how the map is turned: as printed. frame = neutral "
        "mends that.",
        "A sparrow that leaves the map is put on its border.",
    )

    producers: Share = 0.2
    """PD, the share of the sparrows, the best ones, that look for food."""
    scouts: Share = 0.1
    """SD, the share of all, at random, that take fright."""
    safety: Share = 0.8
    """ST, from which on the alarm R2 makes producers fly off."""
    horizon: Whole = 0
    """T of eq. (3); 0: the limit of ``max-generations``, or 500 without one."""
    frame: Frame = "absolute"
    """``absolute``: as printed; ``neutral``: coordinates count from the middle of the map, from -1 to 1, the common
    shift L has a random sign among the rows and one among the columns, and differences of coordinates go in without
    sign in eq. (4) and with sign in the last case of eq. (5)."""
    local_search: bool = False
    """Try a random value in each gene of the best sparrow, in each iteration, and keep what is better."""

    def move(self, state: VectorState, judge: Judge, rng: np.random.Generator) -> tuple[Vectors, Any]:
        swarm = state.vectors.at(state.vectors.order())
        n = len(swarm)
        X = self._framed(swarm.genes)
        leading = min(max(1, round(self.producers * n)), n)
        rank = np.arange(1, n + 1)[:, np.newaxis]
        axes = self.decoder.axes(judge.problem)

        found = judge(self._genes(self._produced(X[:leading], rank[:leading], axes, rng)))
        X_P = self._framed(found.genes[found.best()])
        there = np.concatenate((self._framed(found.genes), self._scrounged(X, X_P, rank, leading, axes, rng)))
        frightened = rng.permutation(n)[: round(self.scouts * n)]
        there[frightened] = self._scouted(X, swarm.costs, swarm.at(slice(1)).better(swarm), frightened, rng)

        once = np.arange(n) < leading  # whom nothing moves a second time
        once[frightened] = False
        later = np.flatnonzero(~once)
        place = np.arange(n)
        place[later] = leading + np.arange(len(later))
        moved = found.joined(judge(self._genes(there[later]))).at(place)
        swarm = swarm.replaced(moved.better(swarm), moved)
        return (self._searched(swarm, judge, rng) if self.local_search else swarm), None

    def _produced(self, X: Floats, rank: Indices, axes: Indices, rng: np.random.Generator) -> Floats:
        """Eq. (3)."""
        n = len(X)
        if rng.random() < self.safety:  # R2 < ST
            alpha = 1.0 - rng.random((n, 1))
            return np.asarray(X * np.exp(-rank / (alpha * self._horizon)))
        return np.asarray(X + rng.standard_normal((n, 1)) * self._ones(n, axes, rng))

    def _scrounged(
        self, X: Floats, X_P: Floats, rank: Indices, leading: int, axes: Indices, rng: np.random.Generator
    ) -> Floats:
        """Eq. (4)."""
        n, d = X.shape
        worst, X, rank = X[-1], X[leading:], rank[leading:]
        Q = rng.standard_normal((n - leading, 1))
        A = np.where(rng.random((n - leading, d)) < 0.5, -1.0, 1.0)
        L = self._ones(n - leading, axes, rng)
        if self.frame == "absolute":
            elsewhere = Q * np.exp((worst - X) / rank**2)
        else:
            elsewhere = Q * L * np.exp(-np.abs(worst - X) / rank**2)
        # A⁺ = Aᵀ (A Aᵀ)⁻¹ is Aᵀ / d: the same number is added in every dimension
        beside = X_P + (np.abs(X - X_P) * A).sum(axis=1, keepdims=True) / max(d, 1) * L
        return np.asarray(np.where(rank > n / 2, elsewhere, beside))

    def _scouted(
        self, X: Floats, f: Floats, worse: NDArray[np.bool_], chosen: Indices, rng: np.random.Generator
    ) -> Floats:
        """Eq. (5); ``worse`` (n,) than the best."""
        best, worst, X_i = X[0], X[-1], X[chosen]
        beta = rng.standard_normal(X_i.shape)
        K = rng.uniform(-1.0, 1.0, (len(chosen), 1))
        home = best + beta * np.abs(X_i - best)
        apart = np.abs(X_i - worst) if self.frame == "absolute" else X_i - worst
        away = X_i + K * apart / (f[chosen, np.newaxis] - f[-1] + EPSILON)
        return np.asarray(np.where(worse[chosen, np.newaxis], home, away))

    def _searched(self, swarm: Vectors, judge: Judge, rng: np.random.Generator) -> Vectors:
        row = swarm.best()
        best = swarm.at([row])
        for gene in rng.permutation(best.genes.shape[1]):
            genes = best.genes.copy()
            genes[0, gene] = rng.random()
            tried = judge(genes)
            best = best.replaced(tried.better(best), tried)
        return swarm.replaced(np.arange(len(swarm)) == row, best)

    @property
    def _horizon(self) -> int:
        limits = [c.limit for c in self.termination if isinstance(c, MaxGenerations)]
        return self.horizon or min(limits, default=USUAL)

    def _ones(self, n: int, axes: Indices, rng: np.random.Generator) -> Floats:
        """L: ones; in the neutral frame with a random sign (n, 2) for each axis."""
        if self.frame == "absolute":
            return np.ones((n, len(axes)))
        return np.where(rng.random((n, 2)) < 0.5, -1.0, 1.0)[:, axes]

    def _framed(self, genes: Floats) -> Floats:
        return genes if self.frame == "absolute" else 2.0 * genes - 1.0

    def _genes(self, X: Floats) -> Floats:
        return np.clip(X if self.frame == "absolute" else 0.5 * (X + 1.0), 0.0, 1.0)
