"""Re-routing: a stretch of a path gives way to the cheapest one under prices drawn at random.

Prices are additive: length, cells by a table, and turns, which is why the search
goes over pairs of a cell and the direction in which it was entered. It stays in a
box about the stretch, so that it costs the same on any map.
"""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR, TOWARDS
from pathloom.compiled.heap import pop, push
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below, uniform
from pathloom.compiled.rows import copy, length_of, remove_loops, row_of, with_changed, with_room
from pathloom.compiled.segments import cells_crossed, segment_free

SQRT2 = math.sqrt(2.0)
BESIDE = 1.5
"""Between centres of neighbours there is less, between those of others more."""


@part("i8(i8, i8, i8)")
def _direction(here, there, cols):
    """Return the direction of a single step between two cells, −1 for any other segment."""
    dr, dc = there // cols - here // cols, there % cols - here % cols
    if abs(dr) > 1 or abs(dc) > 1:
        return np.int64(-1)
    return TOWARDS[3 * (dr + 1) + dc + 1]


@part("f8(i8, i8, f8, f8)")
def _turn(before, after, each, angle):
    """Return the price of a turn: ``each`` for itself and ``angle`` for every 45°; none where a direction is −1."""
    if before < 0 or after < 0 or before == after:
        return 0.0
    apart = abs(after - before)
    return each + angle * min(apart, 8 - apart)


@part("f8(u8[::1], f8)")
def _ratio(state, scale):
    """Return 0 in one case of four, else a number above 0 with median ``scale``, as often below as above."""
    u = uniform(state)
    return scale * u / (1.0 - u) if uniform(state) >= 0.25 else 0.0


@part("Tuple((i4[::1], i4[::1], i8))(i4[::1], i8, i8, i4[::1], i4[::1])")
def _step_by_step(row, count, cols, steps, node):
    """Return the cells that a path crosses, of each the point of the path at or before it, and how many there are."""
    per_row = 1.0 / cols
    size = 0
    for i in range(count - 1):
        r = row_of(row[i], per_row)
        dr = row_of(row[i + 1], per_row) - r
        dc = row[i + 1] - row[i] - dr * cols
        steps = with_room(steps, size, abs(dr) + abs(dc) + 2)
        node = with_room(node, size, abs(dr) + abs(dc) + 2)
        crossed = cells_crossed(row[i], dr, dc, cols, steps[size:])
        for k in range(size, size + crossed - 1):  # the last one is the next segment's first
            node[k] = i
        size += crossed - 1
    steps[size] = row[count - 1]
    node[size] = count - 1
    return steps, node, size + 1


@part("i8(i4[::1], i8, i4[::1], i8, i8, u1[::1], i8, i8)")
def _join(path, size, steps, first, last, blocked, cols, policy):
    """Write steps[last] behind the path, if it is not there already; the cells before it too where it is out of sight.

    The path ends with steps[first]. Returns its new size.
    """
    if first == last:
        return size
    per_row = 1.0 / cols
    dr = row_of(steps[last], per_row) - row_of(steps[first], per_row)
    dc = steps[last] - steps[first] - dr * cols
    if segment_free(blocked, cols, steps[first], dr, dc, policy):
        first = last - 1
    copy(path, size, steps, first + 1, last - first)
    return size + last - first


