"""Maps with paths, as SVG within a page."""

import base64
import io
from html import escape

import numpy as np
from markupsafe import Markup
from numpy.typing import ArrayLike, NDArray

from pathloom.paths.problem import PathProblem

MOST_BARS = 1500
"""Bars of obstacle cells beyond which the map becomes an image."""
WALL = (0x80, 0x86, 0x8E, 0xFF)
"""Grey that is told from light and from dark ground."""


def picture(problem: PathProblem, path: ArrayLike | None, optimum: ArrayLike | None, label: str) -> Markup:
    """Return a map with its start and goal, a path, and the shortest one dotted above it."""
    occupied = problem.grid.occupied
    rows, cols = occupied.shape
    size = max(rows, cols)
    parts = [f'<rect class="free" width="{cols}" height="{rows}"/>', _walls(occupied)]
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


def _walls(occupied: NDArray[np.bool_]) -> str:
    """Return obstacle cells: bars along rows, or an image where these would be too many."""
    edges = np.diff(np.pad(occupied, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    begins, ends = np.argwhere(edges == 1), np.argwhere(edges == -1)
    if len(begins) <= MOST_BARS:
        bars = (f"M{col} {row}h{end - col}v1h-{end - col}z"
                for (row, col), end in zip(begins.tolist(), ends[:, 1].tolist(), strict=True))  # fmt: skip
        return f'<path class="wall" d="{"".join(bars)}"/>'
    from PIL import Image

    pixels = np.zeros((*occupied.shape, 4), np.uint8)
    pixels[occupied] = WALL
    file = io.BytesIO()
    Image.fromarray(pixels).quantize(2).save(file, "png", optimize=True)
    rows, cols = occupied.shape
    data = base64.b64encode(file.getvalue()).decode("ascii")
    return f'<image class="walls" width="{cols}" height="{rows}" href="data:image/png;base64,{data}"/>'


def _line(cells: ArrayLike) -> str:
    points = np.asarray(cells, np.int64).reshape(-1, 2).tolist()
    if len(points) == 1:
        points *= 2
    return "M" + "L".join(f"{col + 0.5:g} {row + 0.5:g}" for row, col in points)
