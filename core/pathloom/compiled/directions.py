"""The eight directions of a step, clockwise from north.

``moves[cell]`` has bit d set where a step from the cell in direction d is legal
under the problem's corner policy.
"""

import numpy as np

DR = np.array([-1, -1, 0, 1, 1, 1, 0, -1], np.int64)
DC = np.array([0, 1, 1, 1, 0, -1, -1, -1], np.int64)
TOWARDS = np.array([7, 0, 1, 6, -1, 2, 5, 4, 3], np.int64)
"""Direction of a step (dr, dc) at index 3 (dr + 1) + (dc + 1)."""
