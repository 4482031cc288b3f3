"""Where the paths of a population run: a heat map of cells."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pathloom.draw.colours import rgb
from pathloom.draw.look import SMALL, TEXT, Floats, dress
from pathloom.draw.raster import crossed
from pathloom.draw.scene import Scene
from pathloom.draw.study.series import colour
from pathloom.draw.study.sheet import Sheet, settled
from pathloom.errors import PathloomError
from pathloom.kernel.state import State
from pathloom.paths.problem import PathProblem

if TYPE_CHECKING:
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure


def heat_figure(state: State, *, sheet: Sheet = Sheet()) -> "Figure":
    """Draw the map with the share of the main population whose paths cross each cell, and the best path so far.

    Raises
    ------
    PathloomError
        If the state is not one of a path problem, or its population is empty.
    """
    problem = state.problem
    if not isinstance(problem, PathProblem):
        raise PathloomError(f"found a state of a {type(problem).__name__}, allowed one of a path problem")
    if not state.demes or len(state.population) == 0:
        raise PathloomError("found a state without a population, allowed one of an evolution")
    from matplotlib.colors import PowerNorm

    decode = problem.representation.decode
    walls = problem.grid.occupied
    shares = crossings([decode(row) for row in state.population], walls.shape)
    scene = Scene(walls, sheet.colours, problem.grid.resolution if problem.grid.metric else None)
    room = sheet.inches - 1.35
    figure, axes = sheet.blank(min(max(room / scene.aspect, 1.4), 6.0) + 0.55)
    scene.draw_map(axes, problem.context.occupied if problem.radius else None)
    box = (*axes.get_xlim(), *axes.get_ylim())
    image = axes.imshow(
        np.ma.masked_equal(shares, 0.0), extent=box, origin="upper", interpolation="nearest",
        norm=PowerNorm(0.5, 0.0, 1.0), cmap=_shades(scene, dark=sheet.dark), zorder=1.5,
    )  # fmt: skip
    axes.set_aspect("equal")
    best = None if state.best is None else decode(state.best.row)
    scene.draw_paths(axes, best, None, None, None)
    bar = figure.colorbar(image, ax=axes, shrink=0.8, pad=0.03, ticks=[0.0, 0.1, 0.5, 1.0])
    bar.ax.set_yticklabels(["0 %", "10 %", "50 %", "100 %"])
    dress(bar.ax, sheet.colours)
    bar.outline.set_visible(False)
    bar.ax.tick_params(labelsize=SMALL)
    bar.set_label("paths that cross a cell", size=TEXT, color=sheet.colours.ink)
    figure.draw_without_rendering()
    points = axes.get_window_extent().width / figure.dpi * 72 / walls.shape[1]
    scene.draw_ends(axes, problem.ends, points)
    return settled(figure)


def crossings(paths: Sequence[NDArray[np.integer[Any]]], shape: tuple[int, ...]) -> Floats:
    """Return for each cell of a map the share of paths (k, 2) that cross its interior."""
    height, width = shape
    counts = np.zeros(height * width)
    for path in paths:
        cells = crossed(np.asarray(path, np.int64))
        counts[np.unique(cells[:, 0] * width + cells[:, 1])] += 1
    shares: Floats = counts.reshape(height, width) / max(len(paths), 1)
    return shares


def _shades(scene: Scene, *, dark: bool) -> "Colormap":
    """Return shades from a tint of the ground to orange: they differ in lightness, and from the path's blue."""
    from matplotlib.colors import LinearSegmentedColormap

    free, full = (np.array(rgb(shade)) / 255 for shade in (scene.colours.free, colour(1, dark=dark)))
    return LinearSegmentedColormap.from_list("heat", [0.85 * free + 0.15 * full, full])
