"""One generation as the page draws it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom.exact import validate
from pathloom.fronts import knee
from pathloom.kernel.counting import counting
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.planner import Planner
from pathloom.kernel.state import Deme, Individual, State
from pathloom.paths.problem import PathProblem
from pathloom.studio.wire import Front, Generation, Ids, Number

MOST_PATHS = 150
"""Paths of a generation that are drawn; more would only cover each other."""
MOST_NODES = 40_000
"""Their nodes, altogether."""
MOST_TRADE_OFFS = 300


def frame_of(state: State, planner: Planner, problem: PathProblem, lane: int, run: int) -> Generation:
    """Return what is drawn of a state."""
    best = shown_best(state, problem)
    row = best.row if best is not None else np.empty(0, np.int32)
    record = state.history.records[-1] if state.history.records else None
    labels = planner.terms.labels
    values = best.values.tolist() if best is not None and len(best.values) == len(labels) else []
    return Generation(
        lane=lane,
        run=run,
        generation=state.generation,
        evaluations=state.evaluations,
        best=ids(row),
        length=length_of(row, problem),
        values=dict(zip(labels, values, strict=False)),
        fitness=record.best if record is not None else None,
        mean=record.mean if record is not None else None,
        diversity=record.diversity if record is not None else None,
        paths=paths_of(state),
        individuals=sum(map(len, state.demes)),
        rates=rates_of(state, planner),
        front=front_of(state, planner),
    )


def shown_best(state: State, problem: PathProblem) -> Individual | None:
    """Return the fittest individual so far; where its path is not free, what the planner would answer."""
    best = state.best
    if best is None or validate(problem.representation.decode(best.row), problem) is None:
        return best
    return state.answer or best


def ids(row: NDArray[Any]) -> Ids:
    """Return a row of the population without its padding."""
    found: list[int] = row[row >= 0].tolist()
    return found


def length_of(row: NDArray[Any], problem: PathProblem) -> Number:
    """Return the length of a path in cells."""
    if len(row) == 0:
        return None
    steps = np.diff(problem.representation.decode(row), axis=0)
    return float(np.hypot(*steps.T).sum())


def paths_of(state: State) -> list[Ids]:
    """Return distinct individuals of all populations, the fittest last."""
    found: list[Ids] = []
    for deme in state.demes:
        found += _paths_of(deme, state, max(1, MOST_PATHS // len(state.demes)))
    while sum(map(len, found)) > MOST_NODES and len(found) > 1:
        found = found[1::2]
    return found


def _paths_of(deme: Deme, state: State, most: int) -> list[Ids]:
    if len(deme) == 0:
        return []
    distinct = deme.distinct
    if distinct is None:
        distinct = state.problem.representation.distinct(deme.population)[0]
    order = distinct[np.argsort(deme.fitness[distinct], kind="stable")]
    if len(order) > most:
        order = order[np.linspace(0, len(order) - 1, most).round().astype(int)]
    return [path for row in deme.population[order] if len(path := ids(row)) > 1]


def rates_of(state: State, planner: Planner) -> dict[str, tuple[Number, Number, Number]]:
    """Return how likely crossover and mutation are applied to the individuals of the main population."""
    if not state.demes or len(state.demes[0]) == 0:
        return {}
    fitness, progress = state.fitness, planner.progress(state)
    found: dict[str, tuple[Number, Number, Number]] = {}
    for slot in ("crossover", "mutation"):
        operator = getattr(planner, slot, None)
        if operator is None or not hasattr(operator, "rates"):
            continue
        with counting():  # what is counted here belongs to no run
            rates = np.asarray(operator.rates(fitness, progress), float)
        found[slot] = (float(rates.min()), float(rates.mean()), float(rates.max()))
    return found


def front_of(state: State, planner: Planner) -> Front | None:
    """Return the trade-offs so far of a planner that looks for them."""
    if not isinstance(planner, FrontPlanner):
        return None
    front = planner.front(state)
    return trade_offs(front.values, [ids(row) for row in front.population])


def trade_offs(values: Floats, paths: list[Ids]) -> Front:
    """Return a front for the page, thinned evenly where it is very large."""
    if len(values) > MOST_TRADE_OFFS:
        kept = np.linspace(0, len(values) - 1, MOST_TRADE_OFFS).round().astype(int)
        values, paths = values[kept], [paths[i] for i in kept]
    return Front(values.tolist(), paths, knee(values) if len(values) else None)
