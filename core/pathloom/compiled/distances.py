"""Collision by distance: how near the centres of obstacles come to a segment, or to the line through it."""

import math

import numpy as np

from pathloom.compiled.jit import kernel
from pathloom.compiled.rows import row_of


@kernel("b1[::1](u1[::1], i8, i8, i4[::1], i4[::1], f8, f8, b1)")
def clear(blocked, rows, cols, first, second, above, below, infinite):
    """Say for each segment whether every obstacle's centre is at least a distance of √(above / below) away.

    From the segment itself, or (``infinite``) from the whole line through it; a
    segment of one point is no line and counts as that point. Distances are
    compared squared and times ``below``: with whole numbers above and below,
    exactly, on all maps whose cells, squared, times ``below`` are fewer than 2**51.
    """
    free = np.empty(first.shape[0], np.bool_)
    per_row = 1.0 / cols
    reach = math.sqrt(above / below)
    for k in range(first.shape[0]):
        r0, r1 = row_of(first[k], per_row), row_of(second[k], per_row)
        c0, c1 = first[k] - r0 * cols, second[k] - r1 * cols
        dr, dc = r1 - r0, c1 - c0
        squared = dr * dr + dc * dc
        whole = infinite and squared > 0
        # go along the longer axis; across it, what is near enough lies within √2 of the reach, the slope being ≤ 1
        flat = abs(dc) >= abs(dr)
        a0, a1 = (c0, c1) if flat else (r0, r1)
        b0 = r0 if flat else c0
        da, db = (dc, dr) if flat else (dr, dc)
        length, height = (cols, rows) if flat else (rows, cols)
        margin = np.int64(reach) + 1
        low, high = min(a0, a1) - margin, max(a0, a1) + margin
        if whole:
            low, high = 0, length - 1
        slope = db / da if da != 0 else 0.0
        band = reach * 1.4142135623730951 + 1e-6
        good = True
        for a in range(max(low, 0), min(high, length - 1) + 1):
            at = a if whole else min(max(a, min(a0, a1)), max(a0, a1))
            b = b0 + slope * (at - a0)
            for across in range(max(math.ceil(b - band), 0), min(math.floor(b + band), height - 1) + 1):
                cell = across * cols + a if flat else a * cols + across
                if not blocked[cell]:
                    continue
                pa, pb = a - a0, across - b0
                along = pa * da + pb * db
                if not whole and along <= 0:
                    near = below * (pa * pa + pb * pb) < above
                elif not whole and along >= squared:
                    near = below * ((pa - da) * (pa - da) + (pb - db) * (pb - db)) < above
                else:
                    cross = float(pa * db - pb * da)
                    near = below * (cross * cross) < above * squared
                if near:
                    good = False
                    break
            if not good:
                break
        free[k] = good
    return free
