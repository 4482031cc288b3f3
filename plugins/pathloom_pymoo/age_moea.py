"""AGE-MOEA: non-dominated sorting and distances in the geometry that the front seems to have."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Floats, Indices
from pathloom_pymoo.breeding import Breeding
from pathloom_pymoo.planner import Marks
from pathloom_pymoo.state import FrontState
from pathloom_pymoo.tournament import by_least, contestants, winners


@dataclass(frozen=True, kw_only=True)
class AgeMoea(Breeding):
    """AGE-MOEA, as pymoo has it: the front's curvature is estimated, and distances are measured along it.

    pymoo compiles parts of it in every process when they are first used, a few seconds.
    """

    name: ClassVar[str] = "age-moea"
    reference: ClassVar[str] = (
        "A. Panichella (2019), An adaptive evolutionary algorithm based on non-Euclidean geometry for many-objective "
        "optimization, GECCO 2019, 595-603, doi:10.1145/3321707.3321839"
    )
    bibtex: ClassVar[str] = """\
@inproceedings{panichella2019agemoea,
  author    = {Panichella, Annibale},
  title     = {An adaptive evolutionary algorithm based on non-{Euclidean} geometry for many-objective optimization},
  booktitle = {Genetic and Evolutionary Computation Conference (GECCO)},
  pages     = {595--603},
  year      = {2019},
  doi       = {10.1145/3321707.3321839}
}
"""
    assumptions: ClassVar[tuple[str, ...]] = (
        "The front's geometry is estimated by pymoo's first version of the algorithm.",
    )

    def parents(self, state: FrontState, pairs: int, rng: np.random.Generator) -> Indices:
        drawn = contestants(2 * pairs, len(state.population), rng)
        rank, alone = by_least(drawn, state.marks["rank"]), by_least(drawn, -state.marks["crowding"])
        return winners(drawn, state.violation, [rank, alone], rng).reshape(-1, 2)

    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        from pymoo.algorithms.moo.age import AGEMOEASurvival

        from pathloom_pymoo.survival import survive

        rows, marks = survive(AGEMOEASurvival(), values, violation, self.population, rng)
        return rows, {name: marks.get(name, np.zeros(len(values))) for name in ("rank", "crowding")}, {}