@kernel(
    "Tuple((i4[:, ::1], i8))(i4[:, ::1], i8[::1], u1[::1], u1[::1], f8[::1], i8, i8, i8, i8, i8, f8, f8, f8, u8[::1])"
)  # fmt: skip
def reroute(
    population, chosen, blocked, moves, distance, rows, cols, policy, longest, margin, spread, cell_scale, turn_scale,
    state,
):  # fmt: skip
    """Replace a random stretch, at most ``longest`` steps, of each chosen path by the cheapest way between its ends.

    Stretches of 2 to 4 steps are as likely as those of 4 to 8, of 8 to 16 and so on.

    A step costs its length, stretched at random by at most ``spread``, plus a
    random price if the cell that it enters is near an obstacle, plus a random
    price for a turn; the medians of those are the two scales. Near are, as it
    falls, the neighbours of obstacles, or whatever is no farther from one than the
    stretch comes: ``distance`` is that of each cell. The way keeps within
    ``margin`` of the stretch's bounding box. Returns the population, and how many
    paths had no interior or no such way: they stay as they are.

    Long segments count as the cells that they cross: a stretch may begin and end
    on them. What lies outside the stretch stays at any angle.
    """
    mark = np.zeros(rows * cols, np.int32)
    steps, node_of = np.empty(4096, np.int32), np.empty(4096, np.int32)
    path = np.empty(population.shape[1] + 256, np.int32)
    flat = np.empty(chosen.shape[0] * (population.shape[1] + 8), np.int32)
    begin = np.zeros(chosen.shape[0] + 1, np.int64)
    room = 0
    far, key, noise = np.empty(0), np.empty(0), np.empty(0)
    parent, place, heap = np.empty(0, np.int32), np.empty(0, np.int32), np.empty(0, np.int32)
    failed = 0
    for q in range(chosen.shape[0]):
        nodes = population[chosen[q]]
        points = length_of(nodes)
        steps, node_of, count = _step_by_step(nodes, points, cols, steps, node_of)
        row = steps
        begin[q + 1] = begin[q]
        if count < 3:
            failed += 1
            continue
        most = min(longest, count - 1)
        span = min(most, np.int64(2.0 * math.exp(uniform(state) * math.log(0.5 * (most + 1)))))
        first = below(state, count - span)
        last = first + span
        start, goal = np.int64(row[first]), np.int64(row[last])
        entry = _direction(row[first - 1], start, cols) if first > 0 else -1
        leave = _direction(goal, row[last + 1], cols) if last + 1 < count else -1

        top, left, down, right = rows, cols, 0, 0
        closest = np.inf
        for i in range(first, last + 1):
            closest = min(closest, distance[row[i]])
            r, c = row[i] // cols, row[i] % cols
            top, down, left, right = min(top, r), max(down, r), min(left, c), max(right, c)
        about = below(state, margin + 1)
        top, left = max(top - about, 0), max(left - about, 0)
        down, right = min(down + about, rows - 1), min(right + about, cols - 1)
        wide = right - left + 1
        cells = (down - top + 1) * wide
        per_row = 1.0 / wide

        if 8 * cells > room:
            room = 16 * cells
            far, key, noise = np.empty(room), np.empty(room), np.empty(room)
            parent, place, heap = np.empty(room, np.int32), np.empty(room, np.int32), np.empty(room, np.int32)
        for k in range(8 * cells):
            far[k] = np.inf
            place[k] = -1
        amount = uniform(state)
        amount *= spread * amount
        for k in range(cells):
            noise[k] = 1.0 + amount * uniform(state)
        weight = _ratio(state, cell_scale)
        near = BESIDE if uniform(state) < 0.5 else closest
        each = _ratio(state, turn_scale)
        angle = 0.0
        if uniform(state) < 0.5:
            each, angle = 0.0, 0.5 * each

        goal_r, goal_c = goal // cols, goal % cols
        size = 0
        node = np.int64(-1)  # the stretch's first cell, entered from outside the box
        while True:
            if node < 0:
                r, c, heading, so_far = start // cols, start % cols, entry, 0.0
            else:
                cell = node >> 3
                below_top = row_of(cell, per_row)
                r, c, heading, so_far = top + below_top, left + cell - below_top * wide, node & 7, far[node]
                if r == goal_r and c == goal_c:
                    break
            legal = moves[r * cols + c]
            here = (r - top) * wide + c - left
            for k in range(8):
                # Beyond 90° a step from the cell before is shorter, and legal: only the first turn may be so sharp.
                d = k if node < 0 else (heading + k - 2) & 7
                if k > 4 and node >= 0:
                    break
                if not legal >> d & 1:
                    continue
                rr, cc = r + DR[d], c + DC[d]
                if rr < top or rr > down or cc < left or cc > right:
                    continue
                there = (rr - top) * wide + cc - left
                step = (SQRT2 if d % 2 == 1 else 1.0) * 0.5 * (noise[here] + noise[there])
                way = so_far + step + _turn(heading, d, each, angle)
                if distance[rr * cols + cc] <= near:
                    way += weight
                if rr == goal_r and cc == goal_c:
                    way += _turn(d, leave, each, angle)
                at = 8 * there + d
                if way < far[at]:
                    far[at] = way
                    parent[at] = node
                    dr, dc = abs(rr - goal_r), abs(cc - goal_c)
                    key[at] = way + max(dr, dc) + (SQRT2 - 1.0) * min(dr, dc)
                    size = push(heap, place, key, size, at)
            if size == 0:
                break
            node = np.int64(pop(heap, place, key, size))
            size -= 1
        if node < 0 or node // 8 != (goal_r - top) * wide + goal_c - left:
            failed += 1
            continue

        made = 0
        at = node
        while at >= 0:
            made += 1
            at = parent[at]
        whole = count + made  # room for every cell, should none be in sight of another
        if whole > path.shape[0]:
            path = np.empty(2 * whole, np.int32)
        # Up to the stretch, the way in its place, and from its end on to the next point.
        before, onward = node_of[first], last
        copy(path, 0, nodes, 0, before + 1)
        while row[onward] != nodes[node_of[onward]]:
            onward += 1
        behind = first
        while row[behind] != nodes[before]:
            behind -= 1
        whole = _join(path, before + 1, row, behind, first, blocked, cols, policy)
        at = node
        for i in range(whole + made - 1, whole - 1, -1):
            cell = at // 8
            path[i] = (top + cell // wide) * cols + left + cell % wide
            at = parent[at]
        whole = _join(path, whole + made, row, last, onward, blocked, cols, policy)
        rest = points - 1 - node_of[onward]
        copy(path, whole, nodes, node_of[onward] + 1, rest)
        whole += rest
        whole = remove_loops(path, whole, mark)
        flat = with_room(flat, begin[q], whole)
        copy(flat, begin[q], path, 0, whole)
        begin[q + 1] = begin[q] + whole
    return with_changed(population, chosen, flat, begin), failed
