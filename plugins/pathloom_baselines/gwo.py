"""Grey wolf optimizer."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from pathloom import Fidelity, Floats, Indices, Swarm
from pathloom.paths.vectors.planner import Judge, Vectors, VectorState
from pathloom_baselines.swarms import DECODED, Frame


@dataclass(frozen=True, kw_only=True)
class Gwo(Swarm):
    """GWO: wolves that go round the three best places, ever closer."""

    name: ClassVar[str] = "gwo"
    reference: ClassVar[str] = (
        "S. Mirjalili, S. M. Mirjalili, A. Lewis (2014), Grey Wolf Optimizer, Advances in Engineering Software 69, "
        "46-61, doi:10.1016/j.advengsoft.2013.12.007"
    )
    bibtex: ClassVar[str] = """\
@article{mirjalili2014gwo,
  author  = {Mirjalili, Seyedali and Mirjalili, Seyed Mohammad and Lewis, Andrew},
  title   = {Grey Wolf Optimizer},
  journal = {Advances in Engineering Software},
  volume  = {69},
  pages   = {46--61},
  year    = {2014},
  doi     = {10.1016/j.advengsoft.2013.12.007}
}
"""
    fidelity: ClassVar[Fidelity] = "faithful"
    assumptions: ClassVar[tuple[str, ...]] = (
        *DECODED,
        "100 wolves, for comparison with the other swarms; the paper has 30. 500 iterations are the paper's.",
        "The leaders are the three best wolves ever seen; in the authors' program a new best does not make the one "
        "before it the second (leaders = authors).",
        "C scales a leader's position itself, so that results depend on which corner of the map is 0, 0, and how the "
        "map is turned: as printed. frame = neutral mends that.",
        "A wolf that leaves the map is put on its border.",
    )

    leaders: Literal["sorted", "authors"] = "sorted"
    """Who is followed: the three best ever seen; or, as in the authors' program, a new best takes the first place, and
    the one that it displaces is forgotten."""
    frame: Frame = "absolute"
    """``absolute``: D = |C X_l - X|, as printed; ``neutral``: D = |C (X_l - X)|."""

    def remember(self, vectors: Vectors) -> Vectors:
        return self._led(vectors.at([]), vectors)

    def move(self, state: VectorState, judge: Judge, rng: np.random.Generator) -> tuple[Vectors, Any]:
        leaders: Vectors = state.memory
        a = 2.0 - 2.0 * self.progress(state)
        vectors = judge(np.clip(self._around(state.vectors.genes, leaders.genes, a, rng), 0.0, 1.0))
        return vectors, self._led(leaders, vectors)

    def _around(self, X: Floats, leaders: Floats, a: float, rng: np.random.Generator) -> Floats:
        r1, r2 = rng.random((2, 3, *X.shape))  # for each leader, wolf and dimension
        A = 2.0 * a * r1 - a  # eq. (3.3)
        C = 2.0 * r2  # eq. (3.4)
        X_l = leaders[:, np.newaxis]
        D = np.abs(C * X_l - X) if self.frame == "absolute" else np.abs(C * (X_l - X))  # eq. (3.5)
        return np.asarray((X_l - A * D).mean(axis=0))  # eqs. (3.6), (3.7)

    def _led(self, leaders: Vectors, wolves: Vectors) -> Vectors:
        """Return the three leaders after so many wolves have come to where they are."""
        known = leaders.joined(wolves)
        if self.leaders == "authors":
            return known.at(_overwritten(_ranks(known), len(leaders)))
        order = known.order()
        return known.at(order[np.minimum(np.arange(3), len(order) - 1)])


def _ranks(vectors: Vectors) -> Indices:
    """Return how many different qualities are better than each vector's own."""
    order = vectors.order()
    ranked = vectors.at(order)
    ranks = np.empty(len(order), np.intp)
    ranks[order[1:]] = np.cumsum(ranked.at(slice(None, -1)).better(ranked.at(slice(1, None))))
    ranks[order[0]] = 0
    return ranks


def _overwritten(ranks: Indices, led: int) -> Indices:
    """Return the rows of the leaders after those behind the first ``led`` have come by, one after the other.

    Each that is better than the first leader takes its place; that is worse, but
    better than the second, takes the second's; likewise the third's.
    """
    wolves = np.arange(led, len(ranks))
    found: list[int] = []
    for place in range(3):
        first = ranks[place] if led else np.iinfo(np.intp).max
        reached = np.minimum.accumulate(np.concatenate(([first], ranks[wolves])))
        renewed = ranks[wolves] < reached[:-1]
        found.append(int(wolves[renewed][-1]) if renewed.any() else place if led else found[-1])
        wolves = wolves[ranks[wolves] > reached[:-1]]
    return np.array(found)
