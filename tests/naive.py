"""Slow, obvious twins of the kernels, and the small maps that they can afford.

Plain Python on tuples (row, column), whole numbers and fractions, straight from the
definitions. Nothing here imports pathloom's algorithms.
"""

import heapq
import math
import os
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from functools import cache
from itertools import pairwise

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from pathloom import PathProblem

Cell = tuple[int, int]
Cells = tuple[Cell, ...]

POLICIES = ("allow", "no-squeeze", "strict")
STEPS = ((-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1))
HALF = Fraction(1, 2)


SHARE = float(os.environ.get("PATHLOOM_EXAMPLES", "0.4"))
"""How many of the examples are drawn: 1 for a thorough run, 10 to look for what hides well."""


def examples(count: int) -> settings:
    """Return settings under which the same examples are drawn in every run, and no clock is looked at."""
    return settings(
        max_examples=max(10, round(SHARE * count)),
        deadline=None,
        derandomize=True,
        suppress_health_check=list(HealthCheck),
    )


# Segments ---------------------------------------------------------------------------------------


@cache
def meets(dr: int, dc: int, r: int, c: int) -> str:
    """Clip the segment from (0, 0) to (dr, dc) to the unit square about (r, c): "inside", "border" or "apart"."""
    enter, leave = Fraction(0), Fraction(1)
    inside = True
    for d, centre in ((dr, r), (dc, c)):
        near, far = centre - HALF, centre + HALF
        if d == 0:
            if not near <= 0 <= far:
                return "apart"
            inside = inside and near < 0 < far
            continue
        first, last = sorted((near / d, far / d))
        enter, leave = max(enter, first), min(leave, last)
    if enter > leave:
        return "apart"
    return "inside" if inside and enter < leave else "border"


@cache
def corners_on(dr: int, dc: int) -> Cells:
    """Return the corners (i + ½, j + ½) that the segment from (0, 0) to (dr, dc) passes through, as (i, j)."""
    rows, cols = range(min(dr, 0), max(dr, 0)), range(min(dc, 0), max(dc, 0))
    return tuple((i, j) for i in rows for j in cols if (i + HALF) * dc == (j + HALF) * dr)


def touched(blocked: np.ndarray, a: Cell, b: Cell) -> dict[Cell, int]:
    """Return how many obstacles a segment meets only there for each corner, as the cell up left of it."""
    dr, dc = b[0] - a[0], b[1] - a[1]
    found: dict[Cell, int] = {}
    for i, j in corners_on(dr, dc):
        around = [(i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1)]
        beside = [(r, c) for r, c in around if meets(dr, dc, r, c) == "border"]
        if obstacles := sum(bool(blocked[a[0] + r, a[1] + c]) for r, c in beside):
            found[i, j] = obstacles
    return found


def squeezed(blocked: np.ndarray, a: Cell, b: Cell) -> int:
    """Return through how many corners a segment passes that two diagonally opposite obstacles share."""
    return sum(obstacles == 2 for obstacles in touched(blocked, a, b).values())


def segment_free(blocked: np.ndarray, a: Cell, b: Cell, corners: str) -> bool:
    """Say whether a segment is free: hold it against every obstacle of the map."""
    dr, dc = b[0] - a[0], b[1] - a[1]
    met = {meets(dr, dc, r - a[0], c - a[1]) for r, c in np.argwhere(blocked).tolist()}
    if "inside" in met or (corners == "strict" and "border" in met):
        return False
    return corners != "no-squeeze" or not squeezed(blocked, a, b)


def path_free(blocked: np.ndarray, path: Iterable[Cell], corners: str) -> bool:
    path = list(path)
    return not blocked[path[0]] and all(segment_free(blocked, a, b, corners) for a, b in pairwise(path))


def steps_singly(path: Iterable[Cell]) -> bool:
    """Say whether each cell is one of the eight neighbours of the one before it."""
    return all(max(abs(r - q), abs(c - d)) == 1 for (r, c), (q, d) in pairwise(path))


