"""Maps as tables of 0 (free) and 1 (occupied): text, and numpy's own `.npy`."""

import io
import math
import warnings
from pathlib import Path

import numpy as np

from pathloom.errors import MapError
from pathloom.files import LARGEST_MAP, FilePath, content, lines, refusal, shown
from pathloom.grid.occupancy import OccupancyGrid

VALUES = {"0": False, "1": True}
ALLOWED = "0 (free) or 1 (occupied)"


def read_table(path: FilePath) -> OccupancyGrid:
    """Return the map of a text with one line a row.

    Values are apart by commas, semicolons, tabs or blanks, one kind in all lines, or by
    nothing, as in `0110`. `1.0` and `0.000e+00`, as numpy writes them, are 1 and 0.

    Raises
    ------
    MapError
        If the file cannot be read, rows differ in length, or a value is neither 0 nor 1;
        says in which line and which column of the table, from 1.
    """
    text = lines(path)
    separator = _separator(text[0])
    rows: list[list[bool]] = []
    for number, line in enumerate(text, start=1):
        words = _words(line, separator)
        try:
            row = [VALUES[word] for word in words]
        except KeyError:
            row = [_value(path, f"line {number}, column {col}", word) for col, word in enumerate(words, start=1)]
        if not row or (rows and len(row) != len(rows[0])):
            allowed = f"{len(rows[0])}, as in line 1" if rows else "one value or more"
            raise refusal(path, f"line {number}", f"{len(row)} values", allowed)
        rows.append(row)
    if len(rows) * len(rows[0]) > LARGEST_MAP:
        raise refusal(path, "", f"{len(rows)} x {len(rows[0])} values", f"at most {LARGEST_MAP}")
    return OccupancyGrid(np.array(rows, dtype=np.bool_), name=Path(path).name)


def read_npy(path: FilePath) -> OccupancyGrid:
    """Return the map of a `.npy` file: two dimensions, booleans or the numbers 0 and 1.

    Objects are refused: to load them is to run what they contain.

    Raises
    ------
    MapError
        If the file cannot be read, is not such a file, or its cells are something else.
    """
    stream = io.BytesIO(content(path))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about headers of Python 2
            version = np.lib.format.read_magic(stream)
            read_header = {
                (1, 0): np.lib.format.read_array_header_1_0,
                (2, 0): np.lib.format.read_array_header_2_0,
            }[version]
            shape, by_columns, dtype = read_header(stream)
    except Exception as error:  # the header is Python text; its parsers raise nearly anything
        cause = str(error) or type(error).__name__
        raise refusal(path, "header", f"a damaged one ({cause})", "that of a numpy array") from error
    if len(shape) != 2 or dtype.kind not in "biuf":
        found = f"an array of shape {shown(shape)} and type {shown(str(dtype))}"
        raise refusal(path, "header", found, "two dimensions of booleans or numbers")
    count = math.prod(shape)
    if count > LARGEST_MAP:
        raise refusal(path, "header", f"{count} cells", f"at most {LARGEST_MAP}")
    values = stream.read()
    if len(values) != count * dtype.itemsize:
        raise refusal(path, "", f"{len(values)} bytes of cells", f"{count * dtype.itemsize}, as the header says")
    if dtype.kind == "b":  # any byte but 0 would pass for true
        dtype = np.dtype(np.uint8)
    cells = np.frombuffer(values, dtype=dtype).reshape(shape, order="F" if by_columns else "C")
    try:
        return OccupancyGrid(cells, name=Path(path).name)
    except MapError as error:
        raise MapError(f"{path}: {error}") from error


def render_table(grid: OccupancyGrid, separator: str) -> bytes:
    """Return a map as text, one line a row, with that between the values."""
    rows = (separator.join(map(str, row)) for row in grid.occupied.astype(np.uint8).tolist())
    return "".join(f"{row}\n" for row in rows).encode("ascii")


def render_npy(grid: OccupancyGrid) -> bytes:
    """Return a map as the bytes of a `.npy` file of booleans."""
    stream = io.BytesIO()
    np.save(stream, grid.occupied, allow_pickle=False)
    return stream.getvalue()


def _separator(line: str) -> str:
    """Return what keeps the values of a line apart; blank for all white space, or nothing."""
    for sign in (",", ";"):
        if sign in line:
            return sign
    return "" if line.strip().isdigit() else " "


def _words(line: str, separator: str) -> list[str]:
    if separator in {",", ";"}:
        return [word.strip() for word in line.split(separator)]
    return line.split() if separator else list(line.strip())


def _value(path: FilePath, where: str, word: str) -> bool:
    if word in VALUES:
        return VALUES[word]
    try:
        number = float(word)
    except ValueError:
        number = math.nan
    if number not in (0.0, 1.0):
        raise refusal(path, where, shown(word) if word else "nothing", ALLOWED)
    return number == 1.0
