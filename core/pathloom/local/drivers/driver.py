"""Driver: steers a robot along a path by what it senses, one decision after the other."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from pathloom.kernel.component import Component, Positive
from pathloom.kernel.evaluation import Floats
from pathloom.local.policy import Decide
from pathloom.local.robot import Motion, Pose, Robot
from pathloom.local.sectors import RING

_COS, _SIN = np.cos(RING), np.sin(RING)


@dataclass(frozen=True, eq=False)
class View:
    """What is known when a decision is due."""

    pose: Pose
    readings: Floats
    """(24,) metres, in the order of `RING`."""
    target: tuple[float, float]
    """A point of the path, the driver's lookahead farther along it than the robot; x and y in metres."""
    left: float
    """Metres of the path that are left."""
    robot: Robot
    reach: float
    """The reading of a sensor that sees nothing."""

    @cached_property
    def distance(self) -> float:
        """Metres to the target."""
        return math.hypot(self.target[0] - self.pose.x, self.target[1] - self.pose.y)

    @cached_property
    def bearing(self) -> float:
        """Where the target lies, in radians, counter-clockwise from the heading."""
        toward = math.atan2(self.target[1] - self.pose.y, self.target[0] - self.pose.x)
        return math.remainder(toward - self.pose.heading, math.tau)

    @cached_property
    def echoes(self) -> Floats:
        """(m, 2) where something was sensed: metres ahead of the robot, and to its left."""
        heard = self.readings < self.reach
        return np.stack((self.readings * _COS, self.readings * _SIN), axis=1)[heard]

    def blocked(self, margin: float) -> bool:
        """Say whether something was sensed within the robot's radius and a margin of the straight way to the target."""
        ahead, left = self.echoes.T
        cos, sin = math.cos(self.bearing), math.sin(self.bearing)
        along, beside = ahead * cos + left * sin, np.abs(left * cos - ahead * sin)
        wide = self.robot.radius + margin
        return bool(((along > 0.0) & (along < self.distance + wide) & (beside < wide)).any())

    def threat(self, motion: Motion, seconds: float, margin: float) -> tuple[float, float] | None:
        """Return what a motion brings the rim within a margin of, and nearer than it is now; of several the nearest.

        Metres ahead of the robot and to its left, as `echoes`; ``None`` where there is nothing.
        """
        there = Pose(0.0, 0.0, 0.0).after(motion, seconds)
        now, then = (np.hypot(*(self.echoes - place).T) for place in (np.zeros(2), np.array(there[:2])))
        near = np.where(then < now, then, np.inf)
        if not (near < self.robot.radius + margin).any():
            return None
        ahead, left = self.echoes[int(near.argmin())]
        return float(ahead), float(left)


@dataclass(frozen=True, kw_only=True)
class Driver(Component, ABC):
    """Steers. What it remembers from one decision to the next it hands out and gets back."""

    kind: ClassVar[str] = "driver"

    lookahead: Positive = 0.6
    """How far along the path the target lies ahead, in metres."""

    @abstractmethod
    def steer(self, view: View, decide: Decide | None, memory: Any) -> tuple[Motion, Any]:
        """Return what the wheels do next, and what to remember; ``decide`` is a policy that was trained.

        ``memory`` is ``None`` at the start, and ``True`` afterwards where a policy has decided.
        """
