"""Runs every kernel once on a small map and prints what came out: for a process in which nothing is compiled."""

import json
import math
import sys

import numpy as np

from pathloom import PathProblem, compiled
from pathloom.compiled import random
from pathloom.paths.context import STEPS, Context
from pathloom.paths.lines import lines_between

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
            found[f"{name}, {corners}"] = [_plain(part) for part in parts]
    for name, value in _oddities().items():
        parts = value if isinstance(value, tuple) else (value,)
        found[name] = [_plain(part) for part in parts]
    return found


def _plain(part: object) -> object:
    if hasattr(part, "tolist"):
        return part.tolist()
    return part if isinstance(part, float) else int(part)


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
    fitness = np.array([0.25, 0.5, 0.375, 0.125, 0.375])
    extremes = np.array([0.5, math.inf, 0.0])
    in_halves = np.array([0, 1, 2], np.int64)
    open_room = PathProblem(np.zeros((3, 3), bool)).context
    comb = np.zeros((4, 150), np.uint8)  # more gaps side by side than buffers have room for at first
    comb[1, 1::2] = 1
    comb = comb.ravel()
    return {
        "votes": compiled.forests.vote(
            np.array([0, 3]), np.array([0, -1, -1, -1], np.int32), np.array([0.5, 0.0, 0.0, 0.0]),
            np.array([1, 0, 0, 0], np.int32), np.array([2, 0, 0, 0], np.int32),
            np.array([[0.5, 0.5], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]]), np.array([[0.25], [0.75]], np.float32),
        ),
        "rays": compiled.rays.cast(comb, 4, 150, np.array([[75.25, 0.5, 0.25], [-1.0, 0.0, 0.0], [75.5, 1.5, 0.0]]),
                                   np.array([0.0, 1.5, -1.5, 3.0]), np.array([[78.0, 0.25, 0.5], [75.25, 0.5, 0.0]]), 9.0),
        "rays along the axes": compiled.rays.cast(
            open_room.blocked, 3, 3, np.array([[1.5, 1.5, 0.0]]), np.array([0.0]), np.empty((0, 3)), 9.0
        ),
        "room": np.array([
            compiled.rays.clearance(comb, 4, 150, x, 2.75, np.array([[9.0, 2.0, 0.5]]), 2.0) for x in (-1.0, 7.5, 9.5)
        ]),
        "walkers": _walked(open_room.blocked, words),
        "ways": compiled.rays.nearest_on_ways(np.zeros((2, 1, 2)), np.ones((1, 2))),
        "no way": compiled.search.octile_path(split.moves, 3, 0, 2),
        "no straight way": compiled.any_angle.any_angle_path(split.blocked, 3, 0, 2, 2, np.zeros(3), np.zeros(3), math.inf, 99),
        "too little work": compiled.any_angle.any_angle_path(np.zeros(9, np.uint8), 3, 6, 2, 2, np.zeros(9), np.zeros(9), 9.0, 1),
        "nothing so short": compiled.any_angle.any_angle_path(np.zeros(9, np.uint8), 3, 6, 2, 2, np.full(9, 2.0), np.full(9, 2.0), 3.0, 9),
        "a long look": compiled.sight.cells_in_sight(comb, 150, 74, 0),
        "ways past a comb": compiled.taut.distances(comb, 150, 74, 599, 0, math.inf, True),
        "no way in the plane": compiled.taut.distances(split.blocked, 3, 0, 2, 0, math.inf, False),
        "nothing inserted": compiled.insertion.sample_by_insertion(2, 3, 0, 2, nothing, *insertion, 4, 16, True, False, words),
        "nothing beside": compiled.insertion.sample_by_insertion(
            2, 3, 0, 3, nothing, squeeze.blocked, squeeze.moves, 2, 2, 1, 1, 8, 16, True, False, words
        ),
        "no walk": compiled.walks.sample_by_walking(2, 5, 0, 2, split.moves, 3, words),
        "long": compiled.seeding.sample_from_trees(
            40, 3, long.moves, 20, long.start, long.goal, long.reachable_cells, 1.0, 2.0, words
        ),
        "one cell": compiled.seeding.sample_from_trees(2, 1, long.moves, 20, 7, 7, long.reachable_cells, 1.0, 2.0, words),
        "nothing in common": compiled.exchange.exchange_tails(apart, np.array([[0, 1]]), 9, False, words),
        "nothing in common, beside each other": compiled.crossing.cross_where_shortest(
            np.array([[0, 1, 2, 5, 8], [0, 3, 6, 7, 8]], np.int32), np.array([[0, 1]]), open_room.moves, 3, 2, True, words
        ),
        "nowhere to cross": compiled.crossing.cross_where_shortest(
            apart, np.array([[0, 2], [1, 2]]), open_room.moves, 3, 2, True, words
        ),
        "nothing to move": compiled.insertion.mutate_neighbour(
            apart, np.array([2]), np.zeros(9, np.uint8), np.zeros(9, np.uint8), 3, 3, 1, 1, 8, 9, True, False, words
        ),
        "no obstacle": compiled.measures.clearances(apart, np.zeros(9, np.uint8), np.full(9, np.inf), 3, 3),
        "one pass": compiled.segments.delete_points(apart, np.zeros(9, np.uint8), 3, 2, 1),
        "steep": compiled.measures.flagged_cells(np.array([[0, 7], [7, 0]], np.int32), np.ones(9, np.uint8), 3),
        "a point": compiled.segments.segments_free(split.blocked, 3, *np.array([[0, 1], [0, 1]], np.int32), 2),
        "nobody": compiled.identity.newcomers(nobody, nobody),
        "falling": compiled.probabilities.falling(fitness, 0.65, 0.7, 0.9, math.exp(-0.5)),
        "falling from infinity": compiled.probabilities.falling(extremes, 0.65, 0.7, 0.9, math.exp(0.5)),
        "falling nowhere": compiled.probabilities.falling(np.full(10, 0.1), 0.65, 0.7, 0.9, 1.0),
        "banded": compiled.probabilities.banded(fitness, 0.8, 0.2, 3.0),
        "banded to infinity": compiled.probabilities.banded(extremes, 0.8, 0.2, 3.0),
        "sinc": compiled.probabilities.sinc(fitness, 0.5, 0.8),
        "sinc from infinity": compiled.probabilities.sinc(extremes, 0.5, 0.8),
        "sinc below zero": compiled.probabilities.sinc(fitness - 0.5, 0.5, 0.8),
        "rates of nobody": compiled.probabilities.sinc(np.empty(0), 0.5, 0.8),
        "libraries too far": compiled.libraries.sample_from_libraries(
            2, 3, 2, 1, True, 0, 8, np.array([4, 5], np.int32), in_halves, open_room.blocked, open_room.moves,
            3, 3, 1, 1, 8, 16, True, False, words,
        ),
        "no library and no way": compiled.libraries.sample_from_libraries(
            2, 3, 1, 0, False, 0, 2, nothing, in_halves[:1], *insertion, 8, 16, True, False, words
        ),
        "loops cut out": compiled.reshaping.without_loops(np.array([[0, 1, 2, 1, 4], [3, 4, 3, -1, -1]], np.int32), 9),
        "steep, cell by cell": compiled.reshaping.cell_by_cell(np.array([[0, 7, 5], [7, 0, -1]], np.int32), 3),
        "one child": compiled.exchange.splice(
            apart, np.array([[0, 1]]), np.array([[1, 0]]), np.array([[True, False]]), 9, True
        ),
        "few words": np.array([random.below(words, 6) for _ in range(9)]),
        "an obstacle at the end": compiled.midpoints.segments_free(split.blocked, 3, *np.array([[0, 1], [1, 0]], np.int32), 1, 1),
        "nothing to join": compiled.joining.exchange_at_position(
            np.array([[0, 2, 4], [0, 2, 4], [0, 4, -1], [1, 1, 3]], np.int32), np.array([[0, 1], [2, 3]]),
            open_room.blocked, open_room.moves, 3, 3, 1, 1, 4, 9, True, False, words,
        ),
        "no way to join": compiled.joining.exchange_at_position(
            np.array([[0, 0, 2], [2, 2, 0]], np.int32), np.array([[0, 1]]), *insertion, 4, 9, True, False, words
        ),
    }  # fmt: skip


