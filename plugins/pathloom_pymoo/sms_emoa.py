"""SMS-EMOA: non-dominated sorting and contributions to the hypervolume."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Floats, Indices
from pathloom_pymoo.breeding import Breeding
from pathloom_pymoo.planner import Marks
from pathloom_pymoo.state import FrontState
from pathloom_pymoo.tournament import by_dominance, contestants, winners


@dataclass(frozen=True, kw_only=True)
class SmsEmoa(Breeding):
    """SMS-EMOA, as pymoo has it: of the last front, whoever adds least hypervolume goes first."""

    name: ClassVar[str] = "sms-emoa"
    reference: ClassVar[str] = (
        "N. Beume, B. Naujoks, M. Emmerich (2007), SMS-EMOA: Multiobjective selection based on dominated hypervolume, "
        "European Journal of Operational Research 181(3), 1653-1669, doi:10.1016/j.ejor.2006.08.008"
    )
    bibtex: ClassVar[str] = """\
@article{beume2007smsemoa,
  author    = {Beume, Nicola and Naujoks, Boris and Emmerich, Michael},
  title     = {{SMS-EMOA}: Multiobjective selection based on dominated hypervolume},
  journal   = {European Journal of Operational Research},
  volume    = {181},
  number    = {3},
  pages     = {1653--1669},
  year      = {2007},
  doi       = {10.1016/j.ejor.2006.08.008}
}
"""
    assumptions: ClassVar[tuple[str, ...]] = (
        "A generation makes as many children as there are individuals, as in pymoo, not one.",
    )

    def parents(self, state: FrontState, pairs: int, rng: np.random.Generator) -> Indices:
        drawn = contestants(2 * pairs, len(state.population), rng)
        dominance = by_dominance(drawn, state.demes[0].values)
        return winners(drawn, state.violation, [dominance], rng).reshape(-1, 2)

    def survivors(
        self, values: Floats, violation: Floats, served: Indices, state: FrontState, rng: np.random.Generator
    ) -> tuple[Indices, Marks, Marks]:
        from pymoo.algorithms.moo.sms import LeastHypervolumeContributionSurvival

        from pathloom_pymoo.survival import survive

        # pymoo scales by the range of the parents, which is steadier than that of all.
        scale = state.demes[0].values if state.demes else values
        rows, marks = survive(
            LeastHypervolumeContributionSurvival(), values, violation, self.population, rng,
            ideal=scale.min(axis=0), nadir=scale.max(axis=0) + 1e-32,
        )  # fmt: skip
        return rows, marks, {}
