"""The simplest planner of fronts: it samples, and keeps what nothing dominates."""

from dataclasses import dataclass, replace
from typing import ClassVar

import moocore
import numpy as np

from pathloom.kernel.evaluation import Floats, Terms, measure
from pathloom.kernel.front import Front, FrontPlanner
from pathloom.kernel.operators import Sampling
from pathloom.kernel.planner import Outcome
from pathloom.kernel.state import State, generator
from pathloom.paths.objectives import Length, Turns, UnsafeCells
from pathloom.paths.tree_seeding import PerturbedTrees


@dataclass(frozen=True)
class Kept(State):
    """What nothing dominated so far."""

    front: Front | None = None


@dataclass(frozen=True, kw_only=True)
class RandomArchive(FrontPlanner):
    """Sample paths and keep those that no other one dominates."""

    name: ClassVar[str] = "random-archive"

    objectives: Terms = Terms({"length": Length(), "unsafe-cells": UnsafeCells(), "turns": Turns()})
    sampling: Sampling = PerturbedTrees()
    each: int = 40

    def start(self, problem, rng):
        m = len(self.objectives)
        empty = Front(np.empty((0, 1), np.int32), np.empty((0, m)))
        return self._more(Kept(problem, rng.bit_generator.state, -1, front=empty), rng)

    def step(self, state):
        return self._more(state, generator(state.random))

    def _more(self, state, rng):
        representation = state.problem.representation
        sampled = self.sampling.sample(state.problem, self.each, rng)
        values = np.concatenate(
            [state.front.values, measure(list(self.objectives.objectives()), sampled, state.problem)]
        )
        both = representation.stack(state.front.population, sampled)
        kept = moocore.is_nondominated(values).nonzero()[0] if len(values) else np.empty(0, int)
        kept = kept[np.lexsort(values[kept].T[::-1])]
        return replace(
            state,
            random=rng.bit_generator.state,
            generation=state.generation + 1,
            evaluations=state.evaluations + len(sampled),
            front=Front(both[kept], values[kept]),
            history=state.history.extended(state.evaluations + len(sampled), float(len(kept)), 0.0, 0.0, 1.0),
        )

    def front(self, state):
        return state.front

    def result(self, state):
        return Outcome(state.front.population[0] if len(state.front) else None, reason="nothing was sampled")


def exhaustive(values: Floats) -> list[int]:
    """Return the rows that no other row dominates, from the definition."""
    rows = values.tolist()
    return [
        i
        for i, a in enumerate(rows)
        if not any(all(y <= x for x, y in zip(a, b, strict=True)) and b != a for b in rows)
    ]
