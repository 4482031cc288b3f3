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
    for name, value in _oddities().items():
        parts = value if isinstance(value, tuple) else (value,)
        found[name] = [part.tolist() if hasattr(part, "tolist") else int(part) for part in parts]
    return found


def _oddities() -> dict[str, object]:
    """Return what comes out where there is little to do, or much."""
    words = np.array([1, 2**40 + 3, 2**63 + 5, 7], np.uint64)
    nothing, nobody = np.empty(0, np.int32), np.empty((0, 1), np.int32)
    split = PathProblem([[0, 1, 0]]).context
    insertion = (split.blocked, split.moves, 1, 3, 1, 1)
    squeeze = PathProblem([[0, 1], [1, 0]], start=(0, 0), goal=(1, 1)).context
    serpentine = np.zeros((21, 20), bool)
    serpentine[1::4, :-1] = serpentine[3::4, 1:] = True
    long = PathProblem(serpentine, start=(20, 0), goal=(0, 0)).context
    apart = np.array([[0, 1, 2], [0, 4, 2], [0, 2, -1]], np.int32)
    return {
        "no way": compiled.search.octile_path(split.moves, 3, 0, 2),
        "no straight way": compiled.search.any_angle_path(split.blocked, 3, 0, 2, 2, np.zeros(3), np.zeros(3), math.inf, 99),
        "too little work": compiled.search.any_angle_path(np.zeros(9, np.uint8), 3, 6, 2, 2, np.zeros(9), np.zeros(9), 9.0, 1),
        "nothing inserted": compiled.insertion.sample_by_insertion(2, 3, 0, 2, nothing, *insertion, 4, 16, True, False, words),
        "nothing beside": compiled.insertion.sample_by_insertion(
            2, 3, 0, 3, nothing, squeeze.blocked, squeeze.moves, 2, 2, 1, 1, 8, 16, True, False, words
        ),
        "no walk": compiled.walks.sample_by_walking(2, 5, 0, 2, split.moves, 3, words),
        "long": compiled.search.sample_from_trees(
            40, long.moves, 20, long.start, long.goal, long.reachable_cells, 1.0, 2.0, words
        ),
        "one cell": compiled.search.sample_from_trees(2, long.moves, 20, 7, 7, long.reachable_cells, 1.0, 2.0, words),
        "nothing in common": compiled.exchange.exchange_tails(apart, np.array([[0, 1]]), 9, False, words),
        "nothing to move": compiled.insertion.mutate_neighbour(
            apart, np.array([2]), np.zeros(9, np.uint8), np.zeros(9, np.uint8), 3, 3, 1, 1, 8, 9, True, False, words
        ),
        "no obstacle": compiled.measures.clearances(apart, np.zeros(9, np.uint8), np.full(9, np.inf), 3, 3),
        "one pass": compiled.segments.delete_points(apart, np.zeros(9, np.uint8), 3, 2, 1),
        "steep": compiled.measures.flagged_cells(np.array([[0, 7], [7, 0]], np.int32), np.ones(9, np.uint8), 3),
        "a point": compiled.segments.segments_free(split.blocked, 3, *np.array([[0, 1], [0, 1]], np.int32), 2),
        "nobody": compiled.identity.newcomers(nobody, nobody),
        "few words": np.array([random.below(words, 6) for _ in range(9)]),
    }  # fmt: skip


def _results(problem: PathProblem) -> dict[str, object]:
    it = problem.context
    insertion = (it.blocked, it.moves, it.rows, it.cols, *it.signs)
    words = np.array([1, 2**40 + 3, 2**63 + 5, 7], np.uint64)  # goes on from kernel to kernel
    trees = compiled.search.sample_from_trees(
        4, it.moves, it.cols, it.start, it.goal, it.reachable_cells, 1.0, 1.5, words
    )
    inserted = compiled.insertion.sample_by_insertion(
        3, 30, it.start, it.goal, it.reachable_cells, *insertion, 8, 56, True, False, words
    )
    printed = compiled.insertion.sample_by_insertion(
        2, 30, it.start, it.goal, it.reachable_cells, *insertion, 4, 56, False, True, words
    )
    direct = compiled.insertion.sample_by_insertion(
        2, 30, it.start, it.goal, np.empty(0, np.int32), *insertion, 8, 56, True, False, words
    )
    pairs, chosen = np.array([[0, 1], [2, 3]]), np.array([3, 0])
    pairs_of_ends = np.stack([it.reachable_cells[:-1], it.reachable_cells[1:]])
    row, col = np.divmod(np.arange(it.blocked.size), it.cols)
    before, after = (np.hypot(row - end // it.cols, col - end % it.cols) for end in (it.start, it.goal))
    return {
        "uniform": np.array([random.uniform(words) for _ in range(3)]),
        "tree": compiled.search.tree(it.moves, np.empty(0, np.float32), it.cols, it.start),
        "octile path": compiled.search.octile_path(it.moves, it.cols, it.start, it.goal),
        "any-angle path": compiled.search.any_angle_path(
            it.blocked, it.cols, it.start, it.goal, it.policy, before, after, math.inf, 10**6
        ),
        "trees": trees,
        "inserted": inserted,
        "inserted as printed": printed,
        "inserted without a cell between": direct,
        "walks": compiled.walks.sample_by_walking(2, 500, it.start, it.goal, it.moves, it.cols, words),
        "exchanged": compiled.exchange.exchange_tails(trees, pairs, it.blocked.size, False, words),
        "mutated": compiled.insertion.mutate_neighbour(trees, chosen, *insertion, 8, 56, True, False, words),
        "one gene mutated": compiled.insertion.mutate_neighbour(trees, chosen, *insertion, 4, 0, True, True, words),
        "lengths": compiled.measures.lengths(trees, it.cols),
        "sums": compiled.measures.sum_over_nodes(trees, it.obstacles_near, 0, 1),
        "turns": compiled.measures.turns(trees, it.cols),
        "energy": compiled.measures.quadrant_energy(
            trees, it.cols, it.goal, *it.signs, np.array([1.0, 3.0, 10.0]), False
        ),
        "energy by angle": compiled.measures.quadrant_energy(
            trees, it.cols, it.goal, *it.signs, np.array([1.0, 3.0, 10.0]), True
        ),
        "distinct": compiled.identity.distinct(np.concatenate((trees, trees[::-1]))),
        "newcomers": compiled.identity.newcomers(np.concatenate((trees, trees)), trees[:1]),
        "free": compiled.segments.segments_free(it.blocked, it.cols, *pairs_of_ends, it.policy),
        "shortened": compiled.segments.delete_points(trees, it.blocked, it.cols, it.policy, 0),
        "clearances": compiled.measures.clearances(trees, it.blocked, it.distance, it.rows, it.cols),
        "flagged": compiled.measures.flagged_cells(trees, it.unsafe, it.cols),
    }


if __name__ == "__main__":
    json.dump(results(), sys.stdout)
