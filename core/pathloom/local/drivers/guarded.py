"""Guarded: whoever drives is overruled before hitting what all sensors see."""

from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom.kernel.component import NonNegative, Positive
from pathloom.local.drivers.avoiding import Avoiding
from pathloom.local.drivers.driver import Driver, View
from pathloom.local.policy import Decide
from pathloom.local.robot import Motion


@dataclass(frozen=True, kw_only=True)
class Guarded(Driver):
    """Let another driver steer, and turn on the spot instead where that would come too near to something.

    The simplified distances have gaps of 30° and more between their arcs, into which a policy of four distances drives
    blindly, and the rule that labelled the data takes no notice of the right; this looks at all 24 readings. Where the
    policy decided, the turn is to the right, on along the wall; on the path it is away from what is near.
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
        threat = view.threat(motion, self.soon, self.room)
        if threat is None:
            return motion, memory
        turn = view.robot.sharp_turn
        return Motion(0.0, turn if threat[1] < 0.0 and not memory else -turn), memory
