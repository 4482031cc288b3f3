"""Included angles: between the way back and the way on at each interior node of a path."""

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import length_of, row_of


@part("i8(i8, i8, i8, i8)")
def class_of(back_r, back_c, on_r, on_c):
    """Return the class of the angle between two directions: 0 180°, 1 from 135°, 2 from 90°, 3 from 45°, 4 less."""
    cross = back_r * on_c - back_c * on_r
    dot = back_r * on_r + back_c * on_c
    if cross == 0:
        return 0 if dot < 0 else 4
    # cos² 45° is one half
    twice, lengths = 2 * dot * dot, (back_r * back_r + back_c * back_c) * (on_r * on_r + on_c * on_c)
    if dot <= 0:
        return 1 if twice >= lengths else 2
    return 3 if twice <= lengths else 4


@kernel("f8[:, ::1](i4[:, ::1], i8)")
def included_angles(population, cols):
    """Count for each path its interior nodes by included angle: of 180°, [135°, 180°), [90°, 135°), [45°, 90°), less.

    Straight on is 180°, straight back 0°. Directions are compared as integers.
    """
    per_row = 1.0 / cols
    found = np.zeros((population.shape[0], 5))
    for k in range(population.shape[0]):
        row = population[k]
        for i in range(1, length_of(row) - 1):
            r = row_of(row[i], per_row)
            c = row[i] - r * cols
            back, on = row_of(row[i - 1], per_row), row_of(row[i + 1], per_row)
            which = class_of(back - r, row[i - 1] - back * cols - c, on - r, row[i + 1] - on * cols - c)
            found[k, which] += 1.0
    return found
