"""What the parts of a figure have in common: sizes of text, steps between ticks, the dress of axes."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pathloom.draw.colours import Theme

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]
Cell = tuple[int, int]

TITLE, TEXT, SMALL = 11.0, 9.5, 8.5
"""Sizes of text, in points."""
STEPS = (1, 2, 5, 10)
"""Round steps between ticks."""


def dress(axes: "Axes", colours: Theme) -> None:
    """Give axes the ground, the ink and the thin frame of the theme."""
    axes.set_facecolor(colours.ground)
    axes.tick_params(labelsize=SMALL, colors=colours.ink, length=3, width=0.7)
    for spine in axes.spines.values():
        spine.set_color(colours.quiet)
        spine.set_linewidth(0.7)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_color(colours.ink)
