"""Calls: how the loop uses a component of each kind, on the small problems."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice
from typing import Any

import numpy as np

from pathloom.errors import ConfigError
from pathloom.exact import octile_path
from pathloom.kernel.archive import Archive
from pathloom.kernel.component import Component, parameters
from pathloom.kernel.compose import build, compose
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.evaluation import Fitness, Objective, Term, Terms, Weighting
from pathloom.kernel.evolution import Control, Evolution
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
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry
from pathloom.kernel.representation import Population
from pathloom.kernel.run import iterate, run
from pathloom.kernel.state import Deme
from pathloom.kernel.termination import MaxGenerations, Termination
from pathloom.paths.ants.colony import Colony
from pathloom.paths.ants.pheromone import Deadlock, Heuristic, InitialPheromone, PheromoneUpdate
from pathloom.paths.collision import Collision
from pathloom.paths.curves import Smoother
from pathloom.paths.maps import Map
from pathloom.paths.objectives import Length, Turns, UnsafeCells
from pathloom.paths.vectors.decoding import Decoder
from pathloom.testing.problems import POLICIES, Place, first_population, places

Rng = np.random.Generator
GENERATIONS = 4
"""How long a planner runs that is tried."""
PAIRS = np.arange(8).reshape(-1, 2)
CHOSEN = np.array([0, 3, 5])


@dataclass(frozen=True)
class Call:
    """One use of a component, as a planner makes it."""

    what: str
    """In words."""
    inputs: Callable[[], tuple[Any, ...]]
    """Makes what is handed in, each time anew."""
    use: Callable[..., Any]
    """Called with the component, the inputs and a generator."""
    place: Place | None = None
    """Where, if it makes a difference."""


def calls_of(component: Component) -> list[Call]:
    """Return how the loop calls a component; nothing where its kind or its representation is not known here."""
    if not on_cells(component):
        return []
    for kind, calls in _CALLS.items():
        if isinstance(component, kind):
            return list(calls(component))
    return []


def called(component: Component) -> bool:
    """Say whether it is known here how the component is called."""
    return bool(calls_of(component))


def on_cells(component: Component) -> bool:
    """Say whether a component works on paths of cells."""
    return component.works_on in ("", "cells")


def short(planner: Planner, **slots: Any) -> Planner:
    """Return a planner with few individuals and generations."""
    few = {p.name: 12 for p in parameters(type(planner)) if p.name in ("population", "ants")}
    changes: dict[str, Any] = {**few, "termination": (MaxGenerations(limit=GENERATIONS),), **slots}
    return compose(planner, **changes)


def generic_planner(**slots: Any) -> Planner:
    """Return the generic evolutionary planner, with parts of the core in its slots."""
    parts = {"sampling": "perturbed-trees", "crossover": "shared-node", "mutation": "reroute"}
    table = {"use": "evolution", "objectives": ["length"], **parts}
    return short(build(Planner, table, default_registry(), ""), **slots)


Calls = Callable[[Any], Iterator[Call]]
"""Makes the calls of a component."""


def _on_maps(inputs: Callable[[Place], tuple[Any, ...]], use: Callable[..., Any], *, few: bool = False) -> Calls:
    """Return the calls with what is handed in on each place, or on the first map alone under each policy."""

    def calls(component: Component) -> Iterator[Call]:
        for place in islice(places(), len(POLICIES) if few else None):
            yield Call(f"on {place}", partial(inputs, place), use, place)

    return calls


def _of_runs(planner: Callable[[Any], Planner], use: Callable[..., Any], states: int) -> Calls:
    """Return the calls with the first states of a planner's run, which may depend on the component."""

    def calls(component: Component) -> Iterator[Call]:
        yield from _on_maps(partial(_states, planner(component), states), use, few=True)(component)

    return calls


def _watched(component: Observer, *given: Any) -> list[None]:
    """Return what an observer says to each state of a run that it watches from beginning to end."""
    states = given[:-1]
    with component.watch(states[0].problem, _generic(component)) as tell:
        return [tell(state) for state in states]


