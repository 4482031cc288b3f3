"""Operator: the kinds of step that a generation is made of.

Each works on a whole population at once and leaves its input untouched.
Randomness comes in as ``rng``; failures are counted, not raised.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom.kernel.component import Component, Share
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.kernel.state import Deme, State

Indices = NDArray[np.intp]


@dataclass(frozen=True, kw_only=True)
class Sampling(Component, ABC):
    """Make the first population."""

    kind: ClassVar[str] = "sampling"

    @abstractmethod
    def sample(self, problem: Problem, n: int, rng: np.random.Generator) -> Population:
        """Return up to n new individuals; fewer where no more could be found."""


@dataclass(frozen=True, kw_only=True)
class Selection(Component, ABC):
    """Choose who has offspring."""

    kind: ClassVar[str] = "selection"

    @abstractmethod
    def select(self, fitness: Floats, n: int, rng: np.random.Generator) -> Indices:
        """Return n row indices, repeats allowed; fitness (m,) is to be maximised."""


@dataclass(frozen=True, kw_only=True)
class Pairing(Component, ABC):
    """Put the selected individuals together in pairs."""

    kind: ClassVar[str] = "pairing"

    @abstractmethod
    def pair(self, fitness: Floats, rng: np.random.Generator) -> Indices:
        """Return disjoint pairs (k, 2) of row indices."""


@dataclass(frozen=True, kw_only=True)
class Probability(Component, ABC):
    """How likely an operator is to be applied, individual by individual."""

    kind: ClassVar[str] = "probability"

    @abstractmethod
    def rates(self, fitness: Floats, progress: float) -> Floats:
        """Return probabilities (n,) for individuals of this fitness.

        ``progress`` is the used share of the budget, in [0, 1]. A pair is
        crossed with the rate of its fitter parent.
        """


@dataclass(frozen=True, kw_only=True)
class _Variation(Component, ABC):
    """What crossover and mutation have in common: how often they are applied."""

    of_the_slot: ClassVar[tuple[str, ...]] = ("rate", "probability")

    rate: Share = 1.0
    """Probability of application, where no ``probability`` is named."""
    probability: Probability | None = None
    """Adaptive probability, in place of the fixed ``rate``."""

    def rates(self, fitness: Floats, progress: float) -> Floats:
        """Return the probability of application for each individual, (n,)."""
        if self.probability is None:
            return np.full(len(fitness), self.rate)
        return self.probability.rates(fitness, progress)


@dataclass(frozen=True, kw_only=True)
class Crossover(_Variation, ABC):
    """Mix the genes of pairs."""

    kind: ClassVar[str] = "crossover"
    rate: Share = 0.8

    @abstractmethod
    def cross(self, population: Population, pairs: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        """Return the population with the rows of each pair (k, 2) replaced by its two children."""


@dataclass(frozen=True, kw_only=True)
class Mutation(_Variation, ABC):
    """Change single individuals."""

    kind: ClassVar[str] = "mutation"
    rate: Share = 0.2

    @abstractmethod
    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        """Return the population with the chosen rows (k,) changed; a failure keeps the parent."""


@dataclass(frozen=True, kw_only=True)
class Repair(Component, ABC):
    """Improve or mend every individual: in each generation (slot ``repair``) or at the end (``refinement``)."""

    kind: ClassVar[str] = "repair"

    @abstractmethod
    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        """Return as many individuals, each no worse for the purpose of the repair."""


@dataclass(frozen=True, kw_only=True)
class Survival(Component, ABC):
    """Decide who makes up the next generation."""

    kind: ClassVar[str] = "survival"

    @abstractmethod
    def survive(self, parents: Deme, children: Deme, problem: Problem, rng: np.random.Generator) -> Deme:
        """Return a deme as large as the parents'."""


@dataclass(frozen=True, kw_only=True)
class Migration(Component, ABC):
    """Let several populations exchange individuals."""

    kind: ClassVar[str] = "migration"

    @property
    @abstractmethod
    def demes(self) -> int:
        """How many populations there are."""

    @abstractmethod
    def exchange(self, demes: tuple[Deme, ...], state: State, rng: np.random.Generator) -> tuple[Deme, ...]:
        """Return the demes of generation ``state.generation + 1`` after the exchange that is then due, if one is.

        ``state`` is that of the generation before.
        """
