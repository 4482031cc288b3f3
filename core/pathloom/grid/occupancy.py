"""The map that everything else plans on: which cells are occupied, and where they lie."""

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.errors import MapError

Origin = tuple[float, float, float]
"""x and y in metres of the lower-left corner of the lower-left cell, yaw in radians."""


@dataclass(frozen=True, init=False, eq=False, repr=False)
class OccupancyGrid:
    """An occupancy grid with, where known, its place in the world.

    Parameters
    ----------
    occupied
        (height, width), anything that numpy takes for booleans or for the numbers 0
        (free) and 1 (occupied); row 0 is the top. A read-only copy is kept.
    resolution
        Side of a cell in metres.
    origin
        x, y (metres) and yaw (radians, counter-clockwise) of the lower-left corner of
        the lower-left cell, or None for a map with no place in the world.
    name
        What messages and tables call the map; not part of its content.

    Raises
    ------
    MapError
        If the cells are not a filled rectangle of 0 and 1, the resolution is not a
        positive number, or the origin is not three finite numbers.
    """

    occupied: NDArray[np.bool_]
    resolution: float
    origin: Origin | None
    name: str

    def __init__(
        self,
        occupied: ArrayLike,
        *,
        resolution: float = 1.0,
        origin: Sequence[float] | None = None,
        name: str = "",
    ) -> None:
        cells = _cells(occupied)
        cells.setflags(write=False)
        # A frozen dataclass lets nobody assign, not even its own constructor.
        object.__setattr__(self, "occupied", cells)
        object.__setattr__(self, "resolution", _resolution(resolution))
        object.__setattr__(self, "origin", None if origin is None else _origin(origin))
        object.__setattr__(self, "name", str(name))

    @property
    def height(self) -> int:
        """Number of rows."""
        return int(self.occupied.shape[0])

    @property
    def width(self) -> int:
        """Number of columns."""
        return int(self.occupied.shape[1])

    @property
    def shape(self) -> tuple[int, int]:
        """(height, width)."""
        return self.height, self.width

    @property
    def metric(self) -> bool:
        """Whether the size of a cell in metres is known: it has a place in the world, or a size of its own."""
        return self.origin is not None or self.resolution != 1.0

    @cached_property
    def free_count(self) -> int:
        """Number of free cells."""
        return self.occupied.size - int(np.count_nonzero(self.occupied))

    @cached_property
    def sha256(self) -> str:
        """Hex digest of size and cells: the same for the same cells, whatever file they came from."""
        digest = hashlib.sha256(f"{self.height} {self.width}\n".encode("ascii"))
        digest.update(np.packbits(self.occupied).tobytes())
        return digest.hexdigest()

    def world(self, cells: ArrayLike) -> NDArray[np.float64]:
        """Return where cell centres lie.

        Parameters
        ----------
        cells
            (n, 2), row and column; also of cells outside the map.

        Returns
        -------
        (n, 2), x and y in metres.

        Raises
        ------
        MapError
            If the map has no origin.
        """
        x0, y0, yaw = self._placed()
        row, col = np.asarray(cells, dtype=np.float64).reshape(-1, 2).T
        along = (col + 0.5) * self.resolution
        up = (self.height - 0.5 - row) * self.resolution
        cos, sin = math.cos(yaw), math.sin(yaw)
        return np.stack((x0 + cos * along - sin * up, y0 + sin * along + cos * up), axis=1)

    def cell_at(self, x: float, y: float) -> tuple[int, int]:
        """Return (row, col) of the cell that holds a point.

        A border shared by two cells belongs to the one on its right or above it.

        Parameters
        ----------
        x, y
            The point, in metres.

        Raises
        ------
        MapError
            If the map has no origin, or the point lies outside the map.
        """
        x0, y0, yaw = self._placed()
        cos, sin = math.cos(yaw), math.sin(yaw)
        along = (cos * (x - x0) + sin * (y - y0)) / self.resolution
        up = (cos * (y - y0) - sin * (x - x0)) / self.resolution
        if not (0.0 <= along < self.width and 0.0 <= up < self.height):  # NaN is outside, too
            wide, high = self.width * self.resolution, self.height * self.resolution
            turned = f", turned by {yaw:g} rad" if yaw else ""
            raise MapError(
                f"{self.name or 'map'}: found the point ({x:g}, {y:g}) m, allowed a point in the "
                f"{wide:g} m x {high:g} m from the lower-left corner ({x0:g}, {y0:g}) on{turned}"
            )
        return self.height - 1 - math.floor(up), math.floor(along)

    def _placed(self) -> Origin:
        if self.origin is None:
            raise MapError(
                f"{self.name or 'map'}: found no origin, allowed world coordinates only on a map "
                "with one (as in the .yaml of a ROS map)"
            )
        return self.origin

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, OccupancyGrid):
            return NotImplemented
        return (
            self.resolution == other.resolution
            and self.origin == other.origin
            and np.array_equal(self.occupied, other.occupied)
        )

    def __hash__(self) -> int:
        return hash((self.sha256, self.resolution, self.origin))

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        return f"<OccupancyGrid {name}{self.height} x {self.width}, {self.free_count} free>"

    def _repr_svg_(self) -> str:
        """Return the map, for notebooks."""
        from pathloom.grid.svg import picture

        return picture(self.occupied)

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.occupied.setflags(write=False)  # numpy forgets this on its way through pickle


def _cells(occupied: ArrayLike) -> NDArray[np.bool_]:
    try:
        array = np.asarray(occupied)
    except (ValueError, TypeError) as error:
        raise MapError("map: found rows of unequal length, allowed a rectangle of 0 and 1") from error
    if array.ndim != 2 or array.size == 0:
        raise MapError(f"map: found an array of shape {array.shape}, allowed (height, width), both 1 or more")
    if array.dtype.kind not in "biuf":
        raise MapError(f"map: found cells of type {array.dtype}, allowed booleans or the numbers 0 and 1")
    if array.dtype.kind != "b":
        with np.errstate(invalid="ignore"):
            wrong = np.argwhere((array != 0) & (array != 1))  # NaN equals neither
        if wrong.size:
            row, col = (int(index) for index in wrong[0])
            raise MapError(f"map: row {row}, col {col}: found {array[row, col]}, allowed 0 (free), 1 (occupied)")
    return np.array(array, dtype=np.bool_, order="C", copy=True, subok=False)


def _resolution(value: float) -> float:
    try:
        resolution = float(value)
    except (TypeError, ValueError, OverflowError):
        resolution = math.nan
    if not (math.isfinite(resolution) and resolution > 0.0):
        raise MapError(f"map: resolution: found {value!r}, allowed metres per cell above 0")
    return resolution


def _origin(value: Sequence[float]) -> Origin:
    try:
        x, y, yaw = (float(number) for number in value)
    except (TypeError, ValueError, OverflowError):
        x = y = yaw = math.nan
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(yaw)):
        raise MapError(f"map: origin: found {value!r}, allowed x and y in metres and yaw in radians")
    return x, y, yaw