def _population(*more: Any) -> Callable[[Place], tuple[Any, ...]]:
    """Return what gives a population, then whatever else is handed in, and the problem."""

    def inputs(place: Place) -> tuple[Any, ...]:
        problem = place.problem()
        return first_population(problem), *(np.copy(m) for m in more), problem

    return inputs


def _demes(place: Place, n: int = 2) -> tuple[Any, ...]:
    """Return so many evaluated populations of 12, and the problem."""
    problem, planner = place.problem(), generic_planner()
    assert isinstance(planner, Evolution)
    return *(planner.evaluate(first_population(problem, seed=k), problem) for k in range(n)), problem


def _states(planner: Planner, n: int, place: Place) -> tuple[Any, ...]:
    """Return the first states of a run, the time of each a second later than that of the one before."""
    states = islice(iterate(place.problem(), planner, 1), n)
    return tuple(replace(state, seconds=float(k)) for k, state in enumerate(states))


def _segments(place: Place) -> tuple[Any, ...]:
    """Return both ends (200, 2) of segments between free cells, and the problem."""
    problem, rng = place.problem(), np.random.default_rng(1)
    free = np.argwhere(~problem.context.occupied)
    return *(free[rng.integers(len(free), size=200)] for _ in range(2)), problem


def _octile(place: Place) -> tuple[Any, ...]:
    problem = place.problem()
    return octile_path(problem)[1], problem


def _colony(place: Place) -> tuple[Any, ...]:
    return Colony(ants=12), place.problem(), _demes(place, 1)[0]


def _random_fitness(n: int) -> tuple[Any, ...]:
    return (np.random.default_rng(n).random(n),)


def _fitness(use: Callable[..., Any]) -> Calls:
    """Return the calls with fitness of several sizes, and of equals."""

    def calls(component: Component) -> Iterator[Call]:
        for n in (1, 2, 3, 5, 12, 99, 100):
            yield Call(f"of {n} individuals", partial(_random_fitness, n), use)
        yield Call("of 10 equally fit individuals", lambda: (np.ones(10),), use)

    return calls


def _random_values(m: int) -> tuple[Any, ...]:
    return np.random.default_rng(m).uniform(1.0, 9.0, (12, m)), np.linspace(1.0, 2.0, m)


def _combined(component: Component) -> Iterator[Call]:
    for m in (1, 2, 3):
        inputs = partial(_random_values, m)
        yield Call(f"of {m} objectives", inputs, lambda c, values, weights, rng: c.combine(values, weights))


def _weighed(component: Any) -> Iterator[Call]:
    every = [Term("length", Length()), Term("unsafe-cells", UnsafeCells()), Term("turns", Turns())]
    for m in (1, 2, 3):
        terms = Terms(every[:m])
        try:
            component.check(terms)
        except ConfigError:
            continue  # it says that it is not for so many

        def inputs(place: Place, terms: Terms = terms) -> tuple[Any, ...]:
            return terms, place.problem()

        yield from _on_maps(inputs, lambda c, terms, problem, rng: c.weights(terms, problem), few=True)(component)


def _map(component: Component) -> Iterator[Call]:
    for corners in POLICIES:
        yield Call(f"under {corners!r}", partial(tuple, [corners]), lambda c, corners, rng: c.grid(corners))


def _controlled(component: Any) -> Iterator[Call]:
    planner = generic_planner(control=component)

    def inputs(place: Place) -> tuple[Any, ...]:
        return planner, *_states(planner, 2, place)

    def advance(c: Control, planner: Evolution, first: Any, second: Any, rng: Rng) -> Any:
        return [c.advance(planner, state, 0, rng) for state in (first, second)]

    yield from _on_maps(inputs, advance, few=True)(component)


def _planned(component: Any) -> Iterator[Call]:
    planner = short(component)

    def answer(c: Planner, problem: Any, seed: int, rng: Rng) -> Any:
        finished = run(problem, planner, seed)
        return finished.outcome.solution, finished.state.history if finished.state else None

    yield from _on_maps(lambda place: (place.problem(), 11), answer, few=True)(component)


