"""Runs every kernel once on a small map and prints what came out: for a process in which nothing is compiled."""

import json
import math
import sys

import numpy as np

from pathloom import PathProblem, compiled
from pathloom.compiled import random

ROOM = """
.....#...
.###.#.#.
...#...#.
.#.#.#.#.
.#...#...
"""


def results() -> dict[str, list]:
    """Return what each kernel gives, as plain lists."""
    blocked = np.array([[glyph == "#" for glyph in line] for line in ROOM.split()])
    found: dict[str, list] = {}
    for corners in ("allow", "no-squeeze", "strict"):
        problem = PathProblem(blocked, start=(4, 0), goal=(0, 8), corners=corners)
        for name, value in _results(problem).items():
            parts = value if isinstance(value, tuple) else (value,)
            found[f"{name}, {corners}"] = [part.tolist() if hasattr(part, "tolist") else int(part) for part in parts]
    return found


def _results(problem: PathProblem) -> dict[str, object]:
    it = problem.context
    cells, search, segments = compiled.cells, compiled.search, compiled.segments
    insertion = (it.blocked, it.moves, it.rows, it.cols, *it.signs)
    words = np.array([1, 2**40 + 3, 2**63 + 5, 7], np.uint64)  # goes on from kernel to kernel
    trees = search.sample_from_trees(4, it.moves, it.cols, it.start, it.goal, it.reachable_cells, 1.0, 1.5, words)
    inserted = cells.sample_by_insertion(
        3, 30, it.start, it.goal, it.reachable_cells, *insertion, 8, 56, True, False, words
    )
    printed = cells.sample_by_insertion(
        2, 30, it.start, it.goal, it.reachable_cells, *insertion, 4, 56, False, True, words
    )
    direct = cells.sample_by_insertion(
        2, 30, it.start, it.goal, np.empty(0, np.int32), *insertion, 8, 56, True, False, words
    )
    pairs, chosen = np.array([[0, 1], [2, 3]]), np.array([3, 0])
    pairs_of_ends = np.stack([it.reachable_cells[:-1], it.reachable_cells[1:]])
    row, col = np.divmod(np.arange(it.blocked.size), it.cols)
    before, after = (np.hypot(row - end // it.cols, col - end % it.cols) for end in (it.start, it.goal))
    return {
        "uniform": np.array([random.uniform(words) for _ in range(3)]),
        "tree": search.tree(it.moves, np.empty(0, np.float32), it.cols, it.start),
        "octile path": search.octile_path(it.moves, it.cols, it.start, it.goal),
        "any-angle path": search.any_angle_path(
            it.blocked, it.cols, it.start, it.goal, it.policy, before, after, math.inf, 10**6
        ),
        "trees": trees,
        "inserted": inserted,
        "inserted as printed": printed,
        "inserted without a cell between": direct,
        "walks": compiled.walks.sample_by_walking(2, 500, it.start, it.goal, it.moves, it.cols, words),
        "exchanged": cells.exchange_tails(trees, pairs, it.blocked.size, False, words),
        "mutated": cells.mutate_neighbour(trees, chosen, *insertion, 8, 56, True, False, words),
        "one gene mutated": cells.mutate_neighbour(trees, chosen, *insertion, 4, 0, True, True, words),
        "lengths": cells.lengths(trees, it.cols),
        "sums": cells.sum_over_nodes(trees, it.obstacles_near, 0, 1),
        "turns": cells.turns(trees, it.cols),
        "energy": cells.quadrant_energy(trees, it.cols, it.goal, *it.signs, np.array([1.0, 3.0, 10.0]), False),
        "energy by angle": cells.quadrant_energy(trees, it.cols, it.goal, *it.signs, np.array([1.0, 3.0, 10.0]), True),
        "distinct": cells.distinct(np.concatenate((trees, trees[::-1]))),
        "newcomers": cells.newcomers(np.concatenate((trees, trees)), trees[:1]),
        "free": segments.segments_free(it.blocked, it.cols, *pairs_of_ends, it.policy),
        "shortened": segments.delete_points(trees, it.blocked, it.cols, it.policy, 0),
        "clearances": segments.clearances(trees, it.blocked, it.distance, it.rows, it.cols),
        "flagged": segments.flagged_cells(trees, it.unsafe, it.cols),
    }


if __name__ == "__main__":
    json.dump(results(), sys.stdout)
