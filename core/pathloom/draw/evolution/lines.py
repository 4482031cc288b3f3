"""Medians with bands of quantiles over generations."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pathloom.draw.look import STEPS, Floats
from pathloom.draw.study.axes import few_ticks, label, plain
from pathloom.draw.study.legend import add_legend
from pathloom.draw.study.series import Curve, colour, line
from pathloom.draw.study.sheet import Sheet, settled
from pathloom.errors import PathloomError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

QUANTILES = (0.1, 0.5, 0.9)


def band(rows: Sequence[ArrayLike]) -> Curve:
    """Return, for each generation, the median and the band from the 10th to the 90th percentile.

    Parameters
    ----------
    rows
        One list of numbers for each run; a run that ended early stands at its last number.
    """
    last = max(len(np.atleast_1d(row)) for row in rows)
    every = np.array([np.pad(np.asarray(row, np.float64), (0, last - len(np.atleast_1d(row))), "edge") for row in rows])
    low, middle, high = np.quantile(every, QUANTILES, axis=0)
    return Curve(np.arange(last), middle, low, high)


def generations_figure(curves: Mapping[str, Curve], y_label: str, *, share: bool, sheet: Sheet) -> "Figure":
    """Draw medians and bands over generations; ``share`` makes the axis go from 0 to 1."""
    from matplotlib.ticker import MaxNLocator

    figure, axes = sheet.blank(2.2)
    plain(axes, sheet.colours)
    for place, curve in enumerate(curves.values()):
        x: Floats = np.asarray(curve.x, np.float64)
        if curve.low is not None and curve.high is not None:
            shade = colour(place, dark=sheet.dark)
            low, high = np.asarray(curve.low, np.float64), np.asarray(curve.high, np.float64)
            axes.fill_between(x, low, high, color=shade, alpha=0.2, linewidth=0)
        axes.plot(x, np.asarray(curve.y), **line(place, dark=sheet.dark))
    axes.margins(x=0.02)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True, steps=STEPS))
    few_ticks(axes.yaxis)
    if share:
        axes.set_ylim(-0.03, 1.03)
    label(axes, "generation", y_label, sheet.colours)
    add_legend(figure, list(curves), sheet)
    return settled(figure)


def columns(runs: Mapping[str, Sequence[object]], name: str) -> dict[str, Curve]:
    """Return the band of one column of the histories of runs, by what they are called.

    Raises
    ------
    PathloomError
        If there are no runs, or one has no such column.
    """
    curves = {}
    for title, histories in runs.items():
        rows = [one.get(name, ()) if isinstance(one, Mapping) else getattr(one, name, ()) for one in histories]
        if not rows or any(len(row) == 0 for row in rows):
            raise PathloomError(f"{title}: found a run without {name!r}, allowed histories of one generation or more")
        curves[title] = band([[np.nan if v is None else v for v in row] for row in rows])
    if not curves:
        raise PathloomError("found no runs to draw, allowed one or more")
    return curves
