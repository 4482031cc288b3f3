"""Shapes: what a component returns has the shape, the type and the range that its kind promises."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from pathloom.grid import OccupancyGrid
from pathloom.kernel.archive import Archive
from pathloom.kernel.component import Component
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.evaluation import Fitness, Objective, Weighting
from pathloom.kernel.evolution import Control
from pathloom.kernel.observer import Observer
from pathloom.kernel.operators import (
    Crossover,
    Migration,
    Mutation,
    Pairing,
    Probability,
    Repair,
    Sampling,
    Selection,
    Survival,
)
from pathloom.kernel.state import Deme, Individual
from pathloom.kernel.termination import Termination
from pathloom.paths.ants.pheromone import Deadlock, Heuristic, InitialPheromone, PheromoneUpdate
from pathloom.paths.collision import Collision
from pathloom.paths.curves import Curve, Smoother
from pathloom.paths.maps import Map
from pathloom.paths.vectors.decoding import Decoder
from pathloom.testing.calls import called
from pathloom.testing.check import expect, promise
from pathloom.testing.trial import Trial, finished


def _looked_at(component: Component) -> bool:
    return called(component) and any(isinstance(component, kind) for kind in _LOOKS)


@promise("shape", where=_looked_at)
def shape(component: Component) -> None:
    """What it returns has the shape, the type and the range that its kind promises."""
    look = next(look for kind, look in _LOOKS.items() if isinstance(component, kind))
    for trial in finished(component):
        for kept, message in look(trial):
            expect(kept, f"expected {message} {trial.call.what}; found {_shown(trial.output)}")


def _shown(value: Any) -> str:
    return f"{value.dtype} {value.shape}:\n{value}" if isinstance(value, np.ndarray) else repr(value)


Look = Iterator[tuple[bool, str]]


def _array(value: Any, shape: tuple[int | None, ...], kinds: str) -> bool:
    """Say whether a value is an array of a shape, in which ``None`` is any number, and of a kind of numbers."""
    if not isinstance(value, np.ndarray) or value.ndim != len(shape) or value.dtype.kind not in kinds:
        return False
    return all(wanted in (None, is_) for wanted, is_ in zip(shape, value.shape, strict=True))


def is_population(value: Any, n: int | None, cells: int) -> bool:
    """Say whether a value is a population of n paths: int32, one row a path, ids of cells, then −1 to the end."""
    if not _array(value, (n, None), "i") or value.dtype != np.int32 or not value.flags.c_contiguous:
        return False
    inside = value >= 0
    ended = (np.diff(inside.astype(np.int8), axis=1) <= 0).all()
    return bool(ended and (value >= -1).all() and (value < cells).all())


POPULATION = "int32 (n, width), C-contiguous, with ids of cells and then only −1,"


def _sampled(trial: Trial) -> Look:
    cells, most = trial.problem.context.blocked.size, trial.inputs[1]
    yield is_population(trial.output, None, cells), f"{POPULATION}"
    yield len(trial.output) <= most, f"at most {most} rows"


def _varied(trial: Trial) -> Look:
    cells, n = trial.problem.context.blocked.size, len(trial.inputs[0])
    yield is_population(trial.output, n, cells), f"{POPULATION} with n = {n}"


def _selected(trial: Trial) -> Look:
    n = len(trial.inputs[0])
    yield _array(trial.output, (n,), "iu"), f"indices ({n},)"
    yield bool(((trial.output >= 0) & (trial.output < n)).all()), f"indices from 0 to {n - 1}"


def _paired(trial: Trial) -> Look:
    n, pairs = len(trial.inputs[0]), trial.output
    yield _array(pairs, (None, 2), "iu"), "pairs of indices (k, 2)"
    yield bool(((pairs >= 0) & (pairs < n)).all()), f"indices from 0 to {n - 1}"
    yield len(np.unique(pairs)) == pairs.size, "disjoint pairs"


def _rates(trial: Trial) -> Look:
    n = len(trial.inputs[0])
    yield _array(trial.output, (3, n), "f"), f"probabilities ({n},)"
    yield bool(((trial.output >= 0.0) & (trial.output <= 1.0)).all()), "probabilities in [0, 1]"


def _values(trial: Trial) -> Look:
    n = len(trial.inputs[0])
    yield _array(trial.output, (n,), "fiub"), f"numbers ({n},), one a row,"
    yield not np.isnan(trial.output).any(), "no NaN"


def _violations(trial: Trial) -> Look:
    yield from _values(trial)
    yield bool((trial.output >= 0.0).all()), "violations that are 0 or more"


def _weights(trial: Trial) -> Look:
    m = len(trial.inputs[0])
    yield _array(trial.output, (m,), "f"), f"weights ({m},)"
    yield bool((np.isfinite(trial.output) & (trial.output >= 0.0)).all()), "weights that are finite and 0 or more"


def _free(trial: Trial) -> Look:
    yield _array(trial.output, (len(trial.inputs[0]),), "b"), f"booleans ({len(trial.inputs[0])},)"


def _is_deme(deme: Any, n: int, cells: int, m: int) -> bool:
    return (
        isinstance(deme, Deme)
        and is_population(deme.population, n, cells)
        and _array(deme.values, (n, m), "f")
        and _array(deme.fitness, (n,), "f")
    )


def _deme_like(trial: Trial, deme: Any, like: Deme) -> tuple[bool, str]:
    n, m = len(like), like.values.shape[1]
    cells = trial.problem.context.blocked.size
    return _is_deme(deme, n, cells, m), f"a deme of {n} individuals with values ({n}, {m}) and fitness ({n},)"


def _survived(trial: Trial) -> Look:
    yield _deme_like(trial, trial.output, trial.inputs[0])


def _advanced(trial: Trial) -> Look:
    for deme, state in zip(trial.output, trial.inputs[1:], strict=True):
        yield _deme_like(trial, deme, state.demes[0])


def _exchanged(trial: Trial) -> Look:
    for demes, state in zip(trial.output, trial.inputs, strict=True):
        yield isinstance(demes, tuple) and len(demes) == len(state.demes), f"a tuple of {len(state.demes)} demes"
        for deme, before in zip(demes, state.demes, strict=True):
            yield _deme_like(trial, deme, before)


def _kept(trial: Trial) -> Look:
    for one in trial.output:
        yield isinstance(one, Individual), "an individual"


def _over(trial: Trial) -> Look:
    for done, progress in trial.output:
        yield isinstance(done, (bool, np.bool_)), "true or false"
        yield 0.0 <= progress <= 1.0, "progress in [0, 1]"


def _observed(trial: Trial) -> Look:
    yield all(one is None for one in trial.output), "nothing"


def _grid(trial: Trial) -> Look:
    yield isinstance(trial.output, OccupancyGrid), "a grid"
    yield bool((~trial.output.occupied).any()), "a free cell"


def _curve(trial: Trial) -> Look:
    yield isinstance(trial.output, Curve), "a curve"
    yield _array(trial.output.points, (None, 2), "f"), "points (m, 2)"
    yield bool((trial.output.points[[0, -1]] == trial.inputs[0][[0, -1]]).all()), "a curve from start to goal"


def _decoded(trial: Trial) -> Look:
    straight, axes, paths = trial.output
    cells = trial.problem.context.blocked.size
    yield _array(straight, (None,), "f"), "genes (d,) of the straight way"
    yield bool(((straight >= 0.0) & (straight <= 1.0)).all()), "genes in [0, 1]"
    yield _array(axes, (len(straight),), "iu") and bool(np.isin(axes, (0, 1)).all()), "axes (d,), each 0 or 1,"
    yield is_population(paths, 12, cells), f"{POPULATION} with n = 12"


def _desired(trial: Trial) -> Look:
    cells = trial.problem.context.blocked.size
    yield _array(trial.output, (cells, 8), "f"), f"numbers ({cells}, 8)"


def _laid(trial: Trial) -> Look:
    yield from _desired(trial)
    yield bool((trial.output > 0.0).all()), "pheromone above 0"


def _renewed(trial: Trial) -> Look:
    cells = trial.problem.context.blocked.size
    for pheromone in trial.output:
        yield _array(pheromone, (cells, 8), "f"), f"pheromone ({cells}, 8)"
        yield bool((pheromone >= 0.0).all()), "pheromone of 0 or more"


def _learned(trial: Trial) -> Look:
    retreats, table, pheromone, closed = trial.output
    cells = trial.problem.context.blocked.size
    yield isinstance(retreats, (bool, np.bool_)), "true or false"
    yield _array(table, (cells,), "i"), f"a table ({cells},) of integers"
    yield _array(pheromone, (cells, 8), "f"), f"pheromone ({cells}, 8)"
    yield _array(closed, (cells,), "u"), f"bytes ({cells},)"


_LOOKS: dict[type[Component], Callable[[Trial], Look]] = {
    Sampling: _sampled,
    Selection: _selected,
    Pairing: _paired,
    Crossover: _varied,
    Mutation: _varied,
    Repair: _varied,
    Probability: _rates,
    Survival: _survived,
    Migration: _exchanged,
    Control: _advanced,
    Archive: _kept,
    Objective: _values,
    Fitness: _values,
    Weighting: _weights,
    Constraint: _violations,
    Collision: _free,
    Termination: _over,
    Observer: _observed,
    Map: _grid,
    Smoother: _curve,
    Decoder: _decoded,
    Heuristic: _desired,
    InitialPheromone: _laid,
    PheromoneUpdate: _renewed,
    Deadlock: _learned,
}
"""How each kind's results are looked at."""

CHECKS = (shape,)
