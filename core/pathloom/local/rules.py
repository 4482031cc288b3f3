"""Policies that need not learn: the rule that labelled the wall-following data, and a smoother one of the same mind."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pathloom.kernel.component import NonNegative, Positive
from pathloom.kernel.evaluation import Floats
from pathloom.local.actions import Action
from pathloom.local.examples import Actions
from pathloom.local.policy import Rule
from pathloom.local.sectors import SENSORS, simplified


def front_and_left(distances: Floats) -> tuple[Floats, Floats]:
    """Return the front and the left distance, (n,) each, of 2, 4 or 24 distances (n, k)."""
    pair = simplified(distances) if distances.shape[1] == SENSORS else distances
    return pair[:, 0], pair[:, 1]


@dataclass(frozen=True, kw_only=True)
class FourLeaves(Rule):
    """Follow the wall on the left: a decision tree of four leaves, which every row of the data obeys.

    The right and the back distance do not count. The data leave gaps of one and two millimetres at
    the thresholds, within which any value would do.
    """

    source: ClassVar[str] = "found in the data of Freire et al. 2009, doi:10.1109/LARS.2009.5418323"

    front: NonNegative = 0.900
    """Turn sharply to the right where the front distance is at most this, in metres."""
    near: NonNegative = 0.494
    """Turn slightly to the right, away from the wall, where the left distance is at most this, in metres."""
    far: NonNegative = 0.900
    """Turn slightly to the left, back to the wall, where the left distance is more than this, in metres."""

    def decide(self, distances: Floats) -> Actions:
        front, left = front_and_left(distances)
        beside = np.where(
            left <= self.near, Action.SLIGHT_RIGHT, np.where(left <= self.far, Action.FORWARD, Action.SLIGHT_LEFT)
        )
        return np.where(front <= self.front, Action.SHARP_RIGHT, beside).astype(np.int64)


@dataclass(frozen=True, kw_only=True)
class WallFollower(Rule):
    """Follow the wall on the left at one distance, with less of a turn the less is wrong.

    Instead of a band around the wall it keeps a distance: what decides is how far the robot is from
    it, seen ``ahead`` by the front distance. It turns sharply late, where the way is really blocked.
    """

    source: ClassVar[str] = "ours: proportional wall following with a dead band"

    front: NonNegative = 0.700
    """Turn sharply to the right where the front distance is at most this, in metres."""
    keep: NonNegative = 0.650
    """The distance from the wall that it keeps, in metres."""
    band: NonNegative = 0.120
    """It goes straight on within this of it, in metres."""
    ahead: Positive = 1.500
    """Front distance below which it begins to turn away from what comes, in metres."""

    def decide(self, distances: Floats) -> Actions:
        front, left = front_and_left(distances)
        coming = np.maximum(self.ahead - front, 0.0) / self.ahead  # 0: nothing ahead, 1: touching
        error = left - self.keep - coming * self.band * 2.0
        beside = np.where(
            error < -self.band, Action.SLIGHT_RIGHT, np.where(error <= self.band, Action.FORWARD, Action.SLIGHT_LEFT)
        )
        return np.where(front <= self.front, Action.SHARP_RIGHT, beside).astype(np.int64)
