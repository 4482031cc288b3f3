"""Segments between cell centres, against obstacle cells, by midpoints of midpoints: quick to write, and not exact."""

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import row_of


@part("i8(i8, i8, i8)")
def _rounded_middle(a, b, sign):
    """Return the midpoint of two coordinates, halves rounded up on an axis that points from start to goal."""
    return sign * ((sign * a + sign * b + 1) // 2)


@part("b1(u1[::1], i8, i8, i8, i8, i8, i8[::1])")
def free_by_midpoints(blocked, cols, a, b, sign_r, sign_c, stack):
    """Say whether no rounded midpoint between two cells, nor between those found so far, is an obstacle.

    Ends where cells are neighbours; the diagonal between two is free. ``stack``
    has room for one cell each time that the distance can be halved.
    """
    if blocked[a] or blocked[b]:
        return False
    per_row = 1.0 / cols
    top = 0
    stack[0] = b
    here = a
    while top >= 0:
        r0, r1 = row_of(here, per_row), row_of(stack[top], per_row)
        c0, c1 = here - r0 * cols, stack[top] - r1 * cols
        if max(abs(r1 - r0), abs(c1 - c0)) <= 1:
            here = stack[top]
            top -= 1
            continue
        middle = _rounded_middle(r0, r1, sign_r) * cols + _rounded_middle(c0, c1, sign_c)
        if blocked[middle]:
            return False
        top += 1
        stack[top] = middle
    return True


@kernel("b1[::1](u1[::1], i8, i4[::1], i4[::1], i8, i8)")
def segments_free(blocked, cols, first, second, sign_r, sign_c):
    """Test many segments: first[k] to second[k]."""
    free = np.empty(first.shape[0], np.bool_)
    stack = np.empty(64, np.int64)  # a distance of up to 2**62 can be halved
    for k in range(first.shape[0]):
        free[k] = free_by_midpoints(blocked, cols, first[k], second[k], sign_r, sign_c, stack)
    return free
