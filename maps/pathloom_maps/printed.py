"""Maps printed in the papers, row by row as printed: the first line is the top."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import Map, OccupancyGrid
from pathloom.paths.context import Corners


def _grid(name: str, drawing: str) -> OccupancyGrid:
    return OccupancyGrid([[glyph == "#" for glyph in line] for line in drawing.split()], name=name)


@dataclass(frozen=True, kw_only=True)
class IgaMap1(Map):
    """Map 1 of Liu et al. 2024, 10×10 with 34 obstacles.

    The text does not say which line is row 1; only with row 1 at the bottom does
    the paper's example individual stand on free cells.
    """

    name: ClassVar[str] = "iga-map1"
    source: ClassVar[str] = "Liu et al. 2024, fig. 1(a)"

    def grid(self, corners: Corners = "strict") -> OccupancyGrid:
        return _grid(
            self.name,
            """
            ..........
            .#..#..##.
            #.#.....#.
            ....#.##..
            ...##..#..
            .#..#.....
            #.#....###
            #...##...#
            ..#.#.#.##
            ..#.#.#.##
            """,
        )


@dataclass(frozen=True, kw_only=True)
class ImagaFig1(Map):
    """The grid of fig. 1 of Zhang et al. 2023, 10×10 with 21 obstacles."""

    name: ClassVar[str] = "imaga-fig1"
    source: ClassVar[str] = "Zhang et al. 2023, fig. 1"

    def grid(self, corners: Corners = "strict") -> OccupancyGrid:
        return _grid(
            self.name,
            """
            ..........
            .##..#....
            ..........
            ..##..#...
            .###......
            .##....##.
            ........#.
            ...#.##...
            ..##.##...
            ..........
            """,
        )
