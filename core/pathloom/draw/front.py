"""The figure of a front: its paths on the map, its values against each other, and in parallel coordinates."""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.draw.colours import Theme, theme
from pathloom.draw.look import SMALL, STEPS, TEXT, TITLE, Cell, Floats, dress
from pathloom.draw.scene import Scene

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure, SubFigure

PANELS = ("paths", "scatter", "parallel")
SHADES = {False: (0.0, 0.88), True: (0.32, 1.0)}
"""The part of the colour map that stands out from dark and from light ground, by whether it is dark."""
MAP = 300.0
"""Side of the map, roughly, in points."""
MARKERS = "^sv<>P"
"""One for each other planner."""


@dataclass(frozen=True)
class Look:
    """What is to be drawn of a front."""

    values: Floats
    """(n, m), n ≥ 1."""
    labels: Sequence[str]
    """m names of objectives."""
    colour: int = 0
    """The objective by which members are coloured."""
    knee: int | None = None
    preferred: int | None = None
    exact: Floats | None = None
    """(k, m), the exact front."""
    rivals: Sequence[tuple[str, Floats]] = ()
    """Other planners' names, and values (j, m) of their paths."""
    paths: Sequence[NDArray[np.int64]] = ()
    """n paths, each (k, 2)."""
    shown: Sequence[int] = ()
    """Members whose paths are drawn."""


@dataclass(frozen=True)
class Ground:
    """The map below the paths."""

    occupied: NDArray[np.bool_]
    start: Cell
    goal: Cell
    closed: NDArray[np.bool_] | None = None
    resolution: float | None = None


