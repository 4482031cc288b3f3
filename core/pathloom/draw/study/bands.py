"""How the best so far improves: medians, with bands of quantiles."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from pathloom.draw.study.axes import in_percent, label, plain, round_logarithms
from pathloom.draw.study.legend import add_legend
from pathloom.draw.study.series import Curve, colour, line
from pathloom.draw.study.sheet import Sheet, settled

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def bands_figure(
    curves: Mapping[str, Curve],
    *,
    x_label: str = "evaluations",
    y_label: str = "gap",
    percent: bool = False,
    logarithmic: bool = False,
    sheet: Sheet = Sheet(),
) -> "Figure":
    """Draw the best so far over evaluations: medians with bands of quantiles."""
    figure, axes = sheet.blank(2.2)
    plain(axes, sheet.colours)
    axes.set_xscale("log")
    for place, curve in enumerate(curves.values()):
        x = np.asarray(curve.x, np.float64)
        if curve.low is not None and curve.high is not None:
            # An upper quantile that has no answer yet leaves the band open upwards.
            low, high = np.asarray(curve.low, np.float64), np.asarray(curve.high, np.float64)
            shade = colour(place, dark=sheet.dark)
            axes.fill_between(x, low, high, step="post", color=shade, alpha=0.2, linewidth=0)
        axes.plot(x, np.asarray(curve.y), drawstyle="steps-post", **line(place, dark=sheet.dark))
    if logarithmic:
        axes.set_yscale("log")
    if percent:
        in_percent(axes.yaxis)
    round_logarithms(axes, [curve.x for curve in curves.values()])
    label(axes, x_label, y_label, sheet.colours)
    add_legend(figure, list(curves), sheet)
    return settled(figure)