def _walked(blocked: np.ndarray, words: np.ndarray) -> np.ndarray:
    movers = np.array([[0.5, 0.5, 0.25], [2.5, 1.5, 0.25], [1.0, 2.5, 0.25]])
    velocities = np.array([[-1.0, 0.0], [0.0, 0.5], [1.0, 0.0]])
    for _ in range(4):
        compiled.rays.wander(blocked, 3, 3, movers, velocities, np.array([[0.5, 2.0, 0.1]]), 2.0, 2.5, 0.4, 0.5, words)
    return np.concatenate((movers.ravel(), velocities.ravel()))


def _results(problem: PathProblem) -> dict[str, object]:
    it = problem.context
    insertion = (it.blocked, it.moves, it.rows, it.cols, *it.signs)
    words = np.array([1, 2**40 + 3, 2**63 + 5, 7], np.uint64)  # goes on from kernel to kernel
    trees = compiled.seeding.sample_from_trees(
        4, 1, it.moves, it.cols, it.start, it.goal, it.reachable_cells, 1.0, 1.5, words
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
    free_cells = np.flatnonzero(it.blocked == 0).astype(np.int32)
    far_apart = (np.repeat(free_cells, len(free_cells)), np.tile(free_cells, len(free_cells)))
    row, col = np.divmod(np.arange(it.blocked.size), it.cols)
    lines = lines_between(it)
    library = (np.concatenate(lines), np.cumsum([0, *map(len, lines)]))
    shorter = compiled.segments.delete_points(trees, it.blocked, it.cols, it.policy, 0)
    cuts, both = np.array([[2, 3], [4, 1]]), np.array([[True, True], [False, True]])
    before, after = (np.hypot(row - end // it.cols, col - end % it.cols) for end in (it.start, it.goal))
    return {
        "uniform": np.array([random.uniform(words) for _ in range(3)]),
        "octile path": compiled.search.octile_path(it.moves, it.cols, it.start, it.goal),
        "any-angle path": compiled.any_angle.any_angle_path(
            it.blocked, it.cols, it.start, it.goal, it.policy, before, after, math.inf, 10**6
        ),
        "cells in sight": compiled.sight.cells_in_sight(it.blocked, it.cols, it.start, it.policy),
        "ways in the plane": compiled.taut.distances(it.blocked, it.cols, it.start, it.goal, it.policy, math.inf, True),
        "the way in the plane": compiled.taut.distances(it.blocked, it.cols, it.start, it.goal, it.policy, 40.0, False),
        "trees": trees,
        "inserted": inserted,
        "inserted as printed": printed,
        "inserted without a cell between": direct,
        "walks": compiled.walks.sample_by_walking(2, 500, it.start, it.goal, it.moves, it.cols, words),
        "exchanged": compiled.exchange.exchange_tails(trees, pairs, it.blocked.size, False, words),
        "crossed where shortest": compiled.crossing.cross_where_shortest(
            trees, pairs, it.moves, it.cols, 3, True, words
        ),
        "without detours": compiled.crossing.without_detours(printed[0], it.moves, it.cols),
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
        "shortened": shorter,
        "pulled": compiled.tightening.pulled(trees, it.blocked, it.cols, it.policy, 3),
        "through the band": compiled.tightening.through_band(trees, it.blocked, it.cols, it.policy, 2, 3),
        "pooled": compiled.pooling.pooled(trees, np.arange(len(trees)), it.blocked, it.cols, it.policy, 1, 500),
        "pooled in little room": compiled.pooling.pooled(trees, np.arange(4), it.blocked, it.cols, it.policy, 2, 3),
        "clearances": compiled.measures.clearances(trees, it.blocked, it.distance, it.rows, it.cols),
        "flagged": compiled.measures.flagged_cells(trees, it.unsafe, it.cols),
        "through libraries": compiled.libraries.sample_from_libraries(
            3, 60, 3, 4, False, it.start, it.goal, *library, *insertion, 8, 56, True, False, words
        ),
        "through libraries with loops": compiled.libraries.sample_from_libraries(
            3, 60, 1, 0, False, it.start, it.goal, *library, *insertion, 4, 56, True, True, words
        ),
        "without loops": compiled.reshaping.without_loops(printed[0], it.blocked.size),
        "cell by cell": compiled.reshaping.cell_by_cell(shorter, it.cols),
        **_trials(it, trees, pairs, chosen, words),
        **_rejoined(it, trees, library),
        **_priced(it, trees),
        **_grown(it, trees, words),
        **_ants(it, trees, pairs, chosen),
        **_smoothed(it),
        **_decoded(it),
        "spliced": compiled.exchange.splice(trees, pairs, cuts, both, it.blocked.size, False),
        "spliced with loops": compiled.exchange.splice(trees, pairs, cuts, both, it.blocked.size, True),
        "beside": compiled.measures.obstacles_beside(trees, it.beside, it.cols),
        "free by midpoints": compiled.midpoints.segments_free(it.blocked, it.cols, *far_apart, *it.signs),
        "joined at a position": compiled.joining.exchange_at_position(
            trees, pairs, *insertion, 4, 56, True, False, words.copy()
        ),
        "joined with loops": compiled.joining.exchange_at_position(
            printed[0], pairs[:1], *insertion, 8, 56, False, True, words.copy()
        ),
    }


def _rejoined(it: Context, trees: np.ndarray, library: tuple[np.ndarray, np.ndarray]) -> dict[str, object]:
    """Return what distances say of segments and lines, and what becomes of paths and stretches that are drawn again."""
    on, insertion = (it.blocked, it.rows, it.cols), (it.blocked, it.moves, it.rows, it.cols, *it.signs)
    words = np.array([5, 2**50 + 1, 2**63 + 9, 11], np.uint64)
    cells = np.flatnonzero(it.blocked == 0).astype(np.int32)
    ends = (np.repeat(cells, len(cells)), np.tile(cells, len(cells)))
    chosen, ends_only = np.arange(len(trees)), np.array([[it.start, it.goal, -1]], np.int32)
    return {
        "clear of segments": compiled.distances.clear(*on, *ends, 1.0, 2.0, False),
        "clear of lines": compiled.distances.clear(*on, *ends, 1.0, 2.0, True),
        "clear by two cells": compiled.distances.clear(*on, *ends, 2.0, 1.0, False),
        "made anew between": compiled.rejoining.mutate_between(
            trees, chosen, 1, 9, *insertion, 8, 56, True, False, words
        ),
        "made anew beyond": compiled.rejoining.mutate_between(
            trees, chosen, 2, 2, *insertion, 4, 9, False, True, words
        ),
        "nothing to make anew": compiled.rejoining.mutate_between(
            ends_only, chosen[:1], 1, 9, *insertion, 8, 56, True, False, words
        ),
        "in turn": compiled.libraries.sample_in_turn(
            4, 30, 6, it.start, it.goal, *library, *insertion, 8, 56, True, False, words
        ),
        "in turn with loops": compiled.libraries.sample_in_turn(
            3, 30, 1, it.start, it.goal, *library, *insertion, 4, 56, False, True, words
        ),
    }


def _priced(it: Context, trees: np.ndarray) -> dict[str, object]:
    """Return the cheapest walks and the fronts under prices of every shape, and what paths cost."""
    cells = it.blocked.size
    step, turn = np.hypot(*np.array(STEPS).T)[np.newaxis], 1.0 - np.eye(8)[np.newaxis]
    by_cell, zone = np.arange(8.0 * cells).reshape(cells, 8) % 5, (np.arange(cells) % 2).astype(np.int32)
    no_turn, no_cell, no_zone = np.zeros((1, 8, 8)), np.empty(0), np.empty(0, np.int32)
    found: dict[str, object] = {}
    for name, tables in {
        "steps": (step, no_cell, no_turn, no_zone),
        "turns and cells": (step, it.unsafe.astype(float), 2.0 * turn, no_zone),
        "steps by cell and turns by zone": (by_cell, no_cell, np.concatenate((turn, 3.0 * turn)), zone),
    }.items():
        found[f"price of {name}"] = compiled.headings.price(trees, it.cols, *tables)
        found[f"cheapest by {name}"] = compiled.headings.cheapest(it.moves, it.cols, it.start, it.goal, *tables)
    found["price of long steps"] = np.isnan(compiled.headings.price(np.array([[0, 9, 13]], np.int32), it.cols, *tables))
    found["cheapest nowhere"] = compiled.headings.cheapest(it.moves, it.cols, it.start, it.start, *tables)
    found["no way at any price"] = compiled.headings.cheapest(0 * it.moves, it.cols, it.start, it.goal, *tables)
    words = np.array([4, 2**33 + 7, 2**62 + 1, 5], np.uint64)
    for goal, way in ((it.goal, "to the goal"), (it.start, "nowhere")):
        found[f"along priced trees {way}"] = compiled.priced.sample_from_priced_trees(
            3, it.moves, it.cols, it.start, goal, *tables, 1.0, 1.5, words
        )
    found["along priced trees without a way"] = compiled.priced.sample_from_priced_trees(
        3, 0 * it.moves, it.cols, it.start, it.goal, *tables, 1.0, 1.5, words
    )
    turns = np.stack((np.zeros((1, 8, 8)), turn, np.zeros((1, 8, 8))))
    both = np.stack((step + 4.0 * (step > 1.0), 0.0 * step, 0.0 * step)).round()
    price = np.stack((np.zeros(cells), np.zeros(cells), it.unsafe.astype(float)))
    across = np.ascontiguousarray(np.moveaxis((turns[:, :, :, np.newaxis] - turns[:, :, np.newaxis]).max(-1), 0, -1))
    for name, goal, limit in (("front", it.goal, 9999), ("no front", it.start, 9), ("too few labels", it.goal, 9)):
        found[name] = compiled.fronts.front(
            it.moves, it.cols, it.start, goal, both, price, turns, across, no_zone, limit
        )
    zones = np.concatenate((turns, 2.0 * turns), axis=1)
    apart = np.full((2, 8, 8, 3), math.inf)
    found["front in zones"] = compiled.fronts.front(
        it.moves, it.cols, it.start, it.goal, np.repeat(both, cells, axis=1), np.zeros((3, 0)), zones, apart, zone, 9999
    )
    return found


def _ants(it: Context, trees: np.ndarray, pairs: np.ndarray, chosen: np.ndarray) -> dict[str, object]:
    """Return where ants and guided walks go, what becomes of pheromone, and of paths that are searched again."""
    words = np.array([9, 2**41 + 7, 2**63 + 1, 3], np.uint64)
    cells, amounts = it.blocked.size, np.array([0.5, 0.25, 0.125, 1.0])
    even, rising = np.ones((cells, 8)), np.linspace(0.5, 2.0, 8 * cells).reshape(cells, 8)
    wanted, nowhere = rising.copy(), np.zeros(cells, np.uint8)
    wanted[:, 2] = math.inf  # to the east wherever there is a way
    closed, marked = nowhere.copy(), np.zeros(cells, bool)
    closed[it.reachable_cells[::7]] = marked[it.reachable_cells[::3]] = True
    there, ends = (it.cols, it.start, it.goal), np.array([[it.start, it.goal, -1]], np.int32)
    return {
        "ants": compiled.ants.march(5, even, rising, 1.0, it.moves, nowhere, *there, True, words),
        "ants that die": compiled.ants.march(5, rising, wanted, 0.5, it.moves, nowhere, *there, False, words),
        "ants with closed cells": compiled.ants.march(5, rising, even, 2.0, it.moves, closed, *there, True, words),
        "ants that nothing draws": compiled.ants.march(3, even, 0 * even, 1.0, it.moves, nowhere, *there, True, words),
        "renewed": compiled.ants.renew(rising, 0.75, trees, amounts, it.moves, it.cols, False, 0.0, math.inf),
        "renewed within limits": compiled.ants.renew(rising, 0.75, trees, amounts, it.moves, it.cols, False, 0.7, 1.5),
        "renewed on cells": compiled.ants.renew(rising, 0.75, trees, amounts, it.moves, it.cols, True, 0.0, math.inf),
        "laid": compiled.ants.lay(0.1, trees, amounts, cells, it.cols, True),
        "laid in sums": compiled.ants.lay(0.1, trees, amounts, cells, it.cols, False),
        "weakened": compiled.ants.weaken(rising, marked, it.moves, it.cols, 0.5),
        "mean number of steps": np.array([compiled.ants.mean_steps(it.moves)]),
        "no steps": np.array([compiled.ants.mean_steps(nowhere)]),
        "reached": np.array([compiled.ants.reaches(it.moves, mask, *there) for mask in (nowhere, closed)]),
        "guided": compiled.guided.sample_by_guided_walks(4, it.start, it.goal, 1.5, it.moves, it.cols, words),
        "guided nowhere": compiled.guided.sample_by_guided_walks(2, it.start, it.goal, 1.5, nowhere, it.cols, words),
        "searched again": compiled.guided.search_again(trees, chosen, 2.0, it.moves, it.cols, words),
        "nothing to search": compiled.guided.search_again(ends, np.zeros(1, np.int64), 2.0, it.moves, it.cols, words),
        "no way to search": compiled.guided.search_again(trees, chosen, 2.0, nowhere, it.cols, words),
        "meeting": compiled.guided.meet(trees, pairs, cells),
        "not meeting": compiled.guided.meet(np.stack((trees[0, :3], trees[0, 2:5])), np.array([[0, 1], [0, 0]]), cells),
        "included angles": compiled.angles.included_angles(trees, it.cols),
        "merged": compiled.merging.merge(trees, pairs, cells, it.cols),
    }  # fmt: skip


def _grown(it: Context, paths: np.ndarray, words: np.ndarray) -> dict[str, object]:
    """Return what a tree in the open gives, and what is made of it."""
    unit, samples = compiled.trees.UNIT, 700
    nodes, parents = np.zeros((samples + 2, 2), np.int64), np.full(samples + 2, -1, np.int32)
    nodes[0] = np.array(divmod(it.start, it.cols)) * unit
    goal = [side * unit for side in divmod(it.goal, it.cols)]
    how = (it.blocked, it.rows, it.cols, it.policy, *goal, 1.2 * unit, 1.7 * unit)
    count, drawn, reached = compiled.trees.grow(*how, 0.1, False, nodes, parents, 1, samples, words)
    branch = [count - 1 if reached < 0 else reached]
    while parents[branch[-1]] >= 0:
        branch.append(int(parents[branch[-1]]))
    way = np.ascontiguousarray(nodes[branch[::-1]])
    found = {
        "grown": (nodes[:count].copy(), parents[:count].copy(), np.array([drawn, reached])),
        "nearest": compiled.trees.nearest_nodes(nodes[:count].copy(), way + unit // 3, it.rows, it.cols),
        "straightened": compiled.trees.straightened(way, it.blocked, it.cols, it.policy),
        "over cells": compiled.trees.cells_of_points(way, it.blocked, it.cols, it.policy),
        "paths straightened": compiled.trees.straightened_paths(paths, it.blocked, it.cols, it.policy),
        "free in the open": compiled.trees.open_segments_free(it.blocked, it.cols, way[:-1], way[1:], it.policy),
    }
    few = compiled.trees.grow(*how, 0.5, True, nodes, parents, 1, 40, words)
    return {**found, "grown by sample": (nodes[: few[0]].copy(), np.array(few))}


def _smoothed(it: Context) -> dict[str, object]:
    """Return what a spline around an obstacle gives, and one into it."""
    around = np.array([[4.0, 0.0], [2.0, 0.0], [2.0, 2.0], [4.0, 2.0], [4.0, 4.0]])
    found: dict[str, object] = {}
    for name, control in (("around", around), ("into it", around + np.array([0.5, 0.7]))):
        pieces = compiled.curves.spline_pieces(control, 3)
        straight = np.zeros(len(pieces), np.bool_)
        free, points, length, curvature = compiled.curves.sampled(
            pieces, straight, it.blocked, it.rows, it.cols, it.policy, 1e-3
        )
        clearance = compiled.curves.clearance(points, it.blocked, it.distance, it.rows, it.cols)
        found[f"spline {name}"] = (pieces, free, points, np.array([length, curvature, clearance]))
    return found


def _decoded(it: Context) -> dict[str, object]:
    """Return the paths of some vectors, how far they lie in obstacles, and the cells along some curves."""
    genes = np.array([[0.1, 0.9, 0.5, 1.0], [0.3, 0.3, 0.75, -0.1], [0.0, 0.2, 0.2, 1.2]])
    lines = np.repeat(genes, 2, axis=1)[:, :7]
    there = (it.start, it.goal, it.rows, it.cols)
    through_points = compiled.decoding.through_points(genes, *there)
    through_lines = compiled.decoding.through_lines(np.ascontiguousarray(lines), *there, False)
    through_rows = compiled.decoding.through_lines(np.ascontiguousarray(lines[:, :3]), *there, True)
    how = (it.blocked, it.cols, it.policy)
    handles = np.array([[[4, 0], [2, 0], [1, 2], [2, 2]], [[2, 2], [3, 2], [0, 5], [0, 8]]], float)
    straight = np.linspace((4.0, 0.0), (0.0, 4.0), 4)
    curves = np.stack((handles, np.stack((straight, straight[::-1]))))
    return {
        "through points": through_points,
        "through lines": through_lines,
        "through rows": through_rows,
        "no way to decode": compiled.decoding.through_points(genes, it.goal, it.goal, it.rows, it.cols),
        "violated by points": compiled.decoding.violations(through_points, *how),
        "violated by lines": compiled.decoding.violations(through_lines, *how),
        "violated by rows": compiled.decoding.violations(through_rows, *how),
        "points on a curve": compiled.decoding.sample_curve(handles, 0.25),
        "cells along curves": compiled.decoding.along_curves(curves, it.cols, 0.25, it.distance, 1.5),
    }


def _trials(
    it: Context, trees: np.ndarray, pairs: np.ndarray, chosen: np.ndarray, words: np.ndarray
) -> dict[str, object]:
    """Return what the linear trial and its operators give, in floating point and in integers."""
    cells = np.flatnonzero(it.blocked == 0).astype(np.int32)
    ends = (np.repeat(cells, len(cells)), np.tile(cells, len(cells)))
    on, nowhere = (it.blocked, it.rows, it.cols), np.empty(0, np.int32)
    short = np.array([[cells[0], -1], [cells[1], cells[2]]], np.int32)
    limits = (400, 5, 0.5)
    found: dict[str, object] = {
        "greedy walks": compiled.walks.sample_by_greedy_walks(
            3, *limits, True, it.start, it.goal, cells, it.moves, it.cols, words
        ),
        "greedy walks without loops": compiled.walks.sample_by_greedy_walks(
            3, *limits, False, it.start, it.goal, cells, it.moves, it.cols, words
        ),
        "cuts": compiled.trial.draw_cuts(trees, pairs, words),
        "nothing to cut": compiled.trial.draw_cuts(short, pairs[:1], words),
        "genes": compiled.trial.draw_genes(trees, chosen, nowhere, *on, words),
        "genes from anywhere": compiled.trial.draw_genes(trees, chosen, cells, *on, words),
        "no gene": compiled.trial.draw_genes(short, pairs[0], nowhere, *on, words),
    }
    for name, tests, parts in (("trial", 1, 0), ("trial in integers", 1, 10), ("trial, verified", 3, 0)):
        how = (*on, it.policy, tests, 0.1, parts)
        found[f"free by {name}"] = compiled.trial.segments_free(*ends, *how)
        found[f"joined by {name}"] = compiled.trial.cut_and_join(trees, pairs, *how, words)
        found[f"replaced by {name}"] = compiled.trial.replace_genes(trees, chosen, nowhere, *how, words)
    return found


if __name__ == "__main__":
    json.dump(results(), sys.stdout)
