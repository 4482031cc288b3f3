"""No operator and no planner knows where north is.

Map, start, goal and population are turned and mirrored, the operator is applied, and
the result is turned back. What is deterministic must come out the same, bit for bit
(sums to the last digits); what is random must have the same distribution.
"""

import dataclasses

import numpy as np
import pytest
from scipy.stats import ks_2samp

import pathloom as pl
from pathloom.kernel.component import Component, parameters
from pathloom.kernel.compose import build, compose
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import run

from .filled import FILLED

ENTRIES = [e for e in default_registry().all_entries() if not any(p.required for p in parameters(e.component))]
SYMMETRIES = [(turns, mirrored) for mirrored in (False, True) for turns in range(4)]
LEAST_P = 1e-4
"""Of some two thousand comparisons with fixed seeds none falls below it by chance alone."""


def in_integers(component):
    """The component, with integers for floating steps along a segment.

    A falling diagonal is sampled from one of its two ends, and the sums of steps depend on which.
    """
    parts = {p.name: getattr(component, p.name) for p in parameters(type(component))}
    changes = {name: in_integers(part) for name, part in parts.items() if isinstance(part, Component)}
    changes |= {p.name: tuple(map(in_integers, parts[p.name])) for p in parameters(type(component)) if p.slots}
    if getattr(component, "arithmetic", "exact") == "floating":
        changes["arithmetic"] = "exact"
    return dataclasses.replace(component, **changes) if changes else component


def of(kind):
    found = [e for e in ENTRIES if issubclass(e.component, kind) and e.component.works_on in ("", "cells")]
    assert found
    filled = [c for c in FILLED if isinstance(c, kind)]
    components = [e.component() for e in found] + filled
    return pytest.mark.parametrize("component", components, ids=[e.name for e in found] + [c.name for c in filled])


class View:
    """A problem, turned and mirrored."""

    def __init__(self, occupied, start, goal, corners, symmetry):
        turns, mirrored = symmetry
        cells = np.arange(occupied.size).reshape(occupied.shape)
        here = np.rot90(cells, turns)
        here = np.ascontiguousarray(here[:, ::-1] if mirrored else here)
        self.old = here.ravel().astype(np.int32)
        self.new = np.argsort(self.old).astype(np.int32)
        ends = [divmod(int(self.new[r * occupied.shape[1] + c]), here.shape[1]) for r, c in (start, goal)]
        self.problem = pl.PathProblem(occupied.ravel()[here], start=ends[0], goal=ends[1], corners=corners)

    def there(self, population):
        return np.where(population < 0, -1, self.new[population])

    def back(self, population):
        return np.where(population < 0, -1, self.old[population])


def views(corners="no-squeeze"):
    occupied = np.ascontiguousarray(pl.load_map("blocks-15:22%:s4").occupied[:, :12])
    return [View(occupied, (13, 1), (2, 10), corners, symmetry) for symmetry in SYMMETRIES]


def first_population(problem, n):
    trees = build(pl.Sampling, "perturbed-trees", default_registry(), "")
    return trees.sample(problem, n, np.random.default_rng(0))


