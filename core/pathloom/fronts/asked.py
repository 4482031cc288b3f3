"""What is asked of a front beside the front itself: the section ``front`` of a config."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from pathloom.errors import ConfigError
from pathloom.kernel.compose import NONE, build, compose, freeze
from pathloom.kernel.evaluation import Floats, Terms, Weighting
from pathloom.kernel.planner import Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.registry import default_registry
from pathloom.naming import closest

Preference = Mapping[str, float] | Weighting


@dataclass(frozen=True)
class Asked:
    """Checked on construction."""

    exact: bool = False
    """Whether the exact front is wanted as well."""
    against: tuple[Any, ...] = ()
    """Planners whose paths are placed beside the front: names, tables as in a config, or planners."""
    runs: int = 1
    """With how many seeds each of them runs, from the run's own on."""
    prefer: Preference | None = None
    """What matters: weights by label, or a rule that gives weights."""
    reference: tuple[float, ...] | None = None
    """Reference point of the hypervolume."""

    def __post_init__(self) -> None:
        for name, allowed, fits in (
            ("exact", "true or false", isinstance(self.exact, bool)),
            ("runs", "an integer from 1 on", type(self.runs) is int and self.runs >= 1),
            ("against", "a list of planners", not isinstance(self.against, (str, Mapping))),
        ):
            if not fits:
                raise ConfigError(f"{name}: found {getattr(self, name)!r}, allowed {allowed}")
        object.__setattr__(self, "against", tuple(self.against))
        object.__setattr__(self, "prefer", _preference(self.prefer))
        object.__setattr__(self, "reference", _point(self.reference))

    @classmethod
    def read(cls, table: Mapping[str, Any], where: str = "front") -> "Asked":
        """Return what a table of a config asks for."""
        known = [f.name for f in fields(cls)]
        for key in table:
            if key not in known:
                raise ConfigError(f"{where}.{key}: no such key; {closest(key, known)}")
        try:
            given: dict[str, Any] = {key: None if value == NONE else value for key, value in table.items()}
            return cls(**given)
        except ConfigError as error:
            raise ConfigError(f"{where}.{error}") from error

    def frozen(self) -> dict[str, Any]:
        """Return the table that asks for the same, every default filled in."""
        prefer = self.prefer
        return {
            "exact": self.exact,
            "against": [freeze(planner) if isinstance(planner, Planner) else planner for planner in self.against],
            "runs": self.runs,
            "prefer": NONE if prefer is None else freeze(prefer) if isinstance(prefer, Weighting) else dict(prefer),
            "reference": NONE if self.reference is None else list(self.reference),
        }

    def check(self, terms: Terms) -> None:
        """Check what only the objectives tell.

        Raises
        ------
        ConfigError
            If a preference is for no objective of these, or the reference point has another number of values.
        """
        labels = terms.labels
        if isinstance(self.prefer, Weighting):
            try:
                self.prefer.check(terms)
            except ConfigError as error:
                raise ConfigError(f"prefer: {error}") from error
        else:
            for label in self.prefer or ():
                if label not in labels:
                    raise ConfigError(f"prefer: no objective of this front is {label!r}; {closest(label, labels)}")
        if self.reference is not None and len(self.reference) != len(terms):
            found = f"{len(self.reference)} numbers for {len(terms)} objectives"
            raise ConfigError(f"reference: found {found}, allowed one each, for {', '.join(labels)}")

    def rivals(self) -> list[Planner]:
        """Return the planners to be placed beside the front."""
        found = []
        for planner in self.against:
            try:
                found.append(compose(planner))
            except ConfigError as error:
                raise ConfigError(f"against: {str(error).removeprefix('planner: ')}") from error
        return found

    def weights(self, terms: Terms, problem: Problem) -> Floats | None:
        """Return the weights (m,) that are preferred; ``None`` where nobody prefers anything.

        Weights that stand beside the objectives count as a preference where they differ.
        """
        if isinstance(self.prefer, Weighting):
            return self.prefer.weights(terms, problem)
        if self.prefer is not None:
            return np.array([float(self.prefer.get(label, 0.0)) for label in terms.labels])
        weights = terms.weights
        return weights if np.ptp(weights) > 0 else None


def _preference(value: Any) -> Preference | None:
    """Return weights by label or a rule, checked."""
    if value is None or isinstance(value, Weighting):
        return value
    if isinstance(value, str) or (isinstance(value, Mapping) and "use" in value):
        return build(Weighting, value, default_registry(), "prefer")
    if not isinstance(value, Mapping):
        raise ConfigError(f"prefer: found {value!r}, allowed weights by objective or the name of a weighting")
    weights = {str(label): _number(weight, f"prefer.{label}") for label, weight in value.items()}
    if min(weights.values(), default=0.0) < 0 or not any(weights.values()):
        raise ConfigError(f"prefer: found {dict(value)!r}, allowed weights from 0 on, not all of them 0")
    return weights


def _point(value: Any) -> tuple[float, ...] | None:
    if value is None:
        return None
    if isinstance(value, str) or not isinstance(value, (Sequence, np.ndarray)):
        raise ConfigError(f"reference: found {value!r}, allowed a list of numbers")
    return tuple(_number(v, "reference") for v in value)


def _number(value: Any, where: str) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.number)):
        raise ConfigError(f"{where}: found {value!r}, allowed a number")
    if not math.isfinite(value):
        raise ConfigError(f"{where}: found {value!r}, allowed a finite number")
    return float(value)
