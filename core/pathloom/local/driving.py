"""The closed loop: sense, decide, move, again and again, from start to goal, into something, or until time is up."""

import math
import time
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pathloom.errors import ConfigError
from pathloom.grid import OccupancyGrid
from pathloom.kernel.component import Component, Count, Positive
from pathloom.kernel.evaluation import Floats
from pathloom.local.drivers.driver import Driver, View
from pathloom.local.hazards import Hazards
from pathloom.local.policy import Decide
from pathloom.local.robot import Pose, Robot
from pathloom.local.sensing import Ultrasound
from pathloom.local.surroundings import cell_side

End = Literal["reached", "collided", "late"]
SPACING = 0.05
"""Metres between the points at which a path is held."""
BACK, ON = 0.5, 3.0
"""Metres of the path, back and on, among which the robot looks for its place."""
SIGHT = 2.0
"""Clearances are measured up to this, in metres."""


class Frame(NamedTuple):
    """A moment, for pictures."""

    pose: Pose
    discs: Floats
    """(m, 3) x, y and radius of what the map does not show."""
    decided: bool
    """Whether a policy decided."""


@dataclass(frozen=True)
class Episode:
    """How one drive ended."""

    end: End
    seconds: float
    """Simulated."""
    progress: float
    """Share of the path that was covered."""
    travelled: float
    """Metres driven."""
    length: float
    """Metres of the path."""
    min_clearance: float
    """Least distance from the robot's rim to anything, in metres, up to 1.7 or so; 0 after a collision."""
    steps: int
    """Decisions."""
    decided: int
    """Decisions that a policy took."""
    standing: int
    walking: int
    """Hazards that found a place."""
    thinking: float = field(default=0.0, compare=False)
    """Seconds of the computer's time for sensing and deciding."""
    working: float = field(default=0.0, compare=False)
    """Seconds of the computer's time in all."""
    frames: tuple[Frame, ...] = field(default=(), compare=False, repr=False)


@dataclass(frozen=True, kw_only=True)
class ClosedLoop(Component):
    """A robot, what it senses, and what is in its way."""

    kind: ClassVar[str] = "simulation"
    source: ClassVar[str] = "ours"

    robot: Robot = Robot()
    """Who drives: its size and its motions."""
    sensing: Ultrasound = Ultrasound()
    """What it knows of its surroundings."""
    hazards: Hazards = Hazards()
    """What stands and walks about without being on the map."""
    cell: Positive = 1.0
    """Metres of a cell's side where the map has no resolution of its own."""
    step: Positive = 0.1
    """Seconds from one decision to the next; the data have nine a second."""
    parts: Count = 2
    """Moves within a step, after each of which collisions are looked for."""
    patience: Positive = 4.0
    """Times the time that the path takes at full speed, after which the robot is late."""

    def drive(
        self,
        grid: OccupancyGrid,
        path: ArrayLike,
        driver: Driver,
        decide: Decide | None = None,
        *,
        seed: int = 0,
        record: bool = False,
    ) -> Episode:
        """Drive along a path once.

        Parameters
        ----------
        path
            (k, 2) cells, from start to goal, of whatever planner.
        decide
            A policy that was trained, for drivers that ask one.
        seed
            Hazards and noise come from it; equal seeds meet equal hazards, whoever drives.
        record
            Keep a frame for each step.

        Raises
        ------
        ConfigError
            If the path has no two points, or the robot does not fit where it begins.
        """
        cell = cell_side(grid, self.cell)
        way = points_along(path, grid.height, cell)
        hidden, noise = (np.random.default_rng([seed, which]) for which in (0, 1))
        around = self.hazards.around(grid, cell, way, self.robot.radius, hidden)
        robot, radius = self.robot, self.robot.radius
        ahead = way[min(len(way) - 1, round(driver.lookahead / SPACING))] - way[0]
        pose = Pose(float(way[0, 0]), float(way[0, 1]), math.atan2(ahead[1], ahead[0]))
        least = around.clearance(pose.x, pose.y, SIGHT)
        if least < radius:
            found = f"{grid.name or 'map'}: found {least:.2f} m of room at the start"
            raise ConfigError(f"{found}, allowed the robot's radius, {radius:g} m, or more")
        length = (len(way) - 1) * SPACING
        until = self.patience * (length / robot.speed + 10.0)
        place, now, travelled, steps, decided = 0, 0.0, 0.0, 0, 0
        memory: Any = None
        end: End = "late"
        frames: list[Frame] = []
        began, thinking = time.perf_counter(), 0.0
        while now < until:
            place = _nearest(way, pose, place)
            if place >= len(way) - 1 - radius / SPACING and math.dist(way[-1], pose[:2]) <= radius:
                end = "reached"
                break
            at = time.perf_counter()
            readings = self.sensing.read(around, np.array([pose]), noise)[0]
            x, y = way[min(len(way) - 1, place + round(driver.lookahead / SPACING))]
            left = (len(way) - 1 - place) * SPACING
            view = View(pose, readings, (float(x), float(y)), left, robot, self.sensing.reach)
            motion, memory = driver.steer(view, decide, memory)
            motion = robot.within(motion)
            thinking += time.perf_counter() - at
            steps += 1
            decided += bool(memory)
            if record:
                frames.append(Frame(pose, around.discs, bool(memory)))
            for _ in range(self.parts):
                short = self.step / self.parts
                pose = pose.after(motion, short)
                around.pass_time(short, pose.x, pose.y, radius)
                travelled += motion.speed * short
                now += short
                least = min(least, around.clearance(pose.x, pose.y, SIGHT))
            if least < radius:
                end = "collided"
                break
        if record:
            frames.append(Frame(pose, around.discs, bool(memory)))
        return Episode(
            end, round(now, 6), 1.0 if end == "reached" else place / (len(way) - 1), travelled, length,
            max(least - radius, 0.0), steps, decided, len(around.standing), len(around.moving),
            thinking, time.perf_counter() - began, tuple(frames),
        )  # fmt: skip


def points_along(path: ArrayLike, height: int, cell: float) -> Floats:
    """Return points (m, 2) in metres along a path (k, 2) of cells, 0.05 m apart; the last is a little nearer.

    Raises
    ------
    ConfigError
        If the path does not lead anywhere.
    """
    cells = np.asarray(path, np.float64).reshape(-1, 2)
    corners = np.stack(((cells[:, 1] + 0.5) * cell, (height - 0.5 - cells[:, 0]) * cell), axis=1)
    gone = np.concatenate(([0.0], np.hypot(*np.diff(corners, axis=0).T).cumsum()))
    if gone[-1] <= SPACING:
        raise ConfigError(f"path: found one of {gone[-1]:g} m, allowed one that leads somewhere")
    at = np.append(np.arange(0.0, gone[-1], SPACING), gone[-1])
    return np.stack([np.interp(at, gone, corners[:, axis]) for axis in (0, 1)], axis=1)


def _nearest(way: Floats, pose: Pose, place: int) -> int:
    """Return the point of the way that is nearest to the robot, among those near where it was; never farther back."""
    first = max(0, place - round(BACK / SPACING))
    near = way[first : place + round(ON / SPACING)]
    apart = (near[:, 0] - pose.x) ** 2 + (near[:, 1] - pose.y) ** 2
    return max(place, first + int(apart.argmin()))
