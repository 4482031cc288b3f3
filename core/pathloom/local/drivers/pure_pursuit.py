"""Pure pursuit: path following that looks for nothing but the path."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom.kernel.component import Positive
from pathloom.local.drivers.driver import Driver, View
from pathloom.local.policy import Decide
from pathloom.local.robot import Motion


@dataclass(frozen=True, kw_only=True)
class PurePursuit(Driver):
    """Follow the path on circles through a point ahead, and avoid nothing."""

    source: ClassVar[str] = (
        "R. C. Coulter (1992), Implementation of the pure pursuit path tracking algorithm, CMU-RI-TR-92-01"
    )

    aside: Positive = 1.0
    """Bearing of the target, in radians, from which on the robot turns on the spot."""

    def steer(self, view: View, decide: Decide | None, memory: Any) -> tuple[Motion, Any]:
        robot = view.robot
        if abs(view.bearing) > self.aside:
            return Motion(0.0, math.copysign(robot.turn, view.bearing)), None
        bend = 2.0 * math.sin(view.bearing) / max(view.distance, 1e-6)
        speed = min(robot.speed, robot.turn / abs(bend)) if bend else robot.speed  # as fast as the circle can be driven
        return robot.within(Motion(speed, speed * bend)), None
