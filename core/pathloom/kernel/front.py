"""Front: what a planner answers with that weighs no objective against another."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from pathloom.kernel.evaluation import Floats, Terms
from pathloom.kernel.planner import Planner
from pathloom.kernel.representation import Population
from pathloom.kernel.state import State


@dataclass(frozen=True)
class Front:
    """Individuals none of which dominates another, with their values (n, m), minimised.

    Their values differ, and are in lexicographic order.
    """

    population: Population
    values: Floats

    def __len__(self) -> int:
        """Return the number of trade-offs."""
        return len(self.values)


@dataclass(frozen=True, kw_only=True)
class FrontPlanner(Planner, ABC):
    """A planner whose answer is a set of trade-offs between its objectives."""

    objectives: Terms
    """What is minimised, each for itself; weights only matter to who chooses from the front."""

    @property
    def terms(self) -> Terms:
        return self.objectives

    @abstractmethod
    def front(self, state: State) -> Front:
        """Return the trade-offs that this state has found."""
