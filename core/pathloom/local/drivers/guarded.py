"""Guarded: whoever drives is overruled before hitting what all sensors see."""

from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom.kernel.component import NonNegative, Positive
from pathloom.local.actions import Action
from pathloom.local.drivers.avoiding import Avoiding
from pathloom.local.drivers.driver import Driver, View
from pathloom.local.policy import Decide
from pathloom.local.robot import Motion


@dataclass(frozen=True, kw_only=True)
class Guarded(Driver):
    """Let another driver steer, and turn sharply to the right instead where that would come too near to something.

    The simplified distances have gaps of 30° and more between their arcs, into which a policy of
    four distances drives blindly; this looks at all 24 readings.
    """

    source: ClassVar[str] = "ours"

    lookahead: Positive = 0.9
    """How far along the path the target lies ahead, in metres."""
    driver: Driver = Avoiding()
    """Who steers."""
    room: NonNegative = 0.10
    """Least distance of the robot's rim from what is sensed, in metres, unless it moves away."""
    soon: Positive = 0.6
    """How far it looks ahead, in seconds."""

    def steer(self, view: View, decide: Decide | None, memory: Any) -> tuple[Motion, Any]:
        motion, memory = self.driver.steer(view, decide, memory)
        if view.nears(motion, self.soon, self.room):
            motion = view.robot.motion(Action.SHARP_RIGHT)
        return motion, memory
