"""The figure of a run: map and path, and beside them how the fitness converged."""

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.draw.colours import Theme, rgb, theme

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend

Floats = NDArray[np.float64]
Cell = tuple[int, int]

# Lengths of the layout are in inches, sizes of text and lines in points.
PAD = 0.14
WIDE = 1.7
"""Ratio of width to height from which the convergence goes below the map."""
LINED = 40
"""Cells along the longer side up to which they are separated by lines."""
NODED = 80
"""Nodes up to which a path shows them."""
DISC = 13.0
"""Diameter of the discs at start and goal."""
TITLE, TEXT, SMALL = 11.0, 9.5, 8.5
STEPS = (1, 2, 5, 10)
"""Round steps between ticks."""


def path_figure(
    occupied: ArrayLike,
    *,
    closed: ArrayLike | None = None,
    start: Cell,
    goal: Cell,
    path: ArrayLike | None = None,
    unrefined: ArrayLike | None = None,
    curve: ArrayLike | None = None,
    optimum: ArrayLike | None = None,
    history: Mapping[str, Any] | None = None,
    title: str = "",
    caption: str = "",
    resolution: float | None = None,
    dark: bool = False,
) -> "Figure":
    """Draw a map with its path, and how the fitness converged.

    Parameters
    ----------
    occupied
        (rows, cols) bool, row 0 at the top.
    closed
        (rows, cols) bool, what is closed to the centre of a robot with a radius;
        free cells of it are drawn in a lighter tone.
    start, goal
        (row, column).
    path, unrefined, optimum
        (k, 2) cells: the path, the path before its refinement, an exact reference.
    curve
        (m, 2) points of a smooth curve along the path, in cells.
    history
        ``evaluations``, ``best``, ``generation_best``, ``mean`` and ``diversity``,
        one value for each generation; any of them may be missing. Drawn from two
        generations on.
    title, caption
        Above the map.
    resolution
        Metres for each cell; the axes are in metres then, else in cells.
    dark
        For dark ground.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    colours = theme(dark=dark)
    walls = np.asarray(occupied, bool)
    figure = Figure(figsize=(6, 6), dpi=150, facecolor=colours.ground)
    FigureCanvasAgg(figure)
    scene = Scene(walls, colours, resolution)

    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8), label="map")
    handles = scene.draw_map(axes, None if closed is None else np.asarray(closed, bool))
    handles += scene.draw_paths(axes, path, unrefined, curve, optimum)
    curves = Curves.read(history or {})
    panels: list[Axes] = []
    if curves is not None:
        panels.append(figure.add_axes((0.1, 0.5, 0.8, 0.4), label="fitness"))
        if curves.diversity is not None:
            panels.append(figure.add_axes((0.1, 0.1, 0.8, 0.2), label="diversity", sharex=panels[0]))
        curves.draw(panels, colours)
    _lay_out(figure, scene, axes, panels, handles, (start, goal), title, caption)
    return figure


@dataclass(frozen=True)
class Scene:
    """A map in the units of its axes: cells with rows downwards, or metres with y upwards."""

    walls: NDArray[np.bool_]
    colours: Theme
    resolution: float | None

    @property
    def aspect(self) -> float:
        """Width through height."""
        rows, cols = self.walls.shape
        return float(cols / rows)

    def place(self, cells: ArrayLike) -> tuple[Floats, Floats]:
        """Return x and y of cells' centres."""
        row, col = np.asarray(cells, float).reshape(-1, 2).T
        if self.resolution is None:
            return col, row
        return (col + 0.5) * self.resolution, (len(self.walls) - row - 0.5) * self.resolution

    def draw_map(self, axes: "Axes", closed: NDArray[np.bool_] | None) -> "list[Artist]":
        """Draw free, closed and obstacle cells and return their entries for the legend."""
        from matplotlib.collections import LineCollection
        from matplotlib.patches import Patch
        from matplotlib.ticker import MaxNLocator

        colours = self.colours
        rows, cols = self.walls.shape
        metres = self.resolution
        cells = np.full((rows, cols, 3), rgb(colours.free), np.uint8)
        handles: list[Artist] = []
        if self.walls.any():
            handles.append(Patch(facecolor=colours.wall, edgecolor="none", label="obstacle"))
        if closed is not None and (closed & ~self.walls).any():
            cells[closed] = rgb(colours.closed)
            handles.append(Patch(facecolor=colours.closed, edgecolor="none", label="closed by radius"))
        cells[self.walls] = rgb(colours.wall)
        box = (-0.5, cols - 0.5, rows - 0.5, -0.5) if metres is None else (0.0, cols * metres, 0.0, rows * metres)
        # With more cells than pixels, the nearest cell alone would tear thin walls.
        kind = "nearest" if max(rows, cols) <= 400 else "antialiased"
        axes.imshow(cells, extent=box, interpolation=kind, aspect="auto", origin="upper", zorder=0)
        if max(rows, cols) <= LINED:
            xs, ys = np.linspace(box[0], box[1], cols + 1), np.linspace(box[2], box[3], rows + 1)
            lines = [[(x, box[2]), (x, box[3])] for x in xs] + [[(box[0], y), (box[1], y)] for y in ys]
            axes.add_collection(
                LineCollection(lines, colors=colours.faint, linewidths=0.6, zorder=1, antialiaseds=False)
            )
        _dress(axes, colours)
        axes.set_xlim(box[0], box[1])
        axes.set_ylim(box[2], box[3])
        for axis, ratio in ((axes.xaxis, self.aspect), (axes.yaxis, 1 / self.aspect)):
            axis.set_major_locator(
                MaxNLocator(
                    nbins=5 if ratio > 0.6 else 3 if ratio > 0.3 else 2,
                    integer=metres is None,
                    steps=STEPS,
                    min_n_ticks=1,
                )
            )
        axes.set_xlabel("column" if metres is None else "metres from the left", size=TEXT)
        axes.set_ylabel("row" if metres is None else "metres from the bottom", size=TEXT)
        return handles

    def draw_paths(
        self,
        axes: "Axes",
        path: ArrayLike | None,
        unrefined: ArrayLike | None,
        curve: ArrayLike | None,
        optimum: ArrayLike | None,
    ) -> "list[Artist]":
        """Draw up to four paths and return their entries for the legend."""
        from matplotlib.lines import Line2D
        from matplotlib.patheffects import Normal, Stroke

        colours = self.colours
        thick = 2.6 if max(self.walls.shape) <= LINED else 2.0
        handles: list[Artist] = []

        def add(cells: ArrayLike | None, label: str, halo: float, **look: Any) -> None:
            if cells is None or len(np.atleast_1d(cells)) == 0:
                return
            line = Line2D(*self.place(cells), label=label, clip_on=False, **look)
            if halo:
                line.set_path_effects([Stroke(linewidth=look["linewidth"] + halo, foreground=colours.free), Normal()])
            axes.add_line(line)
            handles.append(line)

        nodes = 0 if path is None else len(np.atleast_1d(path))
        halo = 1.2
        if curve is not None:
            add(
                curve, "curve", halo, color=colours.goal, linewidth=1.2 * thick, linestyle="-", zorder=2.5,
                solid_joinstyle="round", solid_capstyle="round",
            )  # fmt: skip
            thick, halo = 0.5 * thick, 0.0  # the path lies on the curve, thin enough to let it be seen
        add(
            path, "path", halo, color=colours.path, linewidth=thick, linestyle="-", zorder=3,
            solid_joinstyle="round", solid_capstyle="round", marker="o" if nodes <= NODED else "",
            markersize=thick + 2.6, markerfacecolor=colours.free, markeredgecolor=colours.path,
            markeredgewidth=1.3,
        )  # fmt: skip
        add(
            unrefined, "before refinement", 0.0, color=colours.unrefined, linewidth=1.1,
            linestyle=(0, (4, 2.5)), zorder=4, dash_joinstyle="round",
        )  # fmt: skip
        add(
            optimum, "optimum", 0.0, color=colours.optimum, linewidth=thick * 0.75,
            linestyle=(0, (0.1, 1.9)), zorder=5, dash_capstyle="round",
        )  # fmt: skip
        return handles

    def draw_ends(self, axes: "Axes", ends: tuple[Cell, Cell], points_per_cell: float) -> None:
        """Draw discs with S and G, side by side where they would cover each other.

        Where one reaches over the map's edge, the labels of the ticks make way.
        """
        (r0, c0), (r1, c1) = ends
        across, down = (c1 - c0) * points_per_cell, (r1 - r0) * points_per_cell
        apart = float(np.hypot(across, down))
        push = max(0.0, (DISC + 2 - apart) / 2)
        x, y = (across / apart, -down / apart) if apart else (1.0, 0.0)
        colours = self.colours
        for cell, letter, colour, sign in (
            (ends[0], "S", colours.start, -1),
            (ends[1], "G", colours.goal, 1),
        ):
            at_x, at_y = self.place([cell])
            axes.annotate(
                letter, (float(at_x[0]), float(at_y[0])), xytext=(sign * push * x, sign * push * y),
                textcoords="offset points", ha="center", va="center_baseline", size=8.5, weight="bold",
                color="#ffffff", zorder=7, annotation_clip=False,
                bbox={
                    "boxstyle": "circle,pad=0.22", "facecolor": colour, "edgecolor": colours.free,
                    "linewidth": 0.9,
                },
            )  # fmt: skip
        over_left = DISC / 2 - (min(c0, c1) + 0.5) * points_per_cell
        over_bottom = DISC / 2 - (len(self.walls) - max(r0, r1) - 0.5) * points_per_cell
        axes.tick_params(axis="y", pad=max(3.5, over_left - 1))
        axes.tick_params(axis="x", pad=max(3.5, over_bottom - 1))


