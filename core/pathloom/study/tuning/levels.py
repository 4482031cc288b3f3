"""Main effects with a value of its own for each level: no line is drawn through them.

The additive model response = mean + Σ effect of the factor's level, by least
squares, so that it holds for unbalanced columns as well. Where a design is
orthogonal, it is Taguchi's table of level means.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from pathloom.errors import ConfigError
from pathloom.kernel.evaluation import Floats
from pathloom.study.tuning.effects import checked, pooled_spread


@dataclass(frozen=True)
class LevelEffects:
    """What every level of every factor does."""

    mean: float
    means: tuple[Floats, ...]
    """For each factor the expected response at each level, the other factors being at their average."""
    errors: tuple[Floats, ...]
    """Their standard errors; nan if each setting was tried once."""
    p: Floats
    """(k,) of the F test that the factor does nothing, against the spread of trials; nan without."""
    spread: float
    coefficients: Floats
    covariance: Floats
    """Of the coefficients."""
    codes: tuple[Floats, ...]
    """For each factor its levels, as they stand in the design."""

    def predict(self, levels: ArrayLike) -> tuple[float, float]:
        """Return the expected response at these levels (k,), coded as in the design, and its standard error."""
        row = np.concatenate(
            [
                np.ones(1),
                *(
                    _contrast(codes)[codes == level][0]
                    for codes, level in zip(self.codes, np.asarray(levels), strict=True)
                ),
            ]
        )
        return float(row @ self.coefficients), float(np.sqrt(row @ self.covariance @ row))

    def best(self, *, least: bool = False) -> Floats:
        """(k,), the level of each factor at which the response is largest, or least; the first of equal ones."""
        sign = -1.0 if least else 1.0
        return np.array([codes[int(np.argmax(sign * m))] for codes, m in zip(self.codes, self.means, strict=True)])


def level_effects(design: ArrayLike, trials: ArrayLike) -> LevelEffects:
    """Fit the model to trials (n, repeats) of the settings of a design (n, k).

    Raises
    ------
    ConfigError
        If the shapes do not go together, or the design cannot tell the levels apart.
    """
    levels, tried = checked(design, trials)
    rows, repeats = tried.shape
    codes = tuple(np.unique(column) for column in levels.T)
    parts = [_contrast(own)[np.searchsorted(own, column)] for own, column in zip(codes, levels.T, strict=True)]
    terms = np.column_stack((np.ones(rows), *parts))
    if np.linalg.matrix_rank(terms) < terms.shape[1]:
        raise ConfigError(f"{rows} settings do not tell the levels of {levels.shape[1]} factors apart")
    spread = pooled_spread(tried)
    inverse = np.linalg.inv(terms.T @ terms)
    coefficients = inverse @ terms.T @ tried.mean(axis=1)
    covariance = inverse * (spread**2 / repeats)
    means, errors, p = [], [], []
    first = 1
    for own, part in zip(codes, parts, strict=True):
        wide = part.shape[1]
        of = np.zeros((len(own), terms.shape[1]))
        of[:, 0], of[:, first : first + wide] = 1.0, _contrast(own)
        means.append(of @ coefficients)
        errors.append(np.sqrt(np.einsum("ij,jk,ik->i", of, covariance, of)))
        p.append(_p_of(coefficients[first : first + wide], covariance[first : first + wide, first : first + wide],
                       rows * (repeats - 1)))  # fmt: skip
        first += wide
    return LevelEffects(
        float(coefficients[0]), tuple(means), tuple(errors), np.array(p), spread, coefficients, covariance, codes
    )


def _contrast(codes: Floats) -> Floats:
    """Return (levels, levels − 1), columns that sum to zero: the last level is minus all others."""
    return np.vstack((np.eye(len(codes) - 1), -np.ones(len(codes) - 1)))


def _p_of(effects: Floats, covariance: Floats, freedom: int) -> float:
    if freedom < 1 or not np.isfinite(covariance).all():
        return np.nan
    if not covariance.any():  # trials without any spread
        return 0.0 if effects.any() else 1.0
    statistic = effects @ np.linalg.solve(covariance, effects) / len(effects)
    return float(stats.f.sf(statistic, len(effects), freedom))
