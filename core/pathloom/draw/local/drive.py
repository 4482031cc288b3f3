"""Drives on their map: the planned path, the ways that were taken, and what was in the way."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.draw.colours import theme
from pathloom.draw.look import SMALL, TITLE
from pathloom.draw.scene import Scene
from pathloom.draw.study.series import colour, line

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIGNS = {"reached": "o", "collided": "X", "late": "s"}
"""What marks the end of a drive."""


class Moment(NamedTuple):
    """The robot and what is around it, in metres from the lower-left corner."""

    x: float
    y: float
    heading: float
    discs: NDArray[np.float64]
    """(m, 3) x, y and radius."""
    decided: bool = False
    """Whether a policy decided."""


def drive_figure(
    drives: Mapping[str, Sequence[Moment]],
    ends: Mapping[str, str],
    *,
    occupied: ArrayLike,
    path: ArrayLike,
    cell: float,
    radius: float,
    standing: int,
    title: str = "",
    dark: bool = False,
) -> "Figure":
    """Draw the ways of several drivers through the same obstacles.

    Parameters
    ----------
    drives
        By name, moment by moment.
    ends
        How each ended: ``reached``, ``collided`` or ``late``.
    occupied
        (rows, cols) bool.
    path
        (k, 2) cells.
    cell
        Metres of a cell's side.
    radius
        Of the robot, in metres; it is drawn where a drive ended.
    standing
        How many of the discs stand, the first ones; those that walk are drawn hollow, where they were at the start.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle

    colours = theme(dark=dark)
    walls = np.asarray(occupied, bool)
    scene = Scene(walls, colours, cell)
    high = 6.0 / max(scene.aspect, 0.6)
    figure = Figure((6.4, high + 1.0), dpi=150, facecolor=colours.ground)
    FigureCanvasAgg(figure)
    figure.set_layout_engine("constrained")
    axes = figure.add_subplot(label="map")
    handles = scene.draw_map(axes, None)
    axes.set_aspect("equal")
    (route,) = axes.plot(
        *scene.place(path), color=colours.quiet, linewidth=4, alpha=0.45, solid_capstyle="round", label="path", zorder=2
    )
    handles.append(route)
    first = next(iter(drives.values()))
    full: dict[str, Any] = {"facecolor": colours.optimum, "edgecolor": colours.ink, "linewidth": 0.6}
    hollow: dict[str, Any] = {"facecolor": "none", "edgecolor": colours.optimum, "linewidth": 1.6}
    for discs, look, what in (
        (first[0].discs[:standing], full, "stands, not on the map"),
        (first[0].discs[standing:], hollow, "walks, where it was first"),
    ):
        for x, y, size in discs:
            axes.add_patch(Circle((x, y), size, zorder=3, **look))
        if len(discs):
            face, edge, width = look.values()
            mark = {"markerfacecolor": face, "markeredgecolor": edge, "markeredgewidth": width}
            handles.append(Line2D([], [], marker="o", linestyle="", label=what, **mark))
    for place, (name, moments) in enumerate(drives.items()):
        x, y = np.array([moment[:2] for moment in moments]).T
        look = line(place, dark=dark)
        axes.plot(x, y, zorder=4, **look)
        shade = colour(place, dark=dark)
        axes.add_patch(Circle((x[-1], y[-1]), radius, facecolor="none", edgecolor=shade, linewidth=1.4, zorder=5))
        sign = SIGNS[ends[name]]
        axes.plot(x[-1:], y[-1:], sign, color=shade, markersize=5, zorder=6)
        handles.append(Line2D([], [], marker=sign, markersize=5, label=f"{name}: {ends[name]}", **look))
    if title:
        figure.suptitle(title, size=TITLE, weight="bold", color=colours.ink, parse_math=False)
    legend = figure.legend(
        handles=handles, loc="outside lower center", ncols=2, frameon=False, fontsize=SMALL, labelcolor=colours.ink,
    )  # fmt: skip
    for text in legend.get_texts():
        text.set_parse_math(False)
    return figure
