"""Symmetry: no component knows where north is.

Map, start, goal and population are turned and mirrored, the component is applied, and the result is turned back.
What is deterministic must come out the same, bit for bit (sums to the last digits); what is random must have the same
distribution.
"""

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import ks_2samp

from pathloom.errors import ConfigError
from pathloom.kernel.component import Component, parameters
from pathloom.kernel.compose import build
from pathloom.kernel.evaluation import Objective
from pathloom.kernel.evolution import Evolution
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.operators import Crossover, Mutation, Repair, Sampling
from pathloom.kernel.registry import default_registry
from pathloom.kernel.representation import Population
from pathloom.kernel.run import run
from pathloom.paths.collision import Collision
from pathloom.paths.problem import PathProblem
from pathloom.testing.calls import on_cells, short
from pathloom.testing.check import Broken, expect, promise
from pathloom.testing.problems import POLICIES, first_population, paths_in, views

LEAST_P = 1e-4
"""Of some two thousand comparisons with fixed seeds none falls below it by chance alone."""
COLS = 12
SOME_SIDES = (0, 1, 4, 5)
"""As it was, turned by a quarter, mirrored, and both, where all eight would take long: the others are made of these."""
SAME = "expected no favourite direction: the same distribution from every side"

Features = NDArray[np.float64]


@promise(
    "symmetric", Sampling, Crossover, Mutation, Repair, Objective, Collision, Evolution, FrontPlanner, where=on_cells
)
def symmetric(component: Any) -> None:
    """Turned or mirrored problems have turned or mirrored answers: the same ones where chance has no part, else
    equally likely ones.
    """
    component = in_integers(component)
    if isinstance(component, Sampling):
        alike(_sampled(component))
    elif isinstance(component, Crossover):
        pairs = np.arange(300).reshape(-1, 2)
        alike(_varied(lambda parents, problem, rng: component.cross(parents, pairs, problem, rng)))
    elif isinstance(component, Mutation):
        alike(_varied(lambda parents, problem, rng: _mutated(component, parents, problem, rng)))
    elif isinstance(component, Repair):
        _repaired(component)
    elif isinstance(component, Objective):
        _measured(component)
    elif isinstance(component, Collision):
        _tested(component)
    else:
        alike(_planned(component))


def in_integers(component: Any) -> Any:
    """Return the component with integers for floating steps along a segment, where it has the choice.

    A falling diagonal is sampled from one of its two ends, and the sums of steps depend on which.
    """
    parts = {p.name: getattr(component, p.name) for p in parameters(type(component))}
    changes = {name: in_integers(part) for name, part in parts.items() if isinstance(part, Component)}
    changes |= {p.name: tuple(map(in_integers, parts[p.name])) for p in parameters(type(component)) if p.slots}
    if getattr(component, "arithmetic", "exact") == "floating":
        changes["arithmetic"] = "exact"
    return dataclasses.replace(component, **changes) if changes else component


