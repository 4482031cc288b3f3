"""State: everything that a run has reached, as plain data.

A state can be inspected, drawn, pickled and taken up again: the same state
always leads to the same next one.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.random.bit_generator import ISeedSequence
from numpy.typing import NDArray

from pathloom.kernel.evaluation import Floats
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population


@dataclass(frozen=True)
class Deme:
    """One population with its values (n, m), minimised, and its fitness (n,), maximised."""

    population: Population
    values: Floats
    fitness: Floats
    distinct: NDArray[np.intp] | None = None
    """Indices of the first of each distinct individual, where they are known."""

    def __len__(self) -> int:
        """Return the number of individuals."""
        return len(self.fitness)

    def best(self) -> int:
        """Return the row of the fittest individual; the first of several."""
        return int(np.argmax(self.fitness))


@dataclass(frozen=True)
class Individual:
    """One row with its values (m,), its fitness, and the generation that found it."""

    row: NDArray[Any]
    values: Floats
    fitness: float
    generation: int
    merit: float = 0.0
    """What an archive goes by, to be maximised."""


class Record(NamedTuple):
    """What one generation was like."""

    evaluations: int
    """Evaluations spent so far."""
    best: float
    """Best fitness found so far."""
    generation_best: float
    """Best fitness within the generation."""
    mean: float
    """Mean fitness of the generation."""
    diversity: float
    """Share of distinct individuals."""


@dataclass(frozen=True)
class History:
    """What each generation was like, the first population included; also column by column."""

    records: tuple[Record, ...] = ()

    def extended(
        self, evaluations: int, best: float, generation_best: float, mean: float, diversity: float
    ) -> "History":
        """Return the history with one more generation."""
        return History((*self.records, Record(evaluations, best, generation_best, mean, diversity)))

    @property
    def evaluations(self) -> tuple[int, ...]:
        """Evaluations spent so far."""
        return tuple(record.evaluations for record in self.records)

    @property
    def best(self) -> tuple[float, ...]:
        """Best fitness found so far."""
        return tuple(record.best for record in self.records)

    @property
    def generation_best(self) -> tuple[float, ...]:
        """Best fitness within the generation."""
        return tuple(record.generation_best for record in self.records)

    @property
    def mean(self) -> tuple[float, ...]:
        """Mean fitness of the generation."""
        return tuple(record.mean for record in self.records)

    @property
    def diversity(self) -> tuple[float, ...]:
        """Share of distinct individuals."""
        return tuple(record.diversity for record in self.records)


@dataclass(frozen=True)
class State:
    """Where a run stands after a generation.

    Planners that are not evolutionary subclass it with what they need.
    """

    problem: Problem
    random: Mapping[str, Any]
    """State of the random generator with which the next step begins."""
    generation: int = 0
    evaluations: int = 0
    demes: tuple[Deme, ...] = ()
    """The populations; the first one is the main one."""
    best: Individual | None = None
    """Fittest individual found so far, kept even where the population loses it."""
    answer: Individual | None = None
    """What the planner's archive keeps; without an archive the fittest."""
    history: History = field(default_factory=History)
    counts: Mapping[str, int] = field(default_factory=dict)
    """Failures and fallbacks so far."""
    seconds: float = 0.0
    """Time spent so far."""

    @property
    def population(self) -> Population:
        """The main population (n, width)."""
        return self.demes[0].population

    @property
    def fitness(self) -> Floats:
        """The fitness (n,) of the main population."""
        return self.demes[0].fitness


class _Unseeded(ISeedSequence):
    """Zeros, for a generator that is about to be told its state: a tenth of the cost of seeding."""

    def generate_state(self, n_words: int, dtype: Any = np.uint32) -> NDArray[Any]:
        return np.zeros(n_words, dtype)


def generator(random: Mapping[str, Any]) -> np.random.Generator:
    """Return a generator that goes on where the recorded one stood."""
    bits: Any = np.random.PCG64(cast("Any", _Unseeded()))
    bits.state = random
    return np.random.Generator(bits)