@dataclass(frozen=True)
class Curves:
    """What the history says, generation by generation."""

    evaluations: Floats
    counted: bool
    """Whether the first axis counts evaluations; otherwise it counts generations."""
    fitness: Mapping[str, Floats]
    diversity: Floats | None

    @classmethod
    def read(cls, history: Mapping[str, Any]) -> "Curves | None":
        """Return the curves of a history, or ``None`` where there is nothing to draw."""
        lists = {k: _numbers(history.get(k)) for k in ("evaluations", "best", "generation_best", "mean", "diversity")}
        known = {k: v for k, v in lists.items() if v is not None and len(v)}
        fitness = [k for k in ("best", "generation_best", "mean") if k in known and np.isfinite(known[k]).any()]
        n = min((len(v) for v in known.values()), default=0)
        if n < 2 or not fitness:
            return None
        counted = "evaluations" in known
        x = known["evaluations"][:n] if counted else np.arange(n, dtype=np.float64)
        spread = known.get("diversity")
        shown = spread is not None and np.isfinite(spread[:n]).any()
        return cls(
            x,
            counted,
            {k: known[k][:n] for k in fitness},
            spread[:n] if spread is not None and shown else None,
        )

    def draw(self, panels: "Sequence[Axes]", colours: Theme) -> None:
        """Draw fitness on the first panel and diversity on the second, if there is one."""
        from matplotlib.ticker import EngFormatter, FuncFormatter, MaxNLocator

        looks: dict[str, tuple[str, dict[str, Any]]] = {
            "mean": ("mean", {"color": colours.mean, "linewidth": 1.2, "linestyle": (0, (4, 1.5))}),
            "generation_best": ("of generation", {"color": colours.optimum, "linewidth": 1.2}),
            "best": ("best so far", {"color": colours.path, "linewidth": 2.0, "drawstyle": "steps-post"}),
        }
        top, bottom = panels[0], panels[-1]
        for name, (label, look) in looks.items():
            if name in self.fitness:
                top.plot(self.evaluations, self.fitness[name], label=label, **look)
        values = np.concatenate(list(self.fitness.values()))
        values = values[np.isfinite(values)]
        if values.min() > 0 and values.max() > 300 * values.min():
            top.set_yscale("log")
        else:
            top.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 2.5, 5, 10]))
            top.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        top.set_ylabel("fitness", size=TEXT)
        if self.diversity is not None:
            bottom.plot(self.evaluations, self.diversity, color=colours.start, linewidth=1.3)
            bottom.set_ylim(bottom=min(0.0, float(np.nanmin(self.diversity))))
            bottom.set_ylabel("diversity", size=TEXT)
            bottom.yaxis.set_major_locator(MaxNLocator(nbins=2, steps=STEPS))
            bottom.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            top.tick_params(labelbottom=False)
        for axes in panels:
            _dress(axes, colours)
            axes.margins(x=0.02)
            axes.grid(visible=True, color=colours.faint, linewidth=0.6)
            axes.set_axisbelow(True)
            axes.spines[["top", "right"]].set_visible(False)
        bottom.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True, steps=STEPS))
        bottom.xaxis.set_major_formatter(EngFormatter(sep=""))
        bottom.set_xlabel("evaluations" if self.counted else "generation", size=TEXT)


