"""The colours of all pictures, on light and on dark ground; told apart by colour-blind eyes too.

Source: M. Okabe, K. Ito (2008), Color Universal Design; in the dark the blue is the palette's lighter one.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Theme:
    """Colours, as ``#rrggbb``."""

    ground: str
    """Around map and axes."""
    ink: str
    """Text and axes."""
    faint: str
    """Cell lines, secondary text's rules."""
    quiet: str
    """Secondary text."""
    free: str
    closed: str
    """Free cells that the robot's radius closes."""
    wall: str
    path: str
    unrefined: str
    optimum: str
    start: str
    goal: str
    mean: str
    crowd: str
    best: str
    """Population and best path of an animation."""


LIGHT = Theme(
    ground="#ffffff",
    ink="#1a1a1a",
    faint="#dcdcdc",
    quiet="#5a5a5a",
    free="#ffffff",
    closed="#d3d6da",
    wall="#4a4e54",
    path="#0072b2",
    unrefined="#1a1a1a",
    optimum="#e69f00",
    start="#009e73",
    goal="#d55e00",
    mean="#a34c7c",
    crowd="#56b4e9",
    best="#d55e00",
)
DARK = Theme(
    ground="#15181c",
    ink="#ececec",
    faint="#343a41",
    quiet="#a9b0b8",
    free="#1e2227",
    closed="#3d444c",
    wall="#8b939c",
    path="#56b4e9",
    unrefined="#ececec",
    optimum="#f0e442",
    start="#009e73",
    goal="#d55e00",
    mean="#cc79a7",
    crowd="#56b4e9",
    best="#f0e442",
)


def theme(*, dark: bool) -> Theme:
    """Return the colours of one of the two themes."""
    return DARK if dark else LIGHT


def rgb(colour: str) -> tuple[int, int, int]:
    """Return red, green and blue of ``#rrggbb``."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)
