"""From a result to the figure of its front."""

from typing import TYPE_CHECKING, Any

import numpy as np

from pathloom.draw.front import PANELS, Ground, Look, front_figure, short
from pathloom.errors import PathloomError
from pathloom.fronts.result import ParetoResult
from pathloom.fronts.thinning import thinned
from pathloom.naming import closest

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PATHS = 10
"""Paths that are drawn on the map."""


def figure_of(result: ParetoResult, panels: Any = None, colour: str | None = None, *, dark: bool = False) -> "Figure":
    """Draw a front; see `ParetoResult.plot`."""
    if not result.found:
        raise PathloomError(f"no front to draw: {result.reason or result.status}")
    wanted = (PANELS if len(result.objectives) > 2 else PANELS[:2]) if panels is None else panels
    wanted = (wanted,) if isinstance(wanted, str) else tuple(wanted)
    for panel in wanted:
        if panel not in PANELS:
            raise PathloomError(f"panels: found {panel!r}, allowed {', '.join(PANELS)}; {closest(panel, PANELS)}")
    if not wanted:
        raise PathloomError(f"panels: found none, allowed {', '.join(PANELS)}")
    if colour is not None and colour not in result.objectives:
        hint = closest(colour, result.objectives)
        raise PathloomError(f"colour: no objective of this front is {colour!r}; {hint}")
    if "paths" in wanted and result.path_problem is None:
        raise PathloomError("this result does not hold its map: it was read from JSON")
    choice = result.choice
    shown = thinned(result, PATHS)
    look = Look(
        values=result.values,
        labels=result.objectives,
        colour=0 if colour is None else result.objectives.index(colour),
        knee=choice.knee if choice else None,
        preferred=choice.preferred if choice else None,
        exact=result.exact,
        rivals=_rivals(result),
        paths=result.paths,
        shown=shown,
    )
    return front_figure(
        look,
        _ground(result) if "paths" in wanted else None,
        panels=wanted,
        title=f"{result.planner} on {result.map_title}",
        caption=_caption(result, len(shown) if "paths" in wanted else len(result)),
        dark=dark,
    )


def _ground(result: ParetoResult) -> Ground | None:
    problem = result.path_problem
    if problem is None:
        return None
    return Ground(
        problem.grid.occupied,
        *problem.ends,
        closed=problem.context.occupied if problem.radius else None,
        resolution=problem.grid.resolution if problem.grid.metric else None,
    )


def _rivals(result: ParetoResult) -> list[tuple[str, Any]]:
    """Return the values of other planners' answers."""
    found: dict[str, list[tuple[float, ...]]] = {}
    for rival in result.against:
        found.setdefault(rival.planner, []).extend(p.values for p in rival.placements if p.which == "refined")
    return [(name, np.array(rows)) for name, rows in found.items() if rows]


def _caption(result: ParetoResult, shown: int) -> str:
    parts = [f"{len(result)} trade-off{'s' * (len(result) != 1)}"]
    if shown < len(result):
        parts[0] += f", {shown} of them on the map"
    ratio = result.indicators.get("hypervolume_ratio")
    if ratio is not None:
        parts.append(f"{100 * ratio:.2f} % of the exact front's hypervolume")
    if result.choice is not None:
        values = zip(result.objectives, result.values[result.choice.knee].tolist(), strict=True)
        parts.append("knee at " + ", ".join(f"{label} {short(value)}" for label, value in values))
    return "; ".join([*parts, f"seed {result.seed}"])