def features(population: Population, cols: int = COLS) -> Features:
    """Return length, mean row and mean column of each path (n, 3): what would betray a direction."""
    inside = population >= 0
    counts = inside.sum(axis=1)
    rows, columns = (np.where(inside, part, 0) for part in (population // cols, population % cols))
    steps = np.where(inside[:, 1:], np.hypot(np.diff(rows, axis=1), np.diff(columns, axis=1)), 0.0)
    return np.stack((steps.sum(axis=1), rows.sum(axis=1) / counts, columns.sum(axis=1) / counts), axis=1).round(9)


def alike(samples: list[Features]) -> None:
    """Raise unless the features of all sides have one distribution."""
    for side, sample in enumerate(samples[1:], 1):
        for name, ours, theirs in zip(("length", "mean row", "mean column"), samples[0].T, sample.T, strict=True):
            p = ks_2samp(ours, theirs, method="asymp").pvalue
            if p <= LEAST_P:
                means = f"{ours.mean():.3f} on average, and {theirs.mean():.3f} from side {side}"
                raise Broken(f"{SAME}; found a {name} of {means} (p = {p:.1g})")


def _sampled(component: Sampling) -> list[Features]:
    found = []
    for seed, view in enumerate(views()):
        rng = np.random.default_rng(seed)
        drawn = [component.sample(view.problem, 1, rng) for _ in range(300)]  # of one call they may have much in common
        found.append(np.concatenate([features(view.back(population)) for population in drawn]))
        expect(len(found[-1]) > 200, f"expected more than 200 samples in 300 tries; found {len(found[-1])}")
    return found


def _varied(vary: Any) -> list[Features]:
    found, first = [], first_population(views()[0].problem, 300)
    for seed, view in enumerate(views()):
        rng = np.random.default_rng(seed)
        children = [vary(view.there(first), view.problem, rng) for _ in range(2)]
        found.append(np.concatenate([features(view.back(c)) for c in children]))
    return found


def _mutated(component: Mutation, parents: Population, problem: PathProblem, rng: np.random.Generator) -> Population:
    """Return mutants, one a call: of one call they may have much in common."""
    one = np.array([0])
    mutants = [component.apply(parents[k : k + 1], one, problem, rng) for k in range(len(parents))]
    return problem.representation.encode([problem.representation.decode(mutant[0]) for mutant in mutants])


def _planned(planner: Any) -> list[Features]:
    try:
        planner = short(planner, population=15)
    except ConfigError:
        planner = short(planner)
    found = []
    for turn in SOME_SIDES:
        view = views()[turn]
        paths = [run(view.problem, planner, 100 * turn + seed).outcome.solution for seed in range(40)]
        rows = [features(view.back(path[np.newaxis])) for path in paths if path is not None]
        expect(len(rows) == 40, f"expected 40 answers in 40 runs; found {len(rows)} from side {turn}")
        found.append(np.concatenate(rows))
    return found


def _repaired(component: Repair) -> None:
    for corners in POLICIES:
        sides = views(corners)
        first = first_population(sides[0].problem, 100)
        results = [
            view.back(component.apply(view.there(first), view.problem, np.random.default_rng(seed)))
            for seed, view in enumerate(sides)
        ]
        again = component.apply(sides[0].there(first), sides[0].problem, np.random.default_rng(8))
        paths = paths_in(results[0])
        if paths_in(again) != paths:  # it draws something
            alike([features(population) for population in results])
            continue
        for side, result in enumerate(results):
            for one, other in zip(paths, paths_in(result), strict=True):
                expect(one == other, f"expected {one} from all sides under {corners!r}; found {other} from side {side}")


def _measured(component: Objective) -> None:
    sides = views()
    first = first_population(sides[0].problem, 60)
    deletion = build(Repair, "point-deletion", default_registry(), "")
    deleted = deletion.apply(first, sides[0].problem, np.random.default_rng(0))
    for population in (first, deleted):
        values = [np.asarray(component.measure(view.there(population), view.problem), np.float64) for view in sides]
        for side, other in enumerate(values):
            same = np.allclose(other, values[0], rtol=1e-12, atol=1e-12)
            expect(same, f"expected {values[0].tolist()} from all sides; found {other.tolist()} from side {side}")


def _tested(component: Collision) -> None:
    for corners in POLICIES:
        sides = views(corners)
        cells = np.argwhere(~sides[0].problem.context.occupied)
        rng = np.random.default_rng(1)
        a, b = (cells[rng.integers(len(cells), size=600)] for _ in range(2))
        results = []
        for view in sides:
            cols = view.problem.context.cols
            first, second = (np.stack(divmod(view.new[c[:, 0] * COLS + c[:, 1]], cols), axis=1) for c in (a, b))
            results.append(component.segments_free(first, second, view.problem))
            wrong = np.flatnonzero(results[-1] != results[0])
            at = f"from {a[wrong[:1]].tolist()} to {b[wrong[:1]].tolist()}"
            expect(len(wrong) == 0, f"expected the same from all sides under {corners!r}; found another answer {at}")


CHECKS = (symmetric,)
