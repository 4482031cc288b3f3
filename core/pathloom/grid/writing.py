"""Write a map to a file, whole or not at all."""

from collections.abc import Callable
from pathlib import Path

from pathloom.files import FilePath, refusal, replace, shown
from pathloom.grid.movingai import render_movingai
from pathloom.grid.occupancy import OccupancyGrid
from pathloom.grid.table import render_npy, render_table
from pathloom.naming import meant

RENDERERS: dict[str, Callable[[OccupancyGrid], bytes]] = {
    ".map": render_movingai,
    ".csv": lambda grid: render_table(grid, ","),
    ".txt": lambda grid: render_table(grid, " "),
    ".npy": render_npy,
}


def write_map(grid: OccupancyGrid, path: FilePath) -> None:
    """Write the cells of a map in the format that the suffix names.

    A file that stands there is replaced at once, when the new one is complete. None of
    the formats holds resolution and origin.

    Parameters
    ----------
    grid
        The map.
    path
        `.map` (Moving AI), `.csv` (commas), `.txt` (blanks) or `.npy`.

    Raises
    ------
    MapError
        If the suffix is none of these, or the folder is missing or not writable.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in RENDERERS:
        found = f"the suffix {shown(suffix)}" if suffix else "no suffix"
        raise refusal(path, "", found, " ".join(RENDERERS), meant(suffix, RENDERERS))
    replace(path, RENDERERS[suffix](grid))
