"""Figures of a study: who ranks where, how soon targets are reached, how gaps are spread, what a factor does.

They take plain numbers and names, and return matplotlib figures, as wide as a
column of a paper. Variants keep colour, dash and marker from figure to figure as
long as they come in the same order.
"""

import re
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pathloom.draw.colours import Theme, theme
from pathloom.draw.look import SMALL, STEPS, TEXT, TITLE, Floats, dress

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMN = 3.5
"""Width of a column, in inches."""
LETTER = 0.56 * SMALL / 72
"""Width of a letter of small text, roughly."""
SERIES = {
    False: ("#0072b2", "#d55e00", "#009e73", "#a34c7c", "#8a6d00", "#1a1a1a", "#3aa0d8", "#7a4a1e"),
    True: ("#56b4e9", "#f08a4b", "#2fc79a", "#dd8fb5", "#f0e442", "#ececec", "#8fb8ff", "#c9a27e"),
}
"""Colours of variants, after Okabe and Ito (2008), dark enough on white and light enough on black."""
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.6)), (0, (1.2, 1.2)), (0, (5, 1.5, 1.2, 1.5)), (0, (8, 2)))
MARKERS = "osD^vP*X"


@dataclass(frozen=True)
class Curve:
    """A line that may have a band."""

    x: ArrayLike
    y: ArrayLike
    low: ArrayLike | None = None
    high: ArrayLike | None = None


@dataclass(frozen=True)
class Effect:
    """What one factor does: the mean response at each of its levels."""

    factor: str
    levels: Sequence[str]
    means: ArrayLike
    errors: ArrayLike | None = None
    """Standard errors."""