def front_figure(
    look: Look,
    ground: Ground | None = None,
    *,
    panels: Sequence[str] = PANELS,
    title: str = "",
    caption: str = "",
    dark: bool = False,
) -> "Figure":
    """Draw a front.

    Parameters
    ----------
    look
        Values, labels, paths, and what is marked among them.
    ground
        The map; needed by the panel ``paths``.
    panels
        Some of ``paths``, ``scatter`` (a matrix of scatters from three objectives on) and ``parallel``.
    title, caption
        Above the panels.
    dark
        For dark ground.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    it = _Drawing(look, theme(dark=dark), _shades(dark=dark))
    upper = [name for name in ("paths", "scatter") if name in panels]
    across = [_map_width(ground, it.scatter_size) if name == "paths" else it.scatter_size for name in upper]
    width, height = max(sum(across), 6.0), (it.scatter_size if upper else 0.0)
    heads = [*textwrap.wrap(title, int(width * 11.5)), *(lines := textwrap.wrap(caption, int(width * 13.5)))]
    below = 2.5 if "parallel" in panels else 0.0
    head = 0.2 + 0.2 * len(heads)
    figure = Figure((width, height + below + head), dpi=150, facecolor=it.colours.ground)
    FigureCanvasAgg(figure)
    rect = (0, 0, 1, 1 - head / (height + below + head))
    figure.set_layout_engine("constrained", w_pad=0.09, h_pad=0.07, rect=rect)
    rows = [size for size in (height, below) if size]
    parts = list(figure.subfigures(len(rows), 1, squeeze=False, height_ratios=rows)[:, 0])
    places: list[tuple[Scene, Axes, Ground]] = []
    if upper:
        for name, part in zip(upper, _side_by_side(parts.pop(0), across), strict=True):
            if name == "scatter":
                it.draw_scatter(part)
            elif ground is not None:
                places.append((*it.draw_paths(part, ground), ground))
    if parts:
        it.draw_parallel(parts.pop(0), named="scatter" not in panels)
    _write_heading(figure, heads, len(lines), it.colours)
    _settle(figure, places)
    return figure


@dataclass(frozen=True)
class _Drawing:
    """A front with its colours."""

    look: Look
    colours: Theme
    shades: "Colormap"
    legend: "dict[str, Artist]" = field(default_factory=dict)

    @property
    def scatter_size(self) -> float:
        """Side of the scatter, or of the matrix of scatters, in inches."""
        return {2: 4.8, 3: 5.2, 4: 6.2}.get(len(self.look.labels), 7.4)

    @property
    def scale(self) -> Any:
        """Return from values of one objective to [0, 1]."""
        from matplotlib.colors import Normalize

        column = self.look.values[:, self.look.colour]
        low, high = float(column.min()), float(column.max())
        return Normalize(low, high) if high > low else Normalize(low - 1.0, low + 1.0)

    @property
    def members(self) -> Any:
        """(n, 4), the colour of each member."""
        return self.shades(self.scale(self.look.values[:, self.look.colour]))

    def draw_paths(self, part: "SubFigure", ground: Ground) -> "tuple[Scene, Axes]":
        """Draw the map with the paths of the front, the later ones thinner so that shared ways show all of them."""
        from matplotlib.lines import Line2D

        look = self.look
        axes = part.add_subplot(label="map")
        scene = Scene(np.asarray(ground.occupied, bool), self.colours, ground.resolution)
        scene.draw_map(axes, ground.closed)
        axes.set_aspect("equal")
        shown = sorted(look.shown or range(len(look.paths)), key=lambda i: -look.values[i, look.colour])
        rows, cols = scene.walls.shape
        broad, thin = float(np.clip(0.8 * MAP / max(rows, cols), 2.4, 6.5)), 1.3
        for rank, i in enumerate(shown):
            share = rank / max(1, len(shown) - 1)
            line = Line2D(
                *scene.place(look.paths[i]), color=self.members[i], linewidth=broad + (thin - broad) * share,
                solid_joinstyle="round", solid_capstyle="round", clip_on=False, zorder=3 + share,
            )  # fmt: skip
            axes.add_line(line)
        if np.ptp(look.values[:, look.colour]) > 0:
            self._draw_scale(part, axes)
        return scene, axes

    def _draw_scale(self, part: "SubFigure", axes: "Axes") -> None:
        """Draw what value which colour stands for, below the map."""
        from matplotlib.cm import ScalarMappable

        bar = part.colorbar(
            ScalarMappable(self.scale, self.shades), ax=axes, location="bottom", shrink=0.84, aspect=32, pad=0.02
        )
        bar.set_label(self.look.labels[self.look.colour], size=TEXT, color=self.colours.ink)
        bar.ax.tick_params(labelsize=SMALL, colors=self.colours.ink, length=3, width=0.7)
        bar.outline.set_visible(False)
        _round_ticks(bar.ax.xaxis, self.look.values[:, self.look.colour], 6)

    def draw_scatter(self, part: "SubFigure") -> None:
        """Draw each objective against each other one: one scatter, or the lower half of a matrix."""
        m = len(self.look.labels)
        grid = part.subplots(m - 1, m - 1, squeeze=False, sharex="col", sharey="row")
        for row in range(m - 1):
            for column in range(m - 1):
                axes = grid[row, column]
                if column > row:
                    axes.set_visible(False)
                    continue
                axes.set_label(f"{self.look.labels[row + 1]} over {self.look.labels[column]}")
                self._draw_pair(axes, column, row + 1)
                if row == m - 2:
                    axes.set_xlabel(self.look.labels[column], size=TEXT)
                if column == 0:
                    axes.set_ylabel(self.look.labels[row + 1], size=TEXT)
        part.align_ylabels(grid[:, 0])
        part.legend(
            handles=list(self.legend.values()),
            loc="upper right" if m > 2 else "outside upper center",
            ncols=1 if m > 2 else 4,
            frameon=False,
            fontsize=SMALL,
            labelcolor=self.colours.ink,
            handletextpad=0.4,
            columnspacing=1.0,
            labelspacing=0.7,
        )

    def _draw_pair(self, axes: "Axes", x: int, y: int) -> None:
        """Draw two objectives against each other."""
        look, colours = self.look, self.colours
        dress(axes, colours)
        axes.grid(visible=True, color=colours.faint, linewidth=0.6)
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)

        def mark(values: ArrayLike, label: str, **how: Any) -> None:
            pairs = np.asarray(values).reshape(-1, len(look.labels))
            handle = axes.scatter(pairs[:, x], pairs[:, y], **{"label": label, "linewidths": 1.2, **how})
            self.legend.setdefault(label, handle)

        if len(look.labels) == 2:  # what lies above and to the right of the steps is dominated
            axes.plot(*look.values.T, drawstyle="steps-post", color=colours.quiet, linewidth=0.9, zorder=1.5)
        order = np.argsort(-look.values[:, look.colour], kind="stable")
        mark(look.values[order], "front", s=36, c=self.members[order], edgecolors=colours.ground, zorder=4)
        if look.exact is not None:
            mark(look.exact, "exact front", s=78, marker="D", facecolors="none", edgecolors=colours.quiet, zorder=2)
        for rank, (name, values) in enumerate(look.rivals):  # open and of different sizes: they often coincide
            mark(
                values, name, s=44 + 40 * (rank % len(MARKERS)), marker=MARKERS[rank % len(MARKERS)],
                facecolors="none", edgecolors=(colours.mean, colours.path, colours.ink)[rank % 3], zorder=3,
            )  # fmt: skip
        if look.preferred is not None:
            mark(
                look.values[look.preferred], "preferred", s=150, marker="s", facecolors="none",
                edgecolors=colours.start, zorder=5, linewidths=1.8,
            )  # fmt: skip
        if look.knee is not None:
            mark(
                look.values[look.knee], "knee", s=120, marker="o", facecolors="none", edgecolors=colours.goal,
                zorder=6, linewidths=1.8,
            )  # fmt: skip
        axes.margins(0.09)
        every = [look.values, *(values for _, values in look.rivals)]
        for axis, column, limit in ((axes.xaxis, x, axes.set_xlim), (axes.yaxis, y, axes.set_ylim)):
            drawn = np.concatenate([values[:, column] for values in every])
            _round_ticks(axis, drawn, 5)
            if np.ptp(drawn) == 0:
                limit(drawn[0] - 1, drawn[0] + 1)

    def draw_parallel(self, part: "SubFigure", *, named: bool) -> None:
        """Draw a line for each member through an axis for each objective, each axis from its best to its worst."""
        look, colours = self.look, self.colours
        axes = part.add_subplot(label="parallel")
        dress(axes, colours)
        low, high = look.values.min(axis=0), look.values.max(axis=0)
        span = np.where(high > low, high - low, 1.0)
        scaled = np.where(high > low, (look.values - low) / span, 0.5)
        places = np.arange(len(look.labels))
        order = np.argsort(-look.values[:, look.colour], kind="stable")
        for rank, i in enumerate(order):
            axes.plot(places, scaled[i], color=self.members[i], linewidth=1.5, zorder=3 + rank / len(order))
        marked = (("preferred", look.preferred, colours.start, "s"), ("knee", look.knee, colours.goal, "o"))
        for label, which, edge, marker in marked:
            if which is not None:
                axes.plot(
                    places, scaled[which], color=edge, linewidth=2.4, marker=marker, markersize=7, zorder=5,
                    markerfacecolor="none", markeredgewidth=1.8, label=label, linestyle=(0, (2, 1.2)),
                )  # fmt: skip
        axes.vlines(places, -0.04, 1.04, color=colours.quiet, linewidth=0.9, zorder=2)
        names = [
            f"{label}\n{short(a)} to {short(b)}" if b > a else f"{label}\n{short(a)}"
            for label, a, b in zip(look.labels, low.tolist(), high.tolist(), strict=True)
        ]
        axes.set_xticks(places, names, size=TEXT)
        axes.set_yticks([0, 1], ["best", "worst"], size=SMALL)
        axes.set_xlim(-0.25, len(look.labels) - 0.75)
        axes.tick_params(length=0)
        axes.spines[:].set_visible(False)
        if named and any(which is not None for _, which, _, _ in marked):
            part.legend(
                loc="outside upper center", ncols=2, frameon=False, fontsize=SMALL, labelcolor=colours.ink,
                handlelength=2.6,
            )  # fmt: skip


def short(value: float) -> str:
    """Return a number with at most two digits after the point."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".").replace("-", "−")  # never −0


