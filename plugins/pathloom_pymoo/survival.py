"""pymoo's survivals on whole arrays.

pymoo keeps an object for every individual and asks each for its values. Its
survivals only ever ask a population to ``get`` and ``set`` columns and to be
indexed: `Rows`, the indices of rows with a table of columns behind them, does
that too, and pymoo's own code runs unchanged.
"""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from pymoo.core.population import Population

from pathloom import Floats, Indices


class Rows(Population):  # type: ignore[misc]
    """Row indices (n,) into a table of columns: F, CV, FEAS, and whatever pymoo marks the individuals with."""

    table: dict[str, NDArray[Any]]

    def __new__(cls, table: Mapping[str, NDArray[Any]]) -> Self:
        """Return all rows of a table."""
        rows: Self = np.arange(len(table["F"])).view(cls)  # type: ignore[assignment]
        rows.table = dict(table)
        return rows

    def __array_finalize__(self, parent: Any) -> None:
        """Let what is made of rows have the same table."""
        self.table = getattr(parent, "table", {})

    def __getitem__(self, which: Any) -> Any:
        """Return some rows, or one, which still knows its table."""
        return super().__getitem__((which, ...) if isinstance(which, (int, np.integer)) else which)

    @property
    def F(self) -> Floats:  # noqa: N802 - pymoo's name
        """The values of these rows, or of this one."""
        return np.asarray(self.table["F"][np.asarray(self)])

    def get(self, *columns: str, **_: Any) -> Any:
        """Return one column, or several, of these rows."""
        found = tuple(self.table[name][np.asarray(self)] for name in columns)
        return found[0] if len(found) == 1 else found

    def set(self, *pairs: Any, **columns: Any) -> None:
        """Mark these rows, by name, value, name, value or by keyword; a value is for all of them or one for each."""
        columns |= dict(zip(pairs[::2], pairs[1::2], strict=True))
        for name, value in columns.items():
            given = np.asarray(value)
            if name not in self.table:
                self.table[name] = np.zeros(len(self.table["F"]), given.dtype)
            self.table[name][np.asarray(self)] = given


@dataclass(frozen=True)
class Facts:
    """What survivals ask of pymoo's problem."""

    n_obj: int
    constrained: bool

    def has_constraints(self) -> bool:
        """Whether somebody breaks a constraint: without one, pymoo need not part the feasible from the others."""
        return self.constrained


def survive(
    survival: Any, values: Floats, violation: Floats, n: int, rng: np.random.Generator, **more: Any
) -> tuple[Indices, dict[str, NDArray[Any]]]:
    """Return who survives by one of pymoo's survivals, and how it marked each individual.

    ``values`` (k, m), ``violation`` (k,); ``more`` is handed on to the survival.
    """
    cv = violation[:, np.newaxis]
    rows = Rows({"F": values, "CV": cv, "FEAS": violation == 0.0})
    facts = Facts(values.shape[1], bool(violation.any()))
    with warnings.catch_warnings():  # pymoo's NSGA-III switches all warnings off, for everybody
        warnings.simplefilter("ignore")
        kept = survival.do(facts, rows, n_survive=n, random_state=rng, **more)
    marks = {name: column for name, column in rows.table.items() if name not in ("F", "CV", "FEAS")}
    return np.asarray(kept, np.intp).ravel(), marks
