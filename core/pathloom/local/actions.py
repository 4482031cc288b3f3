"""The four actions among which a policy decides."""

from enum import IntEnum


class Action(IntEnum):
    """What the robot does next; the numbers are the labels of Song et al. (2021), section 3.4."""

    FORWARD = 0
    SLIGHT_RIGHT = 1
    SHARP_RIGHT = 2
    SLIGHT_LEFT = 3


NAMES = ("Move-Forward", "Slight-Right-Turn", "Sharp-Right-Turn", "Slight-Left-Turn")
"""The names of the actions in the wall-following data, in the order of their numbers."""
