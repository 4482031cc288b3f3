"""Exact Pareto fronts of priced paths of single steps: label setting over (cell, heading).

Prices come as in ``headings``, with one more axis in front for the objectives.
They are whole numbers in float64, whose sums are exact: what is equal compares
equal, in whatever order it was added up.

A label is a walk from the start to a state (8 · cell + heading), known by its
bound ``f``: what it costs so far, and the least that each objective alone still
takes to the goal. Labels leave the heap in lexicographic order, so that within
one state the first objective of those that left before is never greater, and
need not be looked at (Pulido, Mandow and Pérez de la Cruz 2015).
"""

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import copy, unpack, with_room


@part("void(f8[:, ::1], i8, u1[::1], i8, i8, f8[:, ::1], f8[::1], f8[:, :, ::1], i4[::1])")
def _bound(to_go, objective, moves, cols, goal, step, cell, turn, zone):
    """Write what each state still costs at least for one objective: Dijkstra's search backwards from the goal."""
    states = 8 * moves.shape[0]
    cost = np.full(states, np.inf)
    heap = np.empty(states, np.int32)
    place = np.full(states, np.int32(-1), np.int32)
    size = 0
    for d in range(8):
        cost[8 * goal + d] = 0.0
        size = push(heap, place, cost, size, 8 * goal + d)
    while size > 0:
        state = pop(heap, place, cost, size)
        size -= 1
        there, d = state // 8, state % 8
        if not moves[there] >> (d + 4) % 8 & 1:  # nobody comes from there
            continue
        here = there - DR[d] * cols - DC[d]
        total = cost[state] + step[here if step.shape[0] > 1 else 0, d]
        if cell.shape[0] > 0:
            total += cell[there]
        z = zone[here] if zone.shape[0] > 0 else 0
        for h in range(8):
            if moves[here] >> (h + 4) % 8 & 1:
                before = 8 * here + h
                if total + turn[z, h, d] < cost[before]:
                    cost[before] = total + turn[z, h, d]
                    size = push(heap, place, cost, size, before)
    for state in range(states):
        to_go[state, objective] = cost[state]


@part("b1(f8[:, ::1], i8, i8)")
def _before(f, a, b):
    """Say whether label a comes before label b in lexicographic order."""
    for i in range(f.shape[1]):
        if f[a, i] != f[b, i]:
            return f[a, i] < f[b, i]
    return False


@part("void(i4[::1], i8, f8[:, ::1], i8)")
def _put(heap, size, f, label):
    """Put a label into the heap of this size."""
    i = size
    while i > 0:
        up = (i - 1) // 2
        if not _before(f, label, heap[up]):
            break
        heap[i] = heap[up]
        i = up
    heap[i] = label


@part("i8(i4[::1], i8, f8[:, ::1])")
def _take(heap, size, f):
    """Take the first label out of the heap of this size."""
    first, last = heap[0], heap[size - 1]
    size -= 1
    i = 0
    while True:
        down = 2 * i + 1
        if down >= size:
            break
        if down + 1 < size and _before(f, heap[down + 1], heap[down]):
            down += 1
        if not _before(f, heap[down], last):
            break
        heap[i] = heap[down]
        i = down
    heap[i] = last
    return first


@part("b1(f8[:, ::1], i4[::1], i8, i8)")
def _dominated(f, chain, first, label):
    """Say whether one of a chain of labels that left the heap before is nowhere greater, the first objective aside."""
    other = first
    while other >= 0:
        i = 1
        while i < f.shape[1] and f[other, i] <= f[label, i]:
            i += 1
        if i == f.shape[1]:
            return True
        other = chain[other]
    return False


@part("i8(f8[:, ::1], i4[::1], i8, i8)")
def _chained(f, chain, first, label):
    """Put a label in front of a chain, take out those that it makes superfluous, return the new first one."""
    chain[label] = first
    last, other = label, first
    while other >= 0:
        i = 1
        while i < f.shape[1] and f[label, i] <= f[other, i]:
            i += 1
        if i == f.shape[1]:
            chain[last] = chain[other]
        else:
            last = other
        other = chain[other]
    return label