def _map_width(ground: Ground | None, height: float) -> float:
    """Return the room of the map across, in inches, below and above which the figure has so much."""
    if ground is None:
        return 0.0
    rows, cols = ground.occupied.shape
    return float(np.clip((height - 1.1) * cols / rows, 2.2, 6.6)) + 0.8


def _side_by_side(part: "SubFigure", across: Sequence[float]) -> "list[SubFigure]":
    return list(part.subfigures(1, len(across), squeeze=False, width_ratios=across)[0])


def _round_ticks(axis: Any, values: Floats, most: int) -> None:
    """Put round numbers on an axis; whole ones where all values are whole."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    whole = bool((values == np.round(values)).all())
    axis.set_major_locator(MaxNLocator(nbins=most, integer=whole, steps=STEPS))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def _write_heading(figure: "Figure", heads: Sequence[str], lines: int, colours: Theme) -> None:
    """Write the lines of the title, and of the caption in smaller letters, from the top down."""
    width, height = figure.get_size_inches()
    for number, text in enumerate(heads):
        small = number >= len(heads) - lines
        figure.text(
            0.14 / width, 1 - (0.16 + 0.2 * number) / height, text, va="top", ha="left", parse_math=False,
            size=TEXT if small else TITLE, weight="normal" if small else "bold",
            color=colours.quiet if small else colours.ink,
        )  # fmt: skip


def _settle(figure: "Figure", places: "Sequence[tuple[Scene, Axes, Ground]]") -> None:
    """Lay the figure out, and draw start and goal, whose discs have a size on paper."""
    engine = figure.get_layout_engine()
    assert engine is not None
    engine.execute(figure)
    for scene, axes, ground in places:
        axes.apply_aspect()
        cell = axes.get_window_extent().height / figure.dpi * 72 / len(scene.walls)
        scene.draw_ends(axes, (ground.start, ground.goal), cell)
    figure.set_layout_engine("none")  # what is drawn later changes nothing


def _shades(*, dark: bool) -> "Colormap":
    """Return viridis without the end that fades into the ground."""
    import matplotlib as mpl
    from matplotlib.colors import ListedColormap

    low, high = SHADES[dark]
    return ListedColormap(mpl.colormaps["viridis"](np.linspace(low, high, 256)))
