"""Ants on a grid: their march, and the pheromone on its edges.

Pheromone and what makes a step desirable are float64 (cells, 8): an entry for
each cell and each of the eight directions out of it. Entries of steps that are
not legal mean nothing.
"""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR, TOWARDS
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below, uniform
from pathloom.compiled.rows import copy, row_of, unpack, with_room


@part("i8(f8[::1], i8[::1], i8, f8, u8[::1])")
def chosen_step(strengths, steps, options, total, state):
    """Return one of the first ``options`` entries of ``steps``, each with its share of the total strength.

    Strengths that are infinite share the choice among themselves, and where all
    are zero every step is as likely.
    """
    if 0.0 < total < np.inf:
        left = uniform(state) * total
        for k in range(options - 1):
            left -= strengths[k]
            if left < 0.0:
                return steps[k]
        return steps[options - 1]
    infinite = 0
    for k in range(options):
        infinite += strengths[k] == np.inf
    if infinite == 0:
        return steps[below(state, options)]
    pick = below(state, infinite)
    for k in range(options):
        if strengths[k] == np.inf:
            if pick == 0:
                return steps[k]
            pick -= 1
    return steps[0]


@kernel("Tuple((i4[:, ::1], i4[::1]))(i8, f8[:, ::1], f8[:, ::1], f8, u1[::1], u1[::1], i8, i8, i8, b1, u8[::1])")
def march(ants, pheromone, desire, alpha, moves, closed, cols, start, goal, retreat, state):
    """Send ants from start to goal: each step in proportion to pheromone^alpha · desire, to no cell twice.

    An infinite desire is followed whatever the pheromone. No ant enters a cell
    that is ``closed``. One that finds no cell to go to dies or, ``retreat``,
    takes one step back, as often as it must: it then arrives wherever there is a
    way. Returns the paths of the ants that arrived, and for every cell but start
    and goal how many ants found no way on from it.
    """
    cells = moves.shape[0]
    strength = pheromone
    if alpha != 1.0:
        strength = np.empty((cells, 8))
        for cell in range(cells):
            for d in range(8):
                if moves[cell] >> d & 1:
                    strength[cell, d] = pheromone[cell, d] ** alpha
    offset = DR * cols + DC
    visited = np.zeros(cells, np.int32)
    for cell in range(cells):
        if closed[cell]:
            visited[cell] = ants + 1  # as if by an ant that comes after all others
    stuck = np.zeros(cells, np.int32)
    path = np.empty(cells, np.int32)
    strengths = np.empty(8)
    steps = np.empty(8, np.int64)
    flat = np.empty(ants * 64 + cells, np.int32)
    begin = np.zeros(ants + 1, np.int64)
    arrived = 0
    for ant in range(1, ants + 1):
        here = start
        path[0] = start
        count = 1
        visited[start] = ant
        while here != goal:
            options = 0
            total = 0.0
            legal = moves[here]
            for d in range(8):
                if legal >> d & 1:
                    there = here + offset[d]
                    if visited[there] < ant:
                        value = desire[here, d]
                        if value < np.inf:
                            value *= strength[here, d]
                        strengths[options] = value
                        steps[options] = there
                        total += value
                        options += 1
            if options > 0:
                here = chosen_step(strengths, steps, options, total, state)
                visited[here] = ant
                path[count] = here
                count += 1
                continue
            if here != start:
                stuck[here] += 1
            count -= 1
            if count == 0 or not retreat:
                count = 0
                break
            here = np.int64(path[count - 1])
        if count > 0:
            flat = with_room(flat, begin[arrived], count)
            copy(flat, begin[arrived], path, 0, count)
            begin[arrived + 1] = begin[arrived] + count
            arrived += 1
    return unpack(flat, begin, arrived), stuck


