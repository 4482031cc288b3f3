"""The ring of 24 ultrasound sensors, and the "simplified distances" that are made of their readings.

Source: A. L. Freire, G. A. Barreto, M. Veloso, A. T. Varela (2009), Short-term memory mechanisms in neural network
learning of robot navigation tasks, LARS, doi:10.1109/LARS.2009.5418323; the arcs are those of the published data.
"""

import numpy as np

from pathloom.kernel.evaluation import Floats

SENSORS = 24
RING: Floats = np.deg2rad(15.0 * (np.arange(SENSORS) - 12.0))
"""(24,) angle of each sensor in the order of the data's columns: column 13 of 24 looks ahead, column 19 to the left."""
ARCS = {"front": (10, 11, 12, 13, 14), "left": (17, 18, 19), "right": (4, 5, 6, 7, 8), "back": (22, 23, 0, 1, 2)}
"""Sensors, counted from 0, of which a simplified distance is the least reading.

Arcs of 60° as described, but for the left one: in every row of the data that is the minimum
of three sensors, an arc of 30°. The recorded back distance is that of these five in 85 % of the rows.
"""
WIDTHS = (2, 4, SENSORS)
"""How many distances an example may have: front and left, all four simplified ones, or all readings."""


def simplified(readings: Floats) -> Floats:
    """Return the front, left, right and back distance (n, 4) of readings (n, 24)."""
    return np.stack([readings[:, arc].min(axis=1) for arc in ARCS.values()], axis=1)


def reduced(readings: Floats, width: int) -> Floats:
    """Return readings (n, 24) as a policy of so many distances takes them: (n, width)."""
    return readings if width == SENSORS else simplified(readings)[:, :width]
