"""Ant System on a grid, and what some programs do otherwise."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import (
    Colony,
    ColonyState,
    Deme,
    Fidelity,
    Floats,
    Heuristic,
    InitialPheromone,
    PathProblem,
    Population,
    Positive,
    Termination,
)
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.ants.ant_system import AntSystem, beyond
from pathloom.paths.context import STEPS

DORIGO = (
    "M. Dorigo, V. Maniezzo, A. Colorni (1996), Ant System: Optimization by a Colony of Cooperating Agents, IEEE "
    "Transactions on Systems, Man, and Cybernetics B 26(1), 29-41, doi:10.1109/3477.484436"
)
BIBTEX = """\
@article{dorigo1996ant,
  author  = {Dorigo, Marco and Maniezzo, Vittorio and Colorni, Alberto},
  title   = {Ant System: Optimization by a Colony of Cooperating Agents},
  journal = {IEEE Transactions on Systems, Man, and Cybernetics, Part B},
  volume  = {26},
  number  = {1},
  year    = {1996},
  pages   = {29--41},
  doi     = {10.1109/3477.484436}
}
"""


@dataclass(frozen=True, kw_only=True)
class Aco(Colony):
    """ACO: Ant System on a grid, as much public code has it.

    ``pheromone = "max-min"`` makes it the MAX-MIN ant system of Stützle and Hoos (2000).
    """

    name: ClassVar[str] = "aco"
    reference: ClassVar[str] = DORIGO
    bibtex: ClassVar[str] = BIBTEX
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Ant System is made for round trips; what it does on a grid, and with which parameters, is common in public "
        "code: 50 ants, 100 iterations, alpha 1, beta 5, rho 0.1, Q 1, tau 1 at first.",
        "The heuristic is one over the distance from the next cell to the goal, for that of the step tells little.",
        "Pheromone lies on steps, in the direction in which they are taken; some programs keep it for cells instead: "
        "pheromone.on.",
        "An ant that finds no way on takes a step back. In public code it mostly dies, deadlock = die: on crowded maps "
        "of 50 x 50 cells not one may arrive then.",
        "100 iterations follow the first march, as the generations of an evolution follow its first population.",
    )

    termination: tuple[Termination, ...] = (MaxGenerations(limit=100),)


@dataclass(frozen=True, kw_only=True)
class InProportion(InitialPheromone):
    """τ_0 = c η: the more desirable a step, the more pheromone on it at first."""

    source: ClassVar[str] = "public programs for grids"

    factor: Positive = 10.0
    """c."""

    def lay(self, colony: Colony, problem: PathProblem, known: Deme) -> Floats:
        eta = colony.heuristic.desirability(problem)
        most = eta.max(initial=0.0, where=np.isfinite(eta))
        return np.asarray(self.factor * np.minimum(eta, most))  # a step that is taken in any case needs no more


@dataclass(frozen=True, kw_only=True)
class StepAndGoalDistance(Heuristic):
    """η = 1 / (d_ij + d), with the length of the step and the distance from where it leads to the goal."""

    source: ClassVar[str] = "our reconstruction of Châari et al. 2014"

    def desirability(self, problem: PathProblem) -> Floats:
        return np.asarray(1.0 / (np.array([np.hypot(dr, dc) for dr, dc in STEPS]) + beyond(problem)))


@dataclass(frozen=True, kw_only=True)
class NoWorseThanMean(AntSystem):
    """Every ant whose path is no longer than the mean of its march leaves Q · F."""

    source: ClassVar[str] = "our reconstruction of Châari et al. 2014"

    def deposits(self, state: ColonyState, progress: float) -> tuple[Population, Floats]:
        paths, amounts = super().deposits(state, progress)
        with np.errstate(divide="ignore"):
            lengths = 1.0 / amounts
        good = lengths <= lengths.sum() / max(len(lengths), 1) * (1.0 + 1e-12)
        return np.ascontiguousarray(paths[good]), amounts[good]
