"""Policy alone: what the policy does when nobody follows a path."""

from dataclasses import dataclass
from typing import Any, ClassVar

from pathloom.errors import ConfigError
from pathloom.local.drivers.driver import Driver, View
from pathloom.local.policy import Decide
from pathloom.local.robot import Motion


@dataclass(frozen=True, kw_only=True)
class PolicyAlone(Driver):
    """Let the policy decide always, as when the data were recorded: the robot follows walls, and no path."""

    source: ClassVar[str] = "Freire et al. 2009, doi:10.1109/LARS.2009.5418323"

    def steer(self, view: View, decide: Decide | None, memory: Any) -> tuple[Motion, Any]:
        if decide is None:
            raise ConfigError(f"{self.name}: found no policy, allowed a policy or a driver that needs none")
        return view.robot.motion(int(decide(view.readings.reshape(1, -1))[0])), True
