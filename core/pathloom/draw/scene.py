"""The map of a figure, with its paths, start and goal."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.draw.colours import Theme, rgb
from pathloom.draw.look import STEPS, TEXT, Cell, Floats, dress

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

LINED = 40
"""Cells along the longer side up to which they are separated by lines."""
NODED = 80
"""Nodes up to which a path shows them."""
DISC = 13.0
"""Diameter of the discs at start and goal, in points."""


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
        dress(axes, colours)
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
