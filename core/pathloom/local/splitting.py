"""Dividing examples into those to learn from and those to be tried on."""

import math
import warnings
from collections.abc import Iterator
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError
from pathloom.local.examples import Examples

Rows = NDArray[np.intp]
Order = Literal["file", "shuffled"]
TRAINING = 0.3
"""Share of the examples that are learned from: 1636 of 5456, Song et al. (2021), section 3.3."""
FOLDS = 10


def hold_out(examples: Examples, rng: np.random.Generator) -> tuple[Rows, Rows]:
    """Return the rows to train on and those to test on, drawn at random: 1636 and 3820 of 5456."""
    test = math.ceil(round((1.0 - TRAINING) * len(examples), 6))
    if len(examples) - test < 2:
        raise ConfigError(f"{examples.name}: found {len(examples)} examples, allowed enough to train on three of ten")
    order = rng.permutation(len(examples))
    return order[test:], order[:test]


def folds(examples: Examples, order: Order, rng: np.random.Generator) -> Iterator[tuple[Rows, Rows]]:
    """Yield ten times the rows to train on and those to test on, each row once for a test, actions in equal shares.

    ``file``: neighbours in time stay together, as the paper's figures need it. ``shuffled``: each fold is drawn from
    all of the time that was recorded, so that nearly every row has a neighbour in time that was learned.
    """
    from sklearn.model_selection import StratifiedKFold

    shuffled = order == "shuffled"
    splitter = StratifiedKFold(FOLDS, shuffle=shuffled, random_state=int(rng.integers(2**31)) if shuffled else None)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # an action rarer than folds is missing in some of them; that is no harm
            yield from splitter.split(examples.distances, examples.actions)
    except ValueError:
        most = int(np.bincount(examples.actions).max())
        found = f"{most} examples of the most frequent action"
        raise ConfigError(f"{examples.name}: found {found}, allowed {FOLDS} or more for as many folds") from None
