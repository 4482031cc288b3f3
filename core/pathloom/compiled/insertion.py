"""Median insertion: kernels that make paths of a few cells, and change one cell of a path."""

import numpy as np

from pathloom.compiled.directions import DC, DR, TOWARDS
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below
from pathloom.compiled.rows import copy, hash_of, length_of, remove_loops, row_of, unpack, with_changed, with_room


@part("i8(i8, i8, i8)")
def _middle(a, b, sign):
    """Return the midpoint of two coordinates, rounded down on an axis that points from start to goal."""
    return sign * ((sign * a + sign * b) // 2)


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
    n, tries, start, goal, middle, blocked, moves, rows, cols, sign_r, sign_c, reach, cap, guarded, loops, state
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
        through = goal
        if middle.shape[0] > 0:
            through = middle[below(state, middle.shape[0])]
        count = connect(
            start, through, blocked, moves, rows, cols, sign_r, sign_c, reach, cap, guarded, path, count, stack, state
        )
        if count >= 0 and through != goal:
            count = connect(
                through, goal, blocked, moves, rows, cols, sign_r, sign_c, reach,
                cap, guarded, path, count, stack, state,
            )  # fmt: skip
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


@kernel("Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[::1], u1[::1], u1[::1], i8, i8, i8, i8, i8, i8, b1, b1, u8[::1])")
def mutate_neighbour(population, chosen, blocked, moves, rows, cols, sign_r, sign_c, reach, cap, guarded, loops, state):
    """Move one random interior cell of each chosen path to a free neighbour, and join it up again.

    The neighbour is none of the two cells beside it on the path. Both sides are
    joined by median insertion. Returns the population and the number of failures,
    which keep the parent.
    """
    width = population.shape[1]
    mark = np.zeros(rows * cols, np.int32)
    stack = np.empty(cap + 2, np.int64)
    path = np.empty(width + 2 * cap + 8, np.int32)
    flat = np.empty(chosen.shape[0] * (width + 8) + path.shape[0], np.int32)
    begin = np.zeros(chosen.shape[0] + 1, np.int64)
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
                    before, moved, blocked, moves, rows, cols, sign_r, sign_c, reach,
                    cap, guarded, path, i, stack, state,
                )  # fmt: skip
                if made >= 0:
                    made = connect(
                        moved, after, blocked, moves, rows, cols, sign_r, sign_c, reach,
                        cap, guarded, path, made, stack, state,
                    )  # fmt: skip
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
    return with_changed(population, chosen, flat, begin), failed
