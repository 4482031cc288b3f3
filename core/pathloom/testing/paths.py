"""Paths: what operators make of cells leads from start to goal, over free segments, under every corner policy."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from pathloom.exact import validate
from pathloom.kernel.component import Component
from pathloom.kernel.operators import Crossover, Mutation, Repair, Sampling
from pathloom.kernel.planner import Planner
from pathloom.kernel.representation import Population
from pathloom.paths.problem import PathProblem
from pathloom.testing.calls import CHOSEN, PAIRS, on_cells
from pathloom.testing.check import Broken, expect, promise
from pathloom.testing.problems import between, paths_in, two_cells
from pathloom.testing.shapes import is_population
from pathloom.testing.trial import Trial, finished

VARIATION = (Crossover, Mutation, Repair)


def _made(component: Component) -> Iterator[tuple[Trial, PathProblem, Population]]:
    """Yield each trial with the population that the component made, as far as it is one."""
    for trial in finished(component):
        problem = trial.problem
        output = trial.output
        if isinstance(component, Planner):
            output = np.empty((0, 1), np.int32) if output[0] is None else output[0][np.newaxis]
        if is_population(output, None, problem.context.blocked.size):  # `shape` says if it is not
            yield trial, problem, output


def _has_ends(row: Any, problem: PathProblem) -> bool:
    ids = row[row >= 0]
    return len(ids) > 0 and ids[0] == problem.context.start and ids[-1] == problem.context.goal


@promise("ends", Sampling, *VARIATION, Planner, where=on_cells)
def ends(component: Component) -> None:
    """Every path leads from the problem's start to its goal."""
    for trial, problem, population in _made(component):
        for row in population:
            leads = f"expected a path from {problem.start} to {problem.goal} {trial.call.what}"
            expect(_has_ends(row, problem), f"{leads}; found {problem.representation.decode(row).tolist()}")


@promise("free", Sampling, *VARIATION, Planner, where=on_cells)
def free(component: Component) -> None:
    """Every segment of every path is free under the problem's corner policy: strict, no-squeeze and allow."""
    for trial, problem, population in _made(component):
        for row in {tuple(path): path for path in paths_in(population)}.values():
            cells = np.array(row, np.int64)
            if not _has_ends(cells, problem):
                continue  # `ends` says so
            path = problem.representation.decode(cells)
            fault = validate(path, problem)
            expect(fault is None, f"expected a free path {trial.call.what}; found one that {fault}: {path.tolist()}")


def _says_single_steps(component: Component) -> bool:
    if isinstance(component, Sampling):
        return on_cells(component) and "8-connected" in component.gives
    return on_cells(component) and "8-connected" not in component.breaks


@promise("single-steps", Sampling, *VARIATION, where=_says_single_steps)
def single_steps(component: Component) -> None:
    """Paths are 8-connected and visit no cell twice where it says so: with '8-connected' in `gives` of a sampling,
    or not in `breaks` of what varies.
    """
    for trial, problem, population in _made(component):
        for row in population:
            path = problem.representation.decode(row)
            steps = np.abs(np.diff(path, axis=0)).max(axis=1, initial=0)
            single = (steps == 1).all() and len(np.unique(path, axis=0)) == len(path)
            expect(single, f"expected single steps to different cells {trial.call.what}; found {path.tolist()}")


@promise("others-kept", Crossover, Mutation, where=on_cells)
def others_kept(component: Component) -> None:
    """Individuals that were not chosen, or in no pair, are as they were."""
    given = CHOSEN if isinstance(component, Mutation) else PAIRS
    for trial, _, population in _made(component):
        before, after = paths_in(trial.inputs[0]), paths_in(population)
        for k, (was, is_) in enumerate(zip(before, after, strict=False)):
            if k not in given:
                expect(was == is_, f"expected row {k} as it was, {was}, {trial.call.what}; found {is_}")


@promise("parent-kept", *VARIATION, where=on_cells)
def parent_kept(component: Any) -> None:
    """Where nothing else is possible the parent stays: a failure costs nobody his place."""
    problem = two_cells()
    parents = problem.representation.encode([np.array(problem.ends)] * 4)
    for seed in range(3):
        rng = np.random.default_rng(seed)
        if isinstance(component, Crossover):
            children = component.cross(parents.copy(), np.array([[0, 1], [2, 3]]), problem, rng)
        elif isinstance(component, Mutation):
            children = component.apply(parents.copy(), np.arange(4), problem, rng)
        else:
            children = component.apply(parents.copy(), problem, rng)
        found = paths_in(children)
        expect(found == paths_in(parents), f"expected {paths_in(parents)} on a map of two cells; found {found}")


@promise("smallest", Sampling, where=on_cells)
def smallest(component: Any) -> None:
    """Start and goal may be one cell, or neighbours."""
    for goal in ((4, 0), (4, 1), (3, 1)):
        problem = between((4, 0), goal)
        try:
            population = component.sample(problem, 3, np.random.default_rng(0))
        except Exception as error:
            raise Broken(f"expected 3 paths from (4, 0) to {goal}; found {type(error).__name__}: {error}") from error
        expect(len(population) == 3, f"expected 3 paths from (4, 0) to {goal}; found {len(population)}")
        for row in population:
            path = problem.representation.decode(row)
            fault = validate(path, problem)
            expect(fault is None, f"expected paths from (4, 0) to {goal}; found one that {fault}: {path.tolist()}")


CHECKS = (ends, free, single_steps, others_kept, parent_kept, smallest)
