"""Artificial fish swarm."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from pathloom import Count, Fidelity, Floats, Positive, Share, Swarm, Termination
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.vectors.planner import Judge, Vectors, VectorState
from pathloom_baselines.swarms import DECODED


@dataclass(frozen=True, kw_only=True)
class Afsa(Swarm):
    """AFSA: fish that prey, swarm, and follow one another."""

    name: ClassVar[str] = "afsa"
    reference: ClassVar[str] = (
        "X.-L. Li, Z.-J. Shao, J.-X. Qian (2002), An optimizing method based on autonomous animats: fish-swarm "
        "algorithm, Systems Engineering - Theory & Practice 22(11), 32-38 (in Chinese)"
    )
    bibtex: ClassVar[str] = """\
@article{li2002afsa,
  author  = {Li, Xiao-Lei and Shao, Zhi-Jiang and Qian, Ji-Xin},
  title   = {An optimizing method based on autonomous animats: fish-swarm algorithm},
  journal = {Systems Engineering -- Theory \\& Practice},
  volume  = {22},
  number  = {11},
  pages   = {32--38},
  year    = {2002}
}
"""
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        *DECODED,
        "The original was not at hand; the rules are those of later descriptions in English.",
        "100 fish and 100 iterations, each of which takes hundreds of evaluations; 10 tries, a visual of 0.25 and a "
        "step of 0.1 are ours, δ = 0.618 is common.",
        "The distance of two fish is the root mean square over their way-points, in shares of the map's sides.",
        "A place is crowded where the share of the fish in sight of it reaches δ; of a centre, those in sight of the "
        "fish itself. Other texts compare food (crowding = food-ratio).",
        "All fish look at where the others were before the iteration.",
        "A fish that leaves the map is put on its border.",
    )

    visual: Positive = 0.25
    """How far a fish sees."""
    stride: Positive = 0.1
    """How far it moves at most: step, in the literature."""
    delta: Share = 0.618
    """δ, from which on a place is crowded."""
    tries: Count = 10
    """How often a fish looks for something better before it moves at random."""
    crowding: Literal["share", "food-ratio"] = "share"
    """``share``: not crowded where n_f / N < δ; ``food-ratio``: where Y_c / n_f > δ Y_i, with the reciprocal of the
    cost as food Y."""
    termination: tuple[Termination, ...] = (MaxGenerations(limit=100),)

    def move(self, state: VectorState, judge: Judge, rng: np.random.Generator) -> tuple[Vectors, Any]:
        fish = state.vectors
        axes = self.decoder.axes(judge.problem)
        waypoints = int(np.bincount(axes, minlength=1).max()) or 1
        X = fish.genes
        apart = _size(X[:, np.newaxis] - X, waypoints)
        near = (apart <= self.visual) & ~np.eye(len(X), dtype=bool)
        swarmed, in_swarm = self._swarm(fish, near, judge, waypoints, rng)
        followed, in_wake = self._follow(fish, near, waypoints, rng)
        swarmed[~in_swarm] = self._prey(fish.at(~in_swarm), judge, waypoints, rng)
        followed[~in_wake] = self._prey(fish.at(~in_wake), judge, waypoints, rng)
        one, other = judge(np.clip(swarmed, 0.0, 1.0)), judge(np.clip(followed, 0.0, 1.0))
        return one.replaced(other.better(one), other), None

    def _prey(self, fish: Vectors, judge: Judge, waypoints: int, rng: np.random.Generator) -> Floats:
        """Step towards the first place in sight that is better, or else anywhere."""
        X = fish.genes
        moved = X + self.stride * rng.uniform(-1.0, 1.0, X.shape)
        hungry = np.arange(len(X))
        for _ in range(self.tries):
            if len(hungry) == 0:
                break
            seen = judge(np.clip(X[hungry] + self.visual * rng.uniform(-1.0, 1.0, X[hungry].shape), 0.0, 1.0))
            better = seen.better(fish.at(hungry))
            lucky = hungry[better]
            moved[lucky] = self._towards(X[lucky], seen.genes[better], waypoints, rng)
            hungry = hungry[~better]
        return moved

    def _swarm(
        self, fish: Vectors, near: NDArray[np.bool_], judge: Judge, waypoints: int, rng: np.random.Generator
    ) -> tuple[Floats, NDArray[np.bool_]]:
        """Step towards the centre of those in sight, where that is better and not crowded; say who did."""
        n_f = near.sum(axis=1)
        centre = (near @ fish.genes) / np.maximum(n_f, 1)[:, np.newaxis]
        moved = fish.genes.copy()
        went = n_f > 0
        if self.crowding == "share":
            went &= n_f / len(fish) < self.delta
        rows = np.flatnonzero(went)
        there, here = judge(centre[rows]), fish.at(rows)
        good = there.better(here)
        if self.crowding == "food-ratio":
            good &= here.costs > self.delta * n_f[rows] * there.costs
        went[rows[~good]] = False
        moved[went] = self._towards(fish.genes[went], centre[went], waypoints, rng)
        return moved, went

    def _follow(
        self, fish: Vectors, near: NDArray[np.bool_], waypoints: int, rng: np.random.Generator
    ) -> tuple[Floats, NDArray[np.bool_]]:
        """Step towards the best of those in sight, where it is better and not crowded; say who did."""
        n_f = near.sum(axis=1)
        rank = np.argsort(fish.order())
        best = np.where(near, rank, len(fish)).argmin(axis=1)
        leader = fish.at(best)
        went = (n_f > 0) & leader.better(fish)
        if self.crowding == "share":
            went &= n_f[best] / len(fish) < self.delta
        else:
            went &= fish.costs > self.delta * n_f[best] * leader.costs
        moved = fish.genes.copy()
        moved[went] = self._towards(fish.genes[went], leader.genes[went], waypoints, rng)
        return moved, went

    def _towards(self, X: Floats, target: Floats, waypoints: int, rng: np.random.Generator) -> Floats:
        """Return places up to a step away from X, in the direction of the target."""
        way = target - X
        far = _size(way, waypoints)[:, np.newaxis]
        length = self.stride * rng.random((len(X), 1))
        return X + length * np.divide(way, far, out=np.zeros_like(way), where=far > 0.0)


def _size(differences: Floats, waypoints: int) -> Floats:
    """Return the root mean square over the way-points of differences (…, d)."""
    return np.asarray(np.sqrt((differences**2).sum(axis=-1) / waypoints))
