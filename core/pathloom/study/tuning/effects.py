"""Main effects of a designed experiment, as a linear model of coded levels.

A design has a row for each setting that is tried and a column for each factor;
its entries are levels, coded −1, 0 and 1 from the lowest to the highest. Every
setting is tried several times, and a linear model of the levels is fitted to
the means. A factor that has its best level in the middle escapes this model;
``levels`` has one that sees it.
"""

from dataclasses import dataclass
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from pathloom.errors import ConfigError
from pathloom.kernel.evaluation import Floats


@dataclass(frozen=True)
class MainEffects:
    """The model mean + Σ slope · level. Errors are standard errors; nan if each setting was tried once."""

    mean: float
    slopes: Floats
    """(k,), change of the response for one level up."""
    errors: Floats
    """(k,), of the slopes."""
    spread: float
    """Standard deviation of the trials of one setting, pooled."""

    @property
    def best(self) -> Floats:
        """(k,), the corner of the design at which the model is largest."""
        return np.where(self.slopes >= 0.0, 1.0, -1.0)

    def predict(self, levels: ArrayLike) -> float:
        """Return the response that the model expects at these levels (k,)."""
        return float(self.mean + self.slopes @ np.asarray(levels, np.float64))


def main_effects(design: ArrayLike, trials: ArrayLike, divisor: Literal["ols", "paper"] = "ols") -> MainEffects:
    """Fit the model to trials (n, repeats) of the settings of a design (n, k).

    ``ols`` takes the slopes of least squares, of all factors at once. ``paper``
    divides the sum of level times mean by the number of settings, as Hao et al.
    2021 do (section 5.2.1, eq. 31). A factor's own regression divides by the settings
    at which it is not at level 0: of nine at three levels that leaves six, so that
    the paper's slopes are two thirds of it.

    Raises
    ------
    ConfigError
        If the trials are not as many rows as the design, or, for ``ols``, if the
        design has too few rows to tell the factors apart.
    """
    levels, tried = checked(design, trials)
    rows, repeats = tried.shape
    spread = pooled_spread(tried)
    terms = np.column_stack((np.ones(rows), levels))
    if divisor == "paper":
        weights = np.column_stack((np.full(rows, 1.0 / rows), levels / rows))
    elif np.linalg.matrix_rank(terms) < terms.shape[1]:
        raise ConfigError(f"{rows} settings of {levels.shape[1]} factors do not tell the factors apart")
    else:
        weights = np.linalg.pinv(terms).T
    mean, *slopes = weights.T @ tried.mean(axis=1)  # every coefficient is a weighted sum of the rows' means
    errors = np.sqrt((weights**2).sum(axis=0) / repeats) * spread
    return MainEffects(float(mean), np.array(slopes), errors[1:], spread)


def level_means(design: ArrayLike, trials: ArrayLike) -> tuple[Floats, ...]:
    """Return for each factor the mean response at each of its levels, from the lowest on."""
    levels, means = np.asarray(design, np.float64), np.asarray(trials, np.float64).mean(axis=1)
    return tuple(np.array([means[column == level].mean() for level in np.unique(column)]) for column in levels.T)


def correlations(design: ArrayLike) -> Floats:
    """Return how far the levels of factors go together, (k, k): 0 for factors that can be told apart cleanly."""
    return np.asarray(np.corrcoef(np.asarray(design, np.float64), rowvar=False))


def aliases(design: ArrayLike) -> list[tuple[int, int]]:
    """Return the pairs of factors that are one under two names: the level of one gives that of the other."""
    levels = np.asarray(design, np.float64)
    found = []
    for a, b in combinations(range(levels.shape[1]), 2):
        together = len(np.unique(levels[:, (a, b)], axis=0))
        if together == len(np.unique(levels[:, a])) == len(np.unique(levels[:, b])):
            found.append((a, b))
    return found


def checked(design: ArrayLike, trials: ArrayLike) -> tuple[Floats, Floats]:
    """Return design and trials as arrays that go together."""
    levels, tried = np.asarray(design, np.float64), np.asarray(trials, np.float64)
    if levels.ndim != 2 or tried.ndim != 2 or len(levels) != len(tried):
        raise ConfigError(f"a design of shape {levels.shape} does not go with trials of shape {tried.shape}")
    return levels, tried


def pooled_spread(trials: Floats) -> float:
    """Return the standard deviation of the trials of one setting, over all settings; nan of single trials."""
    return float(np.sqrt(trials.var(axis=1, ddof=1).mean())) if trials.shape[1] > 1 else np.nan
