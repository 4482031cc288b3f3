"""What of a planner's front may be reported: every path passes the validator, every value is measured on it."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pathloom.exact import validate
from pathloom.fronts.indicators import SAME
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.evaluation import Floats, Terms, measure
from pathloom.kernel.front import Front
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True)
class Verified:
    """Paths none of which dominates another, in lexicographic order of their values (n, m)."""

    paths: tuple[Path, ...]
    values: Floats
    counts: dict[str, int] = field(default_factory=dict)
    """What was dropped, or measured differently from what the planner said."""
    faults: tuple[str, ...] = ()
    """Why paths were dropped, each reason once."""


def verified(front: Front, problem: PathProblem, objectives: Terms, constraints: Sequence[Constraint] = ()) -> Verified:
    """Return the part of a front that holds.

    A path that the validator refuses is dropped and counted, and so is one that
    breaks a constraint, has an infinite value, or is dominated by another one.
    """
    paths = [problem.representation.decode(row) for row in front.population]
    faults = [validate(path, problem) for path in paths]
    valid = np.array([i for i, fault in enumerate(faults) if fault is None], np.intp)
    values = np.full(front.values.shape, np.inf)
    values[valid] = measured([paths[i] for i in valid], problem, objectives)
    feasible = valid[_keeping(constraints, [paths[i] for i in valid], problem)]
    finite = feasible[np.isfinite(values[feasible]).all(axis=1)]
    kept = finite[_in_order(values[finite])]
    counts = {
        "invalid paths dropped": len(paths) - len(valid),
        "infeasible paths dropped": len(valid) - len(feasible),
        "infinite values dropped": len(feasible) - len(finite),
        "dominated paths dropped": len(finite) - len(kept),
        "values corrected": int((np.abs(front.values[kept] - values[kept]) > SAME).any(axis=1).sum()),
    }
    reasons = tuple(dict.fromkeys(fault for fault in faults if fault is not None))
    return Verified(tuple(paths[i] for i in kept), values[kept], {k: v for k, v in counts.items() if v}, reasons)


def measured(paths: list[Path], problem: PathProblem, objectives: Terms) -> Floats:
    """Return the values (n, m) of paths, each (k, 2)."""
    if not paths:
        return np.empty((0, len(objectives)))
    return measure(list(objectives.objectives()), problem.representation.encode(paths), problem) + 0.0  # no -0.0


def _keeping(constraints: Sequence[Constraint], paths: list[Path], problem: PathProblem) -> NDArray[np.bool_]:
    """Return which paths keep to all constraints, up to rounding."""
    keeping = np.ones(len(paths), bool)
    if paths:
        population = problem.representation.encode(paths)
        for constraint in constraints:
            keeping &= constraint.violation(population, problem) <= SAME
    return keeping


def _in_order(values: Floats) -> NDArray[np.intp]:
    """Return the rows that no other one dominates, the first of equal ones, in lexicographic order."""
    if len(values) == 0:
        return np.empty(0, np.intp)
    from moocore import is_nondominated

    kept = is_nondominated(values, keep_weakly=False).nonzero()[0]
    return np.asarray(kept[np.lexsort(values[kept].T[::-1])])
