"""The robot: a disc with two wheels, and how it moves for each action."""

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from pathloom.errors import ConfigError
from pathloom.kernel.component import Component, NonNegative, Positive
from pathloom.local.actions import Action


class Motion(NamedTuple):
    """What the wheels do until the next decision."""

    speed: float
    """Metres a second, forwards."""
    turn: float
    """Radians a second, counter-clockwise."""


class Pose(NamedTuple):
    """Where the robot stands, and where it looks."""

    x: float
    """Metres from the left border of the map."""
    y: float
    """Metres from its lower border."""
    heading: float
    """Radians, counter-clockwise from the x axis."""

    def after(self, motion: Motion, seconds: float) -> "Pose":
        """Return the pose after a time, on a circle or straight on."""
        turned = motion.turn * seconds
        if abs(turned) < 1e-9:
            chord, half = motion.speed * seconds, 0.0
        else:
            chord, half = 2.0 * motion.speed / motion.turn * math.sin(turned / 2.0), turned / 2.0
        along = self.heading + half
        heading = math.remainder(self.heading + turned, math.tau)
        return Pose(self.x + chord * math.cos(along), self.y + chord * math.sin(along), heading)


@dataclass(frozen=True, kw_only=True)
class Robot(Component):
    """A disc that drives forwards and turns on the spot; no slip, no inertia.

    The paper says nothing of how the robot moves for an action, nor do the data; these motions are
    ours. Slight turns are curves of 1 m radius, the sharp one is a turn on the spot.
    """

    kind: ClassVar[str] = "robot"
    name: ClassVar[str] = "robot"
    source: ClassVar[str] = "after the SCITOS G5, whose sensors in the wall-following data come as near as 0.34 m"

    radius: Positive = 0.3
    """Metres."""
    speed: Positive = 0.5
    """Fastest, in metres a second."""
    turn: Positive = 1.5
    """Fastest, in radians a second."""
    forward: NonNegative = 0.4
    """Speed of the action Move-Forward, in metres a second."""
    slight_speed: NonNegative = 0.3
    """Speed in a slight turn, to either side."""
    slight_turn: Positive = 0.3
    """Rate of a slight turn, in radians a second."""
    sharp_speed: NonNegative = 0.0
    """Speed in a sharp turn."""
    sharp_turn: Positive = 1.0
    """Rate of a sharp turn, in radians a second."""

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, most in (("forward", "speed"), ("slight_speed", "speed"), ("sharp_speed", "speed"),
                           ("slight_turn", "turn"), ("sharp_turn", "turn")):  # fmt: skip
            if getattr(self, name) > getattr(self, most):
                found = f"{name} = {getattr(self, name):g}"
                raise ConfigError(f"robot: found {found}, allowed at most {most} = {getattr(self, most):g}")

    def motion(self, action: int) -> Motion:
        """Return what the wheels do for an action."""
        if action == Action.FORWARD:
            return Motion(self.forward, 0.0)
        if action == Action.SHARP_RIGHT:
            return Motion(self.sharp_speed, -self.sharp_turn)
        return Motion(self.slight_speed, self.slight_turn if action == Action.SLIGHT_LEFT else -self.slight_turn)

    def within(self, motion: Motion) -> Motion:
        """Return the nearest motion that the wheels can do."""
        return Motion(min(max(motion.speed, 0.0), self.speed), min(max(motion.turn, -self.turn), self.turn))
