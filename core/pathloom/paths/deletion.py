"""Deletion of points whose neighbours see each other."""

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np

from pathloom import compiled
from pathloom.kernel.component import Whole
from pathloom.kernel.counting import count
from pathloom.kernel.operators import Repair
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population
from pathloom.paths.cell_paths import cells_of
from pathloom.paths.collision import Collision, Exact
from pathloom.paths.pathwise import path_problem
from pathloom.paths.problem import PathProblem


def delete_points(
    population: Population, problem: PathProblem, collision: Collision, passes: int = 1, restore: bool = True
) -> Population:
    """Drop, along each path, every interior point whose neighbours see each other.

    A point that is dropped leaves its predecessor to look at the next one. By
    the triangle inequality a path never gets longer; nor does it get more turns,
    since a point only stays where the path bends behind the one kept before it.

    Parameters
    ----------
    collision
        Says whether two points see each other.
    passes
        How often; 0: until nothing changes.
    restore
        Put points back where the exact test finds a segment blocked that ``collision`` took for free.
    """
    it = problem.context
    if type(collision) is Exact:  # a class that inherits from it may test otherwise
        return np.asarray(compiled.segments.delete_points(population, it.blocked, it.cols, it.policy, passes))
    shorter, done = population, 0
    while passes == 0 or done < passes:
        before, shorter = shorter, _deleted(shorter, problem, collision)
        done += 1
        if (shorter >= 0).sum() == (before >= 0).sum():
            break
    return _restored(shorter, population, problem) if restore else shorter


def _deleted(population: Population, problem: PathProblem, collision: Collision) -> Population:
    """Go along all paths side by side, once, so that a test of segments sees many at a time."""
    n, width = population.shape
    counts = (population >= 0).sum(axis=1)
    kept = np.full((n, width), -1, np.int32)
    kept[:, 0] = population[:, 0]
    at = np.zeros(n, np.intp)  # where the last kept point stands
    for i in range(1, width):
        here = np.flatnonzero(counts > i)
        inside = here[counts[here] > i + 1]
        if len(inside):
            a, b = (
                cells_of(ids, problem.context.cols) for ids in (kept[inside, at[inside]], population[inside, i + 1])
            )
            stays = counts > i
            stays[inside[collision.segments_free(a, b, problem)]] = False
            here = np.flatnonzero(stays)
        at[here] += 1
        kept[here, at[here]] = population[here, i]
    return np.ascontiguousarray(kept[:, : max(1, int(at.max(initial=0)) + 1)])


def _restored(population: Population, before: Population, problem: PathProblem) -> Population:
    """Put the points back that stood on a segment which is not free after all."""
    it = problem.context
    counts = (population >= 0).sum(axis=1)
    rows, starts = np.nonzero(population[:, 1:] >= 0)
    if len(rows) == 0:
        return population
    a, b = population[rows, starts], population[rows, starts + 1]
    free = compiled.segments.segments_free(it.blocked, it.cols, a, b, it.policy)
    if free.all():
        return population
    paths = [row[:k] for row, k in zip(population, counts, strict=True)]
    for k in np.unique(rows[~free]):
        whole = before[k][before[k] >= 0]
        places, at = [0], 0
        for cell in paths[k][1:]:  # the points kept stand among the old ones in the same order
            at += 1 + int(np.argmax(whole[at + 1 :] == cell))
            places.append(at)
        blocked = set(starts[(rows == k) & ~free].tolist())
        pieces = [
            whole[first:last] if s in blocked else whole[first : first + 1]
            for s, (first, last) in enumerate(pairwise(places))
        ]
        paths[k] = np.concatenate((*pieces, whole[-1:]))
        count("points restored", len(paths[k]) - int(counts[k]))
    out = np.full((len(paths), max(map(len, paths))), -1, np.int32)
    for row, path in zip(out, paths, strict=True):
        row[: len(path)] = path
    return out


@dataclass(frozen=True, kw_only=True)
class PointDeletion(Repair):
    """Drop every interior point when the segment between its neighbours is free."""

    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    collision: Collision = Exact()
    """Test of the segment that would take the place of the point."""
    passes: Whole = 1
    """How many times along the path; 0: until nothing changes."""
    restore: bool = True
    """Put points back where the exact test finds a new segment blocked after all."""

    def apply(self, population: Population, problem: Problem, rng: np.random.Generator) -> Population:
        return delete_points(population, path_problem(problem), self.collision, self.passes, self.restore)
