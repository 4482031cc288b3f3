"""Planner: a method that solves a problem, step by step."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from pathloom.kernel.component import Component
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.observer import Observer
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Individual, State
from pathloom.kernel.termination import MaxGenerations, Termination

Fidelity = Literal["faithful", "standard", "reconstructed"]


@dataclass(frozen=True)
class Outcome:
    """What a planner makes of its last state."""

    solution: NDArray[Any] | None
    """The individual that the planner answers with, or ``None``."""
    found: Individual | None = None
    """The best individual of the search, before refinement."""
    reason: str = ""
    """Why there is no solution."""


@dataclass(frozen=True, kw_only=True)
class Planner(Component, ABC):
    """A method. It keeps nothing between calls: all that it has reached is in the state."""

    kind: ClassVar[str] = "planner"
    fidelity: ClassVar[Fidelity] = "standard"
    """``faithful`` to its paper, the ``standard`` form known from the field, or ``reconstructed`` from hints."""
    assumptions: ClassVar[tuple[str, ...]] = ()
    """What the paper leaves open, and how it was filled."""

    anytime: ClassVar[bool] = False
    """Whether it goes on getting better for as long as it may: a time limit then takes the place of its termination."""

    termination: tuple[Termination, ...] = (MaxGenerations(),)
    """Conditions of which any one ends the run."""
    observers: tuple[Observer, ...] = ()
    """Who watches the run; none changes it."""

    @abstractmethod
    def start(self, problem: Problem, rng: np.random.Generator) -> State:
        """Return the first state."""

    @abstractmethod
    def step(self, state: State) -> State:
        """Return the state after one more generation or iteration."""

    @abstractmethod
    def result(self, state: State) -> Outcome:
        """Return the answer that this state gives."""

    @property
    def terms(self) -> Terms:
        """The objectives that the planner works for; empty where it has none of its own."""
        return Terms()

    def fitness_of(self, row: NDArray[Any], problem: Problem) -> tuple[dict[str, float], float | None]:
        """Return the objective values of one individual by label, and its fitness where there is one."""
        return {}, None

    @property
    def unwatched(self) -> Self:
        """The planner without observers: all that its results depend on."""
        return replace(self, observers=()) if self.observers else self

    def done(self, state: State) -> bool:
        """Say whether the run is over."""
        return any(condition.done(state) for condition in self.termination)

    def progress(self, state: State) -> float:
        """Return the used share of the budget, in [0, 1]."""
        return max((condition.progress(state) for condition in self.termination), default=0.0)
