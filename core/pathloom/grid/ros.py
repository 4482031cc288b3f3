"""Maps of the ROS and Nav2 map servers: a `.yaml` that explains the greys of an image.

The three modes follow the map server's documentation,
https://docs.ros.org/en/rolling/p/nav2_map_server/ and http://wiki.ros.org/map_server
(sections on the YAML and on value interpretation).
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import MapError
from pathloom.files import FilePath, neighbour, one_line, refusal, shown, text
from pathloom.grid.image import Picture, read_picture
from pathloom.grid.occupancy import OccupancyGrid, Origin
from pathloom.naming import meant

REQUIRED = ("image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")

UNKNOWN = ("occupied", "free")
"""What unknown cells can become."""

LONGEST_YAML = 1 << 16
"""Characters; a real file has a few lines, and YAML can be made slow to read."""

DEEPEST_YAML = 8
"""Levels of nesting; a real file has two."""

Cells = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class RosMap:
    """A ROS map with its three classes of cells.

    Parameters
    ----------
    occupied, free
        (H, W) each, row 0 the highest y; a cell in neither is unknown.
    resolution
        Metres per cell.
    origin
        x, y (metres) and yaw (radians) of the lower-left corner of the lower-left cell.
    name
        The file's name.
    """

    occupied: Cells
    free: Cells
    resolution: float
    origin: Origin
    name: str

    @property
    def unknown(self) -> Cells:
        """(H, W): neither occupied nor free."""
        return ~(self.occupied | self.free)

    def grid(self, *, unknown: str = "occupied") -> OccupancyGrid:
        """Return the map with its unknown cells `occupied` or `free`.

        Raises
        ------
        MapError
            If `unknown` is neither.
        """
        check_unknown(unknown)
        occupied = self.occupied if unknown == "free" else ~self.free
        return OccupancyGrid(occupied, resolution=self.resolution, origin=self.origin, name=self.name)


def check_unknown(unknown: str) -> None:
    """Refuse what unknown cells cannot become."""
    if unknown not in UNKNOWN:
        raise MapError(f"unknown: found {unknown!r}, allowed {' or '.join(map(repr, UNKNOWN))}")


def read_ros(path: FilePath) -> RosMap:
    """Return the map of a `.yaml` and its image.

    With p = (255 - grey) / 255, or grey / 255 where `negate` is set:

    `trinary` (where no mode is given)
        occupied if p > occupied_thresh, free if p < free_thresh, else unknown.
    `scale`
        occupied if p >= occupied_thresh, free if p <= free_thresh. The server grades what
        lies between; a planner that needs yes or no takes it for unknown, as it takes
        every pixel that is not fully opaque.
    `raw`
        the grey itself is the percentage, unknown above 100; `negate` has no meaning.
        Occupied if grey / 100 > occupied_thresh, free if grey / 100 < free_thresh.

    In `trinary` and `raw` transparency is ignored; in `trinary` the servers average it in
    as if it were one more colour.

    Raises
    ------
    MapError
        If the file cannot be read, is not plain YAML, lacks a key or has a wrong value,
        or if its image is missing or damaged.
    """
    keys = _mapping(path)
    for key in REQUIRED:
        if key not in keys:
            others = [other for other in keys if isinstance(other, str) and other not in REQUIRED]
            near = meant(key, others)
            raise refusal(path, key, "no such key", f"a file with {', '.join(REQUIRED)}", near)
    resolution = _number(path, "resolution", keys["resolution"])
    if resolution <= 0.0:
        raise refusal(path, "resolution", shown(keys["resolution"]), "metres per cell above 0")
    origin = _origin(path, keys["origin"])
    negate = keys["negate"]
    if not isinstance(negate, bool | int) or negate not in (0, 1):
        raise refusal(path, "negate", shown(negate), "0 or 1")
    occupied_thresh, free_thresh = (_share(path, key, keys[key]) for key in ("occupied_thresh", "free_thresh"))
    if free_thresh > occupied_thresh:
        raise refusal(path, "free_thresh", f"{free_thresh}", f"at most occupied_thresh, {occupied_thresh}")
    mode = keys.get("mode", "trinary")
    if not isinstance(mode, str) or mode.lower() not in MODES:
        hint = meant(mode, MODES) if isinstance(mode, str) else ""
        raise refusal(path, "mode", shown(mode), ", ".join(MODES), hint)
    picture = read_picture(_image_path(path, keys["image"]))
    occupied, free = MODES[mode.lower()](picture, bool(negate), occupied_thresh, free_thresh)
    return RosMap(occupied, free, resolution, origin, Path(path).name)


def _trinary(picture: Picture, negate: bool, occupied: float, free: float) -> tuple[Cells, Cells]:
    p = _probability(picture, negate)
    return p > occupied, p < free


def _scale(picture: Picture, negate: bool, occupied: float, free: float) -> tuple[Cells, Cells]:
    p = _probability(picture, negate)
    opaque = np.True_ if picture.opacity is None else picture.opacity == 1.0
    full = p >= occupied
    return full & opaque, (p <= free) & ~full & opaque


def _raw(picture: Picture, _negate: bool, occupied: float, free: float) -> tuple[Cells, Cells]:
    percent = np.rint(picture.grey)
    known = percent <= 100.0
    return known & (percent / 100.0 > occupied), known & (percent / 100.0 < free)


def _probability(picture: Picture, negate: bool) -> NDArray[np.float64]:
    """Return how surely each cell is occupied, 0 to 1."""
    return (picture.grey if negate else 255.0 - picture.grey) / 255.0


MODES: dict[str, Callable[[Picture, bool, float, float], tuple[Cells, Cells]]] = {
    "trinary": _trinary,
    "scale": _scale,
    "raw": _raw,
}
"""How each mode finds the occupied and the free cells, by picture, negate and thresholds."""


def _mapping(path: FilePath) -> dict[Any, Any]:
    """Return the keys and values of the YAML; nothing in it is ever executed."""
    import yaml

    source = text(path)
    if len(source) > LONGEST_YAML:
        raise refusal(path, "", f"{len(source)} characters", f"at most {LONGEST_YAML} in a map's YAML")
    try:
        _check_plain(path, source)
        loaded = yaml.safe_load(source)
    except MapError:
        raise
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}" if mark is not None else ""
        raise refusal(path, where, f"a mistake ({error.problem})", "plain YAML") from error
    except Exception as error:  # constructors of dates and numbers raise errors of their own
        raise refusal(path, "", f"a value that YAML cannot take ({one_line(str(error))})", "plain YAML") from error
    if not isinstance(loaded, dict):
        raise refusal(path, "", f"a {type(loaded).__name__}", f"keys and values: {', '.join(REQUIRED)}")
    return loaded


def _check_plain(path: FilePath, source: str) -> None:
    """Refuse tags, and what makes a short YAML huge or endlessly deep, before anything is built."""
    import yaml

    depth = 0
    for event in yaml.parse(source, Loader=yaml.SafeLoader):
        where = f"line {event.start_mark.line + 1}"  # type: ignore[union-attr]
        if isinstance(event, yaml.AliasEvent):  # nine of nine of nine ... fit in a few lines
            raise refusal(path, where, "an alias", "plain values")
        tag = getattr(event, "tag", None)
        if tag is not None:  # such as !!python/object/apply, which asks for a call
            raise refusal(path, where, f"the tag {shown(tag)}", "plain values")
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        if isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > DEEPEST_YAML:
            raise refusal(path, where, f"more than {DEEPEST_YAML} levels of nesting", "keys and values")


def _number(path: FilePath, key: str, value: object) -> float:
    """Return a finite number; `5e-2` is one, though PyYAML (YAML 1.1) takes it for text."""
    number = math.nan
    exponential = isinstance(value, str) and re.fullmatch(r"[+-]?[0-9]{1,20}[eE][+-]?[0-9]{1,3}", value)
    if (isinstance(value, int | float) and not isinstance(value, bool)) or exponential:
        try:
            number = float(value)  # type: ignore[arg-type]
        except OverflowError:
            number = math.inf
    if not math.isfinite(number):
        raise refusal(path, key, shown(value), "a finite number")
    return number


def _share(path: FilePath, key: str, value: object) -> float:
    share = _number(path, key, value)
    if not 0.0 <= share <= 1.0:
        raise refusal(path, key, shown(value), "a number from 0 to 1")
    return share


def _origin(path: FilePath, value: object) -> Origin:
    if not isinstance(value, list) or len(value) != 3:
        raise refusal(path, "origin", shown(value), "[x, y, yaw] in metres and radians")
    x, y, yaw = (_number(path, "origin", number) for number in value)
    return x, y, yaw


def _image_path(path: FilePath, value: object) -> Path:
    """Return the image's path, which counts from the folder of the YAML."""
    if not isinstance(value, str) or not value.strip():
        raise refusal(path, "image", shown(value), "the path of an image")
    if "://" in value:
        raise refusal(path, "image", f"the address {shown(value)}", "the path of a file")
    image = Path(path).parent / value
    try:
        missing = not image.exists()
    except (OSError, ValueError) as error:
        raise refusal(path, "image", shown(value), "the path of a file") from error
    if missing:
        raise refusal(
            path,
            "image",
            f"no file {shown(value)}",
            "an image that exists, named from the folder of the YAML",
            neighbour(image),
        )
    return image
