"""Section 3.6: the optimisation operator."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom.paths.deletion import PointDeletion


@dataclass(frozen=True, kw_only=True)
class TripletPointDeletion(PointDeletion):
    """Delete, along the path, every D(i) where the line from D(i - 1) to D(i + 1) passes no obstacle.

    The paper does this to every individual in every generation. Its test of the
    line is eq. (11), `LineDistance`, under which nothing could be deleted that
    makes its own results possible; hence the exact test by default.
    """

    source: ClassVar[str] = "Liu et al. 2024, section 3.6"
