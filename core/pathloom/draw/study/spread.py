"""Every run: dots, and a box of the quartiles."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pathloom.draw.look import Floats
from pathloom.draw.study.axes import few_ticks, in_percent, label, name_rows, plain
from pathloom.draw.study.legend import folded
from pathloom.draw.study.series import colour
from pathloom.draw.study.sheet import Sheet, settled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 2000
"""Dots in a row; of more runs, as many are drawn, evenly from the least to the largest."""


def spread_figure(
    samples: Mapping[str, ArrayLike],
    *,
    missing: Mapping[str, int] | None = None,
    x_label: str = "gap",
    percent: bool = False,
    sheet: Sheet = Sheet(),
) -> "Figure":
    """Draw every run as a dot, with a box of the quartiles, one row for each variant.

    Parameters
    ----------
    samples
        Values of each variant; nan is left out.
    missing
        How many runs of each have no value, written at the end of its row.
    """
    lost = missing or {}
    figure, axes = sheet.blank(0.55 + 0.42 * len(samples))
    plain(axes, sheet.colours)
    axes.grid(visible=False, axis="y")
    rng = np.random.default_rng(0)  # the dots' places across mean nothing
    for place, sample in enumerate(samples.values()):
        values = np.asarray(sample, np.float64)
        values = values[np.isfinite(values)]
        if len(values):
            _dots(axes, place, values, colour(place, dark=sheet.dark), rng)
            _box(axes, place, values, sheet.colours.ink)
    names = [folded(name, 0.42 * sheet.inches) for name in samples]
    notes = [f"\n+ {lost[name]} missing" if lost.get(name) else "" for name in samples]
    name_rows(axes, [name + note for name, note in zip(names, notes, strict=True)])
    axes.set_ylim(len(samples) - 0.5, -0.5)
    few_ticks(axes.xaxis)
    if percent:
        in_percent(axes.xaxis)
    label(axes, x_label, "", sheet.colours)
    return settled(figure)


def _dots(axes: "Axes", row: int, values: Floats, shade: str, rng: np.random.Generator) -> None:
    shown = values if len(values) <= MOST else np.sort(values)[np.linspace(0, len(values) - 1, MOST).astype(int)]
    alpha = float(np.clip(12.0 / np.sqrt(len(shown)), 0.12, 0.7))
    axes.scatter(
        shown, row + rng.uniform(-0.22, 0.22, len(shown)), s=7, color=shade, alpha=alpha, linewidths=0, zorder=2,
        rasterized=len(shown) > 500,
    )  # fmt: skip


def _box(axes: "Axes", row: int, values: Floats, ink: str) -> None:
    lower, median, upper = np.quantile(values, (0.25, 0.5, 0.75))
    box: dict[str, Any] = {"color": ink, "linewidth": 1.1, "zorder": 3, "solid_joinstyle": "miter"}
    axes.plot([lower, upper, upper, lower, lower], row + np.array([-1, -1, 1, 1, -1]) * 0.3, **box)
    axes.plot([median, median], [row - 0.3, row + 0.3], **{**box, "linewidth": 2.2})
