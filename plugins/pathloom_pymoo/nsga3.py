"""NSGA-III: non-dominated sorting and niches about reference directions."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import Floats, Indices
from pathloom_pymoo.breeding import Breeding
from pathloom_pymoo.planner import Marks
from pathloom_pymoo.reference import directions
from pathloom_pymoo.state import FrontState
from pathloom_pymoo.tournament import contestants, winners

REMEMBERED = ("ideal_point", "worst_point", "nadir_point", "extreme_points")
"""What pymoo's normalization carries from one generation to the next."""


@dataclass(frozen=True, kw_only=True)
class Nsga3(Breeding):
    """NSGA-III, as pymoo has it: whom fewest dominate survives, of equals whoever fills an empty direction.

    pymoo's own tournament forgets the random generator where two individuals break
    the constraints alike (pymoo issue 794); here it is handed on.
    """

    name: ClassVar[str] = "nsga3"
    reference: ClassVar[str] = (
        "K. Deb, H. Jain (2014), An evolutionary many-objective optimization algorithm using reference-point-based "
        "nondominated sorting approach, part I, IEEE Transactions on Evolutionary Computation 18(4), 577-601, "
        "doi:10.1109/TEVC.2013.2281535"
    )
    bibtex: ClassVar[str] = """\
@article{deb2014nsga3,
  author    = {Deb, Kalyanmoy and Jain, Himanshu},
  title     = {An evolutionary many-objective optimization algorithm using reference-point-based
               nondominated sorting approach, part {I}},
  journal   = {IEEE Transactions on Evolutionary Computation},
  volume    = {18},
  number    = {4},
  pages     = {577--601},
  year      = {2014},
  doi       = {10.1109/TEVC.2013.2281535}
}
"""
    assumptions: ClassVar[tuple[str, ...]] = (
        "The reference directions are the finest even set that is no larger than the population.",
    )

    def parents(self, state: FrontState, pairs: int, rng: np.random.Generator) -> Indices:
        drawn = contestants(2 * pairs, len(state.population), rng)
        return winners(drawn, state.violation, [], rng).reshape(-1, 2)

    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        from pymoo.algorithms.moo.nsga3 import ReferenceDirectionSurvival

        from pathloom_pymoo.survival import survive

        survival: Any = ReferenceDirectionSurvival(directions(values.shape[1], self.population))
        vars(survival.norm).update({name: known.copy() for name, known in state.memory.items()})
        rows, marks = survive(survival, values, violation, self.population, rng)
        known = {name: getattr(survival.norm, name) for name in REMEMBERED}
        return rows, marks, {name: value for name, value in known.items() if value is not None}
