"""Crossing: where two paths meet or pass beside each other, and where one comes back beside itself."""

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import (
    copy,
    hash_of,
    length_between,
    length_of,
    remove_loops,
    unpack,
    with_changed,
    with_room,
)


@part("i8(i8[:, ::1], i8, i8, i8, u8[::1])")
def _keep(points, seen, i, j, state):
    """Put the point (i, j), of which ``seen`` came before, into a reservoir in random order."""
    room = points.shape[0]
    if seen < room:
        slot = below(state, seen + 1)
        points[seen, 0], points[seen, 1] = points[slot, 0], points[slot, 1]
        points[slot, 0], points[slot, 1] = i, j
    else:
        slot = below(state, seen + 1)
        if slot < room:
            points[slot, 0], points[slot, 1] = i, j
    return seen + 1


@part("Tuple((i8, b1))(i4[::1], i4[::1], i8[:, ::1], i4[::1], u1[::1], i8, b1, u8[::1])")
def _meetings(first, second, points, position, moves, cols, beside, state):
    """Put where two paths meet, as a place on either, into a reservoir; or, if they do not, where they pass ``beside``.

    Returns how many such points there are, and whether they are common cells.
    ``position`` (one entry a cell) is all zero before and after.
    """
    m, k = length_of(first), length_of(second)
    for i in range(1, m - 1):
        position[first[i]] = i
    found = 0
    for j in range(1, k - 1):
        if position[second[j]] > 0:
            found = _keep(points, found, position[second[j]], j, state)
    common = found > 0
    if beside and not common:
        for j in range(1, k - 1):
            for d in range(8):
                if moves[second[j]] >> d & 1:
                    i = position[second[j] + DR[d] * cols + DC[d]]
                    if i > 0:
                        found = _keep(points, found, i, j, state)
    for i in range(1, m - 1):
        position[first[i]] = 0
    return found, common


@part("i8(i4[::1], i4[::1], i8, i4[::1], i8, i4[::1])")
def _child(child, head, upto, other, begin, mark):
    """Write one path up to a place and the other from a place on, without loops; return how many cells that is."""
    tail = length_of(other) - begin
    copy(child, 0, head, 0, upto + 1)
    copy(child, upto + 1, other, begin, tail)
    return remove_loops(child, upto + 1 + tail, mark)


@part("void(i4[:, ::1], i8[::1], u8[::1], f8[::1], i4[::1], i8, f8)")
def _keep_if_short(kept, counts, hashes, lengths, child, count, length):
    """Keep a child if it is shorter than one of the two kept, the shorter one first, and not the same as that."""
    value = hash_of(child, count)
    if length >= lengths[1] or (lengths[0] < np.inf and value == hashes[0] and count == counts[0]):
        return
    to = 1
    if length < lengths[0]:
        copy(kept[1], 0, kept[0], 0, counts[0])
        counts[1], hashes[1], lengths[1] = counts[0], hashes[0], lengths[0]
        to = 0
    copy(kept[to], 0, child, 0, count)
    counts[to], hashes[to], lengths[to] = count, value, length


@kernel("Tuple((i4[:, ::1], i8, i8))(i4[:, ::1], i8[:, ::1], u1[::1], i8, i8, b1, u8[::1])")
def cross_where_shortest(population, pairs, moves, cols, most_points, beside, state):
    """Let each pair exchange tails wherever both meet, and keep the two shortest different children.

    At most ``most_points`` common cells, ends apart, are tried, drawn at random
    where there are more. ``beside``: where there is none, pairs of cells that
    are one legal step apart. Of equally short children each may be kept; loops
    are cut out. The shortest child takes the place of the first parent; the
    second parent stays where all children are equal.

    Returns the population, the number of pairs that meet nowhere, which stay,
    and the number of children tried.
    """
    width = population.shape[1]
    mark = np.zeros(moves.shape[0], np.int32)
    position = np.zeros(moves.shape[0], np.int32)  # of the first parent's cells; mark is for loops
    points = np.empty((most_points, 2), np.int64)
    child = np.empty(2 * width, np.int32)
    kept = np.empty((2, 2 * width), np.int32)
    counts = np.zeros(2, np.int64)
    hashes = np.zeros(2, np.uint64)
    lengths = np.zeros(2)
    flat = np.empty(2 * pairs.shape[0] * (width + 8) + 2 * width, np.int32)
    begin = np.zeros(2 * pairs.shape[0] + 1, np.int64)
    failed = tried = 0
    for p in range(pairs.shape[0]):
        first, second = population[pairs[p, 0]], population[pairs[p, 1]]
        found, common = _meetings(first, second, points, position, moves, cols, beside, state)
        failed += found == 0
        lengths[0] = lengths[1] = np.inf
        for q in range(min(found, most_points)):
            i, j = points[q, 0], points[q, 1]
            behind = 1 if common else 0  # beside each other, the tail begins with the cell itself
            for side in range(2):
                if side == 0:
                    count = _child(child, first, i, second, j + behind, mark)
                else:
                    count = _child(child, second, j, first, i + behind, mark)
                length = length_between(child, 0, count - 1, cols)
                _keep_if_short(kept, counts, hashes, lengths, child, count, length)
                tried += 1
        for side in range(2):
            made = counts[side] if lengths[side] < np.inf else 0
            at = 2 * p + side
            flat = with_room(flat, begin[at], made)
            copy(flat, begin[at], kept[side], 0, made)
            begin[at + 1] = begin[at] + made
    return with_changed(population, pairs.ravel(), flat, begin), failed, tried


@kernel("i4[:, ::1](i4[:, ::1], u1[::1], i8)")
def without_detours(population, moves, cols):
    """Cut out of each path whatever lies between two of its cells that are one legal step apart, loops included.

    From each cell that is kept the path goes on with the last of its cells that
    can be stepped to; where there is none further on, with the next one.
    """
    n = population.shape[0]
    last = np.zeros(moves.shape[0], np.int32)
    flat = np.empty(n * population.shape[1] + 8, np.int32)
    begin = np.zeros(n + 1, np.int64)
    at = 0
    for k in range(n):
        row = population[k]
        count = length_of(row)
        for i in range(count):
            last[row[i]] = i
        flat = with_room(flat, at, count)
        i = 0
        while True:
            cell = row[i]
            flat[at] = cell
            at += 1
            i = last[cell]
            if i == count - 1:
                break
            following = i + 1
            for d in range(8):
                if moves[cell] >> d & 1:
                    following = max(following, last[cell + DR[d] * cols + DC[d]])
            i = following
        for i in range(count):
            last[row[i]] = 0
        begin[k + 1] = at
    return unpack(flat, begin, n)
