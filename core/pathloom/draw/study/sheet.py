"""The sheet that a figure is drawn on: its heading, its width, its ground."""

import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pathloom.draw.colours import Theme, theme
from pathloom.draw.look import SMALL, TITLE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMN = 3.5
"""Width of a column, in inches."""


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """What every figure may be told beside what it shows."""

    title: str = ""
    caption: str = ""
    """Below the title, in small letters."""
    width: float | None = None
    """In inches; else a column, or wider where a figure has many panels."""
    dark: bool = False

    @property
    def inches(self) -> float:
        """The width, in inches."""
        return self.width or COLUMN

    @property
    def colours(self) -> Theme:
        """The theme."""
        return theme(dark=self.dark)

    def blank(self, body: float) -> "tuple[Figure, Axes]":
        """Return a figure with the heading, and axes in the ``body`` inches below it that lay themselves out."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        width, heads = self.inches, self._heads()
        head = sum(size * 1.35 / 72 for _, size, _, _ in heads) + (0.08 if heads else 0.0)
        figure = Figure((width, body + head), dpi=150, facecolor=self.colours.ground)
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

    def _heads(self) -> list[tuple[str, float, str, str]]:
        """Return the lines of the heading, each with its size, weight and colour."""
        texts = ((self.title, TITLE, "bold", self.colours.ink), (self.caption, SMALL, "normal", self.colours.quiet))
        return [
            (line, size, weight, colour)
            for text, size, weight, colour in texts
            for line in textwrap.wrap(text, max(16, int((self.inches - 0.2) * 72 / (0.56 * size))))
        ]


def settled(figure: "Figure") -> "Figure":
    """Lay the figure out once; what is drawn later changes nothing."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    return figure
