"""What the runs of an experiment answer: trials, one row for each setting, freed of the maps' own level."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pathloom.errors import ConfigError
from pathloom.kernel.evaluation import Floats
from pathloom.study.statistics.metrics import GAPS, METRICS, Metric, metric
from pathloom.study.statistics.runs import Runs


@dataclass(frozen=True)
class Response:
    """Trials of the settings."""

    metric: Metric
    trials: Floats
    """(settings, trials), values of the metric."""
    maps: int
    penalised: int
    """Runs without a value that count as the worst of their map."""
    left_out: int
    """Maps that are left out, as no run has a value there, or the value is not known."""


def response(runs: Runs, settings: Sequence[str], name: str | None = None) -> Response:
    """Return the trials of settings (names of variants) in one metric: the sharpest known gap unless one is named.

    A map's mean over all settings is taken out of its trials and the mean over all
    maps put back, so that hard maps do not pass for spread. A run without a value counts
    as the worst that any setting had on that map.

    Raises
    ------
    ConfigError
        If no run has a value.
    """
    chosen = metric(name) if name is not None else next(
        (METRICS[gap] for gap in GAPS if runs.knows(METRICS[gap])), METRICS["length"]
    )  # fmt: skip
    table = runs.ordered(settings).table(runs.ordered(settings).costs(chosen))
    finite = np.isfinite(table)
    usable = finite.any(axis=(0, 2)) & ~np.isnan(table).any(axis=(0, 2))
    if not usable.any():
        raise ConfigError(f"response: no map has a {chosen.label} of every run")
    table, finite = table[:, usable], finite[:, usable]
    worst = np.where(finite, table, -np.inf).max(axis=(0, 2), keepdims=True)
    filled = np.where(finite, table, worst)
    level = filled.mean(axis=(0, 2), keepdims=True)
    trials = (filled - level + level.mean()) * chosen.sign
    return Response(
        chosen, trials.reshape(len(settings), -1), int(usable.sum()), int((~finite).sum()), int((~usable).sum())
    )
