"""PathProblem: from a start to a goal on an occupancy grid."""

import math
from dataclasses import KW_ONLY, dataclass, fields
from functools import cached_property
from typing import Any, ClassVar, get_args

import numpy as np

from pathloom.errors import ProblemError
from pathloom.grid import OccupancyGrid, inflate
from pathloom.kernel.problem import Problem
from pathloom.naming import closest, meant
from pathloom.paths.cell_paths import CellPaths
from pathloom.paths.context import Context, Corners

Cell = tuple[int, int]
"""(row, column), counted from 0, row 0 at the top."""

CORNER_NAMES = ("bottom-left", "bottom-right", "top-left", "top-right")


@dataclass(frozen=True)
class PathProblem(Problem):
    """Find a path for a disc-shaped robot between two cells of an occupancy grid.

    Parameters
    ----------
    grid
        The map.
    start, goal
        (row, column) or the name of a corner.
    radius
        Radius of the robot, in metres where the map has a resolution, else in
        cells. A cell is closed to the robot's centre when the disc would overlap
        an obstacle cell there.
    corners
        ``strict``: a path may not even touch an obstacle cell; ``no-squeeze``: it
        may, but not pass between two that share only a corner; ``allow``: only
        the inside of an obstacle cell blocks.

    Raises
    ------
    ProblemError
        If start or goal lie outside the map or on a cell that is closed, or a
        value is out of its range. An unreachable goal is no error: see ``reachable``.
    """

    name: ClassVar[str] = "path"

    grid: OccupancyGrid
    _: KW_ONLY
    start: Cell | str = "bottom-left"
    goal: Cell | str = "top-right"
    radius: float = 0.0
    corners: Corners = "strict"

    def __post_init__(self) -> None:
        if not isinstance(self.grid, OccupancyGrid):
            object.__setattr__(self, "grid", OccupancyGrid(self.grid))
        if not isinstance(self.corners, str) or self.corners not in get_args(Corners):
            hint = meant(str(self.corners), get_args(Corners))
            allowed = ", ".join(get_args(Corners)) + (f"; {hint}" if hint else "")
            raise ProblemError(f"corners: found {self.corners!r}, allowed {allowed}")
        object.__setattr__(self, "radius", self._length(self.radius))
        for end in ("start", "goal"):
            object.__setattr__(self, end, self._cell(end, getattr(self, end)))
        for end in ("start", "goal"):
            self._check_free(end, getattr(self, end))

    @cached_property
    def context(self) -> Context:
        """The map as the operators need it, with obstacles grown by the radius."""
        cells = self.radius / self.grid.resolution
        occupied = inflate(self.grid.occupied, cells) if cells > 0 else self.grid.occupied
        (r0, c0), (r1, c1) = self.ends
        return Context(occupied, self.corners, r0 * self.grid.width + c0, r1 * self.grid.width + c1)

    @property
    def fingerprint(self) -> str:
        grid = self.grid
        return repr((grid.sha256, grid.resolution, grid.origin, self.ends, self.radius, self.corners))

    @cached_property
    def representation(self) -> CellPaths:
        return CellPaths(rows=self.grid.height, cols=self.grid.width)

    @property
    def ends(self) -> tuple[Cell, Cell]:
        """Start and goal as cells."""
        return self.start, self.goal  # type: ignore[return-value]  # names became cells on construction

    @property
    def reachable(self) -> bool:
        """Whether any path exists under the corner policy."""
        return self.context.reachable

    def __getstate__(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in fields(self)}  # caches are worked out again

    @staticmethod
    def _length(radius: Any) -> float:
        try:
            if isinstance(radius, bool) or not isinstance(radius, (int, float, np.number)):
                raise TypeError
            if 0.0 <= (value := float(radius)) < math.inf:
                return value
        except (TypeError, OverflowError):
            pass  # said below, as for any other value
        raise ProblemError(f"radius: found {radius!r}, allowed a number in [0, inf)")

    def _cell(self, end: str, value: Any) -> Cell:
        height, width = self.grid.shape
        if isinstance(value, str):
            if value not in CORNER_NAMES:
                raise ProblemError(
                    f"{end}: found {value!r}, allowed ROW,COL or a corner; {closest(value, CORNER_NAMES)}"
                )
            return (height - 1 if "bottom" in value else 0), (width - 1 if "right" in value else 0)
        try:
            row, col = value
            if any(isinstance(v, (bool, np.bool_)) or int(v) != v for v in (row, col)):
                raise ValueError
        except (TypeError, ValueError, OverflowError):
            raise ProblemError(f"{end}: found {value!r}, allowed (row, column) or the name of a corner") from None
        if not (0 <= row < height and 0 <= col < width):
            raise ProblemError(
                f"{end}: found cell {int(row)},{int(col)} outside the map, "
                f"allowed rows 0 to {height - 1} and columns 0 to {width - 1}"
            )
        return int(row), int(col)

    def _check_free(self, end: str, cell: Cell) -> None:
        occupied = self.context.occupied
        if not occupied[cell]:
            return
        if occupied.all():
            raise ProblemError(f"{end}: cell {cell[0]},{cell[1]} is closed, as is every cell of the map")
        free = np.argwhere(~occupied)
        near = free[np.argmin(((free - cell) ** 2).sum(axis=1))]
        cause = "is an obstacle"
        if not self.grid.occupied[cell]:
            unit = "m" if self.grid.metric else "cells"
            cause = f"is closer to an obstacle than the radius {self.radius:g} {unit}"
        raise ProblemError(f"{end}: cell {cell[0]},{cell[1]} {cause}; the nearest free cell is {near[0]},{near[1]}")
