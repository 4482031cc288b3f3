"""Section 4.8: the optimization operator."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import Collision
from pathloom.paths.deletion import PointDeletion
from pathloom_agacd.collision import LinearTrial


@dataclass(frozen=True, kw_only=True)
class SequentialPointDeletion(PointDeletion):
    """Delete, along the path, every point between two that the linear trial lets see each other.

    The paper's example takes one pass.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.8"

    collision: Collision = LinearTrial()
