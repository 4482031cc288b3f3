"""The linear trial: a segment is sampled in small steps, and each sample is rounded to a cell.

Hao et al. 2021, section 3, eqs. (3) to (6); with the two operators whose new
segments it tests. Coordinates are the paper's, since the verdict of floating
arithmetic depends on them: x = column + 1, y = rows − row, for a way from the
lower left to the upper right. For other ways they are mirrored, so that axes
point from start to goal.

How the operators test a segment is said by four numbers: ``tests``, the sum of
1 for the trial, 2 for the exact test under ``policy``, 4 and 8 for mirrored rows
and columns; ``step``, the distance of samples along the longer axis; and
``parts``, its reciprocal where the trial is done in integers, 0 where it is done
in floating point.
"""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.exchange import splice
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import blank, copy, length_of, remove_loops, row_of
from pathloom.compiled.segments import segment_free

TRIAL, EXACT, MIRRORED_ROWS, MIRRORED_COLS = 1, 2, 4, 8
REFUSED, FREE, MISSED = 0, 1, 2
"""Verdicts; ``MISSED``: free by the trial, not by the exact test."""


@part("i8(f8)")
def _rounded(u):
    """Return the nearest integer, a half rounded down, eq. (6)."""
    low = math.floor(u)
    return low if u - low <= 0.5 else low + 1


@part("i8(i8, i8, i8, i8, i8)")
def _cell(x, y, rows, cols, tests):
    """Return the cell at these coordinates."""
    r = y - 1 if tests & MIRRORED_ROWS else rows - y
    c = cols - x if tests & MIRRORED_COLS else x - 1
    return r * cols + c


@part("b1(u1[::1], i8, i8, i8, i8, i8, i8, f8, i8)")
def _floating_trial(blocked, rows, cols, xi, yi, xj, yj, step, tests):
    """Sample in floating point, each sample a sum of all steps before it."""
    steep = abs(yj - yi) > abs(xj - xi)
    if steep:
        xi, yi, xj, yj = yi, xi, yj, xj
    if xi == xj:
        return True
    k = (yj - yi) / (xj - xi)  # eq. (3)
    b = yi - k * xi  # eq. (4)
    at = float(min(xi, xj))
    end = max(xi, xj)
    while at < end:
        at += step
        along, across = _rounded(at), _rounded(k * at + b)  # eqs. (5) and (6)
        x, y = (across, along) if steep else (along, across)
        if blocked[_cell(x, y, rows, cols, tests)]:
            return False
    return True


@part("b1(u1[::1], i8, i8, i8, i8, i8, i8, i8, i8)")
def _integer_trial(blocked, rows, cols, xi, yi, xj, yj, parts, tests):
    """Sample at exact places: t / parts along the longer axis, t being 1, 2 and so on."""
    steep = abs(yj - yi) > abs(xj - xi)
    if steep:
        xi, yi, xj, yj = yi, xi, yj, xj
    if xi > xj:
        xi, yi, xj, yj = xj, yj, xi, yi
    extent, rise = xj - xi, yj - yi
    for t in range(1, extent * parts + 1):
        # eq. (6): a quotient p / q with a half rounded down is ⌈(2 p − q) / 2 q⌉
        along = xi - (parts - 2 * t) // (2 * parts)
        across = yi - (extent * parts - 2 * rise * t) // (2 * extent * parts)
        x, y = (across, along) if steep else (along, across)
        if blocked[_cell(x, y, rows, cols, tests)]:
            return False
    return True


@part("i8(u1[::1], i8, i8, i8, i8, i8, i8, f8, i8)")
def verdict(blocked, rows, cols, first, second, policy, tests, step, parts):
    """Test the segment between two cells."""
    per_row = 1.0 / cols
    r, s = row_of(first, per_row), row_of(second, per_row)
    c, d = first - r * cols, second - s * cols
    if tests & TRIAL:
        xi, xj = (cols - c, cols - d) if tests & MIRRORED_COLS else (c + 1, d + 1)
        yi, yj = (r + 1, s + 1) if tests & MIRRORED_ROWS else (rows - r, rows - s)
        if parts > 0:
            passed = _integer_trial(blocked, rows, cols, xi, yi, xj, yj, parts, tests)
        else:
            passed = _floating_trial(blocked, rows, cols, xi, yi, xj, yj, step, tests)
        if not passed:
            return REFUSED
    if tests & EXACT and not segment_free(blocked, cols, first, s - r, d - c, policy):
        return MISSED if tests & TRIAL else REFUSED
    return FREE


@kernel("Tuple((b1[::1], i8))(i4[::1], i4[::1], u1[::1], i8, i8, i8, i8, f8, i8)")
def segments_free(first, second, blocked, rows, cols, policy, tests, step, parts):
    """Test many segments, first[k] to second[k]; also return how many the trial alone took for free."""
    free = np.empty(first.shape[0], np.bool_)
    missed = 0
    for k in range(first.shape[0]):
        found = verdict(blocked, rows, cols, first[k], second[k], policy, tests, step, parts)
        free[k] = found == FREE
        missed += found == MISSED
    return free, missed


