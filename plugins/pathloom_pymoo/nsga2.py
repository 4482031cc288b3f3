"""NSGA-II: non-dominated sorting and crowding."""

from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar

import numpy as np

from pathloom import Floats, Indices
from pathloom_pymoo.breeding import Breeding
from pathloom_pymoo.planner import Marks
from pathloom_pymoo.state import FrontState
from pathloom_pymoo.tournament import by_dominance, by_least, contestants, winners


@dataclass(frozen=True, kw_only=True)
class Nsga2(Breeding):
    """NSGA-II, as pymoo has it: whom fewest dominate survives, of equals whoever stands more alone."""

    name: ClassVar[str] = "nsga2"
    reference: ClassVar[str] = (
        "K. Deb, A. Pratap, S. Agarwal, T. Meyarivan (2002), A fast and elitist multiobjective genetic algorithm: "
        "NSGA-II, IEEE Transactions on Evolutionary Computation 6(2), 182-197, doi:10.1109/4235.996017"
    )
    bibtex: ClassVar[str] = """\
@article{deb2002nsga2,
  author    = {Deb, Kalyanmoy and Pratap, Amrit and Agarwal, Sameer and Meyarivan, T.},
  title     = {A fast and elitist multiobjective genetic algorithm: {NSGA-II}},
  journal   = {IEEE Transactions on Evolutionary Computation},
  volume    = {6},
  number    = {2},
  pages     = {182--197},
  year      = {2002},
  doi       = {10.1109/4235.996017}
}
"""
    assumptions: ClassVar[tuple[str, ...]] = (
        "The tournament is pymoo's: dominance before crowding, not rank before crowding.",
    )

    def parents(self, state: FrontState, pairs: int, rng: np.random.Generator) -> Indices:
        drawn = contestants(2 * pairs, len(state.population), rng)
        dominance = by_dominance(drawn, state.demes[0].values)
        alone = by_least(drawn, -state.marks["crowding"])
        return winners(drawn, state.violation, [dominance, alone], rng).reshape(-1, 2)

    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        rank, crowding = np.zeros(len(values)), np.zeros(len(values))
        feasible = (violation == 0.0).nonzero()[0]
        kept = [np.arange(0)]
        if len(feasible):
            chosen, rank[feasible], crowding[feasible] = rank_and_crowding(values[feasible], self.population, rng)
            kept.append(feasible[chosen])
        # pymoo fills up with those that break the constraints least.
        others = (violation > 0.0).nonzero()[0]
        others = others[np.argsort(violation[others])]
        kept.append(others[: self.population - sum(map(len, kept))])
        return np.concatenate(kept), {"rank": rank, "crowding": crowding}, {}


def rank_and_crowding(values: Floats, n: int, rng: np.random.Generator) -> tuple[Indices, Floats, Floats]:
    """Return who of the values (k, m) survives, and everybody's rank and crowding distance (k,).

    The same statements as in pymoo's ``RankAndCrowding``, with arrays in place of
    its loop over individuals, which takes ten times as long as the rest.
    """
    sorting, crowding_distance, randomized_argsort = _pymoo()
    rank, crowding = np.zeros(len(values)), np.zeros(len(values))
    survivors: list[Indices] = []
    there = 0
    for k, front in enumerate(sorting.do(values, n_stop_if_ranked=n)):
        surplus = max(there + len(front) - n, 0)
        distance = crowding_distance.do(values[front], n_remove=surplus)
        rank[front], crowding[front] = k, distance
        if surplus:
            order = randomized_argsort(distance, order="descending", method="numpy", random_state=rng)
            front = front[order[:-surplus]]  # noqa: PLW2901 - the last one is cut
        survivors.append(front)
        there += len(front)
    return np.concatenate(survivors), rank, crowding


@cache
def _pymoo() -> tuple[Any, Any, Any]:
    """Return pymoo's sorting into fronts, crowding distance and sorting with random ties; loading it takes a while."""
    from pymoo.operators.survival.rank_and_crowding.metrics import get_crowding_function
    from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting
    from pymoo.util.randomized_argsort import randomized_argsort

    return NonDominatedSorting(), get_crowding_function("cd"), randomized_argsort