@part("b1(f8[:, ::1], i4[::1], i4[::1], i8, i8, f8[:, ::1], f8[:, :, ::1])")
def _dominated_across(f, chain, first, label, state, to_go, across):
    """Say whether a walk that entered the same cell in another direction is as good, whatever follows."""
    cell, h = 8 * (state // 8), state % 8
    for other_h in range(8):
        other = first[cell + other_h] if other_h != h else -1
        while other >= 0:
            i = 0
            while i < f.shape[1] and (
                f[other, i] - to_go[cell + other_h, i] + across[other_h, h, i] <= f[label, i] - to_go[state, i]
            ):
                i += 1
            if i == f.shape[1]:
                return True
            other = chain[other]
    return False


@part("i4[::1](i4[::1], i8)")
def _longer(flat, room):
    """Return a longer copy of an array."""
    out = np.empty(room, np.int32)
    copy(out, 0, flat, 0, flat.shape[0])
    return out


@part("f8[:, ::1](f8[:, ::1], i8)")
def _taller(f, room):
    """Return a copy of a table with more rows."""
    out = np.empty((room, f.shape[1]))
    for k in range(f.shape[0]):
        for i in range(f.shape[1]):
            out[k, i] = f[k, i]
    return out


@part("i4[:, ::1](i4[::1], i8, i4[::1], i4[::1], i8)")
def _walks(found, n, of, parent, start):
    """Return the cells of the walks that end in these labels."""
    begin = np.zeros(n + 1, np.int64)
    for k in range(n):
        count, label = 1, found[k]
        while label >= 0:
            count += 1
            label = parent[label]
        begin[k + 1] = begin[k] + count
    flat = np.empty(begin[n], np.int32)
    for k in range(n):
        label = found[k]
        for i in range(begin[k + 1] - 1, begin[k], -1):
            flat[i] = of[label] // 8
            label = parent[label]
        flat[begin[k]] = start
    return unpack(flat, begin, n)


@kernel(
    "Tuple((i4[:, ::1], i8))"
    "(u1[::1], i8, i8, i8, f8[:, :, ::1], f8[:, ::1], f8[:, :, :, ::1], f8[:, :, :, ::1], i4[::1], i8)"
)
def front(moves, cols, start, goal, step, cell, turn, across, zone, limit):
    """Return a walk for each value that is not dominated, in lexicographic order, and the number of labels made.

    ``across`` (zones, 8, 8, objectives): how much more a walk that came in the
    first direction pays for its next turn, at most, than one that came in the
    second; inf where the two must not be compared. Past ``limit`` labels there
    are no walks.
    """
    m, states = step.shape[0], 8 * moves.shape[0]
    if start == goal:
        alone = np.empty((1, 1), np.int32)
        alone[0, 0] = start
        return alone, 0
    to_go = np.empty((states, m))
    for i in range(m):
        _bound(to_go, i, moves, cols, goal, step[i], cell[i], turn[i], zone)
    room = 1024
    f = np.empty((room, m))
    of = np.empty(room, np.int32)  # the label's state
    parent = np.empty(room, np.int32)
    chain = np.empty(room, np.int32)  # the next of the labels that left the heap in this state
    heap = np.empty(room, np.int32)
    first = np.full(states, np.int32(-1), np.int32)
    best = -1  # the first of the chain of labels at the goal
    found = np.empty(states, np.int32)
    found_count = labels = size = 0
    label, here, h, z = -1, start, -1, 0
    while True:
        if zone.shape[0] > 0:
            z = zone[here]
        if labels + 8 > room:
            room *= 2
            f, of, parent = _taller(f, room), _longer(of, room), _longer(parent, room)
            chain, heap = _longer(chain, room), _longer(heap, room)
        for d in range(8):
            if not moves[here] >> d & 1 or (h >= 0 and d == (h + 4) % 8):
                continue
            there = here + DR[d] * cols + DC[d]
            state = 8 * there + d
            if to_go[state, 0] == np.inf:
                continue
            for i in range(m):
                total = step[i, here if step.shape[1] > 1 else 0, d] + to_go[state, i]
                if cell.shape[1] > 0:
                    total += cell[i, there]
                if h >= 0:
                    total += turn[i, z, h, d] + f[label, i] - to_go[8 * here + h, i]
                f[labels, i] = total
            if _dominated(f, chain, best, labels) or _dominated(f, chain, first[state], labels):
                continue
            if _dominated_across(
                f, chain, first, labels, state, to_go, across[zone[there] if zone.shape[0] > 0 else 0]
            ):
                continue
            of[labels], parent[labels] = state, label
            _put(heap, size, f, labels)
            labels += 1
            size += 1
        if labels > limit:
            return np.empty((0, 1), np.int32), labels
        expand = False
        while size > 0 and not expand:
            label = _take(heap, size, f)
            size -= 1
            state = of[label]
            here, h = state // 8, state % 8
            if _dominated(f, chain, best, label):
                continue
            if here == goal:
                best = _chained(f, chain, best, label)
                found = with_room(found, found_count, 1)
                found[found_count] = label
                found_count += 1
                continue
            if _dominated(f, chain, first[state], label):
                continue
            if zone.shape[0] > 0:
                z = zone[here]
            if _dominated_across(f, chain, first, label, state, to_go, across[z]):
                continue
            first[state] = _chained(f, chain, first[state], label)
            expand = True
        if not expand:
            break
    return _walks(found, found_count, of, parent, start), labels
