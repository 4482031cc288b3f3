"""Kernels on priced paths of single steps, where a turn has its price too: search over (cell, heading).

Prices come as four tables: ``step`` (1 or cells, 8) by cell left and direction,
``cell`` (cells or 0) by cell entered, ``turn`` (zones, 8, 8) by direction in and
out, ``zone`` (cells or 0) the zone of each cell. A state is 8 · cell + heading,
the heading being the direction in which the cell was entered.
"""

import numpy as np

from pathloom.compiled.directions import DC, DR, TOWARDS
from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import length_of, row_of


@kernel("f8[::1](i4[:, ::1], i8, f8[:, ::1], f8[::1], f8[:, :, ::1], i4[::1])")
def price(population, cols, step, cell, turn, zone):
    """Return what each path costs; nan for one with another step than to one of the 8 neighbours."""
    n = population.shape[0]
    per_row = 1.0 / cols
    found = np.zeros(n)
    for k in range(n):
        heading = -1
        for i in range(1, length_of(population[k])):
            here, there = population[k, i - 1], population[k, i]
            r = row_of(here, per_row)
            dr = row_of(there, per_row) - r
            dc = there - here - dr * cols
            d = TOWARDS[3 * (dr + 1) + dc + 1] if abs(dr) <= 1 and abs(dc) <= 1 else -1
            if d < 0:
                found[k] = np.nan
                break
            found[k] += step[here if step.shape[0] > 1 else 0, d]
            if cell.shape[0] > 0:
                found[k] += cell[there]
            if heading >= 0:
                found[k] += turn[zone[here] if zone.shape[0] > 0 else 0, heading, d]
            heading = d
    return found


@part("f8[::1](u1[::1], i8, i8, f8[:, ::1], f8[::1])")
def _to_go(moves, cols, goal, step, cell):
    """Return what each cell costs at least from there to the goal, turns not counted."""
    cells = moves.shape[0]
    cost = np.full(cells, np.inf)
    heap = np.empty(cells, np.int32)
    place = np.full(cells, np.int32(-1), np.int32)
    cost[goal] = 0.0
    size = push(heap, place, cost, 0, goal)
    while size > 0:
        here = pop(heap, place, cost, size)
        size -= 1
        entering = cost[here] + (cell[here] if cell.shape[0] > 0 else 0.0)
        for back in range(8):
            if moves[here] >> back & 1:  # what can be left in a direction can be entered from there
                before = here + DR[back] * cols + DC[back]
                total = entering + step[before if step.shape[0] > 1 else 0, (back + 4) % 8]
                if total < cost[before]:
                    cost[before] = total
                    size = push(heap, place, cost, size, before)
    return cost


@part("i8(u1[::1], i8, i8)")
def previous(before, cols, state):
    """Return the state before this one, −1 at the first."""
    if before[state] == 8:
        return -1
    return 8 * (state // 8 - DR[state % 8] * cols - DC[state % 8]) + before[state]


@part("i4[::1](u1[::1], i8, i8, i8)")
def _walk(before, cols, start, last):
    """Return the cells from the start to a state."""
    count, state = 1, last
    while state >= 0:
        count += 1
        state = previous(before, cols, state)
    walk = np.empty(count, np.int32)
    walk[0] = start
    state = last
    for i in range(count - 1, 0, -1):
        walk[i] = state // 8
        state = previous(before, cols, state)
    return walk


@kernel("i4[::1](u1[::1], i8, i8, i8, f8[:, ::1], f8[::1], f8[:, :, ::1], i4[::1])")
def cheapest(moves, cols, start, goal, step, cell, turn, zone):
    """Return the cells of a cheapest walk from start to goal; empty where there is none.

    A* (Hart et al. 1968) over cells and headings. What is left to pay is bounded
    by the exact cost without turns, from a search backwards from the goal.
    """
    alone = np.empty(1, np.int32)
    alone[0] = start
    if start == goal:
        return alone
    bound = _to_go(moves, cols, goal, step, cell)
    states = 8 * moves.shape[0]
    cost = np.full(states, np.inf)
    key = np.full(states, np.inf)
    before = np.full(states, np.uint8(8), np.uint8)  # the heading before; 8: none, the walk begins there
    heap = np.empty(states, np.int32)
    place = np.full(states, np.int32(-1), np.int32)
    size = 0
    here, heading, so_far, z = start, 8, 0.0, 0
    while bound[start] < np.inf:
        left = here if step.shape[0] > 1 else 0
        if zone.shape[0] > 0:
            z = zone[here]
        for d in range(8):
            if moves[here] >> d & 1:
                there = here + DR[d] * cols + DC[d]
                total = so_far + step[left, d]
                if heading < 8:
                    total += turn[z, heading, d]
                if cell.shape[0] > 0:
                    total += cell[there]
                state = 8 * there + d
                if total < cost[state]:
                    cost[state] = total
                    key[state] = total + bound[there]
                    before[state] = heading
                    size = push(heap, place, key, size, state)
        state = pop(heap, place, key, size)
        size -= 1
        here, heading, so_far = state // 8, state % 8, cost[state]
        if here == goal:
            return _walk(before, cols, start, state)
    return np.empty(0, np.int32)
