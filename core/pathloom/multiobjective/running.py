"""Planning a front: compose, run, verify, measure, choose, and place others beside it."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import version
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pathloom.compiled.jit import seconds_loading
from pathloom.fronts import Asked, Choice, ParetoResult, Rival, Verified, indicators, knee, place, preferred, verified
from pathloom.fronts import pseudo_weights as pseudo_weights_of
from pathloom.fronts.against import shortcut
from pathloom.kernel.constraint import Constraint
from pathloom.kernel.evaluation import Floats, Terms
from pathloom.kernel.front import Front, FrontPlanner
from pathloom.kernel.planner import Planner
from pathloom.kernel.run import check_interrupt
from pathloom.kernel.state import State
from pathloom.multiobjective.composing import Objectives, front_planner
from pathloom.paths.constraints import Bound
from pathloom.paths.problem import PathProblem
from pathloom.planning import asked_for, check_limits, effort_of, interruptible, no_way, plan, searched

DEFAULT_PLANNER = "pymoo/nsga2"


def pareto(
    problem: PathProblem,
    planner: str | Mapping[str, Any] | Planner = DEFAULT_PLANNER,
    *,
    objectives: Objectives | None = None,
    constraints: Sequence[Any] = (),
    seed: int = 0,
    time_limit: float | None = None,
    exact: bool = False,
    against: Sequence[str | Mapping[str, Any] | Planner] = (),
    runs: int = 1,
    prefer: Any = None,
    reference: ArrayLike | None = None,
    map_name: str = "",
    watch: Callable[[State], None] | None = None,
) -> ParetoResult:
    """Plan a front: paths none of which is better than another in every objective.

    Parameters
    ----------
    problem
        Map, start, goal, radius and corner policy.
    planner
        A multi-objective planner: its name, a table as in a config, or the planner.
    objectives
        Two to five: names of registered objectives, or a table by label as in a
        config. By default the planner's own.
    constraints
        What every path has to keep to, such as ``"clearance>=0.3"``.
    seed
        Integer, at least 0. The same seed gives the same front.
    time_limit
        Seconds after which the front found so far is the answer.
    exact
        Also compute the exact front, where the objectives are additive and the map
        is small enough, and measure the found one against it.
    against
        Planners of single paths whose results are placed beside the front.
    runs
        With how many seeds each of these runs, from ``seed`` on.
    prefer
        What matters: weights by objective, or a weighting (a component, its name or
        its table). By default the weights in ``objectives``, where they differ.
    reference
        Reference point (m,) of the hypervolume; by default it follows from the
        exact front, or without one from the front.
    map_name
        What the result calls the map; by default the name that the grid bears.
    watch
        Called with the state after every generation.

    Returns
    -------
    ParetoResult
        With status ``found``, ``unreachable`` (said before any search) or
        ``not-found``. Every path has passed the exact validator, and every value
        is measured on the path beside it.

    Raises
    ------
    ConfigError
        If the planner, an objective, a constraint or anything else asked for cannot be used.
    """
    seed = check_limits(seed, time_limit)
    composed = front_planner(planner, objectives, constraints)
    asked = Asked(
        exact=exact, against=tuple(against), runs=runs, prefer=prefer,
        reference=None if reference is None else tuple(np.asarray(reference, float).tolist()),
    )  # fmt: skip
    asked.check(composed.objectives)
    rivals = asked.rivals()
    facts = _asked_for(problem, composed, asked, seed, time_limit, map_name)
    if not problem.reachable:
        return ParetoResult(status="unreachable", reason=no_way(problem), **facts)

    finished, phases = searched(problem, composed, seed, time_limit, watch)
    facts["interrupted"] = finished.interrupted
    found, reason = _front_of(problem, composed, finished.state, finished.outcome.reason, facts)
    facts |= effort_of(finished, phases)
    facts["budget"]["counts"] = dict(sorted({**facts["budget"]["counts"], **found.counts}.items()))
    if len(found.values) == 0:
        return ParetoResult(status="not-found", reason=reason, **facts)

    spent: dict[str, float] = {}
    facts["budget"]["references"] = spent
    if exact:
        with interruptible(facts), _timed(spent, "exact"):
            facts["exact"], note = _exact_front(problem, composed)
            reason = "; ".join(filter(None, (reason, note)))
    facts |= _facts_of(found, problem, composed, asked, facts.get("exact"))
    if rivals:
        placed: list[Rival] = []
        with interruptible(facts), _timed(spent, "against"):
            straight = shortcut(found.paths, problem, composed.objectives)
            for result in _runs(problem, rivals, seed, runs, time_limit, facts["problem"]["map"]):
                placed.append(place(result, problem, composed.objectives, found.values, straight))  # noqa: PERF401 - kept if interrupted
        facts["against"] = tuple(placed)
    return ParetoResult(status="found", reason=reason, **facts)


def _asked_for(
    problem: PathProblem, planner: FrontPlanner, asked: Asked, seed: int, time_limit: float | None, map_name: str
) -> dict[str, Any]:
    """Return what a result says of what was asked for, and that there is no front yet."""
    facts = asked_for(problem, planner, seed, time_limit, map_name)
    none = np.empty((0, len(planner.objectives)))
    return {
        **facts,
        "objectives": planner.objectives.labels,
        "values": none,
        "pseudo_weights": none,
        "config": {**facts["config"], "front": asked.frozen()},
        "versions": {**facts["versions"], **{name: version(name) for name in ("moocore", "pymoo")}},
    }


def _front_of(
    problem: PathProblem, planner: FrontPlanner, state: State | None, reason: str, facts: dict[str, Any]
) -> tuple[Verified, str]:
    """Return what of the planner's front holds, and what is to be said of it."""
    front = Front(np.empty((0, 1), np.int32), np.empty((0, len(planner.objectives))))
    if state is not None:
        try:
            front = planner.front(state)
        except (KeyboardInterrupt, SystemError) as error:
            check_interrupt(error)
            facts["interrupted"] = True
    found = verified(front, problem, planner.objectives, constraints_of(planner))
    if found.faults:
        dropped = found.counts["invalid paths dropped"]
        return found, f"{dropped} of {len(front)} paths were dropped: the first one {found.faults[0]}"
    return found, "" if len(found.values) else reason or "the planner found no path"


