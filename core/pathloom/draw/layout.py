"""Layout of a figure: the map gets its room, what stands around it is measured, and the figure is fitted to that.

Lengths are in inches, sizes of text in points.
"""

import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pathloom.draw.colours import Theme
from pathloom.draw.look import SMALL, TEXT, TITLE, Cell
from pathloom.draw.scene import Scene

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend

PAD = 0.14
WIDE = 1.7
"""Ratio of width to height from which the convergence goes below the map."""
GAP = 0.14
"""Between the two panels of the convergence."""


def lay_out(
    figure: "Figure",
    scene: Scene,
    axes: "Axes",
    panels: "list[Axes]",
    handles: "list[Artist]",
    ends: tuple[Cell, Cell],
    title: str,
    caption: str,
) -> None:
    """Put the map, the panels of the convergence, legends, title and caption in their places."""
    measured = _measure(figure, scene, axes, panels, handles, ends)
    head = _Heading.wrapped(title, caption, scene.colours, measured.total - 2 * PAD)
    full = PAD + head.height + measured.body + PAD * 0.6
    figure.set_size_inches(measured.total, full)
    head.write(figure, full - PAD)
    _place(figure, axes, panels, measured, full - PAD - head.height - measured.top)


@dataclass(frozen=True)
class _Measured:
    """What was measured, and where that puts things."""

    width: float
    height: float
    """Of the map."""
    around: tuple[float, float, float, float]
    """How far ticks and labels of the map reach beyond it: left, right, bottom, top."""
    beside: bool
    """Whether the panels stand beside the map; else below it."""
    panel_width: float
    panel_height: float
    panel_heights: "list[float]"
    panel_around: tuple[float, float, float]
    """How far ticks, labels and legend of the panels reach beyond them: left, right, bottom."""
    legend: "Legend | None"
    legend_size: tuple[float, float]
    curve_legend: "Legend | None"
    curve_size: tuple[float, float]

    @property
    def column(self) -> float:
        """Width of the map with what stands around it, and of its legend."""
        return max(_column(self.around, self.width), self.legend_size[0])

    @property
    def total(self) -> float:
        """Width of the figure."""
        left, right, _ = self.panel_around
        return PAD + self.column + PAD + (0.1 + left + self.panel_width + right if self.beside else 0.0)

    @property
    def top(self) -> float:
        """Room above the map: beside panels, its upper edge is theirs."""
        return max(self.around[3], self.curve_size[1]) if self.beside else self.around[3]

    @property
    def below_map(self) -> float:
        """Room below the map, for ticks and legend."""
        return self.around[2] + 0.04 + self.legend_size[1]

    @property
    def body(self) -> float:
        """Height of all but the heading."""
        alone = self.top + self.height + self.below_map
        if self.beside:
            return max(alone, self.top + self.panel_height + self.panel_around[2])
        if not self.panel_heights:
            return alone
        return alone + 0.12 + self.curve_size[1] + self.panel_height + self.panel_around[2]


def _measure(
    figure: "Figure",
    scene: Scene,
    axes: "Axes",
    panels: "list[Axes]",
    handles: "list[Artist]",
    ends: tuple[Cell, Cell],
) -> _Measured:
    """Give the axes their sizes, on which ticks depend, and measure what then stands around them."""
    beside = bool(panels) and scene.aspect < WIDE
    width, height = _map_size(scene.aspect, beside=beside)
    panel_width, panel_height = (2.7, max(height, 2.7)) if beside else (width, 2.3)
    heights = _panel_heights(panel_height, len(panels))
    _resize(figure, axes, width, height)
    for panel, size in zip(panels, heights, strict=True):
        _resize(figure, panel, panel_width, size)
    scene.draw_ends(axes, ends, height * 72 / len(scene.walls))

    left, right, bottom, top = (max(it, 0.08) for it in _overhang(figure, axes))
    overhangs = [_overhang(figure, panel) for panel in panels]
    panel_left = max((it[0] for it in overhangs), default=0.0)
    panel_right = max((it[1] for it in overhangs), default=0.0)
    if panels and not beside:  # one below the other, with the same left edge
        left = panel_left = max(left, panel_left)
    around = (left, right, bottom, top)
    legend = _legend(figure, handles, scene.colours, _column(around, width))
    curve_legend = _legend(figure, _curve_handles(panels), scene.colours, panel_width + 0.3)
    curve_size = _size(figure, curve_legend)
    return _Measured(
        width,
        height,
        around,
        beside,
        panel_width,
        panel_height,
        heights,
        (panel_left, max(panel_right, curve_size[0] - 0.05 - panel_width), overhangs[-1][2] if overhangs else 0.0),
        legend,
        _size(figure, legend),
        curve_legend,
        curve_size,
    )


def _column(around: tuple[float, float, float, float], width: float) -> float:
    return max(around[0] + width + around[1], 2.3)


