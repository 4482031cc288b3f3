"""Shares that rise in steps: targets reached by so many evaluations, and performance profiles."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from pathloom.draw.study.axes import in_percent, label, plain, round_logarithms
from pathloom.draw.study.legend import add_legend
from pathloom.draw.study.series import Curve, line
from pathloom.draw.study.sheet import Sheet, settled

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def ecdf_figure(
    curves: Mapping[str, Curve],
    *,
    begin: float | None = None,
    budget: float | None = None,
    x_label: str = "evaluations",
    y_label: str = "share of runs and targets",
    sheet: Sheet = Sheet(),
) -> "Figure":
    """Draw which share of runs and targets was reached after how many evaluations, in steps, on a logarithmic axis.

    The axis goes from ``begin`` to ``budget``, or as far as the steps do.
    """
    figure, axes = sheet.blank(2.2)
    plain(axes, sheet.colours)
    axes.set_xscale("log")
    places = [np.asarray(curve.x, np.float64) for curve in curves.values()]
    every = np.concatenate([*places, np.ones(0)])
    last = budget if budget is not None else float(every.max(initial=1.0)) * 1.05
    first = begin if begin is not None else max(float(every.min(initial=last)) / 1.3, 0.8)
    last = max(last, first * 1.2)
    for place, (x, curve) in enumerate(zip(places, curves.values(), strict=True)):
        y = np.asarray(curve.y, np.float64)
        kept = x <= last
        level = y[kept][-1] if kept.any() else 0.0
        axes.plot(
            np.concatenate(([first], x[kept], [last])), np.concatenate(([0.0], y[kept], [level])),
            drawstyle="steps-post", **line(place, dark=sheet.dark),
        )  # fmt: skip
    axes.set_xlim(first, last)
    axes.set_ylim(-0.02, 1.02)
    in_percent(axes.yaxis)
    round_logarithms(axes, [[first, last]])
    label(axes, x_label, y_label, sheet.colours)
    add_legend(figure, list(curves), sheet)
    return settled(figure)


def profile_figure(
    curves: Mapping[str, Curve], *, y_label: str = "share of instances", sheet: Sheet = Sheet()
) -> "Figure":
    """Draw a performance profile: the share of instances on which a variant costs at most so many times the least."""
    return ecdf_figure(curves, begin=1.0, x_label="times the least cost", y_label=y_label, sheet=sheet)
