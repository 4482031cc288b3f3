"""Orthogonal arrays: few settings in which any two factors meet in every combination equally often.

Source: G. Taguchi (1987), System of Experimental Design; the arrays L9 (3⁴),
L18 (2¹ 3⁷) and L27 (3¹³). Levels are counted from 0.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError
from pathloom.naming import closest
from pathloom.study.tuning.aliasing import interaction_aliases

Levels = NDArray[np.int64]


@dataclass(frozen=True)
class OrthogonalArray:
    """An array of levels."""

    name: str
    levels: Levels
    """(settings, columns)"""

    @property
    def widths(self) -> tuple[int, ...]:
        """How many levels each column has."""
        return tuple(int(column.max()) + 1 for column in self.levels.T)

    def columns_for(self, counts: Sequence[int]) -> list[int] | None:
        """Return a column for each factor with so many levels, or None if they do not fit.

        A factor takes a column of its own number of levels where one is left, else
        one of more, in which its levels come round again (Taguchi's dummy level); of
        several columns the one that is mixed up least with joint effects of those taken.
        """
        free = list(range(len(self.widths)))
        chosen: dict[int, int] = {}
        for factor in sorted(range(len(counts)), key=lambda i: -counts[i]):
            fitting = [column for column in free if self.widths[column] >= counts[factor]]
            if not fitting:
                return None
            exact = [column for column in fitting if self.widths[column] == counts[factor]]
            taken = tuple(chosen.values())
            chosen[factor] = min(exact or fitting, key=lambda column: (round(self._mixed(column, taken), 9), column))
            free.remove(chosen[factor])
        return [chosen[factor] for factor in range(len(counts))]

    def _mixed(self, column: int, taken: tuple[int, ...]) -> float:
        """Return how much a column and pairs of taken ones are mixed up with each other's joint effects."""
        triples = [tuple(sorted((*pair, column))) for pair in combinations(taken, 2)]
        return sum(_mixed(self.levels[:, triple].tobytes(), len(self.levels)) for triple in triples)


@lru_cache(maxsize=512)
def _mixed(columns: bytes, rows: int) -> float:
    levels = np.frombuffer(columns, np.int64).reshape(rows, -1)
    return sum(alias.share**2 for alias in interaction_aliases(levels))


def _powers_of_three(rank: int) -> Levels:
    """Return the array of 3^rank settings: each column a different direction of the space over three elements."""
    settings = np.array(list(product(range(3), repeat=rank)))
    # One of each pair of opposite directions: the one of which the last coordinate that is not 0 is 1, in the
    # order in which textbooks have them: A, B, AB, AB²; C, AC, AC², BC, ...
    directions = [d[::-1] for d in product(range(3), repeat=rank) if any(d) and next(x for x in d if x) == 1]
    levels: Levels = settings @ np.array(directions).T % 3
    return levels


# Rows of eight digits, levels from 1 as they are printed everywhere.
_L18 = """
11111111 11222222 11333333 12112233 12223311 12331122 13121323 13232131 13313212
21133221 21211332 21322113 22123132 22231213 22312321 23132312 23213123 23321231
"""

ARRAYS = {
    array.name: array
    for array in (
        OrthogonalArray("L9", _powers_of_three(2)),
        OrthogonalArray("L18", np.array([[int(digit) - 1 for digit in row] for row in _L18.split()])),
        OrthogonalArray("L27", _powers_of_three(3)),
    )
}
"""From the smallest on."""
FULL = "full"


def choose_array(counts: Sequence[int], name: str | None = None) -> tuple[str, Levels]:
    """Return the name of the smallest array for factors with so many levels each, and its columns for them.

    All combinations are taken where they are no more settings than the array.

    Parameters
    ----------
    counts
        2 or 3 for each factor.
    name
        ``L9``, ``L18``, ``L27`` or ``full`` for all combinations; else the smallest.

    Raises
    ------
    ConfigError
        If no array has room for the factors, or the named one has none.
    """
    for count in counts:
        if count not in (2, 3) and name != FULL:
            raise ConfigError(f"factor: found {count} levels, allowed 2 or 3 (or --array full)")
    if name is not None and name not in (*ARRAYS, FULL):
        raise ConfigError(f"array: none is called {name!r}; {closest(name, (*ARRAYS, FULL))}")
    every = int(np.prod(counts))
    if name == FULL:
        return FULL, _all(counts)
    for array in ARRAYS.values():
        if name in (None, array.name) and (columns := array.columns_for(counts)) is not None:
            if name is None and every <= len(array.levels):
                return FULL, _all(counts)
            return array.name, array.levels[:, columns] % np.array(counts)
    room = f"{name} has {len(ARRAYS[name].widths)} columns" if name else "L27 has 13 columns"
    raise ConfigError(f"array: {len(counts)} factors of {', '.join(map(str, counts))} levels do not fit: {room}")


def _all(counts: Sequence[int]) -> Levels:
    return np.array(list(product(*(range(count) for count in counts))))
