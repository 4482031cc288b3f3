"""Slow, obvious twins of searches over cells and headings: every walk, every path, in plain Python on tuples."""

import heapq
from collections.abc import Callable, Iterator
from itertools import pairwise

import naive
from naive import Cell, Cells

import pathloom as pl
from pathloom.paths.additive import HEADINGS, Prices

Value = tuple[float, ...]


def steps_of(problem: pl.PathProblem) -> Callable[[Cell], list[tuple[int, Cell]]]:
    blocked = problem.context.occupied
    known: dict[Cell, list[tuple[int, Cell]]] = {}

    def steps(cell: Cell) -> list[tuple[int, Cell]]:
        if cell not in known:
            known[cell] = list(naive.legal_steps(blocked, cell, problem.corners))
        return known[cell]

    return steps


def simple_paths(problem: pl.PathProblem) -> Iterator[Cells]:
    """Yield every path of single steps that visits no cell twice."""
    steps = steps_of(problem)

    def onward(path: Cells) -> Iterator[Cells]:
        if path[-1] == problem.goal:
            yield path
            return
        for _, there in steps(path[-1]):
            if there not in path:
                yield from onward((*path, there))

    return onward((problem.start,))


def priced(prices: Prices, path: Cells, cols: int) -> float:
    """Add up what a path costs, as the definition says."""
    total = prices.constant
    headings = [HEADINGS.tolist().index([q - r, d - c]) for (r, c), (q, d) in pairwise(path)]
    ids = [r * cols + c for r, c in path]
    for k, d in enumerate(headings):
        total += prices.step[ids[k] if len(prices.step) > 1 else 0, d]
        total += prices.cell[ids[k + 1]] if prices.cell.size else 0.0
        if k > 0:
            total += prices.turn[prices.zone[ids[k]] if prices.zone.size else 0, headings[k - 1], d]
    return float(total)


def not_dominated(values: set[Value]) -> set[Value]:
    return {v for v in values if not any(w != v and all(a <= b for a, b in zip(w, v, strict=True)) for w in values)}


def cheapest_walk(problem: pl.PathProblem, prices: Prices) -> float:
    """Search over cells and headings, which never turn back, without any bound."""
    steps, cols = steps_of(problem), problem.context.cols
    heap, done = [(prices.constant, problem.start, -1)], set()
    while heap:
        cost, here, heading = heapq.heappop(heap)
        if here == problem.goal:
            return cost
        if (here, heading) in done:
            continue
        done.add((here, heading))
        at = here[0] * cols + here[1]
        for d, there in steps(here):
            more = prices.step[at if len(prices.step) > 1 else 0, d]
            more += prices.cell[there[0] * cols + there[1]] if prices.cell.size else 0.0
            if heading >= 0:
                more += prices.turn[prices.zone[at] if prices.zone.size else 0, heading, d]
            heapq.heappush(heap, (float(cost + more), there, d))
    return float("inf")


def front_of(problem: pl.PathProblem, add: Callable[[Value, int, Cell, int, Cell], Value], m: int) -> set[Value]:
    """Return the values that are not dominated: whole lists of values for each cell and heading, until none changes.

    ``add(value, heading, here, direction, there)`` is the value one step further.
    """
    steps = steps_of(problem)
    zero = (0,) * m
    if problem.start == problem.goal:
        return {zero}
    lists: dict[tuple[Cell, int], set[Value]] = {(problem.start, -1): {zero}}
    waiting = [(problem.start, -1)]
    while waiting:
        here, heading = waiting.pop(0)
        for d, there in steps(here):
            old = lists.get((there, d), set())
            new = not_dominated(old | {add(value, heading, here, d, there) for value in lists[here, heading]})
            if new != old:
                lists[there, d] = new
                if (there, d) not in waiting and there != problem.goal:
                    waiting.append((there, d))
    return not_dominated({v for (cell, _), values in lists.items() if cell == problem.goal for v in values})
