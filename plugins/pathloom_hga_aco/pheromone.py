"""Section 5.5.1: the pheromone update."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import ColonyState, Distance, Floats, PheromoneUpdate, Population
from pathloom.paths.ants.ant_system import Least, max_min_limits
from pathloom.paths.ants.pheromone import Rate


@dataclass(frozen=True, kw_only=True)
class TwoBest(PheromoneUpdate):
    """The best path of the iteration and the best of all leave pheromone; everywhere else it only evaporates.

    Δτ = (A / D_g + B / D_n) / N_c, eq. (32), with A + B = N_c, eq. (33). A, the
    weight of the best of all, is 0 at first and grows by one with each iteration,
    so that A / N_c is the used share of the budget. The formula adds both parts on
    one step; here each path leaves its own part on its own steps.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.5.1, eqs. (31) to (34)"

    rho: Rate = 0.3
    q: Distance = 1.0
    """Scale of the deposit, in cells; eq. (32) has none."""
    least: Least | Literal["none"] = "chance"
    """τ_min of the MAX-MIN ant system, with its τ_max = 1 / (ρ D_g): see `MaxMin` among the colony's parts. The paper
    names that system, but no limits; ``none``: there are none."""

    def deposits(self, state: ColonyState, progress: float) -> tuple[Population, Floats]:
        deme, best = state.demes[0], state.best
        if best is None:
            return deme.population, np.zeros(len(deme))
        paths, amounts = best.row[np.newaxis], [progress * best.fitness]
        if len(deme):  # else nobody arrived, and there is no best of the iteration
            top = deme.best()
            paths = state.problem.representation.stack(paths, deme.population[top : top + 1])
            amounts.append((1.0 - progress) * float(deme.fitness[top]))
        return paths, self.q * np.array(amounts)

    def limits(self, state: ColonyState) -> tuple[float, float]:
        if self.least == "none":
            return super().limits(state)
        return max_min_limits(state, self.q / self.rho, self.least)
