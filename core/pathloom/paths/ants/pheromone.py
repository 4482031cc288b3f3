"""The parts that a colony of ants is made of: what guides it, what it leaves behind, and what becomes of the lost."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.kernel.component import Component
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.representation import Population
from pathloom.kernel.state import Deme, State
from pathloom.paths.context import Bytes
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem

if TYPE_CHECKING:
    from pathloom.paths.ants.colony import Colony

Rate = Annotated[float, msgspec.Meta(gt=0.0, le=1.0)]
"""A share above zero."""
Counts = NDArray[np.int32]
"""A whole number for each cell."""


@dataclass(frozen=True)
class ColonyState(State):
    """Where a colony stands after an iteration. Its population are the paths of the ants that arrived."""

    pheromone: Floats = field(default_factory=lambda: np.empty((0, 8)))
    """(cells, 8), with which the next ants set out."""
    desire: Floats = field(default_factory=lambda: np.empty((0, 8)))
    """(cells, 8), η^β as a share of the largest at its cell: worked out once for all."""
    stuck: Counts = field(default_factory=lambda: np.empty(0, np.int32))
    """(cells,), how many ants of this iteration found no way on from a cell."""
    table: Counts = field(default_factory=lambda: np.empty(0, np.int32))
    """(cells,), what the deadlock handling remembers."""


@dataclass(frozen=True, kw_only=True)
class Heuristic(Component, ABC):
    """What makes a step desirable, apart from the pheromone on it."""

    kind: ClassVar[str] = "heuristic"
    works_on: ClassVar[str] = "cells"

    @abstractmethod
    def desirability(self, problem: PathProblem) -> Floats:
        """Return η (cells, 8) for every cell and each of the eight directions out of it.

        Infinity is a step that is taken wherever it can be; entries of steps that are not legal are not looked at.
        """


@dataclass(frozen=True, kw_only=True)
class InitialPheromone(Component, ABC):
    """The pheromone that the first ants find."""

    kind: ClassVar[str] = "initial-pheromone"
    works_on: ClassVar[str] = "cells"

    @abstractmethod
    def lay(self, colony: "Colony", problem: PathProblem, known: Deme) -> Floats:
        """Return τ (cells, 8), above zero.

        ``known``: paths that somebody has found before, best first by whatever he went by, with the colony's own
        fitness; mostly none.
        """


@dataclass(frozen=True, kw_only=True)
class PheromoneUpdate(Component, ABC):
    """How pheromone evaporates, and who leaves how much of it."""

    kind: ClassVar[str] = "pheromone-update"
    works_on: ClassVar[str] = "cells"

    rho: Rate = 0.1
    """ρ, the share that evaporates in each iteration."""
    on: Literal["edges", "cells"] = "edges"
    """Whether a path marks the steps that it takes, or the cells: then every step into one of them."""

    @abstractmethod
    def deposits(self, state: ColonyState, progress: float) -> tuple[Population, Floats]:
        """Return paths (k, width), 8-connected, and how much each leaves on every step, (k,).

        ``state``: after the march; ``progress``: the used share of the budget, in [0, 1].
        """

    def limits(self, state: ColonyState) -> tuple[float, float]:
        """Return the least and the most pheromone that a step may bear."""
        return 0.0, np.inf

    def update(self, state: ColonyState, progress: float) -> Floats:
        """Return the pheromone (cells, 8) for the next march; ``state.pheromone`` is what the last one went by."""
        it = path_problem(state.problem).context
        paths, amounts = self.deposits(state, progress)
        keep, limits = 1.0 - self.rho, self.limits(state)
        return np.asarray(
            compiled.ants.renew(state.pheromone, keep, paths, amounts, it.moves, it.cols, self.on == "cells", *limits)
        )


@dataclass(frozen=True, kw_only=True)
class Deadlock(Component, ABC):
    """What becomes of an ant that finds no cell to go to, and what the others learn from it."""

    kind: ClassVar[str] = "deadlock"
    works_on: ClassVar[str] = "cells"

    @property
    @abstractmethod
    def retreats(self) -> bool:
        """Whether the ant takes a step back; else it dies."""

    def learn(self, state: ColonyState, pheromone: Floats) -> tuple[Counts, Floats]:
        """Return what is to be remembered of each cell, and the pheromone.

        ``state``: after the march, with the table of what was remembered so far, zeros at first; ``pheromone``:
        as it was just renewed.
        """
        return state.table, pheromone

    def closed(self, table: Counts) -> Bytes:
        """Return 1 for each cell that the next ants do not enter."""
        return np.zeros(len(table), np.uint8)
