"""MOEA/D: one scalar problem for each reference direction, solved side by side."""

from dataclasses import dataclass
from functools import lru_cache
from types import SimpleNamespace
from typing import ClassVar

import numpy as np

from pathloom import Count, Floats, Indices, Population, Share
from pathloom_pymoo.planner import Marks, MultiObjective
from pathloom_pymoo.reference import directions
from pathloom_pymoo.state import FrontState


@dataclass(frozen=True, kw_only=True)
class Moead(MultiObjective):
    """MOEA/D, as pymoo has it in its parallel form: a child takes the place of neighbours that it improves on.

    The population has one individual for each direction, at most as many as asked
    for. pymoo's MOEA/D heeds no constraints. A child that is there already is not
    made up for, and the children serve the directions in random order.
    """

    name: ClassVar[str] = "moead"
    constrained: ClassVar[bool] = False
    reference: ClassVar[str] = (
        "Q. Zhang, H. Li (2007), MOEA/D: A multiobjective evolutionary algorithm based on decomposition, "
        "IEEE Transactions on Evolutionary Computation 11(6), 712-731, doi:10.1109/TEVC.2007.892759"
    )
    bibtex: ClassVar[str] = """\
@article{zhang2007moead,
  author    = {Zhang, Qingfu and Li, Hui},
  title     = {{MOEA/D}: A multiobjective evolutionary algorithm based on decomposition},
  journal   = {IEEE Transactions on Evolutionary Computation},
  volume    = {11},
  number    = {6},
  pages     = {712--731},
  year      = {2007},
  doi       = {10.1109/TEVC.2007.892759}
}
"""
    assumptions: ClassVar[tuple[str, ...]] = (
        "Of the two children of a pair one is taken at random, as in pymoo.",
        "All children of a generation are made before the first one replaces anybody, as in pymoo's parallel form.",
        "Up to two objectives are decomposed by Tchebycheff's distance, more by boundary intersection, as in pymoo.",
    )

    neighbours: Count = 20
    """How many directions, itself included, count as near."""
    near: Share = 0.9
    """Probability that parents come from near directions."""

    def children(self, state: FrontState, rng: np.random.Generator) -> tuple[Population, Indices]:
        from pymoo.algorithms.moo.moead import NeighborhoodSelection

        n = len(state.population)
        served = rng.permutation(n)
        near = self._neighbourhoods(state.demes[0].values.shape[1])[served]
        selection = NeighborhoodSelection(prob=self.near)
        pairs = selection._do(None, state.population, n, 2, neighbors=near, random_state=rng)
        either = 2 * np.arange(n) + rng.integers(2, size=n)
        parents = pairs.ravel()
        made = self.vary(state.population.take(parents, 0), state.fitness.take(parents), state, rng)
        return made.take(either, 0), served

    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        from pymoo.algorithms.moo.moead import ParallelMOEAD, default_decomp

        from pathloom_pymoo.survival import Rows

        objectives = values.shape[1]
        vectors = directions(objectives, self.population)
        rows = Rows({"F": values})
        if len(served) == 0:  # the first population
            return np.resize(np.arange(len(values)), len(vectors)), {}, {"ideal": values.min(axis=0)}
        parents = len(values) - len(served)
        algorithm = SimpleNamespace(
            pop=rows[:parents],
            ref_dirs=vectors,
            neighbors=self._neighbourhoods(objectives),
            decomposition=default_decomp(SimpleNamespace(n_obj=objectives)),
            ideal=np.minimum(state.memory["ideal"], values[parents:].min(axis=0)),
        )
        for child, direction in enumerate(served.tolist(), start=parents):
            ParallelMOEAD._replace(algorithm, direction, rows[child])
        return np.asarray(algorithm.pop), {}, {"ideal": algorithm.ideal}

    def _neighbourhoods(self, objectives: int) -> Indices:
        """Return for each direction the nearest ones (k, neighbours), as pymoo finds them."""
        return _neighbourhoods(objectives, self.population, self.neighbours)


@lru_cache(maxsize=32)
def _neighbourhoods(objectives: int, population: int, neighbours: int) -> Indices:
    from scipy.spatial.distance import cdist

    vectors = directions(objectives, population)
    return np.argsort(cdist(vectors, vectors), axis=1, kind="quicksort")[:, :neighbours]