@kernel("Tuple((i8[:, ::1], i4[:, ::1]))(i4[:, ::1], i8[:, ::1], u8[::1])")
def draw_cuts(population, pairs, state):
    """Cut both parents of each pair behind a random place, the last one apart.

    Returns for each parent the place, −1 where there is none in one of the two,
    and for each child the two cells that it joins: side by side, p by p.
    """
    at = np.empty((pairs.shape[0], 2), np.int64)
    joints = np.empty((2 * pairs.shape[0], 2), np.int32)
    for p in range(pairs.shape[0]):
        x, y = population[pairs[p, 0]], population[pairs[p, 1]]
        gaps_x, gaps_y = length_of(x) - 1, length_of(y) - 1
        if gaps_x < 1 or gaps_y < 1:
            at[p, 0] = at[p, 1] = -1
            joints[2 * p, 0] = joints[2 * p, 1] = x[0]
            joints[2 * p + 1, 0] = joints[2 * p + 1, 1] = y[0]
            continue
        i, j = below(state, gaps_x), below(state, gaps_y)
        at[p, 0], at[p, 1] = i, j
        joints[2 * p, 0], joints[2 * p, 1] = x[i], y[j + 1]
        joints[2 * p + 1, 0], joints[2 * p + 1, 1] = y[j], x[i + 1]
    return at, joints


@kernel("Tuple((i4[:, ::1], i8, i8))(i4[:, ::1], i8[:, ::1], u1[::1], i8, i8, i8, i8, f8, i8, u8[::1])")
def cut_and_join(population, pairs, blocked, rows, cols, policy, tests, step, parts, state):
    """Let each pair exchange tails behind random cuts, where the segment that joins the halves is free.

    Loops are cut out. Returns the population with the children in their parents'
    rows, how many children were not made, and how many of those the trial alone
    would have let pass.
    """
    at, joints = draw_cuts(population, pairs, state)
    wanted = np.empty((pairs.shape[0], 2), np.bool_)
    failed = missed = 0
    for p in range(pairs.shape[0]):
        for side in range(2):
            wanted[p, side] = at[p, 0] >= 0
            if wanted[p, side] and tests != 0:
                a, b = joints[2 * p + side, 0], joints[2 * p + side, 1]
                found = verdict(blocked, rows, cols, a, b, policy, tests, step, parts)
                wanted[p, side] = found == FREE
                missed += found == MISSED
            failed += not wanted[p, side]
    return splice(population, pairs, at, wanted, blocked.shape[0], False), failed, missed


@kernel("Tuple((i8[::1], i4[::1]))(i4[:, ::1], i8[::1], i4[::1], u1[::1], i8, i8, u8[::1])")
def draw_genes(population, chosen, anywhere, blocked, rows, cols, state):
    """Draw for each chosen path an interior place and a free cell to stand there; −1 for the place: there is none.

    The cell is one of ``anywhere``, or of the 8 neighbours of the old one if that
    is empty; neither the old one nor one of the two beside it on the path.
    """
    places = np.full(chosen.shape[0], np.int64(-1))
    cells = np.full(chosen.shape[0], np.int32(-1))
    for q in range(chosen.shape[0]):
        row = population[chosen[q]]
        count = length_of(row)
        if count < 3:
            continue
        i = 1 + below(state, count - 2)
        cell = np.int64(-1)
        if anywhere.shape[0] > 0:
            cell = np.int64(anywhere[below(state, anywhere.shape[0])])
            if cell in (row[i - 1], row[i], row[i + 1]):
                cell = np.int64(-1)
        else:
            r = row[i] // cols
            c = row[i] - r * cols
            good = 0
            for d in range(8):
                rr, cc = r + DR[d], c + DC[d]
                if rr < 0 or rr >= rows or cc < 0 or cc >= cols:
                    continue
                beside = rr * cols + cc
                if blocked[beside] or beside in (row[i - 1], row[i + 1]):
                    continue
                good += 1
                if below(state, good) == 0:
                    cell = beside
        if cell >= 0:
            places[q] = i
            cells[q] = cell
    return places, cells


@kernel("i4[:, ::1](i4[:, ::1], i8[::1], i8[::1], i4[::1], i8)")
def put_genes(population, chosen, places, cells, size):
    """Put a cell into a place of each chosen path, where the place is not −1, and cut out loops."""
    n, width = population.shape
    mark = np.zeros(size, np.int32)
    out = blank(n, width)
    for k in range(n):
        copy(out[k], 0, population[k], 0, width)
    for q in range(chosen.shape[0]):
        if places[q] >= 0:
            row = out[chosen[q]]
            row[places[q]] = cells[q]
            count = length_of(row)
            for i in range(remove_loops(row, count, mark), count):
                row[i] = -1
    return out


@kernel("Tuple((i4[:, ::1], i8, i8))(i4[:, ::1], i8[::1], i4[::1], u1[::1], i8, i8, i8, i8, f8, i8, u8[::1])")
def replace_genes(population, chosen, anywhere, blocked, rows, cols, policy, tests, step, parts, state):
    """Replace a random interior cell of each chosen path, where both new segments are free.

    Loops are cut out. Returns the population, how many paths stay as they are,
    and how many of those the trial alone would have let pass.
    """
    places, cells = draw_genes(population, chosen, anywhere, blocked, rows, cols, state)
    failed = missed = 0
    for q in range(chosen.shape[0]):
        i = places[q]
        if i >= 0 and tests != 0:
            row = population[chosen[q]]
            found = verdict(blocked, rows, cols, row[i - 1], cells[q], policy, tests, step, parts)
            if found == FREE:
                found = verdict(blocked, rows, cols, cells[q], row[i + 1], policy, tests, step, parts)
            missed += found == MISSED
            if found != FREE:
                places[q] = -1
        failed += places[q] < 0
    return put_genes(population, chosen, places, cells, blocked.shape[0]), failed, missed
