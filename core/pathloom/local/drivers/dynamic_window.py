"""Dynamic window: try all speeds and turns, and take the one that is best for a short while."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar, NamedTuple

import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Count, NonNegative, Positive
from pathloom.kernel.evaluation import Floats
from pathloom.local.drivers.driver import Driver, View
from pathloom.local.policy import Decide
from pathloom.local.robot import Motion, Robot


class Trials(NamedTuple):
    """Motions, and where they lead, seen from the robot: metres ahead and to the left."""

    motions: Floats
    """(n, 2) speed and turn."""
    places: Floats
    """(n, s, 2) on the way."""
    headings: Floats
    """(n,) at its end."""


@dataclass(frozen=True, kw_only=True)
class DynamicWindow(Driver):
    """Drive the circle that leads best to the path and keeps clear of all that is sensed.

    The robot has no inertia, so that its window is the whole of what its wheels can do. What counts is how much nearer
    a circle leads to the target; to face the target, as the source has it, is a term as well, which is off.
    """

    source: ClassVar[str] = (
        "D. Fox, W. Burgard, S. Thrun (1997), IEEE Robot. Autom. Mag. 4(1), 23, eq. (13); target instead of goal"
    )

    lookahead: Positive = 1.5
    """How far along the path the target lies ahead, in metres."""
    horizon: Positive = 2.5
    """How far into the future it looks, in seconds."""
    speeds: Count = 5
    """Speeds that it tries, from 0 on."""
    turns: Count = 15
    """Rates of turning that it tries, to both sides."""
    progress: NonNegative = 1.0
    """Weight of coming nearer to the target, from −1 to 1: as a share of what full speed could do."""
    heading: NonNegative = 0.0
    """Weight of facing the target at the end, from 0 to 1; with more the robot waits where something is in the way."""
    clearance: NonNegative = 0.2
    """Weight of the distance kept, up to ``wide`` metres, from 0 to 1."""
    velocity: NonNegative = 0.5
    """Weight of the speed, from 0 to 1."""
    wide: Positive = 0.6
    """Distance beyond which more room is worth nothing, in metres."""
    margin: NonNegative = 0.05
    """Room without which a circle is out of the question, in metres."""

    def steer(self, view: View, decide: Decide | None, memory: Any) -> tuple[Motion, Any]:
        trials = _trials(view.robot, self.horizon, self.speeds, self.turns)
        target = view.distance * np.array([np.cos(view.bearing), np.sin(view.bearing)])
        room = compiled.rays.nearest_on_ways(trials.places, view.echoes) - view.robot.radius
        toward = target - trials.places[:, -1]
        off = np.arctan2(toward[:, 1], toward[:, 0]) - trials.headings
        facing = 1.0 - np.abs((off + np.pi) % (2.0 * np.pi) - np.pi) / np.pi
        nearer = view.distance - np.hypot(toward[:, 0], toward[:, 1])
        score = (
            self.progress * nearer / (view.robot.speed * self.horizon)
            + self.heading * facing
            + self.clearance * np.minimum(room, self.wide) / self.wide
            + self.velocity * trials.motions[:, 0] / view.robot.speed
        )
        allowed = room >= self.margin
        if not allowed.any():  # nothing but turning on the spot is safe: to the side of the target
            return Motion(0.0, float(np.copysign(view.robot.turn, view.bearing))), None
        best = trials.motions[int(np.where(allowed, score, -np.inf).argmax())]
        return Motion(float(best[0]), float(best[1])), None


@lru_cache(maxsize=8)
def _trials(robot: Robot, horizon: float, speeds: int, turns: int) -> Trials:
    speed, turn = (
        grid.ravel()
        for grid in np.meshgrid(
            np.linspace(0.0, robot.speed, speeds), np.linspace(-robot.turn, robot.turn, turns), indexing="ij"
        )
    )
    after = np.linspace(horizon / 6.0, horizon, 6)
    turned = turn[:, np.newaxis] * after
    chord = speed[:, np.newaxis] * after * np.sinc(turned / (2.0 * np.pi))
    places = np.ascontiguousarray(np.stack((chord * np.cos(turned / 2.0), chord * np.sin(turned / 2.0)), axis=2))
    return Trials(np.stack((speed, turn), axis=1), places, turned[:, -1])
