"""Section 3.7: the reference population."""

import math
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Deme, Indices, Migration, Share, State, Whole
from pathloom.kernel.state import History


@dataclass(frozen=True, kw_only=True)
class ReferencePopulation(Migration):
    """A second population B evolves beside the main one, A; its best take the places of A's worst now and then.

    At the same time individuals of A take the places of B's worst. Both send
    copies, and both are ranked as they stood before.
    """

    source: ClassVar[str] = "Liu et al. 2024, section 3.7, fig. 3"

    interval: Count = 3
    """t, generations from one exchange to the next."""
    until: Whole = 100
    """Last generation with an exchange."""
    share: Share = 0.05
    """n, as a share of the population; at least one individual, unless it is 0. The paper does not give it."""
    sends: Literal["best", "random", "eliminated"] = "best"
    """What A sends, which the paper leaves open: its best, any, or those whose places B's best have just taken."""
    interval_rule: Literal["fixed", "stagnation"] = "fixed"
    """``fixed``: in generations t, 2t, 3t, … ``stagnation``: when A has not improved for t generations, again after
    t - 1 more, and so on down to every generation, until A improves. A t that adapts is the paper's future work."""

    @property
    def demes(self) -> int:
        return 2

    def exchange(self, demes: tuple[Deme, ...], state: State, rng: np.random.Generator) -> tuple[Deme, ...]:
        a, b = demes
        if not self._due(state) or not len(a) or not len(b):
            return demes
        n = min(len(a), len(b), max(round(self.share * len(a)), 1 if self.share else 0))
        from_a, from_b = (np.argsort(-deme.fitness, kind="stable") for deme in (a, b))
        worst_a, worst_b = (ranked[len(ranked) - n :] for ranked in (from_a, from_b))
        sent = {"best": from_a[:n], "eliminated": worst_a}.get(self.sends)
        if sent is None:
            sent = rng.choice(len(a), n, replace=False)
        return _replaced(a, worst_a, b, from_b[:n], state), _replaced(b, worst_b, a, sent, state)

    def _due(self, state: State) -> bool:
        generation = state.generation + 1
        if generation > self.until:
            return False
        if self.interval_rule == "fixed":
            return generation % self.interval == 0
        idle, pause = stagnation(state.history), self.interval
        due = pause
        while due < idle:
            pause = max(pause - 1, 1)
            due += pause
        return due == idle


def stagnation(history: History) -> int:
    """Return how many generations ago the main population had its best individual first, but for rounding."""
    best = history.generation_best
    top = max(best)
    return len(best) - 1 - next(k for k, fitness in enumerate(best) if math.isclose(fitness, top, rel_tol=1e-12))


def _replaced(deme: Deme, places: Indices, other: Deme, rows: Indices, state: State) -> Deme:
    """Return the deme with copies of the other's rows in these places."""
    which = np.arange(len(deme))
    which[places] = len(deme) + rows
    population = state.problem.representation.stack(deme.population, other.population)
    values, fitness = (np.concatenate(pair) for pair in ((deme.values, other.values), (deme.fitness, other.fitness)))
    return Deme(np.ascontiguousarray(population[which]), values[which], fitness[which])
