"""loom: the default planner."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import Count, Crossover, Evolution, Mutation, Sampling, Selection, Survival, Termination, Terms
from pathloom.exact.scalarised import Scalarised
from pathloom.kernel.evolution import Control
from pathloom.kernel.immigrants import RandomImmigrants
from pathloom.kernel.memetic import Memetic
from pathloom.kernel.mutation import OneOf
from pathloom.kernel.repair import InTurn
from pathloom.kernel.sampling import Mixed
from pathloom.kernel.selection import Tournament
from pathloom.kernel.state import Individual, State, generator
from pathloom.kernel.survival import BestOfBoth
from pathloom.kernel.termination import MaxGenerations, Stagnation
from pathloom.paths.exchange import SharedNode
from pathloom.paths.objectives import Length
from pathloom.paths.reroute import Reroute
from pathloom.paths.tree_seeding import PerturbedTrees
from pathloom_loom.band import BandSearch
from pathloom_loom.pool import GenePool
from pathloom_loom.pulling import StringPulling

ROUNDING = 1e-12
"""Share by which sums over the same way differ."""


@dataclass(frozen=True, kw_only=True)
class Loom(Evolution):
    """A small population that learns: perturbed trees, drawn taut, recombined all with all, and polished.

    What learning makes of a path only stays where it is fitter, so it serves any
    objectives. With a time limit it uses the time up.
    """

    name: ClassVar[str] = "loom"
    source: ClassVar[str] = "our own"
    anytime: ClassVar[bool] = True

    population: Count = 40
    sampling: Sampling = Mixed(
        parts=(
            PerturbedTrees(spread=0.5, detour=1.2, pairs=2),
            Scalarised(vectors=1, work=50_000, rest=PerturbedTrees(spread=0.5, detour=1.2)),
        ),
        shares=(39.0, 1.0),
    )
    objectives: Terms = Terms({"length": Length()})
    selection: Selection = Tournament()
    crossover: Crossover | None = SharedNode()
    mutation: Mutation | None = OneOf(
        rate=1.0,
        parts=(RandomImmigrants(sampling=PerturbedTrees(spread=0.5, detour=1.2)), Reroute(longest=24)),
    )
    survival: Survival = BestOfBoth(distinct=True)
    control: Control = Memetic(learning=InTurn(steps=(StringPulling(), GenePool())), polish=BandSearch(), elite=1)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=50), Stagnation(patience=2))

    def solution(self, state: State, answer: Individual) -> NDArray[Any]:
        """Return the answer without superfluous points where it is as fit: sums of more parts are rounded otherwise."""
        fewer = StringPulling(sweeps=0).apply(answer.row[np.newaxis], state.problem, generator(state.random))
        fitness = self.evaluate(fewer, state.problem).fitness[0]
        equal = math.isclose(fitness, answer.fitness, rel_tol=ROUNDING)
        return np.asarray(fewer[0] if equal else answer.row)
