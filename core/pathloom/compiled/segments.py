"""Segments between cell centres, against obstacle cells, in exact integers.

A cell at offset (i, j) along the longer and the shorter axis of a segment with
extents (n, m), n ≥ m, overlaps it iff ``|2 (n j − m i)| < n + m`` (separating
axes on the unit cell: the third axis is the segment's normal) and touches it
in one corner iff the two sides are equal.

Corner policies: 0 ``allow``, only the inside of an obstacle cell blocks;
1 ``no-squeeze``, nor may a segment pass between two obstacles that share a
corner; 2 ``strict``, an obstacle may not even be touched.
"""

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import blank, copy, length_of, row_of, trimmed


@part("b1(u1[::1], i8, i8, i8, i8, i8)")
def segment_free(blocked, cols, a, dr, dc, policy):
    """Say whether the segment from cell a over (dr, dc) is free under a corner policy."""
    step_r = cols if dr > 0 else -cols
    step_c = 1 if dc > 0 else -1
    if abs(dc) >= abs(dr):
        n, m, along, across = abs(dc), abs(dr), step_c, step_r
    else:
        n, m, along, across = abs(dr), abs(dc), step_r, step_c
    if n == 0:
        return blocked[a] == 0
    limit = n + m
    low = 0  # first j of this i that the segment meets
    side = 0  # 2 (n low − m i)
    here = a  # the cell (i, low)
    for _ in range(n + 1):
        while side < -limit or (side == -limit and policy != 2):
            low += 1
            side += 2 * n
            here += across
        j, value, cell = low, side, here
        while value < limit and j <= m:
            if blocked[cell]:
                return False
            j += 1
            value += 2 * n
            cell += across
        touched = value == limit and j <= m and policy != 0 and blocked[cell]
        # At the same corner lies the cell one further along and one back across.
        if touched and (policy == 2 or blocked[cell + along - across]):
            return False
        side -= 2 * m
        here += along
    return True


@part("i8(i8, i8, i8, i8, i4[::1])")
def cells_crossed(a, dr, dc, cols, found):
    """Write the cells whose inside the segment from cell a over (dr, dc) crosses, in order; return how many.

    There is room for them in |dr| + |dc| + 1 entries.
    """
    step_r = cols if dr > 0 else -cols
    step_c = 1 if dc > 0 else -1
    if abs(dc) >= abs(dr):
        n, m, along, across = abs(dc), abs(dr), step_c, step_r
    else:
        n, m, along, across = abs(dr), abs(dc), step_r, step_c
    limit = max(n + m, 1)
    count = low = side = 0
    here = a
    for _ in range(n + 1):
        while side <= -limit:
            low += 1
            side += 2 * n
            here += across
        j, value, cell = low, side, here
        while j <= m and value < limit:
            found[count] = cell
            count += 1
            j += 1
            value += 2 * n
            cell += across
        side -= 2 * m
        here += along
    return count


@kernel("b1[::1](u1[::1], i8, i4[::1], i4[::1], i8)")
def segments_free(blocked, cols, first, second, policy):
    """Test many segments: first[k] to second[k]."""
    free = np.empty(first.shape[0], np.bool_)
    per_row = 1.0 / cols
    for k in range(first.shape[0]):
        dr = row_of(second[k], per_row) - row_of(first[k], per_row)
        free[k] = segment_free(blocked, cols, first[k], dr, second[k] - first[k] - dr * cols, policy)
    return free


@part("i8(i4[::1], i8, u1[::1], i8, i8, i8)")
def drop_points(path, count, blocked, cols, policy, passes):
    """Drop, in place, every interior point whose neighbours see each other; return the new count.

    A point that is dropped leaves its predecessor to look at the next one.
    ``passes``: how often; 0: until nothing changes.
    """
    per_row = 1.0 / cols
    done = 0
    while passes == 0 or done < passes:
        kept = min(count, 1)
        last = path[0]
        r = row_of(last, per_row)
        for i in range(1, count):
            keep = i == count - 1
            if not keep:
                dr = row_of(path[i + 1], per_row) - r
                keep = not segment_free(blocked, cols, last, dr, path[i + 1] - last - dr * cols, policy)
            if keep:
                last = path[i]
                r = row_of(last, per_row)
                path[kept] = last
                kept += 1
        done += 1
        if kept == count:
            break
        count = kept
    return count


@kernel("i4[:, ::1](i4[:, ::1], u1[::1], i8, i8, i8)")
def delete_points(population, blocked, cols, policy, passes):
    """Drop every interior point of each path whose neighbours see each other, in the order of the path.

    ``passes``: how often; 0: until nothing changes.
    """
    n, width = population.shape
    out = blank(n, width)
    for k in range(n):
        row = out[k]
        count = length_of(population[k])
        copy(row, 0, population[k], 0, count)
        kept = drop_points(row, count, blocked, cols, policy, passes)
        for i in range(kept, count):
            row[i] = -1
    return trimmed(out)
