"""Termination: when a run is over."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

from pathloom.kernel.component import Component, Count, Positive, Unit
from pathloom.kernel.state import State


@dataclass(frozen=True, kw_only=True)
class Termination(Component, ABC):
    """A condition that ends a run. Of several, any one does."""

    kind: ClassVar[str] = "termination"

    @abstractmethod
    def done(self, state: State) -> bool:
        """Say whether the run is over."""

    def progress(self, state: State) -> float:
        """Return the used share of the budget, in [0, 1], as far as it can be known."""
        return 0.0


@dataclass(frozen=True, kw_only=True)
class MaxGenerations(Termination):
    """Stop after a number of generations."""

    limit: Annotated[Count, Unit("generations")] = 50
    """The last generation; the first population is number 0."""

    def done(self, state: State) -> bool:
        return state.generation >= self.limit

    def progress(self, state: State) -> float:
        return min(1.0, state.generation / self.limit)


@dataclass(frozen=True, kw_only=True)
class MaxEvaluations(Termination):
    """Stop when a number of evaluations is spent; the generation under way is finished."""

    limit: Annotated[Count, Unit("evaluations")] = 5000
    """How many there may be, of all populations together."""

    def done(self, state: State) -> bool:
        return state.evaluations >= self.limit

    def progress(self, state: State) -> float:
        return min(1.0, state.evaluations / self.limit)


@dataclass(frozen=True, kw_only=True)
class Stagnation(Termination):
    """Stop when the best individual has not changed for a number of generations."""

    patience: Annotated[Count, Unit("generations")] = 40
    """How long the best individual may stay the same."""

    def done(self, state: State) -> bool:
        return state.best is not None and state.generation - state.best.generation >= self.patience


@dataclass(frozen=True, kw_only=True)
class TargetFitness(Termination):
    """Stop when the best fitness reaches a value."""

    value: float
    """The fitness that is good enough."""

    def done(self, state: State) -> bool:
        return state.best is not None and state.best.fitness >= self.value


@dataclass(frozen=True, kw_only=True)
class WallTime(Termination):
    """Stop after a time. The result then depends on the machine."""

    seconds: Annotated[Positive, Unit("seconds")] = 300.0
    """Time from the beginning on."""

    def done(self, state: State) -> bool:
        return state.seconds >= self.seconds

    def progress(self, state: State) -> float:
        return min(1.0, state.seconds / self.seconds)
