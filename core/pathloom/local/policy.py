"""Policy: decides from distances what to do next, by a rule or by what it has learned."""

import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from pathloom.errors import ConfigError
from pathloom.kernel.component import Component
from pathloom.kernel.counting import count
from pathloom.kernel.evaluation import Floats
from pathloom.local.examples import Actions, Examples
from pathloom.local.forest import Forest
from pathloom.local.sectors import reduced

Decide = Callable[[Floats], Actions]
"""Takes distances (n, k) in metres and returns actions (n,); rows do not influence each other."""


@dataclass(frozen=True, kw_only=True)
class Policy(Component, ABC):
    """Decides among the four actions. What it has learned is in the `Model` that training returns, never in it."""

    kind: ClassVar[str] = "policy"
    learns: ClassVar[bool] = True
    """Whether it needs examples."""

    @abstractmethod
    def trained(self, examples: Examples, rng: np.random.Generator) -> Decide:
        """Return how it decides after these examples. Distances then have as many columns as the examples'."""


@dataclass(frozen=True, kw_only=True)
class Rule(Policy, ABC):
    """A policy that has nothing to learn. It takes 2, 4 or 24 distances alike."""

    learns: ClassVar[bool] = False

    @abstractmethod
    def decide(self, distances: Floats) -> Actions:
        """Return the actions (n,) for distances (n, k): front, left and so on, or the readings of all 24 sensors."""

    def trained(self, examples: Examples, rng: np.random.Generator) -> Decide:
        return self.decide


@dataclass(frozen=True, kw_only=True)
class LearnedPolicy(Policy, ABC):
    """A policy that learns by a classifier with the interface of scikit-learn."""

    in_files: ClassVar[frozenset[str]] = frozenset()
    """Dotted names of functions and types of its own that its saved models refer to: a file may name them."""

    @abstractmethod
    def estimator(self, seed: int) -> Any:
        """Return the classifier, not yet fitted; whatever it draws comes from the seed."""

    def trained(self, examples: Examples, rng: np.random.Generator) -> "Model":
        found = np.unique(examples.actions)
        if len(found) < 2:
            raise ConfigError(
                f"{examples.name}: found the action {int(found[0])} only, allowed two or more to learn from"
            )
        classifier = self.estimator(int(rng.integers(2**31)))
        try:
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                classifier.fit(examples.distances, examples.actions)
                classifier.predict(examples.distances[:1])  # neighbours are counted no earlier
        except ValueError as error:  # too few examples for as many neighbours, a parameter out of its range
            raise ConfigError(f"{self.name}: not trained on {len(examples)} examples: {first_line(error)}") from error
        for warning in said:
            count(f"{self.name}: {first_line(warning.message)}")
        return Model(self, classifier, examples.width)


@dataclass(frozen=True, eq=False)
class Model:
    """A policy after training."""

    policy: LearnedPolicy
    classifier: Any
    """Fitted."""
    width: int
    """How many distances it takes: 2, 4 or 24."""

    @cached_property
    def forest(self) -> Forest | None:
        """The trees as arrays, where the classifier is a forest or a tree: a single decision is then quick."""
        return Forest.of(self.classifier)

    def __call__(self, distances: Floats) -> Actions:
        """Return the actions (n,) for distances (n, width)."""
        if distances.ndim != 2 or distances.shape[1] != self.width:
            shape = "(n, k)" if distances.ndim != 2 else f"{distances.shape[1]} distances"
            raise ConfigError(f"{self.policy.name}: found {shape}, allowed {self.width}, as it was trained with")
        if self.forest is not None:
            return self.forest.decide(distances)
        return np.asarray(self.classifier.predict(distances), np.int64)

    def on_readings(self, readings: Floats) -> Actions:
        """Return the actions (n,) for readings of all sensors (n, 24), of which it takes what it was trained with."""
        return self(reduced(readings, self.width))


def first_line(error: Exception | str) -> str:
    """Return the first line of what an error says."""
    return next(iter(str(error).strip().splitlines()), type(error).__name__)
