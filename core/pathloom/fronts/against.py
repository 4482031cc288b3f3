"""Where the path of another planner lies beside a front."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pathloom.fronts.indicators import SAME, additive_epsilon
from pathloom.fronts.verified import measured
from pathloom.kernel.evaluation import Floats, Terms, measure
from pathloom.paths.cell_paths import Path
from pathloom.paths.collision import Exact
from pathloom.paths.deletion import delete_points
from pathloom.paths.problem import PathProblem
from pathloom.result import Result, Status

Which = Literal["unrefined", "refined"]
Verdict = Literal["dominated", "on the front", "beats the front", "beside the front"]


@dataclass(frozen=True)
class Placement:
    """One path beside a front."""

    which: Which
    """As the search found it, or after the planner's refinement."""
    cells: bool
    """Whether each step goes to one of the 8 neighbours. If not, it met the front's members after the same
    deletion of points too."""
    values: tuple[float, ...]
    verdict: Verdict
    """``dominated`` by a member; equal to one (``on the front``); better than one
    (``beats the front``); or neither (``beside the front``: it would be one more trade-off)."""
    dominated_by: tuple[int, ...] = ()
    """The members that are nowhere worse and somewhere better, by their place on the front."""
    dominates: tuple[int, ...] = ()
    """The members that it dominates itself."""
    epsilon: float | None = None
    """By how much the front must improve in every objective to be nowhere worse than this path:
    the additive ε. Negative where it is better everywhere by that much; ``None`` beside an infinite value."""
    excess: tuple[float, ...] = ()
    """How much worse the path is, objective by objective, than the member that dominates it most."""


@dataclass(frozen=True)
class Rival:
    """What another planner answered with one seed, beside a front."""

    planner: str
    seed: int
    status: Status
    placements: tuple[Placement, ...] = ()
    """Of the path before refinement, where the planner has one, and of its answer."""

    def verdict(self, which: Which) -> Verdict | None:
        """Return the verdict on one of its paths, if there is one."""
        return next((p.verdict for p in self.placements if p.which == which), None)


def place(
    result: Result, problem: PathProblem, objectives: Terms, front: Floats, straightened: Floats | None = None
) -> Rival:
    """Place the paths of a result beside a front (n, m), n ≥ 1.

    Both the path before refinement and the answer are measured by the front's
    objectives, whatever the planner itself weighed. To be fair, a path with longer
    segments than single steps meets the members after `straightened` too, values
    (n, m) in the same order; a member stands for both its values.
    """
    found: list[tuple[Which, Path]] = []
    if result.path is not None:
        if result.unrefined is not None:
            found.append(("unrefined", result.unrefined))
        found.append(("refined", result.path))
    values = measured([path for _, path in found], problem, objectives)
    both = front if straightened is None else np.concatenate((front, straightened))
    placements = tuple(
        _placed(which, path, row, front if _of_cells(path) else both, len(front))
        for (which, path), row in zip(found, values, strict=True)
    )
    return Rival(result.planner, result.seed, result.status, placements)


def shortcut(paths: Sequence[Path], problem: PathProblem, objectives: Terms) -> Floats:
    """Return the values (n, m) of paths after the deletion of points whose neighbours see each other."""
    population = delete_points(problem.representation.encode(list(paths)), problem, Exact(), 0, True)
    return measure(list(objectives.objectives()), population, problem) + 0.0  # no -0.0


def _of_cells(path: Path) -> bool:
    return len(path) < 2 or bool((np.abs(np.diff(path, axis=0)).max(axis=1) <= 1).all())


def _placed(which: Which, path: Path, values: Floats, front: Floats, members: int) -> Placement:
    """Place one path; the row of a member is its place in the front modulo ``members``."""
    above, below = dominating(front, values), dominated(front, values)
    same = (np.abs(front - values) <= SAME).all(axis=1)
    verdict: Verdict = (
        "dominated" if len(above) else "on the front" if same.any() else "beats the front" if len(below)
        else "beside the front"
    )  # fmt: skip
    excess: tuple[float, ...] = ()
    if len(above):
        span = np.maximum(np.ptp(front, axis=0), SAME)
        most = above[np.argmax(((values - front[above]) / span).sum(axis=1))]
        excess = tuple((values - front[most]).tolist())
    return Placement(
        which,
        _of_cells(path),
        tuple(values.tolist()),
        verdict,
        tuple(np.unique(above % members).tolist()),
        tuple(np.unique(below % members).tolist()),
        additive_epsilon(front, values[np.newaxis]) if np.isfinite(values).all() else None,
        excess,
    )


def dominating(front: Floats, values: Floats) -> NDArray[np.intp]:
    """Return the members (n, m) that dominate a point (m,); what differs by rounding alone is equal."""
    nowhere_worse, better = np.all(front <= values + SAME, axis=1), np.any(front < values - SAME, axis=1)
    return np.flatnonzero(nowhere_worse & better)


def dominated(front: Floats, values: Floats) -> NDArray[np.intp]:
    """Return the members (n, m) that a point (m,) dominates."""
    nowhere_better, worse = np.all(front >= values - SAME, axis=1), np.any(front > values + SAME, axis=1)
    return np.flatnonzero(nowhere_better & worse)
