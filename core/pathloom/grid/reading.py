"""Read a map of any supported format, told apart by content and suffix."""

import math
from collections.abc import Callable
from pathlib import Path

from pathloom.errors import MapError
from pathloom.files import FilePath, content, refusal, shown
from pathloom.grid.image import read_image
from pathloom.grid.movingai import read_movingai
from pathloom.grid.occupancy import OccupancyGrid
from pathloom.grid.ros import check_unknown, read_ros
from pathloom.grid.table import read_npy, read_table
from pathloom.naming import meant

SUFFIXES = {
    ".map": "movingai",
    ".yaml": "ros",
    ".yml": "ros",
    ".png": "image",
    ".pgm": "image",
    ".bmp": "image",
    ".jpg": "image",
    ".jpeg": "image",
    ".csv": "table",
    ".txt": "table",
    ".npy": "npy",
}

BEGINNINGS = {
    b"type octile": "movingai",
    b"\x93NUMPY": "npy",
    b"\x89PNG\r\n\x1a\n": "image",
    b"\xff\xd8\xff": "image",
    b"P2\n": "image",
    b"P5\n": "image",
}
"""First bytes that no other format has: they count for more than the suffix."""


def read_map(path: FilePath, *, unknown: str = "occupied", threshold: float | None = None) -> OccupancyGrid:
    """Return the map of a file.

    Parameters
    ----------
    path
        Moving AI `.map`; ROS `.yaml`; image `.png .pgm .bmp .jpg`; table `.csv .txt .npy`.
    unknown
        What unknown cells of a ROS map become, `occupied` or `free`.
    threshold
        Grey from 0 to 255 below which a pixel of an image is occupied; None is 128. ROS
        maps bring their own thresholds.

    Raises
    ------
    MapError
        If an argument is out of its range, the format is none of these, or the file
        cannot be read as what it seems to be.
    """
    check_unknown(unknown)
    if threshold is not None and not (math.isfinite(threshold) and 0.0 <= threshold <= 255.0):
        raise MapError(f"threshold: found {threshold}, allowed a grey from 0 to 255")
    readers: dict[str, Callable[[], OccupancyGrid]] = {
        "movingai": lambda: read_movingai(path),
        "ros": lambda: read_ros(path).grid(unknown=unknown),
        "image": lambda: read_image(path, threshold=threshold),
        "table": lambda: read_table(path),
        "npy": lambda: read_npy(path),
    }
    return readers[_format(path)]()


def _format(path: FilePath) -> str:
    """Return which reader a file needs."""
    beginning = content(path, first=max(map(len, BEGINNINGS)))
    for bytes_, kind in BEGINNINGS.items():
        if beginning.startswith(bytes_):
            return kind
    suffix = Path(path).suffix.lower()
    if suffix in SUFFIXES:
        return SUFFIXES[suffix]
    found = f"the suffix {shown(suffix)}" if suffix else "no suffix"
    if suffix == ".scen":
        found, hint = "a scenario", "a scenario names its map"
    else:
        hint = meant(suffix, SUFFIXES)
    raise refusal(path, "", found, f"a map: {' '.join(SUFFIXES)}", hint)
