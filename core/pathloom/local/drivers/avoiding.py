"""Avoiding: follow the path, and let a policy decide while something is in the way."""

from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom.errors import ConfigError
from pathloom.kernel.component import NonNegative, Positive
from pathloom.local.drivers.driver import Driver, View
from pathloom.local.drivers.pure_pursuit import PurePursuit
from pathloom.local.policy import Decide
from pathloom.local.robot import Motion


@dataclass(frozen=True, kw_only=True)
class Avoiding(Driver):
    """Follow the path until the sensors see something in the way to it; then do what the policy says.

    The policy knows nothing of the path: it follows the wall that it meets. The path is taken up again as soon as the
    straight way to it is free, with some more room than when it was left. So do the "bug" algorithms (V. Lumelsky,
    A. Stepanov 1987, Algorithmica 2, 403); unlike them this one may go round in circles.
    """

    source: ClassVar[str] = "ours; Song et al. 2021, section 3, leave open how policy and path go together"

    lookahead: Positive = 0.9
    """How far along the path the target lies ahead, in metres; as far must the way be free."""
    pursuit: PurePursuit = PurePursuit()
    """Follows the path while nothing is in the way."""
    margin: NonNegative = 0.05
    """Room on each side of the robot, in metres, without which the way counts as blocked."""
    relief: NonNegative = 0.05
    """More room, in metres, that there has to be before the path is taken up again."""

    def steer(self, view: View, decide: Decide | None, memory: Any) -> tuple[Motion, Any]:
        if decide is None:
            raise ConfigError(f"{self.name}: found no policy, allowed a policy or a driver that needs none")
        if not view.blocked(self.margin + (self.relief if memory else 0.0)):
            return self.pursuit.steer(view, None, None)[0], False
        return view.robot.motion(int(decide(view.readings.reshape(1, -1))[0])), True