def features(population, cols):
    """Length, mean row and mean column of each path: what would betray a direction."""
    inside = population >= 0
    counts = inside.sum(axis=1)
    rows, columns = (np.where(inside, part, 0) for part in (population // cols, population % cols))
    steps = np.where(inside[:, 1:], np.hypot(np.diff(rows, axis=1), np.diff(columns, axis=1)), 0.0)
    return np.stack((steps.sum(axis=1), rows.sum(axis=1) / counts, columns.sum(axis=1) / counts), axis=1).round(9)


def assert_same_distribution(samples):
    for sample in samples[1:]:
        for name, ours, theirs in zip(("length", "row", "column"), samples[0].T, sample.T, strict=True):
            assert ks_2samp(ours, theirs, method="asymp").pvalue > LEAST_P, name


@of(pl.Sampling)
def test_sampling_has_no_favourite_direction(component):
    found = []
    for seed, view in enumerate(views()):
        rng = np.random.default_rng(seed)
        drawn = [component.sample(view.problem, 1, rng) for _ in range(300)]  # of one call they may have much in common
        found.append(np.concatenate([features(view.back(population), 12) for population in drawn]))
        assert len(found[-1]) > 200
    assert_same_distribution(found)


@of(pl.Crossover)
def test_crossover_has_no_favourite_direction(component):
    found = []
    for seed, view in enumerate(views()):
        parents = view.there(first_population(views()[0].problem, 300))
        pairs = np.arange(300).reshape(-1, 2)
        rng = np.random.default_rng(seed)
        children = [component.cross(parents, pairs, view.problem, rng) for _ in range(2)]
        found.append(np.concatenate([features(view.back(c), 12) for c in children]))
    assert_same_distribution(found)


@of(pl.Mutation)
def test_mutation_has_no_favourite_direction(component):
    found = []
    for seed, view in enumerate(views()):
        parents = view.there(first_population(views()[0].problem, 300))
        rng = np.random.default_rng(seed)
        mutants = [component.apply(parents, np.arange(300), view.problem, rng) for _ in range(2)]
        found.append(np.concatenate([features(view.back(m), 12) for m in mutants]))
    assert_same_distribution(found)


@pytest.mark.parametrize("corners", ["strict", "no-squeeze", "allow"])
@of(pl.Repair)
def test_repair_has_no_favourite_direction_and_without_chance_gives_the_same(component, corners):
    component, first = in_integers(component), first_population(views(corners)[0].problem, 100)
    seeds = [range(8), range(8, 16)]
    repaired = [
        [view.back(component.apply(view.there(first), view.problem, np.random.default_rng(k))) for view, k in runs]
        for runs in (zip(views(corners), numbers, strict=True) for numbers in seeds)
    ]
    paths = [[row[row >= 0].tolist() for row in population] for population in repaired[0]]
    if [row[row >= 0].tolist() for row in repaired[1][0]] == paths[0]:
        assert all(result == paths[0] for result in paths)
    else:  # it draws something
        assert_same_distribution([features(population, 12) for population in repaired[0]])


@pytest.mark.parametrize("corners", ["strict", "no-squeeze", "allow"])
@of(pl.Collision)
def test_a_segment_is_free_from_every_side(component, corners):
    component, all_views = in_integers(component), views(corners)
    free = np.argwhere(~all_views[0].problem.context.occupied)
    rng = np.random.default_rng(1)
    a, b = (free[rng.integers(len(free), size=600)] for _ in range(2))
    results = []
    for view in all_views:
        ends = [view.new[c[:, 0] * 12 + c[:, 1]] for c in (a, b)]
        cols = view.problem.context.cols
        first, second = (np.stack((ids // cols, ids % cols), axis=1) for ids in ends)
        results.append(component.segments_free(first, second, view.problem).tolist())
    assert all(result == results[0] for result in results)


@of(pl.Objective)
def test_objectives_have_the_same_value_from_every_side(component):
    first = first_population(views()[0].problem, 60)
    deleted = build(pl.Repair, "point-deletion", default_registry(), "").apply(
        first, views()[0].problem, np.random.default_rng(0)
    )
    for population in (first, deleted):
        values = [component.measure(view.there(population), view.problem) for view in views()]
        for other in values[1:]:
            assert np.allclose(other, values[0], rtol=1e-12, atol=1e-12)


PLANNERS = [e for e in ENTRIES if issubclass(e.component, (pl.Evolution, FrontPlanner))]


@pytest.mark.parametrize("entry", PLANNERS, ids=lambda e: e.name)
def test_planners_have_no_favourite_direction(entry):
    planner = compose(entry.component(), population=15, termination=[{"use": "max-generations", "limit": 6}])
    found = []
    for turn, view in enumerate(views()):
        paths = [run(view.problem, planner, 100 * turn + seed).outcome.solution for seed in range(40)]
        found.append(np.concatenate([features(view.back(p[np.newaxis]), 12) for p in paths if p is not None]))
        assert len(found[-1]) == 40
    assert_same_distribution(found)


@pytest.mark.parametrize("corners", ["strict", "no-squeeze", "allow"])
@pytest.mark.parametrize("name", ["dijkstra", "any-angle"])
def test_exact_searches_find_the_same_length_from_every_side(name, corners):
    lengths = [pl.plan(view.problem, name).length for view in views(corners)]
    assert lengths == pytest.approx([lengths[0]] * len(lengths), rel=1e-12)


def lengths_from_every_side(repair, name, corners):
    """Lengths (8, n) of the repaired paths: of equally good cells the first in reading order may be taken."""
    occupied = pl.load_map(name, corners=corners).occupied
    ends = (len(occupied) - 1, 0), (0, len(occupied) - 1)
    sides = [View(occupied, *ends, corners, symmetry) for symmetry in SYMMETRIES]
    first = first_population(sides[0].problem, 40)
    repaired = [repair.apply(side.there(first), side.problem, np.random.default_rng(0)) for side in sides]
    return np.array([pl.compiled.measures.lengths(p, len(occupied)) for p in repaired])


@pytest.mark.parametrize(
    ("name", "ties"), [("loom/band-search", 0.0), ("loom/gene-pool", 0.0), ("loom/string-pulling", 0.01)]
)
def test_what_loom_learns_is_as_short_from_every_side(name, ties):
    """Of cells that are equally good string pulling takes the first, which decides of its next step in rare cases."""
    repair, other, all_ = build(pl.Repair, name, default_registry(), ""), 0, 0
    for map_ in ("random-20:20%:s1", "random-20:30%:s2", "random-30:10%:s3", "rooms-25:5", "empty-15"):
        for corners in ("strict", "no-squeeze", "allow"):
            lengths = lengths_from_every_side(repair, map_, corners)
            other += int((np.abs(lengths - lengths[0]) > 1e-9).sum())
            all_ += lengths.size
    assert other <= ties * all_
