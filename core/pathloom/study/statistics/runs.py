"""Rows of runs as columns: read once, held as numbers."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError
from pathloom.kernel.evaluation import Floats
from pathloom.naming import closest
from pathloom.study.row import STATUSES, Row
from pathloom.study.statistics.metrics import GAPS, METRICS, SUCCESS, Metric

CHUNK = 4096
STORED = tuple(name for name in METRICS if name != SUCCESS.name)
FOUND, UNREACHABLE = STATUSES.index("found"), STATUSES.index("unreachable")


@dataclass(frozen=True)
class Runs:
    """All runs of a study, one place of each array for each run.

    Runs stand in the order of variant, instance and seed, so that the order in
    which they ended changes nothing.
    """

    variants: tuple[str, ...]
    """In the order in which they first came."""
    instances: tuple[str, ...]
    """A map with its ends each, in that order too."""
    variant: NDArray[np.intp]
    instance: NDArray[np.intp]
    seed: NDArray[np.int64]
    status: NDArray[np.int8]
    """Places in ``STATUSES``."""
    values: dict[str, Floats]
    """For each metric its values; nan where a run has none."""

    def __len__(self) -> int:
        """Return the number of runs."""
        return len(self.status)

    @classmethod
    def read(cls, rows: Iterable[Row]) -> "Runs":
        """Read rows one by one; only their numbers are kept."""
        variants: dict[str, int] = {}
        instances: dict[str, int] = {}
        codes = {name: code for code, name in enumerate(STATUSES)}
        keys, numbers = [np.empty((0, 4), np.int64)], [np.empty((0, len(STORED)))]
        key, measured = attrgetter("variant", "map", "seed", "status"), attrgetter(*STORED)
        left = iter(rows)
        while chunk := list(islice(left, CHUNK)):
            numbers.append(np.array([measured(row) for row in chunk], np.float64))  # None becomes nan
            keys.append(
                np.array(
                    [
                        (
                            variants.setdefault(variant, len(variants)),
                            instances.setdefault(place, len(instances)),
                            seed,
                            codes[status],
                        )
                        for variant, place, seed, status in map(key, chunk)
                    ],
                    np.int64,
                )
            )
        every, table = np.concatenate(keys), np.concatenate(numbers)
        order = np.lexsort(every[:, 2::-1].T)
        variant, instance, seed, status = every[order].T
        return cls(
            tuple(variants),
            tuple(instances),
            variant.astype(np.intp),
            instance.astype(np.intp),
            seed,
            status.astype(np.int8),
            {name: np.ascontiguousarray(column[order]) for name, column in zip(STORED, table.T, strict=True)},
        )

    def ordered(self, variants: Sequence[str]) -> "Runs":
        """Return the runs of some variants, in another order.

        Raises
        ------
        ConfigError
            If there is no variant of a name.
        """
        for name in variants:
            if name not in self.variants:
                raise ConfigError(f"variants: none is called {name!r}; {closest(name, self.variants)}")
        place = np.full(len(self.variants), -1)
        place[[self.variants.index(name) for name in variants]] = np.arange(len(variants))
        moved = place[self.variant]
        kept = np.argsort(moved, kind="stable")[int((moved < 0).sum()) :]
        return replace(
            self,
            variants=tuple(variants),
            variant=moved[kept],
            instance=self.instance[kept],
            seed=self.seed[kept],
            status=self.status[kept],
            values={name: column[kept] for name, column in self.values.items()},
        )

    def knows(self, metric: Metric) -> bool:
        """Return whether any run has a value of the metric."""
        return metric is SUCCESS or bool(np.isfinite(self.values[metric.name]).any())

    def costs(self, metric: Metric) -> Floats:
        """Return what each run costs, less being better.

        A run that found no path costs infinitely much, so that it ranks worst. A
        run on a map without a path, and a run of which the value is not known, is nan.
        """
        failed = (self.status != FOUND) & (self.status != UNREACHABLE)
        if metric is SUCCESS:
            return np.where(self.status == UNREACHABLE, np.nan, np.where(failed, 0.0, metric.sign))
        costs = metric.sign * _rounded(self.values[metric.name], metric)
        missed = failed
        if metric.target:  # a target that exists on this instance, and was not reached
            missed = failed | ((self.status == FOUND) & self._measurable(metric)[self.instance])
        return np.where(np.isnan(costs) & missed, np.inf, costs)

    def _measurable(self, metric: Metric) -> NDArray[np.bool_]:
        """Return whether the target exists on each instance: whether an optimum is known, or a run got there."""
        known = np.isfinite(self.values[metric.name])
        if metric.name == "evaluations_to_one_percent":
            known |= np.any([np.isfinite(self.values[name]) for name in GAPS], axis=0)
        return np.bincount(self.instance, weights=known, minlength=len(self.instances)) > 0

    def table(self, column: Floats) -> Floats:
        """Return a column as (variants, instances, runs): the runs of one cell side by side, filled up with nan."""
        cell = self.variant * len(self.instances) + self.instance
        counts = np.bincount(cell, minlength=len(self.variants) * len(self.instances))
        place = np.arange(len(cell)) - (np.cumsum(counts) - counts)[cell]
        filled = np.full((len(counts), max(counts.max(initial=0), 1)), np.nan)
        filled[cell, place] = column
        return filled.reshape(len(self.variants), len(self.instances), -1)


def _rounded(values: Floats, metric: Metric) -> Floats:
    """Return values so that what differs by rounding alone is equal: a tie is a tie. An infinite one is none."""
    finite = np.where(np.isfinite(values), values, np.nan)
    if metric.name in GAPS:
        return np.asarray(np.round(finite, 10), np.float64) + 0.0
    size = np.floor(np.log10(np.where(np.abs(finite) > 0.0, np.abs(finite), 1.0)))
    unit: Floats = np.power(10.0, np.nan_to_num(size) - 10.0)
    rounded: Floats = np.asarray(np.round(finite / unit), np.float64) * unit
    return rounded
