"""A small picture of map and path for the terminal, which reads as well without colour."""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.draw.raster import Mask, Path, coarse, crossed

if TYPE_CHECKING:
    from rich.text import Text

Cell = tuple[int, int]

LOOKS = {
    " ": "",  # free
    "#": "bright_black",  # obstacle
    ":": "bright_black",  # closed by the radius
    "*": "bold cyan",  # path
    "o": "bold cyan",  # node of the path
    "S": "bold white on green",
    "G": "bold white on red",
    "+": "bright_black",  # frame
}
"""Styles of what a character stands for."""

BRAILLE = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
"""Bits of the 4 x 2 dots of a Braille character, from U+2800 on."""

QUADRANTS = " ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█"
"""Characters with whole quarters, by the sum of 1 upper left, 2 upper right, 4 lower left, 8 lower right."""


def picture(
    occupied: ArrayLike,
    *,
    closed: ArrayLike | None = None,
    start: Cell,
    goal: Cell,
    path: ArrayLike | None = None,
    width: int = 72,
    height: int = 24,
) -> "Text":
    """Return a picture of a map with its path, framed, in lines of equal width.

    A cell takes two characters where that fits. A larger map is drawn in dots,
    eight to a character; a dot stands for a block of cells, of which thin walls
    stay visible. The path marks every cell, or character, that it crosses, with
    a larger mark at its nodes where a cell can be seen.

    Parameters
    ----------
    occupied
        (rows, cols) bool, row 0 at the top.
    closed
        (rows, cols) bool, what the robot's radius closes.
    start, goal
        (row, column), drawn as S and G.
    path
        (k, 2) cells.
    width, height
        Most characters and lines, frame included; at least 3 each.
    """
    from rich.text import Text

    walls = np.asarray(occupied, bool)
    rims = np.zeros_like(walls) if closed is None else np.asarray(closed, bool) & ~walls
    nodes = np.asarray([] if path is None else path, np.int64).reshape(-1, 2)
    room = max(width - 2, 1), max(height - 2, 1)
    rows, cols = walls.shape
    large = 2 * cols > room[0] or rows > room[1]
    signs, kinds = (_dots if large else _cells)(walls, rims, nodes, (start, goal), room)

    text = Text(no_wrap=True, end="")
    edge = "─" * len(signs[0])
    text.append(f"┌{edge}┐\n", LOOKS["+"])
    for line, kind in zip(signs, kinds, strict=True):
        text.append("│", LOOKS["+"])
        cuts = [0, *(i for i in range(1, len(line)) if kind[i] != kind[i - 1]), len(line)]
        for first, after in pairwise(cuts):
            text.append("".join(line[first:after]), LOOKS[kind[first]])
        text.append("│\n", LOOKS["+"])
    text.append(f"└{edge}┘", LOOKS["+"])
    return text


Signs = tuple[list[list[str]], list[list[str]]]
"""Characters, and for each what it stands for, line by line."""


def _cells(walls: Mask, rims: Mask, path: Path, ends: tuple[Cell, Cell], _: tuple[int, int]) -> Signs:
    """Draw each cell as two characters, which make about a square."""
    kinds = np.where(walls, "#", np.where(rims, ":", " "))
    for mark, cells in (("*", crossed(path)), ("o", path)):
        kinds[cells[:, 0], cells[:, 1]] = mark
    kinds[ends[0]], kinds[ends[1]] = "S", "G"
    look = {" ": "  ", "#": "██", ":": "░░", "*": "••", "o": "●●", "S": "S ", "G": "G "}
    return [list("".join(look[k] for k in row)) for row in kinds], [list(np.repeat(row, 2)) for row in kinds]


def _dots(walls: Mask, rims: Mask, path: Path, ends: tuple[Cell, Cell], room: tuple[int, int]) -> Signs:
    """Draw the map in dots, 2 x 4 to a character, and the path in characters over it."""
    rows, cols = walls.shape
    scale = min(2 * room[0] / cols, 4 * room[1] / rows)  # dots for each cell
    if scale > 1:
        scale = int(scale)
    high = max(1, min(round(rows * scale), 4 * room[1]))
    wide = max(1, min(round(cols * scale), 2 * room[0]))
    solid = coarse(walls, high, wide)
    rim = coarse(rims | walls, high, wide) & ~solid
    lines, chars = -(-high // 4), -(-wide // 2)
    down, across = np.indices(solid.shape)
    blocks = _blocks(solid, lines, chars)
    shaded = _blocks(solid | (rim & ((down + across) % 2 == 0)), lines, chars)  # every other dot
    signs, kinds = [], []
    for plain, full in zip(blocks, shaded, strict=True):
        signs.append([_sign(block) for block in full])
        kinds.append(["#" if p.any() else ":" if f.any() else " " for p, f in zip(plain, full, strict=True)])

    def place(cells: NDArray[np.int64]) -> list[tuple[int, int]]:
        """Return line and character of the dot at the middle of each cell."""
        dots = (2 * cells + 1) * np.array([high, wide]) // (2 * np.array([rows, cols]))
        return [(int(r) // 4, int(c) // 2) for r, c in dots]

    for mark, cells in (("●", crossed(path)), ("S", np.array(ends[:1])), ("G", np.array(ends[1:]))):
        for line, char in place(cells):
            signs[line][char] = mark
            kinds[line][char] = "*" if mark == "●" else mark
    return signs, kinds


def _blocks(mask: Mask, lines: int, chars: int) -> NDArray[np.bool_]:
    """Return a mask (4 lines, 2 chars) as (lines, chars, 4, 2), free beyond its edges."""
    full = np.zeros((4 * lines, 2 * chars), bool)
    full[: mask.shape[0], : mask.shape[1]] = mask
    return full.reshape(lines, 4, chars, 2).swapaxes(1, 2)


def _sign(dots: Mask) -> str:
    """Return the character with these dots: a solid one where its quarters are whole, else Braille."""
    upper, lower = dots[:2], dots[2:]
    if (upper[0] == upper[1]).all() and (lower[0] == lower[1]).all():
        return QUADRANTS[int(upper[0] @ [1, 2] + lower[0] @ [4, 8])]
    return chr(0x2800 + int(BRAILLE[dots].sum()))
