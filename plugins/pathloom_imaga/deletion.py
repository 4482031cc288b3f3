"""Section 2.6: the delete operation."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import Collision
from pathloom.paths.deletion import PointDeletion
from pathloom_imaga.collision import RecursiveMidpoint


@dataclass(frozen=True, kw_only=True)
class MidpointPointDeletion(PointDeletion):
    """Delete, along the path, every node whose neighbours see each other by the midpoint test.

    Since that test overlooks obstacles, points are put back where the exact one
    finds the new segment blocked.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.6, fig. 8"

    collision: Collision = RecursiveMidpoint()
