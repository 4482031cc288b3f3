"""Control of several populations that differ in how they search."""

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from pathloom import (
    ConfigError,
    Control,
    Deme,
    Evolution,
    Floats,
    NonNegative,
    Population,
    Positive,
    Share,
    State,
    compiled,
)

Profile = Annotated[tuple[Share, Share], msgspec.Meta(description="probabilities of crossover and of mutation")]


@dataclass(frozen=True, kw_only=True)
class ByPopulation(Control):
    """Select, cross, mutate, survive; each population has its own probabilities, and a mutant must be accepted.

    What is known of MPMGA are a high and a low value of both probabilities, an
    initial temperature, its decay and an "accuracy coefficient". That the
    temperature decides on mutants, as in simulated annealing, is our reading.

    Children are evaluated before they are mutated, and mutants again, unless all
    mutants are accepted.
    """

    source: ClassVar[str] = "our reconstruction of Hao et al. 2020; parameters: Hao et al. 2021, table 10"

    probabilities: Literal["profiles", "adaptive", "operators"] = "profiles"
    """``profiles``: each population has one of the ``profiles``; ``adaptive``: all go from the highest probability of
    the profiles, up to the mean fitness, in a straight line down to the lowest, for the best; ``operators``: the
    crossover's and the mutation's own, which do not count otherwise."""
    profiles: tuple[Profile, ...] = ((0.8, 0.1), (0.3, 0.6), (0.8, 0.6))
    """Probabilities of crossover and mutation for the first, the second, … population, and round again."""
    acceptance: Literal["annealed", "no-worse", "always"] = "annealed"
    """Which mutants take the place of what they were made of: those that are no worse, and others with probability
    exp((f_mutant - f) / (accuracy · T)); only those that are no worse; or all."""
    accuracy: Positive = 1.0
    """κ, the "accuracy coefficient"."""
    temperature: NonNegative = 1.0
    """T in the first generation. As fitness is mostly below 1, a temperature of 1 accepts nearly everything."""
    decay: Share = 0.9
    """What T is multiplied by from each generation to the next."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.profiles:
            raise ConfigError(f"{self.name}: profiles is a list of at least one pair of probabilities; got none")

    def advance(self, planner: Evolution, state: State, which: int, rng: np.random.Generator) -> Deme:
        deme, problem = state.demes[which], state.problem
        parents = planner.selection.select(deme.fitness, len(deme), rng)
        population, fitness = deme.population[parents], deme.fitness[parents]
        crossing, mutating = self._rates(planner, state, which, fitness)
        if planner.crossover is not None:
            pairs = planner.pairing.pair(fitness, rng)
            first, second = pairs[:, 0], pairs[:, 1]
            fitter = np.where(fitness[first] >= fitness[second], first, second)
            crossed = rng.random(len(pairs)) < crossing[fitter]
            population = planner.crossover.cross(population, pairs[crossed], problem, rng)
        children = self._mutated(planner, state, population, rng.random(len(population)) < mutating, rng)
        return planner.survival.survive(deme, children, problem, rng)

    def _rates(self, planner: Evolution, state: State, which: int, fitness: Floats) -> tuple[Floats, Floats]:
        """Return the probabilities of crossover and of mutation for each parent."""
        if self.probabilities == "operators":
            operators, progress, none = (planner.crossover, planner.mutation), planner.progress(state), np.zeros(1)
            crossing, mutating = (none if o is None else o.rates(fitness, progress) for o in operators)
        elif self.probabilities == "profiles":
            crossing, mutating = (np.full(len(fitness), p) for p in self.profiles[which % len(self.profiles)])
        else:
            # Where all are as fit the search has converged: cross little, mutate much, as in AGACD's eqs. (26), (28).
            falling = (compiled.probabilities.falling(fitness, equal, 1.0, 1.0, 1.0) for equal in (0.0, 1.0))
            bounds = ((min(p), max(p)) for p in zip(*self.profiles, strict=True))
            crossing, mutating = (low + (high - low) * f for f, (low, high) in zip(falling, bounds, strict=True))
        return crossing, mutating

    def _mutated(
        self,
        planner: Evolution,
        state: State,
        population: Population,
        chosen: NDArray[np.bool_],
        rng: np.random.Generator,
    ) -> Deme:
        """Return the population, evaluated, with those of the chosen mutants that are accepted."""
        problem, rows = state.problem, np.flatnonzero(chosen)
        mutants = population if planner.mutation is None else planner.mutation.apply(population, rows, problem, rng)

        def judged(changed: Population) -> Deme:
            repaired = changed if planner.repair is None else planner.repair.apply(changed, problem, rng)
            return planner.evaluate(repaired, problem)

        if self.acceptance == "always":
            return judged(mutants)
        before = judged(population)
        if len(rows) == 0:
            return before
        after = judged(np.ascontiguousarray(mutants[rows]))
        accepted = rng.random(len(rows)) < self._chance(before.fitness[rows], after.fitness, state.generation)
        place = np.arange(len(before))
        place[rows[accepted]] = len(before) + np.flatnonzero(accepted)
        return Deme(
            np.ascontiguousarray(problem.representation.stack(before.population, after.population)[place]),
            np.concatenate((before.values, after.values))[place],
            np.concatenate((before.fitness, after.fitness))[place],
        )

    def _chance(self, before: Floats, after: Floats, generation: int) -> Floats:
        """Return with which probability each mutant is accepted: 1 where it is no worse."""
        heat = self.accuracy * self.temperature * self.decay**generation if self.acceptance == "annealed" else 0.0
        worse = after < before
        chance = np.ones(len(after))
        with np.errstate(over="ignore"):
            chance[worse] = np.exp((after[worse] - before[worse]) / heat) if heat > 0.0 else 0.0
        return chance