def crossed(shape: tuple[int, int], path: Cells) -> set[Cell]:
    """Return the cells whose inside a path crosses."""
    everywhere = [(r, c) for r in range(shape[0]) for c in range(shape[1])]
    return {
        (r, c)
        for a, b in [*pairwise(path), (path[0], path[0])]
        for r, c in everywhere
        if meets(b[0] - a[0], b[1] - a[1], r - a[0], c - a[1]) == "inside"
    }


def cell_by_cell(path: Cells) -> Cells:
    """Return the cells whose inside a path crosses, in the order of the path."""
    found = [path[0]]
    for (r0, c0), (r1, c1) in pairwise(path):
        dr, dc = r1 - r0, c1 - c0
        box = [(r, c) for r in range(min(dr, 0), max(dr, 0) + 1) for c in range(min(dc, 0), max(dc, 0) + 1)]
        inside = [cell for cell in box if meets(dr, dc, *cell) == "inside"]
        inside.sort(key=lambda cell: cell[0] * dr + cell[1] * dc)  # how far along the segment its centre lies
        found += [(r0 + r, c0 + c) for r, c in inside[1:]]
    return tuple(found)


def obstacles_beside(blocked: np.ndarray, cells: Iterable[Cell]) -> set[Cell]:
    """Return the obstacles that are one of the eight neighbours of one of the cells."""
    cells = list(cells)
    obstacles = [(r, c) for r, c in np.argwhere(blocked).tolist()]
    return {o for o in obstacles if any(max(abs(o[0] - r), abs(o[1] - c)) == 1 for r, c in cells)}


def clearance(blocked: np.ndarray, path: Cells) -> float:
    """Return the least distance from a path to a closed obstacle cell: nearest corners and nearest ends."""
    best: Fraction | float = math.inf
    for a, b in [*pairwise(path), (path[0], path[0])]:
        for r, c in np.argwhere(blocked).tolist():
            if meets(b[0] - a[0], b[1] - a[1], r - a[0], c - a[1]) != "apart":
                return 0.0
            square = [(r + s, c + t) for s in (-HALF, HALF) for t in (-HALF, HALF)]
            ends = [sum(max(abs(p - q) - HALF, 0) ** 2 for p, q in zip(e, (r, c), strict=True)) for e in (a, b)]
            best = min(best, *ends, *(_squared_distance(corner, a, b) for corner in square))
    return math.sqrt(best)


def _squared_distance(p: tuple[Fraction, Fraction], a: Cell, b: Cell) -> Fraction:
    dr, dc = b[0] - a[0], b[1] - a[1]
    squared = dr * dr + dc * dc
    t = ((p[0] - a[0]) * dr + (p[1] - a[1]) * dc) / squared if squared else Fraction(0)
    t = min(max(t, Fraction(0)), Fraction(1))
    return (p[0] - a[0] - t * dr) ** 2 + (p[1] - a[1] - t * dc) ** 2


def without_points(blocked: np.ndarray, path: Cells, corners: str, passes: int) -> Cells:
    """Drop points whose neighbours see each other, front to back; 0 passes: until nothing changes."""
    return without_points_by(lambda a, b: segment_free(blocked, a, b, corners), path, passes)


def without_points_by(sees: Callable[[Cell, Cell], bool], path: Cells, passes: int) -> Cells:
    """Drop points between two that see each other, by whatever ``sees`` says."""
    kept = [path[0]]
    for point, following in pairwise(path[1:]):
        if not sees(kept[-1], following):
            kept.append(point)
    shorter = (*kept, path[-1]) if len(path) > 1 else path
    if passes == 1 or shorter == path:
        return shorter
    return without_points_by(sees, shorter, max(passes - 1, 0))


# Paths ------------------------------------------------------------------------------------------


def length(path: Cells) -> float:
    return sum(math.dist(a, b) for a, b in pairwise(path))


