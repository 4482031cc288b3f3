"""Confusion matrices side by side, and below them how accuracy grows with the number of examples."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pathloom.draw.colours import theme
from pathloom.draw.look import SMALL, TEXT, TITLE, dress
from pathloom.draw.study.axes import in_percent, label, plain
from pathloom.draw.study.series import colour, line, marker

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ACTIONS = ("forward", "slight right", "sharp right", "slight left")
ABREAST = 3
"""Matrices side by side."""
SIDE, CURVES = 2.35, 2.4
"""Inches of a matrix with its labels, and of the learning curves."""


def confusion_figure(
    confusions: Mapping[str, Sequence[Sequence[int]]],
    *,
    curves: Mapping[str, Sequence[tuple[int, float]]] | None = None,
    title: str = "",
    dark: bool = False,
) -> "Figure":
    """Draw confusion matrices, (4, 4) counts each, real actions by row; and learning curves where there are any.

    Shades are shares of a row, so that rare actions are seen as well as frequent ones.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    colours = theme(dark=dark)
    across = min(ABREAST, len(confusions))
    rows = -(-len(confusions) // across)
    # a lone matrix has no neighbour whose labels it could share
    size = (SIDE * max(across, 2 if curves else 1) + 0.9, SIDE * rows + (CURVES if curves else 0.0) + 0.5)
    figure = Figure(size, dpi=150, facecolor=colours.ground)
    FigureCanvasAgg(figure)
    figure.set_layout_engine("constrained", w_pad=0.06, h_pad=0.06)
    if title:
        figure.suptitle(title, size=TITLE, weight="bold", color=colours.ink, parse_math=False)
    heights = [SIDE] * rows + ([CURVES] if curves else [])
    grid = figure.add_gridspec(len(heights), across, height_ratios=heights)
    for place, (name, counts) in enumerate(confusions.items()):
        row, col = divmod(place, across)
        _matrix(
            figure.add_subplot(grid[row, col]), name, np.asarray(counts), colours, left=col == 0, below=row == rows - 1
        )
    if curves:
        axes = figure.add_subplot(grid[rows, :])
        plain(axes, colours)
        for place, (name, points) in enumerate(curves.items()):
            x, y = np.array(points, np.float64).reshape(-1, 2).T
            look = line(place, dark=dark)
            axes.plot(
                x, y, marker=marker(place), markersize=4, markerfacecolor=colour(place, dark=dark), label=name, **look
            )
        axes.set_xscale("log")
        ticks = sorted({int(n) for points in curves.values() for n, _ in points})
        axes.set_xticks(ticks, [str(n) for n in ticks], size=SMALL)
        axes.minorticks_off()
        in_percent(axes.yaxis)
        label(axes, "examples learned from", "accuracy on others", colours)
        legend = axes.legend(
            frameon=False, fontsize=SMALL, labelcolor=colours.ink, loc="center left", bbox_to_anchor=(1.0, 0.5)
        )
        for text in legend.get_texts():
            text.set_parse_math(False)
    return figure


def _matrix(axes: Any, name: str, counts: Any, colours: Any, *, left: bool, below: bool) -> None:
    from matplotlib.colors import LinearSegmentedColormap

    shares = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    shades = LinearSegmentedColormap.from_list("shares", [colours.free, colours.path])
    axes.imshow(shares, cmap=shades, vmin=0.0, vmax=1.0, interpolation="nearest")
    dress(axes, colours)
    axes.set_title(name, size=TEXT, color=colours.ink, parse_math=False)
    axes.set_xticks(
        range(len(ACTIONS)), ACTIONS if below else [""] * len(ACTIONS),
        size=SMALL, rotation=40, ha="right", rotation_mode="anchor",
    )  # fmt: skip
    axes.set_yticks(range(len(ACTIONS)), ACTIONS if left else [""] * len(ACTIONS), size=SMALL)
    axes.tick_params(length=0)
    if left:
        axes.set_ylabel("real", size=TEXT, color=colours.ink)
    if below:
        axes.set_xlabel("predicted", size=TEXT, color=colours.ink)
    strong = colours.ground if colours.ground < "#800000" else "#ffffff"
    for row, col in np.ndindex(counts.shape):
        ink = strong if shares[row, col] > 0.5 else colours.ink if counts[row, col] else colours.quiet
        axes.text(col, row, f"{counts[row, col]}", ha="center", va="center", size=SMALL, color=ink)
