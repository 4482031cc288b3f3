"""Breeding: parents are chosen, and their children compete with them for the places of one population."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Literal

import numpy as np

from pathloom import Floats, Indices, Population, Share, Whole, count
from pathloom_pymoo.archive import new_values
from pathloom_pymoo.planner import MultiObjective
from pathloom_pymoo.state import FrontState


@dataclass(frozen=True, kw_only=True)
class Breeding(MultiObjective):
    """A multi-objective planner whose children are new to the population."""

    refills: Whole = 1
    """How often parents are chosen again to make up for children that are there already."""

    equal: Literal["paths", "values"] = "values"
    """Who is there already: somebody with the same path, or, once evaluated, somebody with the same values."""

    from_archive: Share = 0.5
    """Probability that a pair comes from the trade-offs of all generations, of which there may be many more than
    places in the population; 0: never, as in pymoo."""

    def children(self, state: FrontState, rng: np.random.Generator) -> tuple[Population, Indices]:
        """Return up to as many individuals as the population is to have, all different and none of them in it."""
        problem, known = state.problem, state.population
        representation = problem.representation
        found = known[:0]
        for _ in range(1 + self.refills):
            missing = self.population - len(found)
            if missing <= 0 or len(known) == 0:
                break
            made = self.vary(*self._couples(state, (missing + 1) // 2, rng), state, rng)
            made = made.take(representation.distinct(made)[0], 0)
            made = made.take(representation.newcomers(made, known)[:missing], 0)
            found = representation.stack(found, made) if len(found) else made
            known = representation.stack(known, made)
        count("children missing", self.population - len(found))
        return found, np.arange(0)

    def admitted(self, values: Floats, state: FrontState) -> Indices:
        return new_values(values, state.demes[0].values) if self.equal == "values" else np.arange(len(values))

    def _couples(self, state: FrontState, pairs: int, rng: np.random.Generator) -> tuple[Population, Floats]:
        """Return parents (2 pairs, width), each pair one after the other, and their fitness."""
        archive = state.archive
        of_the_archive = int(rng.binomial(pairs, self.from_archive)) if len(archive) else 0
        chosen = np.arange(0)
        if of_the_archive < pairs:
            chosen = self.parents(state, pairs - of_the_archive, rng).ravel()
        population, fitness = state.population.take(chosen, 0), state.fitness.take(chosen)
        if of_the_archive == 0:
            return population, fitness
        chosen = rng.integers(len(archive), size=2 * of_the_archive)
        population = state.problem.representation.stack(population, archive.population.take(chosen, 0))
        return population, np.concatenate((fitness, self.fitness(archive.values.take(chosen, 0))))

    @abstractmethod
    def parents(self, state: FrontState, pairs: int, rng: np.random.Generator) -> Indices:
        """Return pairs (k, 2) of rows of the population, chosen as the algorithm does."""