def _numbers(values: Any) -> Floats | None:
    """Return a list of numbers as floats; what is missing in it, or infinite, becomes nan."""
    if values is None:
        return None
    numbers = np.array([np.nan if v is None else v for v in values], np.float64)
    numbers[~np.isfinite(numbers)] = np.nan
    return numbers


def _dress(axes: "Axes", colours: Theme) -> None:
    axes.set_facecolor(colours.ground)
    axes.tick_params(labelsize=SMALL, colors=colours.ink, length=3, width=0.7)
    for spine in axes.spines.values():
        spine.set_color(colours.quiet)
        spine.set_linewidth(0.7)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_color(colours.ink)


def _lay_out(
    figure: "Figure",
    scene: Scene,
    axes: "Axes",
    panels: "list[Axes]",
    handles: "list[Artist]",
    ends: tuple[Cell, Cell],
    title: str,
    caption: str,
) -> None:
    """Give the map its room, measure what stands around it, and fit the figure to that."""
    colours = scene.colours
    beside = bool(panels) and scene.aspect < WIDE
    width, height = _map_size(scene.aspect, beside=beside)
    rows, _ = scene.walls.shape

    # Sizes first: ticks depend on them. Places follow once all is measured.
    panel_width, panel_height = (2.7, max(height, 2.7)) if beside else (width, 2.3)
    sizes = _panel_heights(panel_height, len(panels))
    _resize(figure, axes, width, height)
    for panel, size in zip(panels, sizes, strict=True):
        _resize(figure, panel, panel_width, size)
    scene.draw_ends(axes, ends, height * 72 / rows)
    left, right, bottom, top = (max(it, 0.08) for it in _overhang(figure, axes))
    around = [_overhang(figure, panel) for panel in panels]
    panel_left = max((it[0] for it in around), default=0.0)
    panel_right = max((it[1] for it in around), default=0.0)
    panel_bottom = around[-1][2] if around else 0.0

    if panels and not beside:  # one below the other, with the same left edge
        left = panel_left = max(left, panel_left)
    column = max(left + width + right, 2.3)
    legend = _legend(figure, handles, colours, column)
    legend_size = _size(figure, legend) if legend else (0.0, 0.0)
    curve_legend = _legend(figure, _curve_handles(panels), colours, panel_width + 0.3)
    curve_size = _size(figure, curve_legend) if curve_legend else (0.0, 0.0)
    panel_right = max(panel_right, curve_size[0] - 0.05 - panel_width)
    column = max(column, legend_size[0])

    total = PAD + column + PAD
    if beside:
        total += 0.1 + panel_left + panel_width + panel_right
    heading = [(title, TITLE, "bold", colours.ink), (caption, TEXT, "normal", colours.quiet)]
    blocks = [
        (textwrap.wrap(text, max(12, int((total - 2 * PAD) * 72 / (0.58 * size)))), size, weight, colour)
        for text, size, weight, colour in heading
        if text.strip()
    ]
    head = sum(len(lines) * size * 1.3 / 72 for lines, size, _, _ in blocks) + (0.06 if blocks else 0.0)

    below_map = bottom + 0.04 + legend_size[1]
    if beside:  # the map's upper edge is that of the panels
        top = max(top, curve_size[1])
    body = top + height + below_map
    if beside:
        body = max(body, top + panel_height + panel_bottom)
    elif panels:
        body += 0.12 + curve_size[1] + panel_height + panel_bottom
    full = PAD + head + body + PAD * 0.6
    figure.set_size_inches(total, full)

    y = full - PAD
    for lines, size, weight, colour in blocks:
        for line in lines:
            y -= size * 1.3 / 72
            figure.text(
                PAD / total, (y + size * 0.35 / 72) / full, line, size=size, weight=weight, color=colour,
                va="baseline", ha="left", parse_math=False,
            )  # fmt: skip
    y = full - PAD - head

    def put(it: "Axes", x: float, bottom_edge: float, w: float, h: float) -> None:
        it.set_position((x / total, bottom_edge / full, w / total, h / full))

    map_left = PAD + left
    map_top = y - top
    put(axes, map_left, map_top - height, width, height)
    if legend:
        centred = map_left + (width - legend_size[0]) / 2
        _put_legend(
            figure,
            legend,
            max(PAD, min(centred, PAD + column - legend_size[0])),
            map_top - height - bottom - 0.04,
        )
    if panels:
        x = PAD + column + 0.1 + panel_left if beside else map_left
        upper = map_top if beside else map_top - height - below_map - 0.12 - curve_size[1]
        if curve_legend:
            _put_legend(figure, curve_legend, x - 0.05, upper + curve_size[1])
        for panel, size in zip(panels, sizes, strict=True):
            put(panel, x, upper - size, panel_width, size)
            upper -= size + 0.14


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
    return [height - low - 0.14, low]


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


def _size(figure: "Figure", legend: "Legend") -> tuple[float, float]:
    extent = legend.get_window_extent(figure.canvas.get_renderer())  # type: ignore[attr-defined]
    return extent.width / figure.dpi, extent.height / figure.dpi


def _put_legend(figure: "Figure", legend: "Legend", x: float, y: float) -> None:
    legend.set_bbox_to_anchor((x, y), transform=figure.dpi_scale_trans)
