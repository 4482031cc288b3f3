"""Hazards: obstacles that stand or walk where the map shows nothing, near the way that the robot is to take."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom.errors import ConfigError
from pathloom.grid import OccupancyGrid
from pathloom.kernel.component import Component, NonNegative, Positive, Whole
from pathloom.kernel.evaluation import Floats
from pathloom.local.surroundings import Surroundings

TRIES = 60
"""Draws of a place for each hazard; who finds none is left out."""


@dataclass(frozen=True, kw_only=True)
class Hazards(Component):
    """Discs near the path, which leave the robot room to pass on either side.

    Those that walk go straight on until they meet a wall or the robot, and then in a direction drawn at
    random. They never walk into the robot: whatever is hit, the robot has driven into.
    """

    kind: ClassVar[str] = "hazards"
    name: ClassVar[str] = "hazards"
    source: ClassVar[str] = "ours"

    standing: Whole = 3
    """How many stand, in the way itself."""
    walking: Whole = 3
    """How many walk about, near the way."""
    least: Positive = 0.15
    """Radius of the smallest, in metres."""
    most: Positive = 0.30
    """Radius of the largest, in metres."""
    slowest: NonNegative = 0.1
    """Slowest pace, in metres a second."""
    fastest: NonNegative = 0.4
    """Fastest pace, in metres a second."""
    clear: NonNegative = 1.5
    """How far start and goal are from each of them at first, in metres."""

    def __post_init__(self) -> None:
        super().__post_init__()
        for low, high in (("least", "most"), ("slowest", "fastest")):
            if getattr(self, low) > getattr(self, high):
                found = f"{low} = {getattr(self, low):g}"
                raise ConfigError(f"hazards: found {found}, allowed at most {high} = {getattr(self, high):g}")

    def around(
        self, grid: OccupancyGrid, cell: float, way: Floats, radius: float, rng: np.random.Generator
    ) -> Surroundings:
        """Return the surroundings of a way (k, 2) for a robot of a radius, hazards in their first places; metres."""
        empty = Surroundings(grid, cell)
        standing = self._placed(empty, self.standing, way, 0.3, 2.0 * radius + 0.2, rng)
        moving = self._placed(Surroundings(grid, cell, standing), self.walking, way, 1.5, 0.0, rng)
        pace = rng.uniform(self.slowest, self.fastest, len(moving))
        angle = rng.uniform(-np.pi, np.pi, len(moving))
        velocities = np.stack((pace * np.cos(angle), pace * np.sin(angle)), axis=1)
        return Surroundings(grid, cell, standing, moving, velocities, rng.bit_generator.random_raw(4))

    def _placed(
        self, around: Surroundings, count: int, way: Floats, aside: float, room: float, rng: np.random.Generator
    ) -> Floats:
        """Return discs (at most count, 3) up to ``aside`` from the way, with room to all that is there."""
        found: list[tuple[float, float, float]] = []
        for _ in range(count):
            for _ in range(TRIES):
                size = float(rng.uniform(self.least, self.most))
                x, y = way[rng.integers(len(way))] + rng.uniform(-aside, aside, 2)
                ends = min(np.hypot(x - way[0, 0], y - way[0, 1]), np.hypot(x - way[-1, 0], y - way[-1, 1]))
                others = min((np.hypot(x - ox, y - oy) - other for ox, oy, other in found), default=np.inf)
                need = size + room
                if ends >= self.clear + size and others >= need and around.clearance(x, y, need) >= need:
                    found.append((float(x), float(y), size))
                    break
        return np.array(found).reshape(-1, 3)
