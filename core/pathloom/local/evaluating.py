"""Evaluating policies on examples: hold-out, ten folds in two orders, and what more examples are worth."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pathloom.kernel.counting import counting
from pathloom.local.examples import Examples
from pathloom.local.measuring import Measures
from pathloom.local.policy import Decide, Policy
from pathloom.local.splitting import Order, folds, hold_out

ORDERS: tuple[Order, ...] = ("file", "shuffled")
SHORTEST = 50
"""Examples at which learning curves begin."""


@dataclass(frozen=True)
class Evaluation:
    """How good a policy is on examples that it did not learn from."""

    holdouts: tuple[Measures, ...]
    """One for each draw; the first is the seed's own."""
    train: int
    test: int
    """Rows of a hold-out."""
    tenfold: Mapping[Order, tuple[Measures, ...]]
    """Ten measures for each order."""
    curve: tuple[tuple[int, float], ...] = ()
    """Rows learned from, and accuracy on the first hold-out's test rows."""
    notes: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return what stands in a document ``pathloom.policy/1``."""
        accuracies = [one.accuracy for one in self.holdouts]
        document: dict[str, Any] = {
            "holdout": {
                **self.holdouts[0].to_dict(), "train": self.train, "test": self.test, "accuracies": accuracies,
                "mean": float(np.mean(accuracies)), "least": min(accuracies), "most": max(accuracies),
            },
        }  # fmt: skip
        for order, each in self.tenfold.items():
            key = "tenfold" if order == "file" else f"tenfold_{order}"
            document[key] = {**Measures.mean(each).to_dict(), "order": order, "folds": [one.accuracy for one in each]}
        if self.curve:
            document["learning_curve"] = [{"train": rows, "accuracy": accuracy} for rows, accuracy in self.curve]
        if self.notes:
            document["notes"] = list(self.notes)
        return document


def evaluate(
    policy: Policy,
    examples: Examples,
    *,
    seed: int = 0,
    draws: int = 1,
    orders: tuple[Order, ...] = ORDERS,
    curve: bool = False,
    tell: Callable[[str], None] = lambda _: None,
) -> Evaluation:
    """Train and try a policy on examples, by hold-out and by ten folds.

    Parameters
    ----------
    seed
        What is drawn depends on it alone: all policies are trained and tried on the same rows.
    draws
        Hold-outs, of which the first is the one of the seed, the next that of ``seed`` + 1, and so on.
    orders
        Of the ten folds; see `folds`.
    curve
        Also learn from 50, 100, 200, … rows.
    tell
        Is told what is done next.

    Raises
    ------
    ConfigError
        If there are too few examples, or the policy cannot learn from them.
    """
    with counting() as counts:
        holdouts = []
        points: list[tuple[int, float]] = []
        for draw in range(draws):
            tell("hold-out")
            train, test = hold_out(examples, np.random.default_rng([seed + draw, 0]))
            there = examples.take(test)
            holdouts.append(tried(policy.trained(examples.take(train), _own(seed + draw)), there))
            if curve and draw == 0:
                tell("learning curve")
                for rows in _sizes(len(train)):
                    some = examples.take(train[:rows])
                    if len(np.unique(some.actions)) > 1:
                        points.append((rows, tried(policy.trained(some, _own(seed)), there).accuracy))
        tenfold: dict[Order, tuple[Measures, ...]] = {}
        for order in orders:
            tell(f"ten folds, {order}")
            each = folds(examples, order, np.random.default_rng([seed, 2]))
            tenfold[order] = tuple(
                tried(policy.trained(examples.take(train), _own(seed)), examples.take(test)) for train, test in each
            )
    notes = tuple(f"{event} ({times} times)" for event, times in counts.items())
    return Evaluation(tuple(holdouts), len(train), len(test), tenfold, tuple(points), notes)


def tried(decide: Decide, examples: Examples) -> Measures:
    """Measure how a policy that has learned decides on examples."""
    return Measures.of(examples.actions, decide(examples.distances))


def _own(seed: int) -> np.random.Generator:
    """Return the generator of a policy's training."""
    return np.random.default_rng([seed, 1])


def _sizes(most: int) -> list[int]:
    """Return numbers of rows, each twice the one before, and all of them."""
    doublings = max(0, round(math.log2(most / SHORTEST)))
    return [*(SHORTEST * 2**k for k in range(doublings)), most]
