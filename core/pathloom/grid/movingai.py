"""Maps of the Moving AI benchmarks: four header lines, then one glyph a cell.

Format: N. R. Sturtevant (2012), Benchmarks for Grid-Based Pathfinding, IEEE Transactions
on Computational Intelligence and AI in Games 4(2), doi:10.1109/TCIAIG.2012.2197681.
"""

import re
from pathlib import Path

import numpy as np

from pathloom.files import LARGEST_MAP, FilePath, lines, refusal, shown
from pathloom.grid.occupancy import OccupancyGrid
from pathloom.naming import meant

FREE = ".GS"
"""Ground, also written G, and swamp, which a walker enters from ordinary ground."""

BLOCKED = "@OTW"
"""Outside, also written O, trees, and water, which a walker does not enter from ground."""

GLYPHS = ". G S (free), @ O T W (blocked)"
HEADER = ("type", "height", "width", "map")


def read_movingai(path: FilePath) -> OccupancyGrid:
    """Return the map of a `.map` file of type octile.

    LF and CRLF, a missing line end after the last row and blank lines after it are fine.

    Raises
    ------
    MapError
        If the file cannot be read, or is not such a map; says in which line and column
        (from 1) what was found.
    """
    text = lines(path)
    height, width = _size(path, text)
    rows = text[len(HEADER) :]
    for number, row in enumerate(rows[:height], start=len(HEADER) + 1):
        _check_row(path, number, row, width)
    if len(rows) != height:
        number = len(HEADER) + min(len(rows), height) + 1
        found = f"the end after {len(rows)} rows" if len(rows) < height else f"more: {shown(rows[height])}"
        raise refusal(path, f"line {number}", found, f"{height} rows, as line 2 says")
    glyphs = np.frombuffer("".join(rows).encode("ascii"), dtype=np.uint8)
    occupied = np.isin(glyphs, np.frombuffer(BLOCKED.encode("ascii"), dtype=np.uint8))
    return OccupancyGrid(occupied.reshape(height, width), name=Path(path).name)


def render_movingai(grid: OccupancyGrid) -> bytes:
    """Return a map as the bytes of a `.map` file, `.` and `@` for its cells."""
    glyphs = np.where(grid.occupied, np.uint8(ord("@")), np.uint8(ord(".")))
    rows = "".join(f"{row.tobytes().decode('ascii')}\n" for row in glyphs)
    return f"type octile\nheight {grid.height}\nwidth {grid.width}\nmap\n{rows}".encode("ascii")


def _size(path: FilePath, text: list[str]) -> tuple[int, int]:
    """Return height and width from the header."""
    values = []
    for number, key in enumerate(HEADER, start=1):
        line = text[number - 1] if number <= len(text) else ""
        word, _, value = line.strip().partition(" ")
        wanted = {"type": "'type octile'", "map": "'map'"}.get(key, f"'{key} N'")
        if word != key or (key == "map" and value):
            found = shown(line) if number <= len(text) else "the end of the file"
            raise refusal(path, f"line {number}", found, wanted, meant(word, [key]) if word != key else "")
        values.append(value.strip())
    kind, height, width = values[:3]
    if kind != "octile":
        raise refusal(path, "line 1, column 6", f"the type {shown(kind)}", "the type 'octile'")
    for number, value in ((2, height), (3, width)):
        if not re.fullmatch("[0-9]{1,9}", value) or int(value) == 0:
            column = len(HEADER[number - 1]) + 2
            raise refusal(path, f"line {number}, column {column}", shown(value), "a whole number from 1")
    if int(height) * int(width) > LARGEST_MAP:
        raise refusal(path, "line 2", f"a map of {height} x {width} cells", f"at most {LARGEST_MAP} cells")
    return int(height), int(width)


def _check_row(path: FilePath, number: int, row: str, width: int) -> None:
    wrong = set(row).difference(FREE, BLOCKED)
    if wrong:
        column = min(row.index(glyph) for glyph in wrong)
        raise refusal(path, f"line {number}, column {column + 1}", shown(row[column]), GLYPHS)
    if len(row) != width:
        column = min(len(row), width) + 1
        found = f"a row of {len(row)} cells"
        raise refusal(path, f"line {number}, column {column}", found, f"{width}, as line 3 says")
