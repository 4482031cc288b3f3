"""Kernels on populations of cell paths: int32 (n, width), flat cell ids, padded with −1.

``moves[cell]`` has bit d set where a step from the cell in direction d is legal
under the problem's corner policy; directions count clockwise from north.
"""

import math

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import blank, copy, hash_of, length_of, row_of, unpack, widest, with_room

DR = np.array([-1, -1, 0, 1, 1, 1, 0, -1], np.int64)
DC = np.array([0, 1, 1, 1, 0, -1, -1, -1], np.int64)
TOWARDS = np.array([7, 0, 1, 6, -1, 2, 5, 4, 3], np.int64)
"""Direction of a step (dr, dc) at index 3 (dr + 1) + (dc + 1)."""


@part("i8(i8, i8, i8)")
def _middle(a, b, sign):
    """Return the midpoint of two coordinates, rounded down on an axis that points from start to goal."""
    return sign * ((sign * a + sign * b) // 2)


@part("i8(i4[::1], i8, i4[::1])")
def remove_loops(path, count, mark):
    """Cut out, in place, whatever lies between two visits of one cell; return the new count.

    ``mark`` (one entry a cell) is all zero before and after.
    """
    kept = 0
    for i in range(count):
        cell = path[i]
        if mark[cell] > 0:
            back = mark[cell]
            for j in range(back, kept):
                mark[path[j]] = 0
            kept = back
        else:
            path[kept] = cell
            kept += 1
            mark[cell] = kept
    for j in range(kept):
        mark[path[j]] = 0
    return kept


@part("i8(i8, i8, u1[::1], u1[::1], i8, i8, i8, i8, i8, i8, b1, i4[::1], i8, i8[::1], u8[::1])")
def connect(a, b, blocked, moves, rows, cols, sign_r, sign_c, reach, cap, guarded, path, count, stack, state):
    """Append the cells from a (which the path ends with) to b by median insertion; return the new count or −1.

    While two cells are more than one step apart their midpoint is inserted; an
    obstacle gives way to a random free neighbour (``reach`` 8 or 4). Where the
    corner policy forbids the diagonal between two neighbours, one of the two
    cells beside it is inserted. ``guarded``: never insert an end of the gap, and
    prefer neighbours that shrink it.
    """
    per_row = 1.0 / cols
    top = 0
    stack[0] = b
    here = a
    inserted = 0
    while top >= 0:
        target = stack[top]
        if target == here:
            top -= 1
            continue
        r0, r1 = row_of(here, per_row), row_of(target, per_row)
        c0, c1 = here - r0 * cols, target - r1 * cols
        gap = max(abs(r1 - r0), abs(c1 - c0))
        if gap == 1:
            if moves[here] >> TOWARDS[3 * (r1 - r0 + 1) + c1 - c0 + 1] & 1:
                if count >= path.shape[0]:
                    return -1
                path[count] = target
                count += 1
                here = target
                top -= 1
                continue
            beside, other = r0 * cols + c1, r1 * cols + c0
            if blocked[beside] and blocked[other]:
                return -1
            if blocked[beside] or (not blocked[other] and below(state, 2) == 0):
                beside = other
            chosen = beside
        else:
            r, c = _middle(r0, r1, sign_r), _middle(c0, c1, sign_c)
            chosen = r * cols + c
            if blocked[chosen]:
                good = 0  # how many of the best class so far; a reservoir of one keeps each as likely
                best_class = 0
                chosen = -1
                for d in range(8):
                    if reach == 4 and d % 2 == 1:
                        continue
                    rr, cc = r + DR[d], c + DC[d]
                    if rr < 0 or rr >= rows or cc < 0 or cc >= cols or blocked[rr * cols + cc]:
                        continue
                    cell = rr * cols + cc
                    rank = 1
                    if guarded:
                        if cell in (here, target):
                            continue
                        widest = max(abs(rr - r0), abs(cc - c0), abs(rr - r1), abs(cc - c1))
                        rank = 2 if widest < gap else 1
                    if rank > best_class:
                        best_class = rank
                        good = 1
                        chosen = cell
                    elif rank == best_class:
                        good += 1
                        if below(state, good) == 0:
                            chosen = cell
                if chosen < 0:
                    return -1
        inserted += 1
        top += 1
        if inserted > cap or top >= stack.shape[0]:
            return -1
        stack[top] = chosen
    return count


@kernel(
    "Tuple((i4[:, ::1], i8, i8))(i8, i8, i8, i8, i4[::1], u1[::1], u1[::1], i8, i8, i8, i8, i8, i8, b1, b1, u8[::1])"
)
def sample_by_insertion(
    n,
    tries,
    start,
    goal,
    middle,
    blocked,
    moves,
    rows,
    cols,
    sign_r,
    sign_c,
    reach,
    cap,
    guarded,
    loops,
    state,
):
    """Draw n distinct paths start – random cell of ``middle`` – goal, joined by median insertion.

    Stops after ``tries`` failures in a row. Returns the paths, the number of
    failed tries, and the number of tries that gave a path already drawn.
    """
    room = 4 * (rows + cols) + 2 * cap + 8
    path = np.empty(room, np.int32)
    stack = np.empty(cap + 2, np.int64)
    mark = np.zeros(rows * cols, np.int32)
    flat = np.empty(n * 2 * (rows + cols) + room, np.int32)
    begin = np.zeros(n + 1, np.int64)
    hashes = np.empty(n, np.uint64)
    found = failed = again = in_a_row = 0
    while found < n and in_a_row < tries:
        in_a_row += 1
        path[0] = start
        count = 1
        if middle.shape[0] > 0:
            through = middle[below(state, middle.shape[0])]
            count = connect(
                start,
                through,
                blocked,
                moves,
                rows,
                cols,
                sign_r,
                sign_c,
                reach,
                cap,
                guarded,
                path,
                count,
                stack,
                state,
            )
            if count < 0:
                failed += 1
                continue
            count = connect(
                through,
                goal,
                blocked,
                moves,
                rows,
                cols,
                sign_r,
                sign_c,
                reach,
                cap,
                guarded,
                path,
                count,
                stack,
                state,
            )
        else:
            count = connect(
                start,
                goal,
                blocked,
                moves,
                rows,
                cols,
                sign_r,
                sign_c,
                reach,
                cap,
                guarded,
                path,
                count,
                stack,
                state,
            )
        if count < 0:
            failed += 1
            continue
        if not loops:
            count = remove_loops(path, count, mark)
        value = hash_of(path, count)
        old = False
        for k in range(found):
            if hashes[k] == value and begin[k + 1] - begin[k] == count:
                same = True
                for i in range(count):
                    same = same and flat[begin[k] + i] == path[i]
                old = old or same
        if old:
            again += 1
            continue
        flat = with_room(flat, begin[found], count)
        copy(flat, begin[found], path, 0, count)
        begin[found + 1] = begin[found] + count
        hashes[found] = value
        found += 1
        in_a_row = 0
    return unpack(flat, begin, found), failed, again


@kernel("Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[:, ::1], i8, b1, u8[::1])")
def exchange_tails(population, pairs, cells, loops, state):
    """Let each pair exchange what comes after a random cell that both visit, ends apart.

    Returns the population with the children in their parents' rows, and the
    number of pairs without a common cell, which stay as they are.
    """
    n = population.shape[0]
    mark = np.zeros(cells, np.int32)
    counts = np.empty(n, np.int64)
    for k in range(n):
        counts[k] = length_of(population[k])
    most = widest(population)
    at = np.zeros((pairs.shape[0], 2), np.int64)
    failed = 0
    for p in range(pairs.shape[0]):
        x, y = pairs[p, 0], pairs[p, 1]
        for i in range(1, counts[x] - 1):
            mark[population[x, i]] = i
        common = 0
        for j in range(1, counts[y] - 1):
            if mark[population[y, j]] > 0:
                common += 1
        if common > 0:
            pick = below(state, common)
            for j in range(1, counts[y] - 1):
                if mark[population[y, j]] > 0:
                    if pick == 0:
                        at[p, 0] = mark[population[y, j]]
                        at[p, 1] = j
                        break
                    pick -= 1
            most = max(most, at[p, 0] + counts[y] - at[p, 1], at[p, 1] + counts[x] - at[p, 0])
        else:
            failed += 1
        for i in range(1, counts[x] - 1):
            mark[population[x, i]] = 0
    out = blank(n, most)
    for k in range(n):
        copy(out[k], 0, population[k], 0, counts[k])
    for p in range(pairs.shape[0]):
        if at[p, 0] == 0:
            continue
        for side in range(2):
            x, y = pairs[p, side], pairs[p, 1 - side]
            head, tail = at[p, side] + 1, counts[y] - at[p, 1 - side] - 1
            row = out[x]
            copy(row, head, population[y], at[p, 1 - side] + 1, tail)
            count = head + tail
            if not loops:
                count = remove_loops(row, count, mark)
            for i in range(count, most):
                row[i] = -1
    return out, failed


@kernel("Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[::1], u1[::1], u1[::1], i8, i8, i8, i8, i8, i8, b1, b1, u8[::1])")
def mutate_neighbour(population, chosen, blocked, moves, rows, cols, sign_r, sign_c, reach, cap, guarded, loops, state):
    """Move one random interior cell of each chosen path to a free neighbour, and join it up again.

    The neighbour is none of the two cells beside it on the path. Both sides are
    joined by median insertion. Returns the population and the number of failures,
    which keep the parent.
    """
    n, width = population.shape
    mark = np.zeros(rows * cols, np.int32)
    stack = np.empty(cap + 2, np.int64)
    path = np.empty(width + 2 * cap + 8, np.int32)
    flat = np.empty(chosen.shape[0] * (width + 8) + path.shape[0], np.int32)
    begin = np.zeros(chosen.shape[0] + 1, np.int64)
    most = widest(population)
    failed = 0
    for q in range(chosen.shape[0]):
        row = population[chosen[q]]
        count = length_of(row)
        made = -1
        if count >= 3:
            i = 1 + below(state, count - 2)
            before, after = row[i - 1], row[i + 1]
            r, c = row[i] // cols, row[i] % cols
            good = 0
            moved = -1
            for d in range(8):
                rr, cc = r + DR[d], c + DC[d]
                if (reach == 4 and d % 2 == 1) or rr < 0 or rr >= rows or cc < 0 or cc >= cols:
                    continue
                cell = rr * cols + cc
                if blocked[cell] or cell in (before, after):
                    continue
                good += 1
                if below(state, good) == 0:
                    moved = cell
            if moved >= 0:
                copy(path, 0, row, 0, i)
                made = connect(
                    before,
                    moved,
                    blocked,
                    moves,
                    rows,
                    cols,
                    sign_r,
                    sign_c,
                    reach,
                    cap,
                    guarded,
                    path,
                    i,
                    stack,
                    state,
                )
                if made >= 0:
                    made = connect(
                        moved,
                        after,
                        blocked,
                        moves,
                        rows,
                        cols,
                        sign_r,
                        sign_c,
                        reach,
                        cap,
                        guarded,
                        path,
                        made,
                        stack,
                        state,
                    )
                if made >= 0:
                    copy(path, made, row, i + 2, count - i - 2)
                    made += count - i - 2
                    if not loops:
                        made = remove_loops(path, made, mark)
        if made < 0:
            failed += 1
            made = 0
        flat = with_room(flat, begin[q], made)
        copy(flat, begin[q], path, 0, made)
        begin[q + 1] = begin[q] + made
        most = max(most, made)
    out = blank(n, most)
    for k in range(n):
        copy(out[k], 0, population[k], 0, length_of(population[k]))
    for q in range(chosen.shape[0]):
        made = begin[q + 1] - begin[q]
        if made > 0:
            copy(out[chosen[q]], 0, flat, begin[q], made)
            for i in range(made, most):
                out[chosen[q], i] = -1
    return out, failed


@kernel("f8[::1](i4[:, ::1], i8)")
def lengths(population, cols):
    """Return the Euclidean length of each path, in cells."""
    per_row = 1.0 / cols
    found = np.zeros(population.shape[0])
    for k in range(population.shape[0]):
        straight = diagonal = 0  # counted, so that paths of single steps have the same length in any order
        total = 0.0
        r0 = c0 = 0
        for i in range(population.shape[1]):
            cell = population[k, i]
            if cell < 0:
                break
            r = row_of(cell, per_row)
            c = cell - r * cols
            if i > 0:
                squared = (r - r0) * (r - r0) + (c - c0) * (c - c0)
                if squared == 1:
                    straight += 1
                elif squared == 2:
                    diagonal += 1
                else:
                    total += math.sqrt(squared)
            r0, c0 = r, c
        found[k] = straight + diagonal * math.sqrt(2.0) + total
    return found


@kernel("f8[::1](i4[:, ::1], u1[::1], i8, i8)")
def sum_over_nodes(population, table, skip_first, skip_last):
    """Add up a table's entries over the nodes of each path, without some at its ends."""
    found = np.zeros(population.shape[0])
    for k in range(population.shape[0]):
        count = length_of(population[k])
        total = 0
        for i in range(skip_first, count - skip_last):
            total += table[population[k, i]]
        found[k] = total
    return found


@kernel("f8[:, ::1](i4[:, ::1], i8)")
def turns(population, cols):
    """Return for each path the number of its turns and the sum of their angles in radians.

    Directions are compared as integers; going straight back is a turn of π.
    """
    per_row = 1.0 / cols
    found = np.zeros((population.shape[0], 2))
    for k in range(population.shape[0]):
        r0 = c0 = dr0 = dc0 = 0
        for i in range(population.shape[1]):
            cell = population[k, i]
            if cell < 0:
                break
            r = row_of(cell, per_row)
            c = cell - r * cols
            dr, dc = r - r0, c - c0
            if i > 1 and (dr != dr0 or dc != dc0):
                cross, dot = dr0 * dc - dc0 * dr, dr0 * dr + dc0 * dc
                if cross != 0 or dot < 0:
                    found[k, 0] += 1.0
                    found[k, 1] += math.atan2(abs(cross), dot)
            r0, c0, dr0, dc0 = r, c, dr, dc
    return found


@kernel("f8[::1](i4[:, ::1], i8, i8, i8, i8, f8[::1], b1)")
def quadrant_energy(population, cols, goal, sign_r, sign_c, price, by_angle):
    """Charge each turn by the quadrant of the direction that it takes: price[0] towards the goal, price[2] away.

    Quadrants are those of axes that point from start to goal; along an axis,
    towards the goal counts as its quadrant, away as the opposite one. ``by_angle``: by the angle between the
    direction and the goal instead, up to 45°, up to 135°, beyond.
    """
    per_row = 1.0 / cols
    goal_r = goal // cols
    goal_c = goal - goal_r * cols
    found = np.zeros(population.shape[0])
    for k in range(population.shape[0]):
        r0 = c0 = dr0 = dc0 = 0
        for i in range(population.shape[1]):
            cell = population[k, i]
            if cell < 0:
                break
            r = row_of(cell, per_row)
            c = cell - r * cols
            dr, dc = r - r0, c - c0
            if i > 1 and (dr != dr0 or dc != dc0) and (dr0 * dc != dc0 * dr or dr0 * dr + dc0 * dc < 0):
                if by_angle:
                    to_r, to_c = goal_r - r0, goal_c - c0
                    cross, dot = abs(dr * to_c - dc * to_r), dr * to_r + dc * to_c
                    which = 0 if dot >= cross else (1 if -dot <= cross else 2)
                else:
                    forward_r, forward_c = sign_r * dr, sign_c * dc
                    if forward_r >= 0 and forward_c >= 0:
                        which = 0
                    elif forward_r <= 0 and forward_c <= 0:
                        which = 2
                    else:
                        which = 1
                found[k] += price[which]
            r0, c0, dr0, dc0 = r, c, dr, dc
    return found


@part("i8(i8[::1], u8[::1], u8, i8)")
def _place(table, hashes, value, k):
    """Put item k with a hash into an open table of items; return the item of the same hash, or k."""
    mask = np.uint64(table.shape[0] - 1)
    slot = (value >> np.uint64(20)) & mask
    while table[slot] >= 0 and hashes[table[slot]] != value:
        slot = (slot + np.uint64(1)) & mask
    if table[slot] < 0:
        table[slot] = k
    return table[slot]


@part("i8[::1](i8)")
def _table(items):
    """Return an open table, empty, for so many items."""
    size = 4
    while size < 2 * items:
        size *= 2
    table = np.empty(size, np.int64)
    for i in range(size):
        table[i] = -1
    return table


@kernel("Tuple((i8[::1], i8[::1]))(i4[:, ::1])")
def distinct(population):
    """Return the index of the first of each different path, and for each path which of those it is.

    Paths are told apart by a 64-bit hash.
    """
    n = population.shape[0]
    table = _table(n)
    hashes = np.empty(n, np.uint64)
    first = np.empty(n, np.int64)
    which = np.empty(n, np.int64)
    different = 0
    for k in range(n):
        hashes[k] = hash_of(population[k], length_of(population[k]))
        same = _place(table, hashes, hashes[k], k)
        if same == k:
            first[different] = k
            which[k] = different
            different += 1
        else:
            which[k] = which[same]
    return first[:different].copy(), which


@kernel("i8[::1](i4[:, ::1], i4[:, ::1])")
def newcomers(population, before):
    """Return the index of each path that was not there before, told apart by a 64-bit hash."""
    n, m = population.shape[0], before.shape[0]
    table = _table(m)
    hashes = np.empty(m + n, np.uint64)
    for k in range(m):
        hashes[k] = hash_of(before[k], length_of(before[k]))
        _place(table, hashes, hashes[k], k)
    new = np.empty(n, np.int64)
    count = 0
    mask = np.uint64(table.shape[0] - 1)
    for k in range(n):
        value = hash_of(population[k], length_of(population[k]))
        slot = (value >> np.uint64(20)) & mask
        while table[slot] >= 0 and hashes[table[slot]] != value:
            slot = (slot + np.uint64(1)) & mask
        if table[slot] < 0:
            new[count] = k
            count += 1
    return new[:count].copy()
