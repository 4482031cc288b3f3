"""From what is drawn on the page to a path problem, and from maps to the page."""

import re
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import MapError, PathloomError, ProblemError
from pathloom.grid import OccupancyGrid, read_map
from pathloom.paths.maps import MapFamily, map_of
from pathloom.paths.problem import PathProblem
from pathloom.planning import no_way
from pathloom.studio.wire import LONGEST_SIDE, Drawn, Files, Look, Map, Named, Refused, Scene

PLACES = ("start", "goal", "map", "planner", "seed")
"""Parts of the page that a message can belong to."""


def grid_of(drawn: Drawn) -> OccupancyGrid:
    """Return the map that was drawn.

    Raises
    ------
    MapError
        If there are more or fewer bits than cells.
    """
    cells = drawn.rows * drawn.cols
    if len(drawn.bits) != -(-cells // 8):
        raise MapError(f"map: found {len(drawn.bits)} bytes, allowed {-(-cells // 8)} for {drawn.rows} x {drawn.cols}")
    occupied = np.unpackbits(np.frombuffer(drawn.bits, np.uint8), count=cells)
    return OccupancyGrid(occupied.reshape(drawn.rows, drawn.cols).astype(bool), name="studio")


def drawn(occupied: NDArray[np.bool_]) -> Drawn:
    """Return a map (rows, cols) for the page.

    Raises
    ------
    MapError
        If a side is longer than the page takes.
    """
    rows, cols = occupied.shape
    if max(rows, cols) > LONGEST_SIDE:
        raise MapError(f"map: found {rows} x {cols} cells, allowed at most {LONGEST_SIDE} along a side")
    return Drawn(rows, cols, np.packbits(occupied).tobytes())


def problem_of(scene: Scene) -> PathProblem:
    """Return the problem of a scene.

    Raises
    ------
    MapError, ProblemError
        If the map or an end of the path cannot be used. An unreachable goal is not told here.
    """
    grid = grid_of(scene.map)
    return PathProblem(grid, start=scene.start, goal=scene.goal, radius=scene.radius, corners=scene.corners)


def reachable_problem_of(scene: Scene) -> PathProblem:
    """Return the problem of a scene; an unreachable goal is an error of the goal."""
    problem = problem_of(scene)
    if not problem.reachable:
        raise ProblemError(f"goal: {no_way(problem)}")
    return problem


def look_at(scene: Scene) -> Look:
    """Say whether there is a way at all, and which cells the radius closes."""
    closed = None
    if scene.radius:
        from pathloom.grid import inflate

        closed = np.packbits(inflate(grid_of(scene.map).occupied, scene.radius)).tobytes()
    try:
        reachable_problem_of(scene)
    except PathloomError as error:
        return Look(refusal(error), closed)
    return Look(None, closed)


def refusal(error: Exception, lane: int | None = None, run: int | None = None) -> Refused:
    """Return what an error says, and where on the page."""
    text = " ".join(str(error).split())
    where, _, rest = text.partition(":")
    if where in PLACES[:2]:
        return Refused(where, rest.strip(), lane, run)
    head = re.split(r"[.:\[]", text, maxsplit=1)[0]
    return Refused(head if head in PLACES else "", text, lane, run)


def named_map(asked: Named) -> Map:
    """Return a registered or generated map; files are not looked at.

    Raises
    ------
    MapError
        If there is none of this name, or it is too large.
    """
    found = map_of(asked.name)
    if isinstance(found, MapFamily) and found.size > LONGEST_SIDE:
        raise MapError(f"map: found a size of {found.size}, allowed at most {LONGEST_SIDE} along a side")
    return Map(drawn(found.grid(asked.corners).occupied), asked.name)


def read_files(sent: Files) -> Map:
    """Return the map in files that somebody chose.

    Raises
    ------
    MapError
        If they are no map.
    """
    with tempfile.TemporaryDirectory(prefix="pathloom-studio-") as folder:
        paths = [Path(folder) / _plain(name) for name in sent.files]
        for path, content in zip(paths, sent.files.values(), strict=True):
            path.write_bytes(content)
        first = next((path for path in paths if path.suffix.lower() in (".yaml", ".yml")), paths[0])
        try:
            grid = read_map(first)
        except MapError as error:
            raise MapError(str(error).replace(folder, "").replace("\\", "/").lstrip("/")) from None
    note = ""
    if grid.metric:
        note = f"A cell of this map is {grid.resolution:g} m wide; the studio reckons in cells."
    return Map(drawn(grid.occupied), "", note)


def _plain(name: str) -> str:
    """Return the last part of a file's name, in signs that every system takes."""
    last = re.split(r"[/\\]", name)[-1]
    cleaned = re.sub(r"[^\w.\- ]", "_", last)[-100:].lstrip(".")
    return cleaned or "map"
