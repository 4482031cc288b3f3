"""Section 4.5: the delete operation."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom.paths.deletion import PointDeletion


@dataclass(frozen=True, kw_only=True)
class SequentialPointDeletion(PointDeletion):
    """Delete, along the path, every node whose neighbours can be joined free of obstacles.

    The paper names neither the test of a segment nor the number of passes.
    """

    source: ClassVar[str] = "Li et al. 2021, section 4.5, fig. 5"
