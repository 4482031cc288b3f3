"""The names of variants: folded where they are long, and in a legend below the axes."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from pathloom.draw.look import SMALL
from pathloom.draw.study.series import line
from pathloom.draw.study.sheet import Sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LETTER = 0.56 * SMALL / 72
"""Width of a letter of small text, roughly, in inches."""


def folded(name: str, room: float) -> str:
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


def add_legend(figure: "Figure", names: Sequence[str], sheet: Sheet) -> None:
    """Put the names below the axes, in as many columns as fit, and make the figure so much taller."""
    from matplotlib.lines import Line2D

    if not names:
        return
    width, height = figure.get_size_inches()
    shown = [folded(name, width - 0.7) for name in names]
    longest = max(len(line) for name in shown for line in name.splitlines())
    columns = max(1, min(len(names), int((width - 0.1) / (0.55 + longest * LETTER))))
    lines = -(-sum(1 + name.count("\n") for name in shown) // columns)
    below = lines * 1.4 * SMALL / 72 + 0.12
    figure.set_size_inches(width, height + below)
    for text in figure.texts:  # the heading keeps its distance from the upper edge
        text.set_y((text.get_position()[1] * height + below) / (height + below))
    _, _, _, top = figure.get_layout_engine().get()["rect"]  # type: ignore[union-attr]
    share = below / (height + below)
    figure.get_layout_engine().set(rect=(0, share, 1, top * (1 - share)))  # type: ignore[union-attr, call-arg]
    handles = [
        Line2D([], [], label=name, **{**line(place, dark=sheet.dark), "linewidth": 1.8})
        for place, name in enumerate(shown)
    ]
    legend = figure.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(0.04 / width, 0), borderaxespad=0.3,
        ncols=columns, frameon=False, fontsize=SMALL,
        labelcolor=sheet.colours.ink, handlelength=2.1, handletextpad=0.5, columnspacing=1.2, labelspacing=0.35,
    )  # fmt: skip
    legend.set_in_layout(False)
    for text in legend.get_texts():
        text.set_parse_math(False)