def constraints_of(planner: FrontPlanner) -> tuple[Constraint, ...]:
    """Return the constraints of a planner that knows any."""
    return tuple(getattr(planner, "constraints", ()))


def _facts_of(
    found: Verified, problem: PathProblem, planner: FrontPlanner, asked: Asked, exact: Floats | None
) -> dict[str, Any]:
    """Return what a result says of a front that was found: members, indicators, choice."""
    values, labels = found.values, planner.objectives.labels
    weights = asked.weights(planner.objectives, problem)
    choice = Choice(knee(values))
    if weights is not None:
        shares = dict(zip(labels, (weights / weights.sum()).tolist(), strict=True))
        choice = Choice(choice.knee, preferred(values, weights), shares)
    facts: dict[str, Any] = {
        "values": values,
        "paths": found.paths,
        "pseudo_weights": pseudo_weights_of(values),
        "choice": choice,
        "indicators": indicators(values, exact, asked.reference),
    }
    if problem.grid.origin is not None:
        facts["world"] = tuple(problem.grid.world(path) for path in found.paths)
    return facts


def _exact_front(problem: PathProblem, planner: FrontPlanner) -> tuple[Floats | None, str]:
    """Return the values of the exact front, measured on its paths, or why there are none."""
    constraints = constraints_of(planner)
    if not all(_keeps_what_dominates(constraint, planner.objectives) for constraint in constraints):
        return None, "no exact front: only upper limits of the objectives themselves can be heeded"
    from pathloom.exact.front import exact_front

    front = exact_front(problem, planner.objectives)
    if front is None:
        return None, "no exact front: an objective is not additive, or the map is too large"
    return verified(front, problem, planner.objectives, constraints).values, ""


def _keeps_what_dominates(constraint: Constraint, objectives: Terms) -> bool:
    """Say whether whatever dominates a path that keeps to a constraint keeps to it as well.

    Then the front under the constraint is the part of the whole front that keeps to it.
    """
    if not isinstance(constraint, Bound) or constraint.objective not in objectives.objectives():
        return False
    return (constraint.at_most if constraint.objective.negated else constraint.at_least) is None


def _runs(
    problem: PathProblem, rivals: list[Planner], seed: int, runs: int, time_limit: float | None, name: str
) -> Iterator[Any]:
    """Yield the results of other planners, with one seed after the other."""
    for rival in rivals:
        for number in range(runs):
            yield plan(problem, rival, seed=seed + number, time_limit=time_limit, map_name=name)


@contextmanager
def _timed(spent: dict[str, float], what: str) -> Iterator[None]:
    """Note how long something took, without the loading of kernels."""
    began, loaded = time.perf_counter(), seconds_loading()
    try:
        yield
    finally:
        spent[what] = time.perf_counter() - began - (seconds_loading() - loaded)
