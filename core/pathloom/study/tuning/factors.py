"""Factors of an experiment: parameters of a planner, and the values to try."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pathloom.errors import ConfigError
from pathloom.kernel.compose import compose, freeze, override
from pathloom.kernel.planner import Planner
from pathloom.study.design import Variant
from pathloom.study.tuning.arrays import Levels, choose_array


@dataclass(frozen=True)
class Factor:
    """One parameter, and the values to try: its levels, from the first on."""

    path: str
    """As in ``--set``: ``population``, ``crossover.rate``."""
    values: tuple[Any, ...]


@dataclass(frozen=True)
class Experiment:
    """The settings that are tried."""

    base: Planner
    factors: tuple[Factor, ...]
    array: str
    """Name of the orthogonal array; ``full`` for all combinations."""
    levels: Levels
    """(settings, factors), counted from 0."""

    @property
    def coded(self) -> Levels:
        """(settings, factors), levels around 0: −1, 0, 1 of three, −1, 1 of two, −3, −1, 1, 3 of four."""
        counts = np.array([len(factor.values) for factor in self.factors])
        coded: Levels = np.where(counts % 2, self.levels - counts // 2, 2 * self.levels - (counts - 1))
        return coded

    def values_at(self, codes: Sequence[float]) -> dict[str, Any]:
        """Return the values of the factors at coded levels."""
        levels = [round(c) + n // 2 if n % 2 else (round(c) + n - 1) // 2
                  for c, n in zip(codes, (len(factor.values) for factor in self.factors), strict=True)]  # fmt: skip
        return self.setting(levels)

    def setting(self, row: Sequence[int]) -> dict[str, Any]:
        """Return the values of the factors at these levels, counted from 0."""
        return {factor.path: factor.values[level] for factor, level in zip(self.factors, row, strict=True)}

    def variants(self) -> tuple[Variant, ...]:
        """Return a variant for each setting, in order."""
        return tuple(variant_at(self.base, self.setting(row)) for row in self.levels.tolist())


def experiment(
    base: "str | Mapping[str, Any] | Planner", factors: Mapping[str, Sequence[Any]], array: str | None = None
) -> Experiment:
    """Return the experiment with these factors in the smallest array that has room for them.

    Raises
    ------
    ConfigError
        If a parameter is unknown, a value out of range or listed twice, or the factors do not fit.
    """
    planner = compose(base)
    if not factors:
        raise ConfigError("factor: found none, allowed one or more, as in population=40,50,60")
    listed = tuple(Factor(path, tuple(values)) for path, values in factors.items())
    for factor in listed:
        seen = []
        for value in factor.values:
            table = freeze(_with(planner, factor.path, value))
            if table in seen:
                raise ConfigError(f"factor {factor.path}: found {value!r} twice, allowed each once")
            seen.append(table)
    name, levels = choose_array([len(factor.values) for factor in listed], array)
    return Experiment(planner, listed, name, levels)


def variant_at(base: Planner, setting: Mapping[str, Any]) -> Variant:
    """Return the base with these parameters, as a variant that bears them as its name."""
    planner = base
    for path, value in setting.items():
        planner = _with(planner, path, value)
    changes = {path: str(value) for path, value in setting.items()}
    return Variant(", ".join(f"{path}={value}" for path, value in changes.items()), planner, changes)


def _with(planner: Planner, path: str, value: Any) -> Planner:
    try:
        return override(planner, path, value)
    except ConfigError as error:
        raise ConfigError(f"factor {error}") from error
