"""What every operator needs to know of a map, worked out once for a problem."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pathloom.grid import labels
from pathloom.kernel.evaluation import Objective

Bytes = NDArray[np.uint8]
Cells = NDArray[np.int32]
"""Flat cell ids: row · width + column."""

Corners = Literal["strict", "no-squeeze", "allow"]
POLICIES: dict[str, int] = {"allow": 0, "no-squeeze": 1, "strict": 2}

STEPS = ((-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1))
"""The eight directions, clockwise from north, as (row, column)."""


@dataclass(frozen=True)
class Context:
    """Masks and tables of one blocked map under one corner policy.

    All tables are flat, row after row; nobody writes to them.
    """

    occupied: NDArray[np.bool_]
    """(rows, cols), obstacles as far as the robot's centre is concerned."""
    corners: Corners
    start: int
    goal: int

    @cached_property
    def rows(self) -> int:
        """Height of the map."""
        return int(self.occupied.shape[0])

    @cached_property
    def cols(self) -> int:
        """Width of the map."""
        return int(self.occupied.shape[1])

    @cached_property
    def policy(self) -> int:
        """The corner policy's number in the kernels."""
        return POLICIES[self.corners]

    @cached_property
    def signs(self) -> tuple[int, int]:
        """Directions (row, column) from start to goal, +1 or −1; −1 and +1 where they share a row or a column."""
        dr, dc = (
            self.goal // self.cols - self.start // self.cols,
            self.goal % self.cols - self.start % self.cols,
        )
        return (1 if dr > 0 else -1), (-1 if dc < 0 else 1)

    @cached_property
    def aligned(self) -> bool:
        """Whether start and goal share a row or a column."""
        return self.start // self.cols == self.goal // self.cols or self.start % self.cols == self.goal % self.cols

    @cached_property
    def blocked(self) -> Bytes:
        """1 for obstacles."""
        return _flat(self.occupied)

    @cached_property
    def moves(self) -> Bytes:
        """Bit d: a step in direction d is legal."""
        return _flat(self._moves(self.policy))

    @cached_property
    def loose_moves(self) -> Bytes:
        """Bit d: a step in direction d is legal where corners do not count (``allow``)."""
        return self.moves if self.policy == 0 else _flat(self._moves(0))

    def _moves(self, policy: int) -> Bytes:
        free = np.pad(~self.occupied, 1)
        rows, cols = self.occupied.shape

        def shifted(dr: int, dc: int) -> NDArray[np.bool_]:
            return free[1 + dr : 1 + dr + rows, 1 + dc : 1 + dc + cols]

        legal = np.zeros((rows, cols), np.uint8)
        for d, (dr, dc) in enumerate(STEPS):
            ok = shifted(0, 0) & shifted(dr, dc)
            if dr and dc and policy == 1:
                ok = ok & (shifted(dr, 0) | shifted(0, dc))
            elif dr and dc and policy == 2:
                ok = ok & shifted(dr, 0) & shifted(0, dc)
            legal |= ok.astype(np.uint8) << np.uint8(d)
        return legal

    def neighbours(self, reach: Literal[4, 8] = 8, border: bool = False) -> Bytes:
        """Return how many of the 4 or 8 neighbours of each cell are obstacles; ``border``: outside the map counts."""
        if (reach, border) not in self._neighbours:
            self._neighbours[reach, border] = self._count_neighbours(reach, border)
        return self._neighbours[reach, border]

    @cached_property
    def _neighbours(self) -> dict[tuple[int, bool], Bytes]:
        return {}

    def _count_neighbours(self, reach: Literal[4, 8], border: bool) -> Bytes:
        blocked = np.pad(self.occupied, 1, constant_values=border).astype(np.uint8)
        rows, cols = self.occupied.shape
        total = np.zeros((rows, cols), np.uint8)
        for dr, dc in STEPS if reach == 8 else STEPS[::2]:
            total += blocked[1 + dr : 1 + dr + rows, 1 + dc : 1 + dc + cols]
        return _flat(total)

    @cached_property
    def optima(self) -> dict[Objective, float]:
        """The least values of objectives on cell paths, as they become known."""
        return {}

    @property
    def obstacles_near(self) -> Bytes:
        """Number of obstacles among the 8 neighbours; outside the map does not count."""
        return self.neighbours(8)

    @cached_property
    def beside(self) -> Bytes:
        """Bit d: the neighbour in direction d is an obstacle."""
        blocked = np.pad(self.occupied, 1)
        rows, cols = self.occupied.shape
        bits = np.zeros((rows, cols), np.uint8)
        for d, (dr, dc) in enumerate(STEPS):
            bits |= blocked[1 + dr : 1 + dr + rows, 1 + dc : 1 + dc + cols].astype(np.uint8) << np.uint8(d)
        return _flat(bits)

    @cached_property
    def unsafe(self) -> Bytes:
        """1 for cells with an obstacle among their 8 neighbours."""
        return _flat(self.obstacles_near > 0)

    @cached_property
    def distance(self) -> NDArray[np.float64]:
        """Distance of each cell's centre to the nearest obstacle's centre, in cells; inf on an empty map."""
        from scipy.ndimage import distance_transform_edt

        if not self.occupied.any():
            return np.full(self.occupied.size, np.inf)
        return np.ascontiguousarray(distance_transform_edt(~self.occupied), np.float64).ravel()

    @cached_property
    def component(self) -> NDArray[np.bool_]:
        """(rows, cols), the cells that can be reached from the start."""
        found = labels(self.occupied, self.corners)
        return np.asarray(found == found.ravel()[self.start])

    @property
    def reachable(self) -> bool:
        """Whether the goal can be reached."""
        return bool(self.component.ravel()[self.goal])

    @cached_property
    def reachable_cells(self) -> Cells:
        """The cells that can be reached from the start, without start and goal."""
        inside = self.component.ravel().copy()
        inside[[self.start, self.goal]] = False
        return np.flatnonzero(inside).astype(np.int32)


def _flat(table: NDArray[np.generic]) -> Bytes:
    return np.ascontiguousarray(table, np.uint8).ravel()
