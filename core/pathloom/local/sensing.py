"""Sensing: a ring of 24 ultrasound sensors, with noise, and echoes that get lost."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom.kernel.component import Component, NonNegative, Positive, Share
from pathloom.kernel.evaluation import Floats
from pathloom.local.sectors import RING
from pathloom.local.surroundings import Surroundings


@dataclass(frozen=True, kw_only=True)
class Ultrasound(Component):
    """24 rays, 15° apart, from the middle of the robot.

    A ray stands for a sensor's whole cone, and distances count from the middle: the least in the
    recorded data, 0.34 m, is just above the robot's radius. Readings are whole millimetres, as recorded.
    """

    kind: ClassVar[str] = "sensing"
    source: ClassVar[str] = "after Freire et al. 2009, doi:10.1109/LARS.2009.5418323"

    reach: Positive = 5.0
    """The farthest reading, in metres; also what a lost echo reads."""
    noise: NonNegative = 0.01
    """Standard deviation of a reading, in metres."""
    lost: Share = 0.005
    """Share of the echoes that get lost."""

    def read(self, around: Surroundings, poses: Floats, rng: np.random.Generator) -> Floats:
        """Return the readings (n, 24) at poses (n, 3), in metres."""
        seen = around.rays(poses, RING, self.reach)
        if self.noise > 0.0:
            seen = seen + self.noise * rng.standard_normal(seen.shape)
        if self.lost > 0.0:
            seen = np.where(rng.random(seen.shape) < self.lost, self.reach, seen)
        return np.asarray(np.round(np.clip(seen, 0.0, self.reach), 3))
