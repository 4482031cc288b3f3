"""Guided walks: at random, but drawn to a target, and never in vain; with what is made of them."""

import math

import numpy as np

from pathloom.compiled.ants import chosen_step
from pathloom.compiled.directions import DC, DR
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, length_of, row_of, unpack, with_room


@part("i8(i4[::1], i8, f8, u1[::1], i8, i4[::1], i4, u8[::1])")
def walk(path, target, pull, moves, cols, visited, stamp, state):
    """Walk from the cell ``path[0]`` to the target and write the way into the path; return where it ends.

    Each step goes to a cell not visited before, with a probability in proportion
    to exp(−pull · d), d being its distance to the target, or to the target itself
    where that is one step away. From a cell with no way on the walk steps back.
    It does not enter cells that bear the stamp already. Returns −1 where there
    is no way.
    """
    per_row = 1.0 / cols
    to_r = row_of(target, per_row)
    to_c = target - to_r * cols
    steps = np.empty(8, np.int64)
    strengths = np.empty(8)
    last = 0
    here = np.int64(path[0])
    visited[here] = stamp
    while here != target:
        r = row_of(here, per_row) - to_r
        c = here - (r + to_r) * cols - to_c
        away = math.sqrt(r * r + c * c)
        options = 0
        total = 0.0
        for d in range(8):
            if moves[here] >> d & 1:
                there = here + DR[d] * cols + DC[d]
                if visited[there] == stamp:
                    continue
                rr, cc = r + DR[d], c + DC[d]
                strength = math.exp(pull * (away - math.sqrt(rr * rr + cc * cc))) if there != target else np.inf
                steps[options] = there
                strengths[options] = strength
                total += strength
                options += 1
        if options == 0:
            last -= 1
            if last < 0:
                break
            here = np.int64(path[last])
            continue
        here = chosen_step(strengths, steps, options, total, state)
        visited[here] = stamp
        last += 1
        path[last] = here
    return last


@kernel("i4[:, ::1](i8, i8, i8, f8, u1[::1], i8, u8[::1])")
def sample_by_guided_walks(n, start, goal, pull, moves, cols, state):
    """Draw n guided walks from start to goal; none if there is no way."""
    visited = np.zeros(moves.shape[0], np.int32)
    path = np.empty(moves.shape[0], np.int32)
    flat = np.empty(n * 64 + moves.shape[0], np.int32)
    begin = np.zeros(n + 1, np.int64)
    found = 0
    for k in range(n):
        path[0] = start
        last = walk(path, goal, pull, moves, cols, visited, np.int32(k + 1), state)
        if last < 0:
            break
        flat = with_room(flat, begin[k], last + 1)
        copy(flat, begin[k], path, 0, last + 1)
        begin[k + 1] = begin[k] + last + 1
        found += 1
    return unpack(flat, begin, found)


@part("i8(i4[::1], i8, i4[::1], i8, i8, b1, i4[::1], f8, u1[::1], i8, i4[::1], i4, u8[::1])")
def _anew(to, at, row, count, gene, back, walked, pull, moves, cols, visited, stamp, state):
    """Write a path with the part before (``back``) or behind a gene walked anew; return where it ends, or −1."""
    for i in range(gene + 1 if back else 0, count if back else gene):
        visited[row[i]] = stamp  # the other part stays, and is not to be crossed
    walked[0] = row[gene] if back else row[count - 1]
    target = np.int64(row[0] if back else row[gene])
    last = walk(walked, target, pull, moves, cols, visited, stamp, state)
    if last < 0:
        return -1
    if not back:
        copy(to, at, row, 0, gene)
        at += gene
    for i in range(last, -1, -1):
        to[at] = walked[i]
        at += 1
    if back:
        copy(to, at, row, gene + 1, count - gene - 1)
        at += count - gene - 1
    return at


@kernel("Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[::1], f8, u1[::1], i8, u8[::1])")
def search_again(population, chosen, pull, moves, cols, state):
    """Pick an interior cell of each of n chosen paths and walk anew: from it to the start, and from the goal to it.

    Returns 2 n paths, first those with the first part anew, then those with the
    second; and the number of paths without an interior, which stay. A part that
    cannot be walked without crossing the other one stays as well.
    """
    n = chosen.shape[0]
    cells = moves.shape[0]
    visited = np.zeros(cells, np.int32)
    walked = np.empty(cells, np.int32)
    genes = np.zeros(n, np.int64)
    flat = np.empty(2 * n * (population.shape[1] + 16) + 2 * cells, np.int32)
    begin = np.zeros(2 * n + 1, np.int64)
    failed = 0
    for q in range(n):
        count = length_of(population[chosen[q]])
        if count < 3:
            failed += 1
        else:
            genes[q] = 1 + below(state, count - 2)
    for q in range(2 * n):
        row = population[chosen[q % n]]
        gene = genes[q % n]
        count = length_of(row)
        flat = with_room(flat, begin[q], count + cells)
        end = np.int64(-1)
        if gene > 0:
            stamp = np.int32(q + 1)
            end = _anew(
                flat, begin[q], row, count, gene, q < n, walked, pull, moves, cols, visited, stamp, state
            )  # fmt: skip
        if end < 0:
            copy(flat, begin[q], row, 0, count)
            end = begin[q] + count
        begin[q + 1] = end
    return unpack(flat, begin, 2 * n), failed


@kernel("b1[::1](i4[:, ::1], i8[:, ::1], i8)")
def meet(population, pairs, cells):
    """Say of each pair of paths whether both visit some cell, ends apart."""
    found = np.zeros(pairs.shape[0], np.bool_)
    mark = np.zeros(cells, np.int32)
    for p in range(pairs.shape[0]):
        first, second = population[pairs[p, 0]], population[pairs[p, 1]]
        for i in range(1, length_of(first) - 1):
            mark[first[i]] = p + 1
        for i in range(1, length_of(second) - 1):
            if mark[second[i]] == p + 1:
                found[p] = True
                break
    return found