def _kept(c: Archive, deme: Deme, later: Deme, problem: Any, rng: Rng) -> Any:
    first = c.update(None, deme, np.arange(len(deme)), 0, problem, None, rng)
    return first, c.update(first, later, np.arange(len(later)), 1, problem, None, rng)


def _exchanged(c: Migration, first: Any, second: Any, rng: Rng) -> Any:
    return [c.exchange(state.demes, state, rng) for state in (first, second)]


def _decoded(c: Decoder, problem: Any, seed: int, rng: Rng) -> Any:
    straight = c.straight(problem)
    genes = np.random.default_rng(seed).random((12, len(straight)))
    return straight, c.axes(problem), c.decode(genes, problem)


def _learned(c: Deadlock, state: Any, rng: Rng) -> Any:
    table, pheromone = c.learn(state, state.pheromone)
    return c.retreats, table, pheromone, c.closed(table)


def _cross(c: Crossover, parents: Population, pairs: Any, problem: Any, rng: Rng) -> Any:
    return c.cross(parents, pairs, problem, rng)


def _mutate(c: Mutation, parents: Population, rows: Any, problem: Any, rng: Rng) -> Any:
    return c.apply(parents, rows, problem, rng)


def _generic(component: Any) -> Planner:
    return generic_planner()


_CALLS: dict[type[Component], Calls] = {
    Sampling: _on_maps(lambda place: (place.problem(), 7), lambda c, problem, n, rng: c.sample(problem, n, rng)),
    Selection: _fitness(lambda c, fitness, rng: c.select(fitness, len(fitness), rng)),
    Pairing: _fitness(lambda c, fitness, rng: c.pair(fitness, rng)),
    Crossover: _on_maps(_population(PAIRS), _cross),
    Mutation: _on_maps(_population(CHOSEN), _mutate),
    Repair: _on_maps(_population(), lambda c, population, problem, rng: c.apply(population, problem, rng)),
    Objective: _on_maps(_population(), lambda c, population, problem, rng: c.measure(population, problem)),
    Constraint: _on_maps(_population(), lambda c, population, problem, rng: c.violation(population, problem)),
    Probability: _fitness(lambda c, fitness, rng: np.stack([c.rates(fitness, p) for p in (0.0, 0.5, 1.0)])),
    Survival: _on_maps(_demes, lambda c, parents, born, problem, rng: c.survive(parents, born, problem, rng), few=True),
    Archive: _on_maps(_demes, _kept, few=True),
    Migration: _of_runs(lambda component: generic_planner(migration=component), _exchanged, 2),
    Control: _controlled,
    Fitness: _combined,
    Weighting: _weighed,
    Collision: _on_maps(_segments, lambda c, a, b, problem, rng: c.segments_free(a, b, problem)),
    Termination: _of_runs(_generic, lambda c, *given: [(c.done(s), c.progress(s)) for s in given[:-1]], 3),
    Observer: _of_runs(_generic, _watched, 3),
    Map: _map,
    Smoother: _on_maps(_octile, lambda c, path, problem, rng: c.smooth(path, problem), few=True),
    Decoder: _on_maps(lambda place: (place.problem(), 1), _decoded),
    Heuristic: _on_maps(lambda place: (place.problem(),), lambda c, problem, rng: c.desirability(problem)),
    InitialPheromone: _on_maps(_colony, lambda c, colony, problem, known, rng: c.lay(colony, problem, known), few=True),
    PheromoneUpdate: _of_runs(
        lambda component: short(Colony(pheromone=component)),
        lambda c, first, second, rng: (c.update(first, 0.0), c.update(second, 0.5)), 2,
    ),
    Deadlock: _of_runs(lambda component: short(Colony(deadlock=component)), _learned, 1),
    Planner: _planned,
}  # fmt: skip
"""How each kind is used."""
