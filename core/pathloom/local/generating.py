"""Examples without end: a simulated robot on any map, labelled by an expert."""

import numpy as np

from pathloom.errors import ConfigError
from pathloom.grid import OccupancyGrid
from pathloom.kernel.evaluation import Floats
from pathloom.local.actions import Action
from pathloom.local.examples import Examples
from pathloom.local.policy import Rule
from pathloom.local.robot import Pose, Robot
from pathloom.local.sectors import SENSORS, WIDTHS, reduced
from pathloom.local.sensing import Ultrasound
from pathloom.local.surroundings import Surroundings, cell_side

MOST = 2_000_000
"""Examples beyond which a request is refused."""
TRIES = 200
"""Draws of a place for every one that is needed, before a map counts as too narrow."""
STEP = 1.0 / 9.0
"""Seconds between two recorded rows: the data have 9 a second."""


def generate(
    grid: OccupancyGrid,
    count: int,
    expert: Rule,
    *,
    rng: np.random.Generator,
    robot: Robot = Robot(),
    sensing: Ultrasound = Ultrasound(),
    width: int = 4,
    cell: float = 1.0,
    driven: bool = False,
) -> Examples:
    """Return examples of what an expert does on a map.

    The expert sees what the robot senses, noise included, as in the recorded data, where
    every label follows from the recorded distances.

    Parameters
    ----------
    count
        How many.
    width
        Distances of each: 2, 4 or 24.
    cell
        Metres of a cell's side where the map has no resolution.
    driven
        The expert drives, and the examples are what it meets, one after the other, as they were recorded; else
        places and headings are drawn at random, and every situation that the map has occurs.

    Raises
    ------
    ConfigError
        If the map has no room for the robot, or a number is out of its range.
    """
    if not 1 <= count <= MOST or width not in WIDTHS:
        found, allowed = (count, f"1 to {MOST}") if width in WIDTHS else (width, "2, 4 or 24 distances")
        raise ConfigError(f"generated examples: found {found}, allowed {allowed}")
    around = Surroundings(grid, cell_side(grid, cell))
    if driven:
        readings = _along_the_way(around, count, expert, robot, sensing, rng)
    else:
        readings = sensing.read(around, free_poses(around, count, robot.radius, rng), rng)
    distances = reduced(readings, width)
    how = "driven" if driven else "scattered"
    return Examples(distances, expert.decide(distances), f"generated ({expert.name}, {how}, {grid.name or 'a map'})")


def free_poses(around: Surroundings, count: int, radius: float, rng: np.random.Generator) -> Floats:
    """Return poses (count, 3) drawn from all at which a disc touches nothing.

    Raises
    ------
    ConfigError
        If hardly a draw finds room.
    """
    height, width = (side * around.cell for side in around.grid.shape)
    found: list[tuple[float, float, float]] = []
    for _ in range(TRIES * count):
        x, y = float(rng.random()) * width, float(rng.random()) * height
        if around.clearance(x, y, radius) >= radius:
            found.append((x, y, float(rng.uniform(-np.pi, np.pi))))
            if len(found) == count:
                return np.array(found)
    raise ConfigError(f"{around.grid.name or 'map'}: found hardly any room for a robot of radius {radius:g} m")


def _along_the_way(
    around: Surroundings, count: int, expert: Rule, robot: Robot, sensing: Ultrasound, rng: np.random.Generator
) -> Floats:
    """Return what the expert senses as it drives, (count, 24).

    It is set down anew where it would hit something, and where it has lost the wall: after a full circle to the left.
    """
    circle = round(2.0 * np.pi / (robot.slight_turn * STEP))
    readings = np.empty((count, SENSORS))
    pose, circling = None, 0
    for row in range(count):
        if pose is None:
            pose, circling = _beside_a_wall(around, expert, robot, sensing, rng), 0
        readings[row] = sensing.read(around, np.array([pose]), rng)[0]
        action = int(expert.decide(readings[row : row + 1])[0])
        circling = circling + 1 if action == Action.SLIGHT_LEFT else 0
        pose = pose.after(robot.motion(action), STEP)
        if circling >= circle or around.clearance(pose.x, pose.y, robot.radius) < robot.radius:
            pose = None
    return readings


def _beside_a_wall(
    around: Surroundings, expert: Rule, robot: Robot, sensing: Ultrasound, rng: np.random.Generator
) -> Pose:
    """Return a free pose at which the expert does not look for a wall on its left; the last one tried if none is."""
    for _ in range(TRIES):
        pose = free_poses(around, 1, robot.radius, rng)
        if int(expert.decide(sensing.read(around, pose, rng))[0]) != Action.SLIGHT_LEFT:
            break
    return Pose(*pose[0])
