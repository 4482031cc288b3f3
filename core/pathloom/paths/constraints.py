"""Constraints on paths: bounds on objectives, absolute or relative to the least that is possible."""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import compiled
from pathloom.errors import ConfigError
from pathloom.kernel.compose import build
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.evaluation import Floats, Objective, measure
from pathloom.kernel.problem import Problem
from pathloom.kernel.registry import Registry, default_registry
from pathloom.kernel.representation import Population
from pathloom.paths.additive import prices_of
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem

SLACK = 1e-9
"""Share of a limit by which rounding may overstep it."""


@dataclass(frozen=True, kw_only=True)
class Bound(Constraint):
    """Keep an objective's quantity within limits.

    Limits are those of the quantity that people speak of: a clearance of at least
    0.3, although the objective ``clearance``, being minimised, is minus that. A
    violation is the distance to the limit, as a share of the limit where that is
    not 0, so that violations of several quantities can be added up.
    """

    example: ClassVar[Mapping[str, Any]] = {"at_most": 40.0}

    objective: Objective
    """Whose quantity is bounded."""
    at_most: float | None = None
    """Upper limit."""
    at_least: float | None = None
    """Lower limit."""
    relative_to_optimum: bool = False
    """Whether the limits are multiples of the least value that an 8-connected path can have."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.at_most is None and self.at_least is None:
            raise ConfigError(f"{self.text}: allowed is at_most, at_least or both; got neither")
        for limit in (self.at_most, self.at_least):
            if limit is not None and not math.isfinite(limit):
                raise ConfigError(f"{self.text}: limits are finite numbers; got {limit!r}")
        check_constraints([self])

    @property
    def text(self) -> str:
        """The condition in words."""
        of = " x optimum" if self.relative_to_optimum else ""
        limits = (("<=", self.at_most), (">=", self.at_least))
        return " and ".join(f"{self.objective.name} {sign} {v:g}{of}" for sign, v in limits if v is not None)

    def violation(self, population: Population, problem: Problem) -> Floats:
        return self.excess(measure([self.objective], population, problem)[:, 0], problem)

    def excess(self, values: Floats, problem: Problem) -> Floats:
        """Return the violation (n,) of individuals with these values (n,) of the objective."""
        values = -values if self.objective.negated else values
        unit = least(self.objective, path_problem(problem)) if self.relative_to_optimum else 1.0
        found = np.zeros(len(values))
        for limit, sign in ((self.at_most, 1.0), (self.at_least, -1.0)):
            if limit is not None:
                scale = abs(limit * unit) or 1.0
                beyond = sign * (values - limit * unit) / scale
                found += np.where(beyond > SLACK, beyond, 0.0)
        return found


def least(objective: Objective, problem: PathProblem) -> float:
    """Return the least value of an additive objective that an 8-connected path can have.

    Raises
    ------
    ConfigError
        If the objective is not additive: no exact optimum is known then.
    """
    known = problem.context.optima
    if objective not in known:
        prices = prices_of(objective, problem)
        if prices is None:
            raise ConfigError(f"constraints: no exact optimum of {objective.name!r} is known, it is not additive")
        it = problem.context
        walk = compiled.headings.cheapest(it.moves, it.cols, it.start, it.goal, *prices.tables)[np.newaxis]
        known[objective] = float(prices.along(walk, problem)[0]) if walk.size else math.inf
    return known[objective]


def check_constraints(constraints: Iterable[Constraint]) -> None:
    """Refuse constraints that no path can keep to, whatever the map.

    Raises
    ------
    ConfigError
        Which ones contradict each other.
    """
    limits: dict[tuple[Objective, bool], tuple[Bound, Bound]] = {}  # the highest lower and the lowest upper one
    for one in constraints:
        if not isinstance(one, Bound):
            continue
        if one.relative_to_optimum and one.at_most is not None and one.at_most < 1.0:
            raise ConfigError(f"constraint {one.text!r}: no path is better than the optimum")
        key = (one.objective, one.relative_to_optimum)
        low, high = limits.get(key, (one, one))
        low, high = max(low, one, key=_lower), min(high, one, key=_upper)
        if _lower(low) > _upper(high):
            texts = " and ".join(dict.fromkeys((repr(low.text), repr(high.text))))
            raise ConfigError(f"constraints: {texts} contradict each other")
        limits[key] = (low, high)


def _lower(bound: Bound) -> float:
    return -math.inf if bound.at_least is None else bound.at_least


def _upper(bound: Bound) -> float:
    return math.inf if bound.at_most is None else bound.at_most


_TEXT = re.compile(
    r"\s*(?P<name>[\w./-]*[\w])\s*(?P<sign><=|>=|≤|≥)\s*(?P<limit>[-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*"
    r"(?P<relative>(?:[x×*]\s*)optimum)?\s*"
)


def parse_constraint(text: str, registry: Registry | None = None) -> Bound:
    """Return the bound that a text names: ``clearance >= 0.3``, ``length <= 1.2 x optimum``.

    Raises
    ------
    ConfigError
        If it is no such text, or the objective is unknown.
    """
    found = _TEXT.fullmatch(text)
    if found is None:
        form = "'OBJECTIVE <= NUMBER' or '>=', with 'x optimum' behind the number where that is the unit"
        raise ConfigError(f"constraint: found {text!r}, allowed {form}")
    try:
        limit = float(found["limit"])
    except ValueError:
        raise ConfigError(f"constraint {text!r}: {found['limit']!r} is no number") from None
    objective = build(Objective, found["name"], registry or default_registry(), f"constraint {text!r}")
    side = "at_most" if found["sign"] in ("<=", "≤") else "at_least"
    return Bound(objective=objective, relative_to_optimum=found["relative"] is not None, **{side: limit})
