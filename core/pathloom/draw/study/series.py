"""What variants look like: each has a colour, a dash and a marker by its place among them."""

from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

SERIES = {
    False: ("#0072b2", "#d55e00", "#009e73", "#a34c7c", "#8a6d00", "#1a1a1a", "#3aa0d8", "#7a4a1e"),
    True: ("#56b4e9", "#f08a4b", "#2fc79a", "#dd8fb5", "#f0e442", "#ececec", "#8fb8ff", "#c9a27e"),
}
"""Colours of variants, after Okabe and Ito (2008), dark enough on white and, by ``True``, light enough on black."""
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.6)), (0, (1.2, 1.2)), (0, (5, 1.5, 1.2, 1.5)), (0, (8, 2)))
MARKERS = "osD^vP*X"


@dataclass(frozen=True)
class Curve:
    """A line that may have a band."""

    x: ArrayLike
    y: ArrayLike
    low: ArrayLike | None = None
    high: ArrayLike | None = None


def colour(place: int, *, dark: bool) -> str:
    """Return the colour of a variant."""
    palette = SERIES[dark]
    return palette[place % len(palette)]


def marker(place: int) -> str:
    """Return the marker of a variant."""
    return MARKERS[place % len(MARKERS)]


def line(place: int, *, dark: bool) -> dict[str, Any]:
    """Return how a variant's line looks: a colour, and a dash for eyes and printers that see none."""
    turn = place + place // len(SERIES[dark])
    return {"color": colour(place, dark=dark), "linestyle": DASHES[turn % len(DASHES)], "linewidth": 1.5}