@dataclass(frozen=True)
class _Heading:
    """Title and caption, in lines."""

    blocks: "list[tuple[list[str], float, str, str]]"
    """Lines, size, weight and colour."""

    @classmethod
    def wrapped(cls, title: str, caption: str, colours: Theme, room: float) -> "_Heading":
        """Return the heading in lines no wider than the room."""
        texts = ((title, TITLE, "bold", colours.ink), (caption, TEXT, "normal", colours.quiet))
        return cls(
            [
                (textwrap.wrap(text, max(12, int(room * 72 / (0.58 * size)))), size, weight, colour)
                for text, size, weight, colour in texts
                if text.strip()
            ]
        )

    @property
    def height(self) -> float:
        """Height of all lines, with the space below."""
        lines = sum(len(lines) * size * 1.3 / 72 for lines, size, _, _ in self.blocks)
        return lines + (0.06 if self.blocks else 0.0)

    def write(self, figure: "Figure", y: float) -> None:
        """Write the lines from an upper edge down."""
        total, full = figure.get_size_inches()
        for lines, size, weight, colour in self.blocks:
            for line in lines:
                y -= size * 1.3 / 72
                figure.text(
                    PAD / total, (y + size * 0.35 / 72) / full, line, size=size, weight=weight, color=colour,
                    va="baseline", ha="left", parse_math=False,
                )  # fmt: skip


def _place(figure: "Figure", axes: "Axes", panels: "list[Axes]", it: _Measured, map_top: float) -> None:
    """Put the axes and legends where they belong, the map's upper edge at ``map_top``."""
    total, full = figure.get_size_inches()

    def put(which: "Axes", x: float, bottom: float, width: float, height: float) -> None:
        which.set_position((x / total, bottom / full, width / total, height / full))

    map_left = PAD + it.around[0]
    put(axes, map_left, map_top - it.height, it.width, it.height)
    if it.legend:
        centred = map_left + (it.width - it.legend_size[0]) / 2
        x = max(PAD, min(centred, PAD + it.column - it.legend_size[0]))
        _put_legend(figure, it.legend, x, map_top - it.height - it.around[2] - 0.04)
    x = PAD + it.column + 0.1 + it.panel_around[0] if it.beside else map_left
    upper = map_top if it.beside else map_top - it.height - it.below_map - 0.12 - it.curve_size[1]
    if it.curve_legend:
        _put_legend(figure, it.curve_legend, x - 0.05, upper + it.curve_size[1])
    for panel, size in zip(panels, it.panel_heights, strict=True):
        put(panel, x, upper - size, it.panel_width, size)
        upper -= size + GAP


def _map_size(aspect: float, *, beside: bool) -> tuple[float, float]:
    """Return width and height of the map for a figure as wide as a page at most."""
    if aspect >= WIDE:
        return 6.4, max(6.4 / aspect, 0.04)
    side = 3.8 if beside else 4.6
    height = min(side / aspect, side * 1.5)
    return max(height * aspect, 0.04), height


def _panel_heights(height: float, count: int) -> list[float]:
    if count < 2:
        return [height] * count
    low = max(0.45, 0.24 * height)
    return [height - low - GAP, low]


def _resize(figure: "Figure", axes: "Axes", width: float, height: float) -> None:
    across, down = figure.get_size_inches()
    axes.set_position((0.2, 0.2, width / across, height / down))


def _overhang(figure: "Figure", axes: "Axes") -> tuple[float, float, float, float]:
    """Return how far ticks and labels reach beyond the axes: left, right, bottom, top."""
    from matplotlib.transforms import Bbox

    around = axes.get_tightbbox(figure.canvas.get_renderer())  # type: ignore[attr-defined]  # the Agg canvas has one
    inner = axes.get_window_extent()
    outer = Bbox.union([inner, around]) if around is not None else inner
    dpi = figure.dpi
    return (
        (inner.x0 - outer.x0) / dpi,
        (outer.x1 - inner.x1) / dpi,
        (inner.y0 - outer.y0) / dpi,
        (outer.y1 - inner.y1) / dpi,
    )


def _curve_handles(panels: "list[Axes]") -> "list[Artist]":
    return [*reversed(panels[0].get_lines())] if panels else []


def _legend(figure: "Figure", handles: "list[Artist]", colours: Theme, room: float) -> "Legend | None":
    """Return a legend with as many columns as fit into the room."""
    if not handles:
        return None
    for columns in range(len(handles), 0, -1):
        legend = figure.legend(
            handles=handles, loc="upper left", ncols=columns, frameon=False, fontsize=SMALL,
            labelcolor=colours.ink, borderpad=0.25, handlelength=1.7, handletextpad=0.5,
            columnspacing=1.0, labelspacing=0.35, borderaxespad=0.0,
        )  # fmt: skip
        if columns == 1 or _size(figure, legend)[0] <= room:
            return legend
        legend.remove()
    return None


def _size(figure: "Figure", legend: "Legend | None") -> tuple[float, float]:
    if legend is None:
        return 0.0, 0.0
    extent = legend.get_window_extent(figure.canvas.get_renderer())  # type: ignore[attr-defined]
    return extent.width / figure.dpi, extent.height / figure.dpi


def _put_legend(figure: "Figure", legend: "Legend", x: float, y: float) -> None:
    legend.set_bbox_to_anchor((x, y), transform=figure.dpi_scale_trans)
