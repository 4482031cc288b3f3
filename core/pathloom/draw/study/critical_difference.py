"""Who ranks where, and who cannot be told apart."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pathloom.draw.look import SMALL
from pathloom.draw.study.axes import label, name_rows, plain, whole_numbers
from pathloom.draw.study.legend import folded
from pathloom.draw.study.series import colour, marker
from pathloom.draw.study.sheet import Sheet, settled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def critical_difference_figure(
    ranks: Mapping[str, float],
    groups: Sequence[Sequence[str]] = (),
    *,
    critical: float | None = None,
    sheet: Sheet = Sheet(),
) -> "Figure":
    """Draw average ranks, one row for each variant, and bars beside variants that cannot be told apart.

    Source: J. Demšar (2006), J. Mach. Learn. Res. 7, 1, figure 1; there on one
    line, which has no room for the names of variants.

    Parameters
    ----------
    ranks
        Average rank of each variant; 1 is best.
    groups
        Variants that cannot be told apart, neighbours in rank.
    critical
        Nemenyi's critical difference, drawn to scale.
    """
    ordered = sorted(ranks, key=ranks.__getitem__)
    names = [folded(name, 0.42 * sheet.inches) for name in ordered]
    lines = np.array([1 + name.count("\n") for name in names])
    figure, axes = sheet.blank(0.75 + 0.1 * len(names) + 0.15 * lines.sum())
    plain(axes, sheet.colours)
    axes.grid(visible=False, axis="y")
    axes.spines["left"].set_visible(False)
    last = float(max(len(ordered), 2))
    for row, name in enumerate(ordered):
        _dot(axes, row, ranks[name], list(ranks).index(name), sheet)
    step = 0.055 * (last - 1.0)
    begin = last + 3.2 * step  # beyond the longest number
    for place, group in enumerate(groups):
        rows = [ordered.index(name) for name in group]
        x = begin + step * place
        axes.plot(
            [x, x], [min(rows) - 0.25, max(rows) + 0.25], color=sheet.colours.ink, linewidth=3.0,
            solid_capstyle="butt", clip_on=False,
        )  # fmt: skip
    if critical is not None:
        end = min(1.0 + critical, begin)
        _scale(axes, critical, end, sheet, beside=end < 0.5 * (1.0 + last))
    name_rows(axes, names)
    axes.set_ylim(len(names) - 0.4, -0.6 if critical is None else -1.6)
    axes.set_xlim(1.0 - 0.02 * (last - 1), begin + step * max(len(groups), 0) + 0.2 * step)
    axes.set_xticks(whole_numbers(1.0, last))
    axes.spines["bottom"].set_bounds(1.0, last)
    label(axes, "average rank", "", sheet.colours)
    return settled(figure)


def _dot(axes: "Axes", row: int, rank: float, place: int, sheet: Sheet) -> None:
    """Draw a variant's rank, and write it."""
    axes.plot([1, rank], [row, row], color=sheet.colours.faint, linewidth=1.2, zorder=1)
    look: dict[str, Any] = {"marker": marker(place), "markersize": 5.5, "clip_on": False}
    axes.plot([rank], [row], color=colour(place, dark=sheet.dark), zorder=4, **look)
    axes.annotate(
        f"{rank:.2f}", (rank, row), xytext=(5, 0), textcoords="offset points", size=SMALL, color=sheet.colours.ink,
        va="center", zorder=5,
    )  # fmt: skip


def _scale(axes: "Axes", critical: float, end: float, sheet: Sheet, *, beside: bool) -> None:
    """Draw the critical difference above the ranks, with its name beside or above it."""
    axes.plot([1.0, end], [-0.85, -0.85], color=sheet.colours.ink, linewidth=1.2, marker="|", markersize=6)
    axes.annotate(
        f"critical difference {critical:.2f}", (end if beside else 1.0, -0.85), xytext=(5, 0) if beside else (0, 5),
        textcoords="offset points", size=SMALL, color=sheet.colours.quiet, va="center" if beside else "bottom",
    )  # fmt: skip
