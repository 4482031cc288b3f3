"""Objectives, and how a planner makes one fitness of several of them."""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError, PluginError
from pathloom.kernel.component import Component, NonNegative
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Objective(Component, ABC):
    """A quantity to be minimised."""

    kind: ClassVar[str] = "objective"
    negated: ClassVar[bool] = False
    """Whether its value is minus the quantity that it is named after, which is to be large."""

    @abstractmethod
    def measure(self, population: Population, problem: Problem) -> Floats:
        """Return one value for each of the n rows, (n,); ``inf`` for an infeasible individual."""


@dataclass(frozen=True, kw_only=True)
class Fitness(Component, ABC):
    """One number to be maximised, made of the objectives' values."""

    kind: ClassVar[str] = "fitness"

    @abstractmethod
    def combine(self, values: Floats, weights: Floats) -> Floats:
        """Return the fitness (n,) of values (n, m) under weights (m,)."""


@dataclass(frozen=True)
class Term:
    """One objective under the label that a config gives it, with its weight."""

    label: str
    objective: Objective
    weight: float = 1.0


class Terms(tuple[Term, ...]):
    """The objectives of a planner, in order; labels are distinct."""

    __slots__ = ()
    __words__: ClassVar[str] = "a table of objectives with weights"

    def __new__(cls, terms: Iterable[Term] | Mapping[str, Objective | tuple[Objective, float]] = ()) -> Self:
        """Make the terms from a mapping of labels to objectives, or to pairs with a weight."""
        if isinstance(terms, Mapping):
            pairs = ((k, v if isinstance(v, tuple) else (v, 1.0)) for k, v in terms.items())
            terms = [Term(label, objective, float(weight)) for label, (objective, weight) in pairs]
        return super().__new__(cls, terms)

    @classmethod
    def __checked__(cls, value: Any, where: str) -> Self:
        terms = value if isinstance(value, cls) else cls(value)
        if not terms:
            raise ConfigError(f"{where} is a table with at least one term; got none")
        for term in terms:
            if not np.isfinite(term.weight) or term.weight < 0:
                raise ConfigError(f"{where}.{term.label}: weight is a number in [0, inf); got {term.weight!r}")
        return terms

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels, in order."""
        return tuple(term.label for term in self)

    @property
    def weights(self) -> Floats:
        """The weights (m,), in order."""
        return np.array([term.weight for term in self])

    def objectives(self) -> Iterator[Objective]:
        """Yield the objectives in order."""
        return (term.objective for term in self)


@dataclass(frozen=True, kw_only=True)
class Weighting(Component, ABC):
    """A rule that gives the weights of the objectives, in place of plain numbers."""

    kind: ClassVar[str] = "weighting"

    def check(self, terms: Terms) -> None:
        """Raise a ``ConfigError`` where the rule cannot give weights to these objectives."""

    @abstractmethod
    def weights(self, terms: Terms, problem: Problem) -> Floats:
        """Return the weights (m,) of the objectives, in their order."""


@dataclass(frozen=True, kw_only=True)
class ReciprocalOfSum(Fitness):
    """F = 1 / sum of w_k t_k; ``inf`` where the sum is zero."""

    def combine(self, values: Floats, weights: Floats) -> Floats:
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / (values @ weights))


@dataclass(frozen=True, kw_only=True)
class WeightedReciprocals(Fitness):
    """F = sum of w_k / max(t_k, floor_k): each objective counts by its own reciprocal.

    A floor says below which value an objective no longer counts; without one a
    zero would outweigh everything else.
    """

    floors: tuple[NonNegative, ...] = (1.0,)
    """One for each objective, in order; the last one stands for all that follow."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.floors:
            raise ConfigError(f"{self.name}: floors is a list of at least one number; got none")

    def combine(self, values: Floats, weights: Floats) -> Floats:
        values = np.maximum(values, _for_each(self.floors, values.shape[1]))
        if min(self.floors) > 1e-150:  # no reciprocal overflows
            return np.asarray(np.reciprocal(values) @ weights)
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            parts = weights / (values + 0.0)  # -0.0 becomes 0.0
        return np.asarray(parts.sum(axis=1, where=weights > 0.0))  # 0 / 0 counts as nothing


@lru_cache(maxsize=64)
def _for_each(floors: tuple[float, ...], terms: int) -> Floats:
    """Return one floor for each of so many terms."""
    return np.array((floors + floors[-1:] * terms)[:terms])


def measure(objectives: Sequence[Objective], population: Population, problem: Problem) -> Floats:
    """Return the values (n, m) of all objectives.

    Raises
    ------
    PluginError
        If an objective returns another shape than (n,), or NaN.
    """
    values = np.empty((len(population), len(objectives)))
    for column, objective in enumerate(objectives):
        found = np.asarray(objective.measure(population, problem))
        if found.shape != (len(population),):
            asked = f"wanted shape ({len(population)},), one value a row; got {found.shape}"
            first = f" for {_shown(population[0], problem)}" if len(population) == 1 else ""
            raise PluginError(f"objective {objective.name!r}: {asked}{first}")
        values[:, column] = found
    flat = values.ravel()
    if math.isnan(flat @ flat):  # NaN where one of the values is
        row, column = (int(i) for i in np.argwhere(np.isnan(values))[0])
        raise PluginError(f"objective {objectives[column].name!r}: returned NaN for {_shown(population[row], problem)}")
    return values


def _shown(row: NDArray[Any], problem: Problem) -> str:
    """Return an individual in one line."""
    return " ".join(repr(problem.representation.decode(row)).split())
