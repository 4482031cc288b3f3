"""Migration between populations of one kind."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Count, Deme, Indices, Migration, Share, State


@dataclass(frozen=True, kw_only=True)
class RingMigration(Migration):
    """Copies of each population's best take the places of the worst in the next one.

    All migrants are taken before the first is put in its place, so that the
    order of the populations does not matter.
    """

    source: ClassVar[str] = "our reconstruction of Hao et al. 2020; Cohoon et al. 1987"

    populations: Count = 3
    """How many there are, each as large as the planner's ``population``."""
    topology: Literal["ring", "complete", "random-pairs"] = "ring"
    """Where migrants come from: the population before; the best migrants of all the others; or a partner, drawn for
    each exchange, with one population left over where their number is odd."""
    rate: Share = 0.2
    """Share of a population that is replaced; at least one individual."""
    interval: Count = 1
    """Generations from one exchange to the next."""

    @property
    def demes(self) -> int:
        return self.populations

    def exchange(self, demes: tuple[Deme, ...], state: State, rng: np.random.Generator) -> tuple[Deme, ...]:
        if len(demes) == 1 or (state.generation + 1) % self.interval:
            return demes
        size = min(map(len, demes))
        migrants = min(max(1, round(self.rate * size)), size)
        ranked = [np.argsort(-deme.fitness, kind="stable") for deme in demes]
        return tuple(
            self._settled(deme, ranked[k], [(demes[s], ranked[s][:migrants]) for s in sources], migrants, state)
            for k, (deme, sources) in enumerate(zip(demes, self._sources(len(demes), rng), strict=True))
        )

    def _sources(self, n: int, rng: np.random.Generator) -> list[list[int]]:
        """Return for each population which others send to it."""
        if self.topology == "ring":
            return [[(k - 1) % n] for k in range(n)]
        if self.topology == "complete":
            return [[s for s in range(n) if s != k] for k in range(n)]
        sources: list[list[int]] = [[] for _ in range(n)]
        order = rng.permutation(n).tolist()
        for a, b in zip(order[::2], order[1::2], strict=False):
            sources[a], sources[b] = [b], [a]
        return sources

    @staticmethod
    def _settled(deme: Deme, ranked: Indices, sources: list[tuple[Deme, Indices]], migrants: int, state: State) -> Deme:
        """Return the deme with the best migrants of its sources in the places of its worst."""
        if not sources:
            return deme
        stack = state.problem.representation.stack
        population, values, fitness = deme.population, deme.values, deme.fitness
        for source, rows in sources:
            population = stack(population, source.population[rows])
            values = np.concatenate((values, source.values[rows]))
            fitness = np.concatenate((fitness, source.fitness[rows]))
        best = len(deme) + np.argsort(-fitness[len(deme) :], kind="stable")[:migrants]
        which = np.arange(len(deme))
        which[ranked[len(deme) - migrants :]] = best
        return Deme(np.ascontiguousarray(population[which]), values[which], fitness[which])