@kernel("f8[:, ::1](f8[:, ::1], f8, i4[:, ::1], f8[::1], u1[::1], i8, b1, f8, f8)")
def renew(pheromone, keep, population, amounts, moves, cols, into, least, most):
    """Return the pheromone after evaporation, which leaves the share ``keep``, and a deposit along each path.

    An amount goes to every step that its path takes, in the direction taken;
    ``into``: to every step into a cell that it enters. The result is cut to
    [least, most]. Paths are 8-connected.
    """
    cells = moves.shape[0]
    per_row = 1.0 / cols
    out = np.empty((cells, 8))
    for cell in range(cells):
        for d in range(8):
            out[cell, d] = pheromone[cell, d] * keep
    for k in range(population.shape[0]):
        for i in range(1, population.shape[1]):
            b = np.int64(population[k, i])
            if b < 0:
                break
            if into:
                for d in range(8):
                    if moves[b] >> d & 1:
                        out[b + DR[d] * cols + DC[d], (d + 4) % 8] += amounts[k]
                continue
            a = np.int64(population[k, i - 1])
            dr = row_of(b, per_row) - row_of(a, per_row)
            out[a, TOWARDS[3 * (dr + 1) + b - a - dr * cols + 1]] += amounts[k]
    if least > 0.0 or most < np.inf:
        for cell in range(cells):
            for d in range(8):
                out[cell, d] = min(max(out[cell, d], least), most)
    return out


@kernel("f8[:, ::1](f8, i4[:, ::1], f8[::1], i8, i8, b1)")
def lay(base, population, amounts, cells, cols, largest):
    """Return pheromone ``base`` everywhere, but along the paths, to and fro, the path's amount over the step's length.

    Where paths share a step the largest counts, or else the sum; nowhere less
    than ``base``. Paths are 8-connected.
    """
    per_row = 1.0 / cols
    out = np.zeros((cells, 8))
    for k in range(population.shape[0]):
        for i in range(1, population.shape[1]):
            b = np.int64(population[k, i])
            if b < 0:
                break
            a = np.int64(population[k, i - 1])
            dr = row_of(b, per_row) - row_of(a, per_row)
            d = TOWARDS[3 * (dr + 1) + b - a - dr * cols + 1]
            value = amounts[k] / (math.sqrt(2.0) if d % 2 == 1 else 1.0)
            back = (d + 4) % 8
            out[a, d] = max(out[a, d], value) if largest else out[a, d] + value
            out[b, back] = max(out[b, back], value) if largest else out[b, back] + value
    for cell in range(cells):
        for d in range(8):
            out[cell, d] = max(out[cell, d], base)
    return out


@kernel("f8[:, ::1](f8[:, ::1], b1[::1], u1[::1], i8, f8)")
def weaken(pheromone, marked, moves, cols, factor):
    """Return the pheromone with that of every step into a marked cell multiplied by ``factor``."""
    out = pheromone.copy()
    for cell in range(moves.shape[0]):
        if marked[cell]:
            for d in range(8):
                if moves[cell] >> d & 1:
                    out[cell + DR[d] * cols + DC[d], (d + 4) % 8] *= factor
    return out


@kernel("f8(u1[::1])")
def mean_steps(moves):
    """Return how many legal steps there are on average from a cell that has any; 0 without one."""
    cells = steps = 0
    for cell in range(moves.shape[0]):
        cells += moves[cell] != 0
        for d in range(8):
            steps += moves[cell] >> d & 1
    return steps / max(cells, 1)


@kernel("b1(u1[::1], u1[::1], i8, i8, i8)")
def reaches(moves, closed, cols, start, goal):
    """Say whether a way leads from start to goal without a closed cell."""
    seen = np.zeros(moves.shape[0], np.bool_)
    queue = np.empty(moves.shape[0], np.int32)
    queue[0] = start
    seen[start] = True
    size = 1
    done = 0
    while done < size and not seen[goal]:
        here = np.int64(queue[done])
        done += 1
        for d in range(8):
            if moves[here] >> d & 1:
                there = here + DR[d] * cols + DC[d]
                if not seen[there] and not closed[there]:
                    seen[there] = True
                    queue[size] = there
                    size += 1
    return seen[goal]
