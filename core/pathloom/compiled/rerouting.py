"""Re-routing: a stretch of a path gives way to the cheapest one under prices drawn at random.

Prices are additive: length, cells by a table, and turns, which is why the search
goes over pairs of a cell and the direction in which it was entered. It stays in a
box about the stretch, so that it costs the same on any map.
"""

import math

import numpy as np

from pathloom.compiled.directions import DC, DR, TOWARDS
from pathloom.compiled.jit import kernel, part
from pathloom.compiled.random import below, uniform
from pathloom.compiled.rows import copy, length_of, remove_loops, row_of, with_changed, with_room
from pathloom.compiled.segments import cells_crossed, segment_free

SQRT2 = math.sqrt(2.0)
BESIDE = 1.5
"""Between centres of neighbours there is less, between those of others more."""


@part("i8(i8, i8, i8)")
def _direction(here, there, cols):
    """Return the direction of a single step between two cells, 8 for any other segment."""
    dr, dc = there // cols - here // cols, there % cols - here % cols
    if abs(dr) > 1 or abs(dc) > 1:
        return np.int64(8)
    return TOWARDS[3 * (dr + 1) + dc + 1]


@part("void(f8[:, ::1], f8, f8)")
def _price_turns(turn, each, angle):
    """Write what turns cost, by direction in and out: ``each`` for itself and ``angle`` for every 45°.

    The direction 8 stands for any: nothing is paid.
    """
    for before in range(9):
        for after in range(9):
            apart = abs(after - before)
            apart = 0 if max(before, after) == 8 else min(apart, 8 - apart)
            turn[before, after] = each + angle * apart if apart > 0 else 0.0


@part("void(f8[::1], i4[::1], i8, f8, i8)")
def _put(keys, items, size, key, item):
    """Put an item into a heap of this size."""
    i = size
    while i > 0:
        up = (i - 1) // 2
        if keys[up] <= key:
            break
        keys[i], items[i] = keys[up], items[up]
        i = up
    keys[i], items[i] = key, item


@part("i8(f8[::1], i4[::1], i8)")
def _take(keys, items, size):
    """Take the item with the least key out of a heap of this size."""
    least = items[0]
    size -= 1
    key, item = keys[size], items[size]
    i = 0
    while True:
        down = 2 * i + 1
        if down >= size:
            break
        if down + 1 < size and keys[down + 1] < keys[down]:
            down += 1
        if keys[down] >= key:
            break
        keys[i], items[i] = keys[down], items[down]
        i = down
    keys[i], items[i] = key, item
    return least


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
    far, least, half, extra = np.empty(0), np.empty(0), np.empty(0), np.empty(0)
    parent, keys, items = np.empty(0, np.int32), np.empty(0), np.empty(0, np.int32)
    turn = np.empty((9, 9))
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
        entry = _direction(row[first - 1], start, cols) if first > 0 else 8
        leave = _direction(goal, row[last + 1], cols) if last + 1 < count else 8

        top, left, down, right = rows, cols, 0, 0
        closest = np.inf
        for i in range(first, last + 1):
            closest = min(closest, distance[row[i]])
            r, c = row[i] // cols, row[i] % cols
            top, down, left, right = min(top, r), max(down, r), min(left, c), max(right, c)
        about = np.int64(math.exp(uniform(state) * math.log(margin + 1.0))) - 1
        top, left = max(top - about, 0), max(left - about, 0)
        down, right = min(down + about, rows - 1), min(right + about, cols - 1)
        wide = right - left + 1
        cells = (down - top + 1) * wide
        per_row = 1.0 / wide

        if cells > room:
            room = 2 * cells
            far, least, half, extra = np.empty(8 * room), np.empty(room), np.empty(room), np.empty(room)
            parent = np.empty(8 * room, np.int32)
            keys, items = np.empty(64 * room + 8), np.empty(64 * room + 8, np.int32)  # as many as there are turns
        amount = uniform(state)
        amount *= spread * amount
        for k in range(cells):
            half[k] = 0.5 + 0.5 * amount * uniform(state)
            least[k] = np.inf
        for k in range(8 * cells):
            far[k] = np.inf
        weight = _ratio(state, cell_scale)
        near = BESIDE if uniform(state) < 0.5 else closest
        each = _ratio(state, turn_scale)
        angle = 0.0
        if uniform(state) < 0.5:
            each, angle = 0.0, 0.5 * each
        _price_turns(turn, each, angle)
        for k in range(cells):
            beside = row_of(k, per_row)
            extra[k] = weight if distance[(top + beside) * cols + left + k - beside * wide] <= near else 0.0

        goal_r, goal_c = goal // cols, goal % cols
        sharpest = each + 4.0 * angle
        end = (goal_r - top) * wide + goal_c - left
        size = 0
        node = np.int64(-1)  # the stretch's first cell, entered from outside the box
        here, heading, so_far = (start // cols - top) * wide + start % cols - left, entry, 0.0
        while True:
            below_top = row_of(here, per_row)
            r, c = top + below_top, left + here - below_top * wide
            legal = moves[r * cols + c]
            for d in range(8):
                if not legal >> d & 1:
                    continue
                rr, cc = r + DR[d], c + DC[d]
                if rr < top or rr > down or cc < left or cc > right:
                    continue
                there = here + DR[d] * wide + DC[d]
                step = (half[here] + half[there]) * (SQRT2 if d % 2 == 1 else 1.0)
                way = so_far + step + turn[heading, d] + extra[there]
                ahead = 0.0
                if there == end:
                    way += turn[d, leave]
                else:
                    dr, dc = goal_r - rr, goal_c - cc
                    if dr * DC[d] != dc * DR[d] or dr * DR[d] + dc * DC[d] < 0:  # the goal is not straight ahead
                        ahead = each + angle
                    dr, dc = abs(dr), abs(dc)
                    ahead += max(dr, dc) + (SQRT2 - 1.0) * min(dr, dc)
                # Who came here from elsewhere, and may turn as sharply as can be, has no more to pay.
                at = 8 * there + d
                if way < far[at] and way < least[there] + sharpest:
                    far[at] = way
                    least[there] = min(least[there], way)
                    parent[at] = node
                    _put(keys, items, size, way + ahead, at)
                    size += 1
            node = np.int64(-1)
            while size > 0 and node < 0:
                node = _take(keys, items, size)
                size -= 1
                here, heading = node >> 3, node & 7
                so_far = far[node]
                if so_far < 0.0 or so_far > least[here] + sharpest:
                    node = np.int64(-1)
            if node < 0 or here == end:
                break
            far[node] = -1.0  # done with
        if node < 0:
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
