"""The figure of a run: map and path, and beside them how the fitness converged."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pathloom.draw.colours import theme
from pathloom.draw.convergence import Curves
from pathloom.draw.layout import lay_out
from pathloom.draw.look import Cell
from pathloom.draw.scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def path_figure(
    occupied: ArrayLike,
    *,
    closed: ArrayLike | None = None,
    start: Cell,
    goal: Cell,
    path: ArrayLike | None = None,
    unrefined: ArrayLike | None = None,
    curve: ArrayLike | None = None,
    optimum: ArrayLike | None = None,
    history: Mapping[str, Any] | None = None,
    title: str = "",
    caption: str = "",
    resolution: float | None = None,
    dark: bool = False,
) -> "Figure":
    """Draw a map with its path, and how the fitness converged.

    Parameters
    ----------
    occupied
        (rows, cols) bool, row 0 at the top.
    closed
        (rows, cols) bool, what is closed to the centre of a robot with a radius;
        free cells of it are drawn in a lighter tone.
    start, goal
        (row, column).
    path, unrefined, optimum
        (k, 2) cells: the path, the path before its refinement, an exact reference.
    curve
        (m, 2) points of a smooth curve along the path, in cells.
    history
        ``evaluations``, ``best``, ``generation_best``, ``mean`` and ``diversity``,
        one value for each generation; any of them may be missing. Drawn from two
        generations on.
    title, caption
        Above the map.
    resolution
        Metres for each cell; the axes are in metres then, else in cells.
    dark
        For dark ground.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    colours = theme(dark=dark)
    walls = np.asarray(occupied, bool)
    figure = Figure(figsize=(6, 6), dpi=150, facecolor=colours.ground)
    FigureCanvasAgg(figure)
    scene = Scene(walls, colours, resolution)

    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8), label="map")
    handles = scene.draw_map(axes, None if closed is None else np.asarray(closed, bool))
    handles += scene.draw_paths(axes, path, unrefined, curve, optimum)
    curves = Curves.read(history or {})
    panels: list[Axes] = []
    if curves is not None:
        panels.append(figure.add_axes((0.1, 0.5, 0.8, 0.4), label="fitness"))
        if curves.diversity is not None:
            panels.append(figure.add_axes((0.1, 0.1, 0.8, 0.2), label="diversity", sharex=panels[0]))
        curves.draw(panels, colours)
    lay_out(figure, scene, axes, panels, handles, (start, goal), title, caption)
    return figure
