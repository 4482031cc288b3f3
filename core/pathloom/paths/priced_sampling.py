"""Sampling by prices: what samplings have in common that go where a planner's objectives are small."""

from abc import ABC
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from pathloom.kernel.counting import count
from pathloom.kernel.evaluation import Terms
from pathloom.kernel.operators import Sampling
from pathloom.paths.additive import Prices, prices_of
from pathloom.paths.objectives import Length
from pathloom.paths.problem import PathProblem
from pathloom.paths.tree_seeding import PerturbedTrees


@dataclass(frozen=True, kw_only=True)
class PricedSampling(Sampling, ABC):
    """Base of samplings that price cells, steps and turns by additive objectives."""

    works_on: ClassVar[str] = "cells"
    gives: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    objectives: Terms | None = None
    """What is priced, by its weights. Empty: the objectives of the planner; of nobody's, length alone."""
    rest: Sampling = PerturbedTrees()
    """Makes the individuals that this sampling leaves out."""

    def serving(self, objectives: Terms) -> Self:
        served = super().serving(objectives)
        return replace(served, objectives=objectives) if served.objectives is None else served

    @property
    def terms(self) -> Terms:
        """What is priced."""
        return Terms({"length": Length()}) if self.objectives is None else self.objectives

    def priced(self, problem: PathProblem) -> tuple[list[Prices], list[float]]:
        """Return the prices of the objectives that are additive, with their weights; the others are counted."""
        found = [(prices_of(term.objective, problem), term.weight) for term in self.terms]
        kept = [(prices, weight) for prices, weight in found if prices is not None]
        count("objectives not additive", len(found) - len(kept))
        return [prices for prices, _ in kept], [weight for _, weight in kept]
