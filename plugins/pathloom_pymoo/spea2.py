"""SPEA2: strength, and distance to the nearest others."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import Floats, Indices
from pathloom_pymoo.breeding import Breeding
from pathloom_pymoo.nsga3 import REMEMBERED
from pathloom_pymoo.planner import Marks
from pathloom_pymoo.state import FrontState
from pathloom_pymoo.tournament import by_least, contestants, winners


@dataclass(frozen=True, kw_only=True)
class Spea2(Breeding):
    """SPEA2, as pymoo has it: who is dominated by few that dominate few survives, of equals whoever is alone."""

    name: ClassVar[str] = "spea2"
    reference: ClassVar[str] = (
        "E. Zitzler, M. Laumanns, L. Thiele (2001), SPEA2: Improving the strength Pareto evolutionary algorithm, "
        "TIK report 103, ETH Zurich, doi:10.3929/ethz-a-004284029"
    )
    bibtex: ClassVar[str] = """\
@techreport{zitzler2001spea2,
  author    = {Zitzler, Eckart and Laumanns, Marco and Thiele, Lothar},
  title     = {{SPEA2}: Improving the strength {Pareto} evolutionary algorithm},
  institution = {ETH Zurich},
  number    = {TIK 103},
  year      = {2001},
  doi       = {10.3929/ethz-a-004284029}
}
"""
    assumptions: ClassVar[tuple[str, ...]] = (
        "Population and archive are one, and distances are normalized, as in pymoo.",
    )

    def parents(self, state: FrontState, pairs: int, rng: np.random.Generator) -> Indices:
        drawn = contestants(2 * pairs, len(state.population), rng)
        strength = by_least(drawn, state.marks["SPEA_F"])
        return winners(drawn, state.violation, [strength], rng).reshape(-1, 2)

    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        from pymoo.algorithms.moo.nsga3 import HyperplaneNormalization
        from pymoo.algorithms.moo.spea2 import SPEA2Survival

        from pathloom_pymoo.survival import survive

        survival: Any = SPEA2Survival(normalize=True)
        if state.memory:
            survival.norm = HyperplaneNormalization(values.shape[1])
            vars(survival.norm).update({name: known.copy() for name, known in state.memory.items()})
        rows, marks = survive(survival, values, violation, self.population, rng)
        memory = {} if survival.norm is None else {name: getattr(survival.norm, name) for name in REMEMBERED}
        return rows, {"SPEA_F": marks.get("SPEA_F", np.zeros(len(values)))}, memory
