"""Section 5.3.2: who goes on to the next generation, and which mutant."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom import Control, Deme, Evolution, Population, Problem, State
from pathloom.kernel.survival import replaced
from pathloom_hga_aco.mutation import TwoWayReverseSearch


@dataclass(frozen=True, kw_only=True)
class FamilyCompetition(Control):
    """Select, cross, let each pair compete with its own children, mutate, and let both mutants compete.

    "Selects the best individuals from the parent and offspring": here the best
    two different ones of each family of four, for otherwise copies of one parent
    would soon make up the whole population. Of the two mutants that the paper's
    mutation makes of an individual the fitter takes its place; another mutation
    makes one. Only new individuals are repaired and evaluated.
    """

    source: ClassVar[str] = "Song et al. 2021, section 5.3.2"

    worse: bool = True
    """Whether the fitter mutant takes the place of an individual that is fitter still."""

    def advance(self, planner: Evolution, state: State, which: int, rng: np.random.Generator) -> Deme:
        before, problem = state.demes[which], state.problem
        parents = planner.selection.select(before.fitness, len(before), rng)
        deme = Deme(before.population[parents], before.values[parents], before.fitness[parents])
        progress = planner.progress(state)
        deme = self._crossed(planner, deme, problem, progress, rng)
        deme = self._mutated(planner, deme, problem, progress, rng)
        return planner.survival.survive(before, deme, problem, rng)

    def _crossed(
        self, planner: Evolution, deme: Deme, problem: Problem, progress: float, rng: np.random.Generator
    ) -> Deme:
        """Return the deme with the best two of each crossed pair and its children in the pair's places."""
        if planner.crossover is None:
            return deme
        pairs = planner.pairing.pair(deme.fitness, rng)
        fitter = pairs[np.arange(len(pairs)), deme.fitness[pairs].argmax(axis=1)]
        pairs = pairs[rng.random(len(pairs)) < planner.crossover.rates(deme.fitness, progress)[fitter]]
        if len(pairs) == 0:
            return deme
        rows = pairs.ravel()
        crossed = planner.crossover.cross(deme.population, pairs, problem, rng)
        children = self._evaluated(planner, crossed[rows], problem, rng)
        everybody = Deme(
            problem.representation.stack(children.population, deme.population[rows]),
            np.concatenate((children.values, deme.values[rows])),
            np.concatenate((children.fitness, deme.fitness[rows])),
        )
        best = self._best_two(everybody, problem)
        return replaced(deme, rows, everybody, best.ravel(), problem)

    @staticmethod
    def _best_two(everybody: Deme, problem: Problem) -> np.ndarray:
        """Return for each family the rows (k, 2) of its best two: children stand first, p by p, and then parents."""
        families = np.arange(len(everybody)).reshape(2, -1, 2).swapaxes(0, 1).reshape(-1, 4)
        ranked = np.argsort(-everybody.fitness[families], axis=1, kind="stable")
        families = np.take_along_axis(families, ranked, axis=1)
        alike = problem.representation.distinct(everybody.population)[1][families]
        others = alike[:, 1:] != alike[:, :1]
        second = np.where(others.any(axis=1), others.argmax(axis=1), 0) + 1
        return np.stack((families[:, 0], families[np.arange(len(families)), second]), axis=1)

    def _mutated(
        self, planner: Evolution, deme: Deme, problem: Problem, progress: float, rng: np.random.Generator
    ) -> Deme:
        """Return the deme with the fitter mutant of each individual that is mutated in its place."""
        if planner.mutation is None:
            return deme
        chosen = np.flatnonzero(rng.random(len(deme)) < planner.mutation.rates(deme.fitness, progress))
        if len(chosen) == 0:
            return deme
        if isinstance(planner.mutation, TwoWayReverseSearch):
            made = problem.representation.stack(*planner.mutation.both(deme.population, chosen, problem, rng))
        else:
            made = planner.mutation.apply(deme.population, chosen, problem, rng)[chosen]
        mutants = self._evaluated(planner, made, problem, rng)
        best = mutants.fitness.reshape(-1, len(chosen)).argmax(axis=0) * len(chosen) + np.arange(len(chosen))
        if not self.worse:
            good = mutants.fitness[best] >= deme.fitness[chosen]
            chosen, best = chosen[good], best[good]
        return replaced(deme, chosen, mutants, best, problem)

    @staticmethod
    def _evaluated(planner: Evolution, population: Population, problem: Problem, rng: np.random.Generator) -> Deme:
        if planner.repair is not None:
            population = planner.repair.apply(population, problem, rng)
        return planner.evaluate(np.ascontiguousarray(population), problem)
