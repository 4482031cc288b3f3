"""Seeds along cheapest trees over cells and headings, under prices that are perturbed cell by cell.

Prices and states are those of ``headings``; entering a cell costs its random
factor times what it costs otherwise.
"""

import numpy as np

from pathloom.compiled.directions import DC, DR
from pathloom.compiled.headings import previous
from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below, uniform
from pathloom.compiled.rows import copy, remove_loops, unpack, with_room


@part("f8[::1](i8, f8, u8[::1])")
def _factors(cells, spread, state):
    """Return one factor for each cell, uniform in [1, 1 + spread]."""
    factor = np.empty(cells)
    for cell in range(cells):
        factor[cell] = 1.0 + spread * uniform(state)
    return factor


@part("f8(i8, i8, i8, i8, f8[:, ::1], f8[::1], f8[:, :, ::1], i4[::1])")
def _price(here, h, d, there, step, cell, turn, zone):
    """Return what a step costs, after a turn if there was a heading (0 to 7) before."""
    price = step[here if step.shape[0] > 1 else 0, d]
    if cell.shape[0] > 0:
        price += cell[there]
    if h < 8:
        price += turn[zone[here] if zone.shape[0] > 0 else 0, h, d]
    return price


@part("f8(f8[::1], u1[::1], f8[::1], f8, u1[::1], i8, i8, i8, f8[:, ::1], f8[::1], f8[:, :, ::1], i4[::1])")
def _outwards(cost, before, factor, detour, moves, cols, start, goal, step, cell, turn, zone):
    """Write what each state costs, and the heading before it, as far as ``detour`` times the goal; return its cost."""
    states = 8 * moves.shape[0]
    heap, place = np.empty(states, np.int32), np.full(states, np.int32(-1), np.int32)
    size, here, h, so_far, reached = 0, start, 8, 0.0, np.inf
    while True:
        for d in range(8):
            if moves[here] >> d & 1 and (h == 8 or d != (h + 4) % 8):
                there = here + DR[d] * cols + DC[d]
                total = so_far + factor[there] * _price(here, h, d, there, step, cell, turn, zone)
                if total < cost[8 * there + d]:
                    cost[8 * there + d] = total
                    before[8 * there + d] = h
                    size = push(heap, place, cost, size, 8 * there + d)
        if size == 0 or cost[heap[0]] > detour * reached:
            return reached
        state = pop(heap, place, cost, size)
        size -= 1
        here, h, so_far = state // 8, state % 8, cost[state]
        if here == goal and reached == np.inf:
            reached = so_far


@part("void(f8[::1], u1[::1], f8[::1], f8, u1[::1], i8, i8, f8[:, ::1], f8[::1], f8[:, :, ::1], i4[::1])")
def _inwards(cost, after, factor, limit, moves, cols, goal, step, cell, turn, zone):
    """Write what it costs from each state to the goal, and the heading after it, as far as ``limit``."""
    states = 8 * moves.shape[0]
    heap, place = np.empty(states, np.int32), np.full(states, np.int32(-1), np.int32)
    size = 0
    for d in range(8):
        cost[8 * goal + d] = 0.0
        size = push(heap, place, cost, size, 8 * goal + d)
    while size > 0 and cost[heap[0]] <= limit:
        state = pop(heap, place, cost, size)
        size -= 1
        there, d = state // 8, state % 8
        if moves[there] >> (d + 4) % 8 & 1:
            here = there - DR[d] * cols - DC[d]
            for h in range(8):
                if moves[here] >> (h + 4) % 8 & 1 and h != (d + 4) % 8:
                    total = cost[state] + factor[there] * _price(here, h, d, there, step, cell, turn, zone)
                    if total < cost[8 * here + h]:
                        cost[8 * here + h] = total
                        after[8 * here + h] = d
                        size = push(heap, place, cost, size, 8 * here + h)


@kernel("i4[:, ::1](i8, u1[::1], i8, i8, i8, f8[:, ::1], f8[::1], f8[:, :, ::1], i4[::1], f8, f8, u8[::1])")
def sample_from_priced_trees(n, moves, cols, start, goal, step, cell, turn, zone, spread, detour, state):
    """Draw n paths through random states, along two cheapest trees; none where there is no way.

    A state's detour through both trees costs at most ``detour`` times the direct way.
    """
    cells, states = moves.shape[0], 8 * moves.shape[0]
    flat, begin = np.empty(4096, np.int32), np.zeros(n + 1, np.int64)
    out, home = np.full(states, np.inf), np.full(states, np.inf)
    before, after = np.full(states, np.uint8(8), np.uint8), np.full(states, np.uint8(8), np.uint8)
    direct = 0.0
    if start != goal:
        factor = _factors(cells, spread, state)
        direct = _outwards(out, before, factor, detour, moves, cols, start, goal, step, cell, turn, zone)
        if direct == np.inf:
            return np.empty((0, 1), np.int32)
        factor = _factors(cells, spread, state)
        _inwards(home, after, factor, detour * direct, moves, cols, goal, step, cell, turn, zone)
    limit = detour * direct
    near = np.empty(states, np.int32)
    count = 0
    for s in range(states):
        if out[s] + home[s] <= limit or (s // 8 == goal and out[s] <= limit):
            near[count] = s
            count += 1
    mark, path = np.zeros(cells, np.int32), np.empty(2 * states + 2, np.int32)
    for k in range(n):
        size = 1
        path[0] = start
        if start != goal:
            through = near[below(state, count)]
            s = np.int64(through)
            while s >= 0:
                size += 1
                s = previous(before, cols, s)
            s = np.int64(through)
            for i in range(size - 1, 0, -1):
                path[i] = s // 8
                s = previous(before, cols, s)
            s = np.int64(through)
            while s // 8 != goal:
                d = after[s]
                s = 8 * (s // 8 + DR[d] * cols + DC[d]) + d
                path[size] = s // 8
                size += 1
            size = remove_loops(path, size, mark)
        flat = with_room(flat, begin[k], size)
        copy(flat, begin[k], path, 0, size)
        begin[k + 1] = begin[k] + size
    return unpack(flat, begin, n)
