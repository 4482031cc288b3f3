"""RVEA: angles to reference vectors."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import Floats, Indices, NonNegative, Share
from pathloom_pymoo.breeding import Breeding
from pathloom_pymoo.planner import Marks
from pathloom_pymoo.reference import directions
from pathloom_pymoo.state import FrontState

REMEMBERED = ("ideal", "nadir", "V", "gamma")
"""What pymoo's survival carries from one generation to the next."""


@dataclass(frozen=True, kw_only=True)
class Rvea(Breeding):
    """RVEA, as pymoo has it: one survives for each reference vector, at first the nearest to the ideal point.

    pymoo wants a number of generations that is known beforehand; here the used
    share of any budget serves.
    """

    name: ClassVar[str] = "rvea"
    reference: ClassVar[str] = (
        "R. Cheng, Y. Jin, M. Olhofer, B. Sendhoff (2016), A reference vector guided evolutionary algorithm for "
        "many-objective optimization, IEEE Transactions on Evolutionary Computation 20(5), 773-791, "
        "doi:10.1109/TEVC.2016.2519378"
    )
    bibtex: ClassVar[str] = """\
@article{cheng2016rvea,
  author    = {Cheng, Ran and Jin, Yaochu and Olhofer, Markus and Sendhoff, Bernhard},
  title     = {A reference vector guided evolutionary algorithm for many-objective optimization},
  journal   = {IEEE Transactions on Evolutionary Computation},
  volume    = {20},
  number    = {5},
  pages     = {773--791},
  year      = {2016},
  doi       = {10.1109/TEVC.2016.2519378}
}
"""
    assumptions: ClassVar[tuple[str, ...]] = (
        "In place of the share of generations counts the used share of any budget.",
        "The vectors stay as they are while all have the same value in one objective: pymoo's would become NaN.",
    )

    alpha: NonNegative = 2.0
    """How late in the run the angle begins to count: exponent of the used share of the budget."""
    adaptation: Share = 0.1
    """Share of the budget after which the vectors are fitted to the front's range again; 0: never."""

    def parents(self, state: FrontState, pairs: int, rng: np.random.Generator) -> Indices:
        from pymoo.operators.selection.rnd import RandomSelection

        return np.asarray(RandomSelection()._do(None, state.population, pairs, 2, random_state=rng))

    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        from pymoo.algorithms.moo.rvea import APDSurvival

        from pathloom_pymoo.survival import survive

        survival: Any = APDSurvival(directions(values.shape[1], self.population), alpha=self.alpha)
        vars(survival).update({name: known.copy() for name, known in state.memory.items() if name in REMEMBERED})
        used = self.progress(state)
        rows, _ = survive(survival, values, violation, self.population, rng, n_gen=used, n_max_gen=1.0)
        turn = np.array(used // self.adaptation if self.adaptation else 0.0)
        if turn > state.memory.get("turn", np.array(0.0)) and (survival.nadir > survival.ideal).all():
            survival.adapt()
        known = {name: getattr(survival, name) for name in REMEMBERED}
        return rows, {}, {"turn": turn, **{name: value for name, value in known.items() if value is not None}}