def directions(path: Cells) -> list[Cell]:
    """Return the direction of each segment, in lowest terms."""
    found = []
    for (r, c), (q, d) in pairwise(path):
        common = math.gcd(q - r, d - c)
        found.append(((q - r) // common, (d - c) // common))
    return found


def turns(path: Cells) -> int:
    return sum(a != b for a, b in pairwise(directions(path)))


def turn_angle(path: Cells) -> float:
    total = 0.0
    for (r, c), (q, d) in pairwise(directions(path)):
        turned = abs(math.atan2(d, q) - math.atan2(c, r))
        total += min(turned, 2 * math.pi - turned)
    return total


def quadrant_energy(path: Cells, goal: Cell, signs: Cell, price: tuple[float, ...], by_angle: bool) -> float:
    """Charge each turn by the class of its new direction."""
    total = 0.0
    for point, (old, (dr, dc)) in zip(path[1:], pairwise(directions(path)), strict=False):
        if old == (dr, dc):
            continue
        to_r, to_c = goal[0] - point[0], goal[1] - point[1]
        if by_angle:
            dot = dr * to_r + dc * to_c
            steep = 2 * dot**2 - (dr**2 + dc**2) * (to_r**2 + to_c**2)  # 0 at 45° and at 135°
            which = 0 if dot >= 0 and steep >= 0 else 2 if dot < 0 and steep > 0 else 1
        else:
            ahead = (dr * signs[0] >= 0, dc * signs[1] >= 0)
            behind = (dr * signs[0] <= 0, dc * signs[1] <= 0)
            which = 0 if all(ahead) else 2 if all(behind) else 1
        total += price[which]
    return total


def distinct(paths: list[Cells]) -> tuple[list[int], list[int]]:
    """Return the index of the first of each different path, and for each path which of those it is."""
    different = list(dict.fromkeys(paths))
    return [paths.index(path) for path in different], [different.index(path) for path in paths]


def newcomers(paths: list[Cells], before: list[Cells]) -> list[int]:
    return [k for k, path in enumerate(paths) if path not in before]


def without_loops(path: Cells) -> Cells:
    """Cut out what lies between two visits of one cell, the first loop to close first."""
    kept: list[Cell] = []
    for cell in path:
        kept = kept[: kept.index(cell) + 1] if cell in kept else [*kept, cell]
    return tuple(kept)


def exchanges(mother: Cells, father: Cells, loops: bool) -> set[tuple[Cells, Cells]]:
    """Return every pair of children that an exchange of tails at a common interior cell can give."""
    found = set()
    for i in range(1, len(mother) - 1):
        for j in range(1, len(father) - 1):
            if mother[i] == father[j]:
                pair = (mother[:i] + father[j:], father[:j] + mother[i:])
                found.add(pair if loops else (without_loops(pair[0]), without_loops(pair[1])))
    return found or {(mother, father)}


# Searches ---------------------------------------------------------------------------------------


def dijkstra(start: Cell, edges: Callable[[Cell], Iterator[tuple[Cell, float]]]) -> dict[Cell, float]:
    """Return the distance of every cell that can be reached."""
    done: dict[Cell, float] = {}
    heap = [(0.0, start)]
    while heap:
        far, here = heapq.heappop(heap)
        if here not in done:
            done[here] = far
            for there, cost in edges(here):
                heapq.heappush(heap, (far + cost, there))
    return done


def free_cells(blocked: np.ndarray) -> list[Cell]:
    return [(r, c) for r, c in np.argwhere(~blocked).tolist()]


def legal_steps(blocked: np.ndarray, cell: Cell, corners: str) -> Iterator[tuple[int, Cell]]:
    """Yield direction and target of each step that stays on the map and is free."""
    for d, (dr, dc) in enumerate(STEPS):
        there = cell[0] + dr, cell[1] + dc
        on_map = 0 <= there[0] < blocked.shape[0] and 0 <= there[1] < blocked.shape[1]
        if on_map and segment_free(blocked, cell, there, corners):
            yield d, there


def octile_distances(blocked: np.ndarray, start: Cell, corners: str) -> dict[Cell, float]:
    def edges(cell: Cell) -> Iterator[tuple[Cell, float]]:
        return ((there, math.dist(cell, there)) for _, there in legal_steps(blocked, cell, corners))

    return dijkstra(start, edges)


def any_angle_distances(blocked: np.ndarray, start: Cell, corners: str) -> dict[Cell, float]:
    """Search the whole visibility graph of all free cells."""
    cells = free_cells(blocked)

    def edges(cell: Cell) -> Iterator[tuple[Cell, float]]:
        return ((there, math.dist(cell, there)) for there in cells if segment_free(blocked, cell, there, corners))

    return dijkstra(start, edges)


# Random numbers ---------------------------------------------------------------------------------


def xoshiro(state: list[int]) -> Iterator[int]:
    """Yield the words of xoshiro256++."""
    mask = 2**64 - 1

    def rotated(x: int, k: int) -> int:
        return (x << k | x >> (64 - k)) & mask

    s = list(state)
    while True:
        yield (rotated((s[0] + s[3]) & mask, 23) + s[0]) & mask
        t = s[1] << 17 & mask
        s[2] ^= s[0]
        s[3] ^= s[1]
        s[1] ^= s[2]
        s[0] ^= s[3]
        s[2] ^= t
        s[3] = rotated(s[3], 45)


# What tests draw --------------------------------------------------------------------------------


def maps(max_side: int = 7) -> st.SearchStrategy[np.ndarray]:
    """Draw maps of one cell and more, a third of the cells blocked."""
    shapes = array_shapes(min_dims=2, max_dims=2, max_side=max_side)
    return arrays(np.bool_, shapes, elements=st.sampled_from((False, False, True)), fill=st.nothing())


@st.composite
def problems(draw: st.DrawFn, max_side: int = 7, corners: Iterable[str] = POLICIES) -> PathProblem:
    """Draw problems whose ends are free; they may be one cell, and the goal may be out of reach."""
    blocked = draw(maps(max_side))
    start, goal = (draw(cells_of(blocked.shape)) for _ in range(2))
    blocked[start] = blocked[goal] = False
    return PathProblem(blocked, start=start, goal=goal, corners=draw(st.sampled_from(list(corners))))


def cells_of(shape: tuple[int, int]) -> st.SearchStrategy[Cell]:
    return st.tuples(st.integers(0, shape[0] - 1), st.integers(0, shape[1] - 1))


def paths_on(shape: tuple[int, int], max_size: int = 7) -> st.SearchStrategy[Cells]:
    """Draw any sequences of cells, legal or not, in which no cell directly follows itself."""
    sequences = st.lists(cells_of(shape), min_size=1, max_size=max_size)
    return sequences.map(lambda path: tuple(c for k, c in enumerate(path) if k == 0 or c != path[k - 1]))


words = st.integers(0, 2**32).map(lambda seed: np.random.default_rng(seed).bit_generator.random_raw(4).tolist())
"""States of the generator in the kernels."""


def packed(paths: Iterable[Cells], cols: int, padding: int = 0) -> np.ndarray:
    """Return paths as a population: flat cell ids, int32, padded with −1 and ``padding`` more of them."""
    paths = list(paths)
    population = np.full((len(paths), max(map(len, paths), default=1) + padding), -1, np.int32)
    for row, path in zip(population, paths, strict=True):
        row[: len(path)] = [r * cols + c for r, c in path]
    return population


def unpacked(population: np.ndarray, cols: int) -> list[Cells]:
    """Return a population as paths; no cell may follow the padding."""
    paths = []
    for row in population.tolist():
        ids = [cell for cell in row if cell >= 0]
        assert row == ids + [-1] * (len(row) - len(ids))
        paths.append(tuple(divmod(cell, cols) for cell in ids))
    return paths
