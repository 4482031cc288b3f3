"""Section 5.4: the fusion of the genetic algorithm with the colony."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Colony, Deme, Distance, Floats, InitialPheromone, PathProblem, Positive, Share, compiled
from pathloom.paths.ants.ant_system import Least, share_of_least


@dataclass(frozen=True, kw_only=True)
class GaPheromoneSeed(InitialPheromone):
    """Lay τ_ij = τ_ji = φ / (D l_ij) along the best paths that a genetic algorithm has found, eq. (28).

    D is the length of the path, l_ij that of the step. A colony that nobody tells
    of paths finds the same pheromone everywhere.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.4, eq. (28)"

    share: Share = 0.2
    """How many of the known paths are laid, best first, at least one: "some" in the paper."""
    phi: Distance = 1.0
    """φ, in cells; not in the paper."""
    overlap: Literal["max", "sum"] = "max"
    """What a step bears that several of the paths take; not in the paper."""
    base: Positive | Least = "chance"
    """Pheromone of all other steps: a number, or τ_min of the MAX-MIN ant system, as the update of the same name has
    it. Not in the paper."""

    def lay(self, colony: Colony, problem: PathProblem, known: Deme) -> Floats:
        it = problem.context
        cells = it.blocked.size
        if len(known) == 0:
            return np.full((cells, 8), 1.0 if isinstance(self.base, str) else self.base)
        some = max(1, round(self.share * len(known)))
        merit = known.fitness[:some]  # 1 / D
        paths = compiled.reshaping.cell_by_cell(np.ascontiguousarray(known.population[:some]), it.cols)
        base = self.base
        if isinstance(base, str):
            top = int(merit.argmax())
            steps = int((paths[top] >= 0).sum()) - 1
            base = float(merit[top]) / colony.pheromone.rho * share_of_least(problem, steps, base)
        return np.asarray(compiled.ants.lay(base, paths, self.phi * merit, cells, it.cols, self.overlap == "max"))
