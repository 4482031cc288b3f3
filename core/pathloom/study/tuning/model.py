"""From trials to a choice: what each factor does, which setting is predicted best, and how sure that is."""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from pathloom.kernel.evaluation import Floats
from pathloom.study.statistics.multiple import holm
from pathloom.study.tuning.aliasing import Alias, interaction_aliases
from pathloom.study.tuning.effects import MainEffects, aliases, correlations, main_effects
from pathloom.study.tuning.factors import Experiment
from pathloom.study.tuning.levels import LevelEffects, level_effects
from pathloom.study.tuning.response import Response

By = Literal["levels", "ols", "paper"]
"""What the optimum is read off: mean responses of levels, or the corner of a linear model."""


@dataclass(frozen=True)
class Model:
    """What an experiment says."""

    by: By
    levels: LevelEffects
    linear: MainEffects
    """With the divisor that is asked for; by least squares else."""
    p: Floats
    """(k,) of each factor doing nothing, after Holm's correction; nan without repeated trials."""
    optimum: dict[str, Any]
    """The setting that is predicted best."""
    predicted: float
    """The response expected there."""
    error: float
    """Standard error of that; nan without repeated trials."""
    inseparable: tuple[tuple[int, int], ...]
    """Pairs of factors that are one under two names."""
    correlated: tuple[tuple[int, int, float], ...]
    """Pairs of factors whose levels go together otherwise, with the correlation."""
    confounded: tuple[Alias, ...]
    """Main effects that could as well be joint effects of two other factors."""


def model(experiment: Experiment, response: Response, by: By = "levels") -> Model:
    """Fit the experiment's trials, and find the optimum.

    Raises
    ------
    ConfigError
        If the design cannot tell its factors apart.
    """
    design, trials, least = experiment.coded, response.trials, response.metric.sign > 0
    linear = main_effects(design, trials, "paper" if by == "paper" else "ols")
    levels = level_effects(design, trials)
    if by == "levels":
        codes = levels.best(least=least)
        predicted, error = levels.predict(codes)
    else:
        rising = linear.slopes * (-1.0 if least else 1.0) >= 0.0
        codes = np.where(rising, design.max(axis=0), design.min(axis=0)).astype(np.float64)
        predicted = linear.predict(codes)
        # The weights of a linear model's coefficients are as good as uncorrelated; exactly so in orthogonal arrays.
        error = float(np.sqrt(linear.spread**2 / trials.size + ((codes * linear.errors) ** 2).sum()))
    p = holm(levels.p) if np.isfinite(levels.p).all() else levels.p
    together = aliases(design)
    going = np.atleast_2d(correlations(design)) if design.shape[1] > 1 else np.eye(1)
    correlated = tuple((int(a), int(b), float(going[a, b])) for a, b in np.argwhere(np.triu(np.abs(going), 1) > 1e-9))
    return Model(
        by, levels, linear, p, experiment.values_at(codes.tolist()), predicted, error,
        tuple(together), correlated, tuple(interaction_aliases(design)),
    )  # fmt: skip
