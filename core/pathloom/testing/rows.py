"""Rows: padding means nothing, and an individual's values are its own."""

from typing import Any

import numpy as np

from pathloom.kernel.component import Component
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.evaluation import Objective
from pathloom.kernel.operators import Crossover, Mutation, Repair
from pathloom.testing.calls import on_cells
from pathloom.testing.check import expect, promise
from pathloom.testing.problems import paths_in
from pathloom.testing.shapes import is_population
from pathloom.testing.trial import SEED, Trial, finished

WIDER = ((0, 0), (0, 9))


def _again(component: Component, trial: Trial, population: Any) -> Any:
    """Return what a component makes of another population, all else the same."""
    _, *more = trial.call.inputs()
    return trial.call.use(component, population, *more, np.random.default_rng(SEED))


@promise("padding", Crossover, Mutation, Repair, Objective, Constraint, where=on_cells)
def padding(component: Component) -> None:
    """More padding changes nothing."""
    for trial in list(finished(component))[:6]:
        wider = np.pad(trial.call.inputs()[0], WIDER, constant_values=-1)
        found = _again(component, trial, wider)
        if not isinstance(component, (Objective, Constraint)):
            cells = trial.problem.context.blocked.size
            if not (is_population(found, None, cells) and is_population(trial.output, None, cells)):
                continue  # `shape` says so
            before, after = paths_in(trial.output), paths_in(found)
        else:
            before, after = np.asarray(trial.output).tolist(), np.asarray(found).tolist()
        expect(before == after, f"expected the same with more padding {trial.call.what}; found {after}, not {before}")


@promise("own-value", Objective, Constraint, where=on_cells)
def own_value(component: Component) -> None:
    """A path's value depends on that path alone, not on its place or on the others."""
    for trial in list(finished(component))[:6]:
        population = trial.call.inputs()[0]
        some = np.arange(len(population))[::-2]
        found = np.asarray(_again(component, trial, np.ascontiguousarray(population[some])), np.float64)
        wanted = np.asarray(trial.output, np.float64)[some]
        same = found.shape == wanted.shape and np.allclose(found, wanted, rtol=1e-12, atol=1e-12)
        expect(same, f"expected {wanted.tolist()} of some of the paths {trial.call.what}; found {found.tolist()}")


CHECKS = (padding, own_value)
