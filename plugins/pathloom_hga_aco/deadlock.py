"""Section 5.5.2: deadlock elimination."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import msgspec
import numpy as np

from pathloom import ColonyState, Count, Deadlock, Floats, Whole, compiled, count
from pathloom.paths.ants.pheromone import Counts
from pathloom.paths.context import Bytes
from pathloom.paths.pathwise import path_problem

Penalty = Annotated[float, msgspec.Meta(gt=0.0, lt=1.0)]


@dataclass(frozen=True, kw_only=True)
class DeadAngleTable(Deadlock):
    """Keep a table of the cells from which ants found no way on, and let no ant go there again.

    The pheromone of the steps into such a cell is multiplied by λ, eq. (35). Start
    and goal are never in the table, and it is cleared when no way is left without
    its cells.

    A caution: an ant is stuck where all cells around it are obstacles or on its
    own path, and that need not be a dead end of the map. A cell in the table for
    good may lie on the shortest path.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.5.2, eq. (35)"

    penalty: Penalty = 0.5
    """λ; not in the paper."""
    stuck: Literal["retreat", "die"] = "retreat"
    """Whether an ant that finds no way on takes a step back or dies; not in the paper."""
    times: Count = 10
    """After how many ants that got stuck in it a cell is in the table."""
    spare: bool = True
    """Keep those cells out of the table through which an ant of the same iteration arrived."""
    every: Whole = 0
    """Clear the table every so many iterations; 0: never."""

    @property
    def retreats(self) -> bool:
        return self.stuck == "retreat"

    def closed(self, table: Counts) -> Bytes:
        return (table >= self.times).view(np.uint8)

    def learn(self, state: ColonyState, pheromone: Floats) -> tuple[Counts, Floats]:
        it = path_problem(state.problem).context
        table, found = state.table, state.stuck > 0
        if found.any():
            pheromone = compiled.ants.weaken(pheromone, found, it.moves, it.cols, self.penalty)
            table = table + state.stuck
            if self.spare:
                table[state.population[state.population >= 0]] = 0
            if not compiled.ants.reaches(it.moves, self.closed(table), it.cols, it.start, it.goal):
                count("dead-angle table cleared")
                table = np.zeros_like(table)
        if self.every and (state.generation + 1) % self.every == 0:
            table = np.zeros_like(table)
        return table, pheromone
