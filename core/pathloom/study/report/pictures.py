"""Maps with paths, as SVG within a page."""

from html import escape

import numpy as np
from markupsafe import Markup
from numpy.typing import ArrayLike

from pathloom.grid.svg import walls
from pathloom.paths.problem import PathProblem


def picture(problem: PathProblem, path: ArrayLike | None, optimum: ArrayLike | None, label: str) -> Markup:
    """Return a map with its start and goal, a path, and the shortest one dotted above it."""
    occupied = problem.grid.occupied
    rows, cols = occupied.shape
    size = max(rows, cols)
    parts = [f'<rect class="free" width="{cols}" height="{rows}"/>', walls(occupied)]
    if path is not None:
        parts.append(f'<path class="halo" d="{_line(path)}"/><path class="path" d="{_line(path)}"/>')
    if optimum is not None:
        parts.append(f'<path class="optimum" d="{_line(optimum)}"/>')
    dot = size / 28 if size > 28 else 1.0
    for (row, col), kind in zip(problem.ends, ("start", "goal"), strict=True):
        parts.append(f'<circle class="{kind}" cx="{col + 0.5:g}" cy="{row + 0.5:g}" r="{0.42 * dot:.3g}"/>')
    edge = 0.5 * dot
    return Markup(  # noqa: S704 - numbers, and one label that is escaped
        f'<svg class="map" viewBox="{-edge:.3g} {-edge:.3g} {cols + 2 * edge:.4g} {rows + 2 * edge:.4g}" role="img" '
        f'aria-label="{escape(label)}">{"".join(parts)}</svg>'
    )


def _line(cells: ArrayLike) -> str:
    points = np.asarray(cells, np.int64).reshape(-1, 2).tolist()
    if len(points) == 1:
        points *= 2
    return "M" + "L".join(f"{col + 0.5:g} {row + 0.5:g}" for row, col in points)
