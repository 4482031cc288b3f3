"""Crossing: where two paths meet or pass beside each other, and where one comes back beside itself."""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import blank, copy, hash_of, length_of, remove_loops, row_of, unpack, with_room


@part("f8(i4[::1], i8, i8)")
def _length(path, count, cols):
    """Return the Euclidean length of a path, the same for any order of single steps."""
    per_row = 1.0 / cols
    straight = diagonal = 0
    total = 0.0
    for i in range(1, count):
        dr = row_of(path[i], per_row) - row_of(path[i - 1], per_row)
        dc = path[i] - path[i - 1] - dr * cols
        squared = dr * dr + dc * dc
        if squared == 1:
            straight += 1
        elif squared == 2:
            diagonal += 1
        else:
            total += math.sqrt(squared)
    return straight + diagonal * math.sqrt(2.0) + total


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
    n, width = population.shape
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
    most = 1
    failed = tried = 0
    for p in range(pairs.shape[0]):
        first, second = population[pairs[p, 0]], population[pairs[p, 1]]
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
        if found == 0:
            failed += 1
        lengths[0] = lengths[1] = np.inf
        for q in range(min(found, most_points)):
            i, j = points[q, 0], points[q, 1]
            for side in range(2):
                # at a common cell the tail begins behind it, beside each other with the cell itself
                if side == 0:
                    tail = j + 1 if common else j
                    copy(child, 0, first, 0, i + 1)
                    copy(child, i + 1, second, tail, k - tail)
                    count = i + 1 + k - tail
                else:
                    tail = i + 1 if common else i
                    copy(child, 0, second, 0, j + 1)
                    copy(child, j + 1, first, tail, m - tail)
                    count = j + 1 + m - tail
                count = remove_loops(child, count, mark)
                tried += 1
                length = _length(child, count, cols)
                value = hash_of(child, count)
                if length >= lengths[1]:
                    continue
                if lengths[0] < np.inf and value == hashes[0] and count == counts[0]:
                    continue
                to = 1
                if length < lengths[0]:
                    copy(kept[1], 0, kept[0], 0, counts[0])
                    counts[1], hashes[1], lengths[1] = counts[0], hashes[0], lengths[0]
                    to = 0
                copy(kept[to], 0, child, 0, count)
                counts[to], hashes[to], lengths[to] = count, value, length
        for side in range(2):
            made = counts[side] if lengths[side] < np.inf else 0
            at = 2 * p + side
            flat = with_room(flat, begin[at], made)
            copy(flat, begin[at], kept[side], 0, made)
            begin[at + 1] = begin[at] + made
            most = max(most, made)
    for k in range(n):
        most = max(most, length_of(population[k]))
    out = blank(n, most)
    for k in range(n):
        copy(out[k], 0, population[k], 0, length_of(population[k]))
    for at in range(2 * pairs.shape[0]):
        made = begin[at + 1] - begin[at]
        if made > 0:
            row = out[pairs[at // 2, at % 2]]
            copy(row, 0, flat, begin[at], made)
            for i in range(made, most):
                row[i] = -1
    return out, failed, tried


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
