"""Running: a component works in the generic planner, in planners of other plugins, and with pymoo's selection."""

from collections.abc import Iterator
from functools import cache
from typing import Any

from pathloom.errors import ConfigError
from pathloom.exact import validate
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
from pathloom.kernel.registry import CORE, default_registry
from pathloom.kernel.run import run
from pathloom.kernel.termination import MaxGenerations, Termination
from pathloom.paths.ants.colony import Colony
from pathloom.paths.ants.pheromone import Deadlock, Heuristic, InitialPheromone, PheromoneUpdate
from pathloom.paths.collision import Collision
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.maps import load_map
from pathloom.paths.objectives import Length
from pathloom.paths.problem import PathProblem
from pathloom.paths.vectors.decoding import Decoder
from pathloom.planning import plan
from pathloom.testing.calls import GENERATIONS, generic_planner, on_cells, short
from pathloom.testing.check import Broken, Inapplicable, expect, promise

IN_THE_LOOP = (
    Sampling, Selection, Pairing, Crossover, Mutation, Repair, Probability, Survival, Migration, Control, Archive,
    Objective, Fitness, Weighting, Collision, Termination, Observer,
)  # fmt: skip
OF_COLONIES = (Heuristic, InitialPheromone, PheromoneUpdate, Deadlock)
WITH_PYMOO = (Sampling, Crossover, Mutation, Repair, Objective, Constraint, Termination, Observer)


@cache
def _problem() -> PathProblem:
    return PathProblem(load_map("random-12:20:s1", corners="allow"), corners="allow")


def _answers(planner: Planner, what: str) -> None:
    """Run a planner: its generations all happen, and its answer is valid."""
    problem = _problem()
    finished = run(problem, planner, 3)
    assert finished.state is not None
    reached, wanted = finished.state.generation, f"expected {GENERATIONS} generations and a valid answer {what}"
    over = any(condition.done(finished.state) for condition in planner.termination)
    expect(over and reached <= GENERATIONS, f"{wanted}; found {reached} generations")
    if finished.outcome.solution is None:
        raise Broken(f"{wanted}; found none: {finished.outcome.reason}")
    fault = validate(problem.representation.decode(finished.outcome.solution), problem)
    expect(fault is None, f"{wanted}; found one that {fault}")


def _with(planner: Planner, component: Component) -> Iterator[Planner]:
    """Yield a planner with the component in each place that it fits."""
    limit = MaxGenerations(limit=GENERATIONS)
    if isinstance(component, Objective):
        yield compose(planner, weighting="none", objectives=Terms([Term("length", Length()), Term("more", component)]))
    elif isinstance(component, Probability):
        for slot in ("crossover", "mutation"):
            if getattr(planner, slot, None) is not None:
                changes: dict[str, Any] = {slot: {"probability": component}}
                yield compose(planner, **changes)
    elif isinstance(component, Collision):
        yield compose(planner, refinement=PointDeletion(collision=component))
    elif isinstance(component, Termination):
        yield compose(planner, termination=(component, limit))
    else:
        for parameter in parameters(type(planner)):
            kind = parameter.slot or parameter.slots
            if kind is not None and isinstance(component, kind):
                changes = {parameter.name: (component,) if parameter.slots else component}
                yield compose(planner, **changes)


@promise("in-a-planner", *IN_THE_LOOP, *OF_COLONIES, Decoder, where=on_cells)
def in_a_planner(component: Component) -> None:
    """In its place in the generic planner, or the generic colony, it gives valid answers."""
    planner = generic_planner()
    if isinstance(component, OF_COLONIES):
        planner = short(Colony())
    elif isinstance(component, Decoder):
        planner = short(build(Planner, "pso", default_registry(), ""))
    try:
        for one in _with(planner, component):
            _answers(one, f"from {planner.name!r}")
    except ConfigError as refused:
        said = f"expected a message that names {component.name!r} where it is refused; found {refused}"
        expect(component.name in str(refused), said)


@promise("in-others-planners", *IN_THE_LOOP, where=on_cells)
def in_others_planners(component: Component) -> None:
    """It works in planners of other plugins, or is refused there with a message that names it."""
    ran, refusals = 0, []
    for planner in _planners_beside(type(component)):
        try:
            composed = list(_with(planner, component))
        except ConfigError as error:
            refusals.append(str(error))
            continue
        for one in composed:
            _answers(one, f"from {planner.name!r}")
            ran += 1
    unnamed = [refusal for refusal in refusals if component.name not in refusal]
    expect(not unnamed, f"expected messages that name {component.name!r}; found {unnamed}")
    expect(ran, f"expected one planner of another plugin that takes it; found all refuse it: {refusals}")


@promise("in-pymoo", *WITH_PYMOO, where=on_cells)
def in_pymoo(component: Component) -> None:
    """With NSGA-II of pymoo in the place of selection and survival it gives valid answers."""
    planner = short(build(Planner, "nsga2", default_registry(), ""))
    ran = False
    try:
        if isinstance(component, Objective):
            others = [t for t in planner.terms if t.objective != component][:2]
            planners: Any = [compose(planner, objectives=Terms([*others, Term("more", component)]))]
        else:
            planners = _with(planner, component)
        for one in planners:
            _answers_or_says_why(one, component)
            ran = True
    except ConfigError as refused:
        said = f"expected a message that names {component.name!r} where it is refused; found {refused}"
        expect(component.name in str(refused), said)
        raise Inapplicable(f"it is refused: {refused}") from refused
    expect(ran, "expected a place for it in 'nsga2'; found none")


def _answers_or_says_why(planner: Planner, component: Component) -> None:
    if isinstance(component, Constraint):  # nothing may keep to it
        result = plan(_problem(), planner, seed=3)
        expect(result.path is not None or result.reason, "expected a path or why there is none; found neither")
        return
    _answers(planner, "from 'nsga2'")


@cache
def _planners() -> dict[str, list[Planner]]:
    """Return the shortened evolutionary planners of our plugins that need nothing, by namespace."""
    found: dict[str, list[Planner]] = {}
    for entry in default_registry().all_entries(Evolution):
        if entry.source.ours and not any(p.required for p in parameters(entry.component)):
            found.setdefault(entry.source.namespace, []).append(short(entry.component()))  # type: ignore[arg-type]
    return found


def _planners_beside(component: type[Component]) -> list[Planner]:
    """Return one planner of every plugin of ours that the component does not come from."""
    home = default_registry().name_of(component).rpartition("/")[0] or CORE
    return [planners[-1] for namespace, planners in _planners().items() if namespace != home]


CHECKS = (in_a_planner, in_others_planners, in_pymoo)
