"""Exchange of tails at a position, whatever cell stands there: the two parts are joined by median insertion."""

import numpy as np

from pathloom.compiled.insertion import connect
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, length_of, remove_loops, with_changed, with_room


@part("b1(i4[::1], i4[::1])")
def _same(one, other):
    """Say whether two padded rows hold the same path."""
    for i in range(one.shape[0]):
        if one[i] != other[i]:
            return False
        if one[i] < 0:
            break
    return True


@kernel("Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[:, ::1], u1[::1], u1[::1], i8, i8, i8, i8, i8, i8, b1, b1, u8[::1])")
def exchange_at_position(
    population, pairs, blocked, moves, rows, cols, sign_r, sign_c, reach, cap, guarded, loops, state
):
    """Let each pair exchange what comes after a random interior position of the shorter parent.

    The two parts of a child are joined by median insertion. Parents that are
    alike stay. Returns the population with the children in their parents' rows,
    and the number of children that could not be joined, or whose parents have no
    interior: there the parent stays.
    """
    width = population.shape[1]
    mark = np.zeros(rows * cols, np.int32)
    stack = np.empty(cap + 2, np.int64)
    path = np.empty(width + cap + 8, np.int32)
    flat = np.empty(2 * pairs.shape[0] * (width + 8) + path.shape[0], np.int32)
    begin = np.zeros(2 * pairs.shape[0] + 1, np.int64)
    failed = 0
    for p in range(pairs.shape[0]):
        shorter = min(length_of(population[pairs[p, 0]]), length_of(population[pairs[p, 1]]))
        alike = shorter >= 3 and _same(population[pairs[p, 0]], population[pairs[p, 1]])
        at = 1 + below(state, shorter - 2) if shorter >= 3 else 0
        for side in range(2):
            head, tail = population[pairs[p, side]], population[pairs[p, 1 - side]]
            made = 0
            if at > 0 and not alike:
                copy(path, 0, head, 0, at + 1)
                made = connect(
                    head[at], tail[at + 1], blocked, moves, rows, cols, sign_r, sign_c, reach,
                    cap, guarded, path, at + 1, stack, state,
                )  # fmt: skip
            if made > 0:
                rest = length_of(tail) - at - 2
                copy(path, made, tail, at + 2, rest)
                made += rest
                if not loops:
                    made = remove_loops(path, made, mark)
            elif not alike:
                failed += 1
                made = 0
            k = 2 * p + side
            flat = with_room(flat, begin[k], made)
            copy(flat, begin[k], path, 0, made)
            begin[k + 1] = begin[k] + made
    return with_changed(population, pairs.ravel(), flat, begin), failed