def critical_difference_figure(
    ranks: Mapping[str, float],
    groups: Sequence[Sequence[str]] = (),
    *,
    critical: float | None = None,
    title: str = "",
    caption: str = "",
    width: float = COLUMN,
    dark: bool = False,
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
    colours = theme(dark=dark)
    ordered = sorted(ranks, key=ranks.__getitem__)
    names = [_folded(name, 0.42 * width) for name in ordered]
    lines = np.array([1 + name.count("\n") for name in names])
    figure, axes = _blank(width, 0.75 + 0.1 * len(names) + 0.15 * lines.sum(), title, caption, colours)
    _plain(axes, colours)
    axes.grid(visible=False, axis="y")
    axes.spines["left"].set_visible(False)
    last = float(max(len(ordered), 2))
    for row, name in enumerate(ordered):
        axes.plot([1, ranks[name]], [row, row], color=colours.faint, linewidth=1.2, zorder=1)
        look: dict[str, Any] = {"marker": _marker(list(ranks).index(name)), "markersize": 5.5, "clip_on": False}
        axes.plot([ranks[name]], [row], color=_colour(list(ranks).index(name), dark), zorder=4, **look)
        axes.annotate(
            f"{ranks[name]:.2f}", (ranks[name], row), xytext=(5, 0), textcoords="offset points", size=SMALL,
            color=colours.ink, va="center", zorder=5,
        )  # fmt: skip
    step = 0.055 * (last - 1.0)
    begin = last + 3.2 * step  # beyond the longest number
    for place, group in enumerate(groups):
        rows = [ordered.index(name) for name in group]
        x = begin + step * place
        axes.plot(
            [x, x], [min(rows) - 0.25, max(rows) + 0.25], color=colours.ink, linewidth=3.0, solid_capstyle="butt",
            clip_on=False,
        )  # fmt: skip
    if critical is not None:
        end = min(1.0 + critical, begin)
        axes.plot([1.0, end], [-0.85, -0.85], color=colours.ink, linewidth=1.2, marker="|", markersize=6)
        beside = end < 0.5 * (1.0 + last)
        axes.annotate(
            f"critical difference {critical:.2f}", (end if beside else 1.0, -0.85), xytext=(5, 0) if beside else (0, 5),
            textcoords="offset points", size=SMALL, color=colours.quiet, va="center" if beside else "bottom",
        )  # fmt: skip
    axes.set_yticks(range(len(names)), names, size=SMALL)
    _as_written(axes)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(len(names) - 0.4, -0.6 if critical is None else -1.6)
    axes.set_xlim(1.0 - 0.02 * (last - 1), begin + step * max(len(groups), 0) + 0.2 * step)
    axes.set_xticks(_ticks(1.0, last))
    axes.spines["bottom"].set_bounds(1.0, last)
    _label(axes, "average rank", "", colours)
    return _settled(figure)


def ecdf_figure(
    curves: Mapping[str, Curve],
    *,
    budget: float | None = None,
    x_label: str = "evaluations",
    y_label: str = "share of runs and targets",
    title: str = "",
    caption: str = "",
    width: float = COLUMN,
    dark: bool = False,
) -> "Figure":
    """Draw which share of runs and targets was reached after how many evaluations, in steps, on a logarithmic axis."""
    return _steps(curves, budget, x_label, y_label, (title, caption), width, dark=dark)


def profile_figure(
    curves: Mapping[str, Curve],
    *,
    most: float | None = None,
    x_label: str = "times the least cost",
    y_label: str = "share of instances",
    title: str = "",
    caption: str = "",
    width: float = COLUMN,
    dark: bool = False,
) -> "Figure":
    """Draw a performance profile: the share of instances on which a variant costs at most so many times the least."""
    return _steps(curves, most, x_label, y_label, (title, caption), width, dark=dark, first=1.0)


def bands_figure(
    curves: Mapping[str, Curve],
    *,
    x_label: str = "evaluations",
    y_label: str = "gap",
    percent: bool = False,
    logarithmic: bool = False,
    title: str = "",
    caption: str = "",
    width: float = COLUMN,
    dark: bool = False,
) -> "Figure":
    """Draw the best so far over evaluations: medians with bands of quantiles."""
    colours = theme(dark=dark)
    figure, axes = _blank(width, 2.2, title, caption, colours)
    _plain(axes, colours)
    axes.set_xscale("log")
    for place, curve in enumerate(curves.values()):
        x = np.asarray(curve.x, np.float64)
        if curve.low is not None and curve.high is not None:
            # An upper quantile that has no answer yet leaves the band open upwards.
            low, high = np.asarray(curve.low, np.float64), np.asarray(curve.high, np.float64)
            axes.fill_between(x, low, high, step="post", color=_colour(place, dark), alpha=0.2, linewidth=0)
        axes.plot(x, np.asarray(curve.y), drawstyle="steps-post", **_line(place, dark))
    if logarithmic:
        axes.set_yscale("log")
    if percent:
        _percent(axes.yaxis)
    _round_logarithms(axes, [curve.x for curve in curves.values()])
    _label(axes, x_label, y_label, colours)
    _legend(figure, list(curves), colours, dark=dark)
    return _settled(figure)


def spread_figure(
    samples: Mapping[str, ArrayLike],
    *,
    missing: Mapping[str, int] | None = None,
    x_label: str = "gap",
    percent: bool = False,
    title: str = "",
    caption: str = "",
    width: float = COLUMN,
    dark: bool = False,
) -> "Figure":
    """Draw every run as a dot, with a box of the quartiles, one row for each variant.

    Parameters
    ----------
    samples
        Values of each variant; nan is left out.
    missing
        How many runs of each have no value, written at the end of its row.
    """
    colours = theme(dark=dark)
    lost = missing or {}
    figure, axes = _blank(width, 0.55 + 0.42 * len(samples), title, caption, colours)
    _plain(axes, colours)
    axes.grid(visible=False, axis="y")
    rng = np.random.default_rng(0)  # the dots' places across mean nothing
    for place, sample in enumerate(samples.values()):
        values = np.asarray(sample, np.float64)
        values = values[np.isfinite(values)]
        if not len(values):
            continue
        colour = _colour(place, dark)
        shown = values if len(values) <= 2000 else np.sort(values)[np.linspace(0, len(values) - 1, 2000).astype(int)]
        axes.scatter(
            shown, place + rng.uniform(-0.22, 0.22, len(shown)), s=7, color=colour, alpha=_alpha(len(shown)),
            linewidths=0, zorder=2, rasterized=len(shown) > 500,
        )  # fmt: skip
        lower, median, upper = np.quantile(values, (0.25, 0.5, 0.75))
        box: dict[str, Any] = {"color": colours.ink, "linewidth": 1.1, "zorder": 3, "solid_joinstyle": "miter"}
        axes.plot([lower, upper, upper, lower, lower], place + np.array([-1, -1, 1, 1, -1]) * 0.3, **box)
        axes.plot([median, median], [place - 0.3, place + 0.3], **{**box, "linewidth": 2.2})
    names = [
        f"{_folded(name, 0.42 * width)}\n+ {lost[name]} missing" if lost.get(name) else _folded(name, 0.42 * width)
        for name in samples
    ]
    axes.set_yticks(range(len(samples)), names, size=SMALL)
    _as_written(axes)
    axes.set_ylim(len(samples) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    _ticks_on(axes.xaxis, 5)
    if percent:
        _percent(axes.xaxis)
    _label(axes, x_label, "", colours)
    return _settled(figure)


def main_effects_figure(
    effects: Sequence[Effect],
    *,
    mean: float | None = None,
    y_label: str = "response",
    title: str = "",
    caption: str = "",
    width: float | None = None,
    dark: bool = False,
) -> "Figure":
    """Draw the mean response at each level of each factor, with standard errors, on one common scale.

    Four factors stand in one row at most.
    """
    colours = theme(dark=dark)
    across = min(len(effects), 4)
    down = -(-len(effects) // across)
    wide = width or max(COLUMN, 0.75 + 1.35 * across)
    figure, rest = _blank(wide, 0.35 + 1.75 * down, title, caption, colours)
    rest.remove()
    grid = figure.subplots(down, across, squeeze=False, sharey=True)
    for place, effect in enumerate(effects):
        axes = grid.flat[place]
        _plain(axes, colours)
        at, means = np.arange(len(effect.levels)), np.asarray(effect.means, np.float64)
        if mean is not None:
            axes.axhline(mean, color=colours.quiet, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
        errors = None if effect.errors is None else np.asarray(effect.errors, np.float64)
        axes.errorbar(
            at, means, yerr=errors if errors is not None and np.isfinite(errors).all() else None,
            color=_colour(0, dark), marker="o", markersize=4.5, linewidth=1.4, elinewidth=1.0, capsize=2.5, zorder=3,
        )  # fmt: skip
        axes.set_xticks(at, effect.levels, size=SMALL)
        axes.set_xlim(-0.4, len(at) - 0.6)
        axes.set_xlabel(_folded(effect.factor, wide / across - 0.3), size=SMALL, parse_math=False)
        axes.set_label(effect.factor)
        _ticks_on(axes.yaxis, 5)
        if place % across == 0:
            axes.set_ylabel(y_label, size=TEXT, color=colours.ink)
    for axes in list(grid.flat)[len(effects) :]:
        axes.set_visible(False)
    return _settled(figure)


def _steps(
    curves: Mapping[str, Curve],
    end: float | None,
    x_label: str,
    y_label: str,
    heading: tuple[str, str],
    width: float,
    *,
    dark: bool,
    first: float | None = None,
) -> "Figure":
    """Draw shares that rise in steps, each up to the end that all share."""
    colours = theme(dark=dark)
    figure, axes = _blank(width, 2.2, *heading, colours)
    _plain(axes, colours)
    axes.set_xscale("log")
    places = [np.asarray(curve.x, np.float64) for curve in curves.values()]
    every = np.concatenate([*places, np.ones(0)])
    last = end if end is not None else float(every.max(initial=1.0)) * 1.05
    begin = first if first is not None else max(float(every.min(initial=last)) / 1.3, 0.8)
    last = max(last, begin * 1.2)
    for place, (x, curve) in enumerate(zip(places, curves.values(), strict=True)):
        y = np.asarray(curve.y, np.float64)
        kept = x <= last
        level = y[kept][-1] if kept.any() else 0.0
        axes.plot(
            np.concatenate(([begin], x[kept], [last])), np.concatenate(([0.0], y[kept], [level])),
            drawstyle="steps-post", **_line(place, dark),
        )  # fmt: skip
    axes.set_xlim(begin, last)
    axes.set_ylim(-0.02, 1.02)
    _percent(axes.yaxis)
    _round_logarithms(axes, [[begin, last]])
    _label(axes, x_label, y_label, colours)
    _legend(figure, list(curves), colours, dark=dark)
    return _settled(figure)


def _blank(width: float, body: float, title: str, caption: str, colours: Theme) -> "tuple[Figure, Axes]":
    """Return a figure with a heading, and axes in the room below it that lay themselves out."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    heads = [
        (line, size, weight, colour)
        for text, size, weight, colour in (
            (title, TITLE, "bold", colours.ink),
            (caption, SMALL, "normal", colours.quiet),
        )
        if text.strip()
        for line in textwrap.wrap(text, max(16, int((width - 0.2) * 72 / (0.56 * size))))
    ]
    head = sum(size * 1.35 / 72 for _, size, _, _ in heads) + (0.08 if heads else 0.0)
    figure = Figure((width, body + head), dpi=150, facecolor=colours.ground)
    FigureCanvasAgg(figure)
    figure.set_layout_engine("constrained", w_pad=0.05, h_pad=0.05, rect=(0, 0, 1, body / (body + head)))
    y = body + head - 0.04
    for line, size, weight, colour in heads:
        y -= size * 1.35 / 72
        figure.text(
            0.08 / width, (y + size * 0.3 / 72) / (body + head), line, size=size, weight=weight, color=colour,
            va="baseline", ha="left", parse_math=False,
        )  # fmt: skip
    return figure, figure.add_subplot()


def _plain(axes: "Axes", colours: Theme) -> None:
    dress(axes, colours)
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(visible=True, color=colours.faint, linewidth=0.6)
    axes.set_axisbelow(True)


def _as_written(axes: "Axes") -> None:
    """Let a dollar in a variant's name be a dollar."""
    for text in axes.get_yticklabels():
        text.set_parse_math(False)


def _label(axes: "Axes", x: str, y: str, colours: Theme) -> None:
    axes.set_xlabel(x, size=TEXT, color=colours.ink)
    axes.set_ylabel(y, size=TEXT, color=colours.ink)


def _legend(figure: "Figure", names: Sequence[str], colours: Theme, *, dark: bool) -> None:
    """Put the names below the axes, in as many columns as fit, and make the figure so much taller."""
    from matplotlib.lines import Line2D

    if not names:
        return
    width, height = figure.get_size_inches()
    folded = [_folded(name, width - 0.7) for name in names]
    longest = max(len(line) for name in folded for line in name.splitlines())
    columns = max(1, min(len(names), int((width - 0.1) / (0.55 + longest * LETTER))))
    lines = -(-sum(1 + name.count("\n") for name in folded) // columns)
    below = lines * 1.4 * SMALL / 72 + 0.12
    figure.set_size_inches(width, height + below)
    for text in figure.texts:  # the heading keeps its distance from the upper edge
        text.set_y((text.get_position()[1] * height + below) / (height + below))
    _, _, _, top = figure.get_layout_engine().get()["rect"]  # type: ignore[union-attr]
    share = below / (height + below)
    figure.get_layout_engine().set(rect=(0, share, 1, top * (1 - share)))  # type: ignore[union-attr, call-arg]
    handles = [
        Line2D([], [], label=name, **{**_line(place, dark), "linewidth": 1.8}) for place, name in enumerate(folded)
    ]
    legend = figure.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(0.04 / width, 0), borderaxespad=0.3,
        ncols=columns, frameon=False, fontsize=SMALL,
        labelcolor=colours.ink, handlelength=2.1, handletextpad=0.5, columnspacing=1.2, labelspacing=0.35,
    )  # fmt: skip
    legend.set_in_layout(False)
    for text in legend.get_texts():
        text.set_parse_math(False)


def _folded(name: str, room: float) -> str:
    """Return a name in at most three lines of so many inches, broken where names have joints."""
    letters = max(8, int(room / LETTER))
    parts = re.findall(r"[^\s=/,+._-]*[\s=/,+._-]*", name)
    lines = [""]
    for part in parts:
        if lines[-1] and len(lines[-1]) + len(part.rstrip()) > letters:
            lines.append("")
        lines[-1] += part
    lines = [line.rstrip() for line in lines]
    if len(lines) > 3:
        lines = [*lines[:2], lines[2] + "…"]
    return "\n".join(line if len(line) <= letters + 2 else line[: letters + 1] + "…" for line in lines)


def _colour(place: int, dark: bool) -> str:
    palette = SERIES[dark]
    return palette[place % len(palette)]


def _marker(place: int) -> str:
    return MARKERS[place % len(MARKERS)]


def _line(place: int, dark: bool) -> dict[str, Any]:
    """Return how a variant's line looks: a colour, and a dash for eyes and printers that see none."""
    turn = place + place // len(SERIES[dark])
    return {"color": _colour(place, dark), "linestyle": DASHES[turn % len(DASHES)], "linewidth": 1.5}


def _alpha(count: int) -> float:
    return float(np.clip(12.0 / np.sqrt(max(count, 1)), 0.12, 0.7))


def _ticks(low: float, high: float) -> Floats:
    step = 1.0 if high - low <= 9 else float(np.ceil((high - low) / 8))
    return np.arange(low, high + 1e-9, step)


def _ticks_on(axis: Any, most: int) -> None:
    from matplotlib.ticker import MaxNLocator

    axis.set_major_locator(MaxNLocator(nbins=most, steps=STEPS))


def _percent(axis: Any) -> None:
    from matplotlib.ticker import FuncFormatter

    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{round(100.0 * value, 6) + 0.0:g} %".replace("-", "−")))


def _round_logarithms(axes: "Axes", every: Sequence[ArrayLike]) -> None:
    """Put few round numbers on a logarithmic axis: powers of ten, and 2 and 5 between where it is short."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    spent = np.concatenate([np.asarray(x, np.float64) for x in every]) if every else np.ones(1)
    spent = spent[np.isfinite(spent) & (spent > 0)]
    decades = float(np.log10(spent.max() / spent.min())) if len(spent) else 0.0
    subs = (1.0,) if decades > 2.5 else (1.0, 2.0, 5.0) if decades > 0.7 else (1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)
    axes.xaxis.set_major_locator(LogLocator(subs=subs))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: _number(value)))


def _number(value: float) -> str:
    if value >= 1e6:
        return f"{value / 1e6:g}M"
    return f"{value / 1e3:g}k" if value >= 1e4 else f"{value:g}"


def _settled(figure: "Figure") -> "Figure":
    """Lay the figure out once; what is drawn later changes nothing."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    return figure
