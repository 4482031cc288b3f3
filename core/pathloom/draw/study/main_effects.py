"""What a factor does: the mean response at each of its levels."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pathloom.draw.look import SMALL, TEXT
from pathloom.draw.study.axes import few_ticks, plain
from pathloom.draw.study.legend import folded
from pathloom.draw.study.series import colour
from pathloom.draw.study.sheet import COLUMN, Sheet, settled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Effect:
    """What one factor does: the mean response at each of its levels."""

    factor: str
    levels: Sequence[str]
    means: ArrayLike
    errors: ArrayLike | None = None
    """Standard errors."""


def main_effects_figure(
    effects: Sequence[Effect], *, mean: float | None = None, y_label: str = "response", sheet: Sheet = Sheet()
) -> "Figure":
    """Draw the mean response at each level of each factor, with standard errors, on one common scale.

    Four factors stand in one row at most.
    """
    across = min(len(effects), 4)
    down = -(-len(effects) // across)
    sheet = replace(sheet, width=sheet.width or max(COLUMN, 0.75 + 1.35 * across))
    figure, rest = sheet.blank(0.35 + 1.75 * down)
    rest.remove()
    grid = figure.subplots(down, across, squeeze=False, sharey=True)
    for place, (axes, effect) in enumerate(zip(grid.flat, effects, strict=False)):
        plain(axes, sheet.colours)
        if mean is not None:
            axes.axhline(mean, color=sheet.colours.quiet, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
        _panel(axes, effect, colour(0, dark=sheet.dark), sheet.inches / across - 0.3)
        if place % across == 0:
            axes.set_ylabel(y_label, size=TEXT, color=sheet.colours.ink)
    for axes in grid.flat[len(effects) :]:
        axes.set_visible(False)
    return settled(figure)


def _panel(axes: "Axes", effect: Effect, shade: str, room: float) -> None:
    """Draw one factor; its name has so many inches of room."""
    at, means = np.arange(len(effect.levels)), np.asarray(effect.means, np.float64)
    errors = None if effect.errors is None else np.asarray(effect.errors, np.float64)
    axes.errorbar(
        at, means, yerr=errors if errors is not None and np.isfinite(errors).all() else None, color=shade, marker="o",
        markersize=4.5, linewidth=1.4, elinewidth=1.0, capsize=2.5, zorder=3,
    )  # fmt: skip
    axes.set_xticks(at, effect.levels, size=SMALL)
    axes.set_xlim(-0.4, len(at) - 0.6)
    axes.set_xlabel(folded(effect.factor, room), size=SMALL, parse_math=False)
    axes.set_label(effect.factor)
    few_ticks(axes.yaxis)
