"""Axes that all figures of a study share: their dress, their labels, and few round ticks."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pathloom.draw.colours import Theme
from pathloom.draw.look import SMALL, STEPS, TEXT, Floats, dress

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plain(axes: "Axes", colours: Theme) -> None:
    """Leave a grid and two spines."""
    dress(axes, colours)
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(visible=True, color=colours.faint, linewidth=0.6)
    axes.set_axisbelow(True)


def name_rows(axes: "Axes", names: Sequence[str]) -> None:
    """Write a name beside each row; a dollar in it is a dollar."""
    axes.set_yticks(range(len(names)), names, size=SMALL)
    for text in axes.get_yticklabels():
        text.set_parse_math(False)
    axes.tick_params(axis="y", length=0)


def label(axes: "Axes", x: str, y: str, colours: Theme) -> None:
    """Say what the axes show."""
    axes.set_xlabel(x, size=TEXT, color=colours.ink)
    axes.set_ylabel(y, size=TEXT, color=colours.ink)


def whole_numbers(low: float, high: float) -> Floats:
    """Return ticks a whole number apart, about nine at most."""
    step = 1.0 if high - low <= 9 else float(np.ceil((high - low) / 8))
    return np.arange(low, high + 1e-9, step)


def few_ticks(axis: Any, most: int = 5) -> None:
    """Put ticks at round steps."""
    from matplotlib.ticker import MaxNLocator

    axis.set_major_locator(MaxNLocator(nbins=most, steps=STEPS))


def in_percent(axis: Any) -> None:
    """Write shares as percent."""
    from matplotlib.ticker import FuncFormatter

    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{round(100.0 * value, 6) + 0.0:g} %".replace("-", "−")))


def round_logarithms(axes: "Axes", every: Sequence[ArrayLike]) -> None:
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
