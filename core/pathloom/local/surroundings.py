"""What is around the robot: the walls of a map, and discs that the map does not show."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pathloom import compiled
from pathloom.grid import OccupancyGrid
from pathloom.kernel.evaluation import Floats

NOBODY: Floats = np.empty((0, 3))


@dataclass(eq=False)
class Surroundings:
    """A map in metres, with obstacles that stand or move. It changes: movers move, and it keeps their random state."""

    grid: OccupancyGrid
    cell: float
    """Side of a cell, in metres."""
    standing: Floats = field(default_factory=NOBODY.copy)
    """(s, 3) x, y and radius in metres."""
    moving: Floats = field(default_factory=NOBODY.copy)
    """(m, 3) likewise."""
    velocities: Floats = field(default_factory=lambda: np.empty((0, 2)))
    """(m, 2) metres a second."""
    words: NDArray[np.uint64] = field(default_factory=lambda: np.zeros(4, np.uint64))
    """The movers' random state."""

    def __post_init__(self) -> None:
        self._standing, self._moving = self._in_cells(self.standing), self._in_cells(self.moving)
        self._velocities = np.ascontiguousarray(self.velocities / self.cell * (1.0, -1.0))
        self._gather()

    @cached_property
    def _blocked(self) -> NDArray[np.uint8]:
        return np.ascontiguousarray(self.grid.occupied, np.uint8).ravel()

    def rays(self, poses: Floats, angles: Floats, reach: float) -> Floats:
        """Return how far rays at angles (k,) from the heading go from poses (n, 3): (n, k) metres, at most reach."""
        there = np.ascontiguousarray(poses, np.float64).copy()
        there[:, 0] /= self.cell
        there[:, 1] = self.grid.height - there[:, 1] / self.cell
        height, width = self.grid.shape
        seen = compiled.rays.cast(self._blocked, height, width, there, angles, self._discs, reach / self.cell)
        return np.asarray(seen) * self.cell

    def clearance(self, x: float, y: float, reach: float) -> float:
        """Return how far a point is from what is nearest to it, in metres, at most reach."""
        height, width = self.grid.shape
        col, row = x / self.cell, height - y / self.cell
        return (
            float(compiled.rays.clearance(self._blocked, height, width, col, row, self._discs, reach / self.cell))
            * self.cell
        )

    def pass_time(self, seconds: float, x: float, y: float, radius: float) -> None:
        """Let the movers walk on; they turn rather than walk into the robot, a disc at (x, y)."""
        if len(self._moving) == 0:
            return
        height, width = self.grid.shape
        compiled.rays.wander(
            self._blocked, height, width, self._moving, self._velocities, self._standing,
            x / self.cell, height - y / self.cell, radius / self.cell, seconds, self.words,
        )  # fmt: skip
        self._gather()

    @property
    def discs(self) -> Floats:
        """(s + m, 3) all discs as they are now, the standing ones first: x, y and radius in metres."""
        found = self._discs * self.cell
        found[:, 1] = self.grid.height * self.cell - found[:, 1]
        return found

    def _in_cells(self, discs: Floats) -> Floats:
        found = np.array(discs, np.float64).reshape(-1, 3) / self.cell
        found[:, 1] = self.grid.height - found[:, 1]
        return np.ascontiguousarray(found)

    def _gather(self) -> None:
        self._discs = np.concatenate((self._standing, self._moving))


def cell_side(grid: OccupancyGrid, otherwise: float) -> float:
    """Return the side of a map's cells in metres: the map's own resolution where it has one."""
    return grid.resolution if grid.metric else otherwise
