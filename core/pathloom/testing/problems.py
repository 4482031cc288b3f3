"""The small problems on which components are tried, first populations on them, and each seen from eight sides."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from pathloom.grid import OccupancyGrid
from pathloom.kernel.compose import build
from pathloom.kernel.operators import Sampling
from pathloom.kernel.registry import default_registry
from pathloom.kernel.representation import Population
from pathloom.paths.context import Corners
from pathloom.paths.maps import load_map
from pathloom.paths.problem import Cell, PathProblem

POLICIES: tuple[Corners, ...] = get_args(Corners)
MAPS = ("blocks-12:20%:s3", "iga-map1", "imaga-fig1", "random-9:10:s1", "empty-5", "maze-11:1", "rooms-13:3")
"""Single cells and blocks, wide and narrow ways, with and without detours."""
SYMMETRIES = tuple((turns, mirrored) for mirrored in (False, True) for turns in range(4))
"""Quarter turns, and whether left and right change places."""


@cache
def _map(name: str, corners: Corners) -> OccupancyGrid:
    return load_map(name, corners=corners)


@dataclass(frozen=True)
class Place:
    """A map with a corner policy, of which a fresh problem can be had as often as it takes."""

    map: str
    corners: Corners

    def __str__(self) -> str:
        return f"{self.map} under {self.corners!r}"

    def problem(self) -> PathProblem:
        """Return the problem from bottom left to top right."""
        return PathProblem(_map(self.map, self.corners), corners=self.corners)


def places() -> Iterator[Place]:
    """Yield the places, each policy on the first map before the second."""
    for name in MAPS:
        for corners in POLICIES:
            yield Place(name, corners)


def between(start: Cell, goal: Cell) -> PathProblem:
    """Return the problem between two cells of an open map."""
    return PathProblem(_map("empty-5", "strict"), start=start, goal=goal)


def two_cells() -> PathProblem:
    """Return the problem on a map of two cells, of which one is the start and the other one the goal."""
    return PathProblem(OccupancyGrid(np.zeros((1, 2))), start=(0, 0), goal=(0, 1))


def first_population(problem: PathProblem, n: int = 12, seed: int = 0) -> Population:
    """Return different paths of single steps."""
    trees = build(Sampling, "perturbed-trees", default_registry(), "")
    return trees.sample(problem, n, np.random.default_rng(seed))


def paths_in(population: Population) -> list[list[int]]:
    """Return the flat cell ids of each path, without padding."""
    return [row[row >= 0].tolist() for row in population]


class View:
    """A problem, turned and mirrored."""

    def __init__(
        self, occupied: NDArray[np.bool_], start: Cell, goal: Cell, corners: Corners, symmetry: tuple[int, bool]
    ) -> None:
        turns, mirrored = symmetry
        here: NDArray[np.intp] = np.rot90(np.arange(occupied.size).reshape(occupied.shape), turns)
        here = np.ascontiguousarray(here[:, ::-1] if mirrored else here)
        self.old = here.ravel().astype(np.int32)
        self.new = np.argsort(self.old).astype(np.int32)
        cols = int(here.shape[-1])
        ends = [divmod(int(self.new[r * occupied.shape[1] + c]), cols) for r, c in (start, goal)]
        self.problem = PathProblem(OccupancyGrid(occupied.ravel()[here]), start=ends[0], goal=ends[1], corners=corners)

    def there(self, population: Population) -> Population:
        """Return paths as they are on the turned map."""
        return np.where(population < 0, -1, self.new[population])

    def back(self, population: Population) -> Population:
        """Return paths of the turned map as they are on the first one."""
        return np.where(population < 0, -1, self.old[population])


@cache
def views(corners: Corners = "no-squeeze") -> tuple[View, ...]:
    """Return one problem from its eight sides; the first is as it was, 15 × 12 cells."""
    occupied = np.ascontiguousarray(_map("blocks-15:22%:s4", "strict").occupied[:, :12])
    return tuple(View(occupied, (13, 1), (2, 10), corners, symmetry) for symmetry in SYMMETRIES)
