"""Planning: compose, run, verify, and put the result together."""

import math
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from pathloom.compiled.jit import seconds_loading
from pathloom.config import DEFAULT_PLANNER, frozen, lasting, smoother
from pathloom.errors import ConfigError, ProblemError
from pathloom.exact import any_angle_search, contacts, octile_path, validate
from pathloom.exact.curves import validate_curve
from pathloom.files import FilePath
from pathloom.kernel import compose as composition
from pathloom.kernel import storing
from pathloom.kernel.compose import compose, freeze, part
from pathloom.kernel.planner import Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import Run, check_interrupt, check_seed, run
from pathloom.kernel.run import iterate as iterate_planner
from pathloom.kernel.state import Record, State
from pathloom.paths.cell_paths import Path
from pathloom.paths.curves import Curve, Points, PolylinePlanner, Smoother
from pathloom.paths.metrics import metrics
from pathloom.paths.problem import PathProblem
from pathloom.result import Result, Status, describe_problem, versions

__all__ = ["compose", "freeze", "iterate", "load_state", "part", "plan"]


def plan(
    problem: PathProblem,
    planner: str | Mapping[str, Any] | Planner = DEFAULT_PLANNER,
    *,
    seed: int = 0,
    time_limit: float | None = None,
    optimum: bool = False,
    smooth: str | Mapping[str, Any] | Smoother | None = None,
    map_name: str = "",
    watch: Callable[[State], None] | None = None,
) -> Result:
    """Plan one path, and verify it.

    Parameters
    ----------
    problem
        Map, start, goal, radius and corner policy.
    planner
        A planner's name, a table as in a config, or a planner.
    seed
        Integer, at least 0. The same seed gives the same path, metrics and history.
    time_limit
        Seconds after which the best path so far is the answer. A planner that can
        always go on, as `loom`, uses them up, unless a termination was set.
    optimum
        Also compute the exact octile and any-angle optima, and the gaps to them.
    smooth
        What makes a curve of the path: a smoother's name, a table as in a config, or
        a smoother. By default what the planner has for it, if anything.
    map_name
        What the result calls the map; by default the name that the grid bears.
    watch
        Called with the state after every generation.

    Returns
    -------
    Result
        With status ``found``, ``unreachable`` (said before any search) or
        ``not-found``. A path that is returned has passed the exact validator, a
        curve the one for curves.

    Raises
    ------
    ConfigError
        If the planner, one of its parts, the smoother or the seed is not usable.
    """
    seed = check_limits(seed, time_limit)
    composed = lasting(composition.compose(planner), time_limit)
    wanted = smoother(smooth, "smooth")
    facts = asked_for(problem, composed, seed, time_limit, map_name, wanted)
    if not problem.reachable:
        return Result(status="unreachable", reason=no_way(problem), **facts)

    finished, phases = searched(problem, composed, seed, time_limit, watch)
    return concluded(problem, composed, finished, phases, facts, smooth=wanted, optimum=optimum)


def concluded(
    problem: PathProblem,
    planner: Planner,
    finished: Run,
    phases: dict[str, float],
    facts: dict[str, Any],
    *,
    smooth: Smoother | None = None,
    optimum: bool = False,
) -> Result:
    """Return the result of a finished run: its answer verified, measured, and held against the optimum.

    ``facts``: what was asked for, from `asked_for`.
    """
    state, outcome = finished.state, finished.outcome
    path, unrefined, reason = _verified(problem, outcome.solution, outcome.found, outcome.reason)
    facts["interrupted"] = finished.interrupted
    polyline, chosen = None, smooth
    if isinstance(planner, PolylinePlanner) and state is not None:
        polyline, chosen = planner.polyline(state), smooth or planner.smoothing
    if path is not None:
        facts |= _facts_of(path, polyline, problem, planner)
        if chosen is not None:
            with interruptible(facts):
                facts["curve"], fault, phases = _smoothed(
                    problem, chosen, path if polyline is None else polyline, phases
                )
                reason = reason or fault
    facts |= effort_of(finished, phases)
    if optimum:
        with interruptible(facts):
            facts["optimum"], facts["gap"] = _references(
                problem, facts["metrics"]["length"] if path is not None else None
            )
    status: Status = "found" if path is not None else "not-found"
    return Result(status=status, path=path, unrefined=unrefined, reason=reason, **facts)


def iterate(
    problem: Problem,
    planner: str | Mapping[str, Any] | Planner = DEFAULT_PLANNER,
    *,
    seed: int = 0,
    state: State | None = None,
) -> Iterator[State]:
    """Yield the state after the first population and after each generation, until the planner is done.

    With ``state``, such as `load_state` gives, begin with that one and go on from it.

    Raises
    ------
    ProblemError
        If the goal of a path problem cannot be reached.
    """
    composed = composition.compose(planner)
    check_seed(seed)
    if isinstance(problem, PathProblem) and not problem.reachable:
        raise ProblemError(f"the goal cannot be reached under the corner policy {problem.corners!r}")
    return iterate_planner(problem, composed, seed, state=state)


def load_state(file: FilePath, problem: Problem, planner: str | Mapping[str, Any] | Planner = DEFAULT_PLANNER) -> State:
    """Return a state that the observer ``snapshots`` saved, to go on from with `iterate`.

    Raises
    ------
    ConfigError
        If the file is damaged, or its run had another problem or another planner.
    MapError
        If there is no such file, or it cannot be read.
    """
    return storing.load_state(file, problem, composition.compose(planner))


def check_limits(seed: object, time_limit: float | None) -> int:
    """Return the seed, if it and the time limit can be used.

    Raises
    ------
    ConfigError
        Which of them cannot.
    """
    number = check_seed(seed)
    if time_limit is not None and not time_limit > 0:
        raise ConfigError(f"time limit: found {time_limit!r}, allowed seconds above 0")
    return number


def asked_for(
    problem: PathProblem, planner: Planner, seed: int, time_limit: float | None, map_name: str,
    smooth: Smoother | None = None,
) -> dict[str, Any]:  # fmt: skip
    """Return what a result says of what was asked for."""
    name = map_name or problem.grid.name or "unnamed"
    return {
        "planner": default_registry().name_of(type(planner)).rpartition("/")[2],
        "seed": seed,
        "problem": describe_problem(problem, name),
        "config": frozen(problem, name, planner, seed, time_limit, smooth),
        "versions": versions(),
        "path_problem": problem,
    }


def no_way(problem: PathProblem) -> str:
    (r0, c0), (r1, c1) = problem.ends
    return f"the goal {r1},{c1} cannot be reached from {r0},{c0} under the corner policy {problem.corners!r}"


@contextmanager
def interruptible(facts: dict[str, Any]) -> Iterator[None]:
    """Let Ctrl-C end what is done here and no more: the path is there already."""
    try:
        yield
    except (KeyboardInterrupt, SystemError) as error:
        check_interrupt(error)
        facts["interrupted"] = True


def searched(
    problem: PathProblem,
    planner: Planner,
    seed: int,
    time_limit: float | None,
    watch: Callable[[State], None] | None,
) -> tuple[Run, dict[str, float]]:
    """Run the planner; return what it found, and its phases with the loading of kernels as one of its own.

    Kernels are loaded, once even compiled, by whoever first needs them: that is no merit or fault of the planner.
    """
    loaded = seconds_loading()

    def clock() -> float:
        return time.perf_counter() - seconds_loading()

    finished = run(problem, planner, seed, time_limit=time_limit, watch=watch, clock=clock)
    return finished, {**finished.phases, "loading": seconds_loading() - loaded}


def _facts_of(path: Path, polyline: Points | None, problem: PathProblem, planner: Planner) -> dict[str, Any]:
    """Return what a result says of a verified path: metrics, objectives, fitness, and where it is in the world."""
    met = contacts(path, problem)
    found = {**metrics(path, problem), "touches": met.touches, "squeezes": met.squeezes}
    if polyline is not None:
        found["polyline_length"] = float(np.hypot(*np.diff(polyline, axis=0).T).sum())
        found["polyline_nodes"] = len(polyline)
    objectives, fitness = planner.fitness_of(problem.representation.encode([path])[0], problem)
    world = {} if problem.grid.origin is None else {"world": problem.grid.world(path)}
    return {"metrics": found, "objectives": objectives, "fitness": fitness, **world}


def effort_of(finished: Run, phases: Mapping[str, float]) -> dict[str, Any]:
    """Return what a run took, when it found its first answer and its last, and its history."""
    state = finished.state
    budget = {
        "generations": state.generation if state else 0,
        "evaluations": state.evaluations if state else 0,
        "seconds": sum(phases.values()) - phases["loading"],
        "seconds_to_first": finished.first,
        "seconds_to_best": finished.best,
        "phases": phases,
        "counts": dict(sorted(state.counts.items())) if state else {},
    }
    if state is None:
        return {"budget": budget}
    return {"budget": budget, "history": {name: list(getattr(state.history, name)) for name in Record._fields}}


def _verified(problem: PathProblem, solution: Any, found: Any, reason: str) -> tuple[Path | None, Path | None, str]:
    """Return the path and what it was before refinement, as far as the validator lets them pass.

    A refined path that does not pass gives way to the one it was made of: the
    deleted points are restored.
    """
    decode = problem.representation.decode
    unrefined = decode(found.row) if found is not None else None
    fault = validate(unrefined, problem) if unrefined is not None else None
    if fault is not None:
        unrefined = None
    if solution is None:
        return None, unrefined, reason
    path = decode(solution)
    why = validate(path, problem)
    if why is None:
        return path, unrefined, reason
    if unrefined is not None:
        return unrefined, unrefined, f"the refined path {why}; its points were restored"
    return None, None, f"the best path of the search {why}"


def _smoothed(
    problem: PathProblem, chosen: Smoother, way: Path | Points, phases: Mapping[str, float]
) -> tuple[Curve | None, str, dict[str, float]]:
    """Return the curve along a way, why there is none, and the phases with what it took."""
    began, loaded = time.perf_counter(), seconds_loading()
    curve = chosen.smooth(way, problem)
    fault = validate_curve(curve.points, problem)
    loading = seconds_loading() - loaded
    took = {"smoothing": time.perf_counter() - began - loading, "loading": phases["loading"] + loading}
    if fault is None:
        return curve, "", {**phases, **took}
    return None, f"the curve of {chosen.name!r} {fault}; it was dropped", {**phases, **took}


def _references(problem: PathProblem, length: float | None) -> tuple[dict[str, float | None], dict[str, float | None]]:
    """Return the optima, where they are known, with what no path is shorter than, and the gaps to them."""
    known = any_angle_search(problem)
    found = {
        "grid": octile_path(problem)[0],
        "any_angle": known.length if known.proven else math.inf,
        "any_angle_bound": known.bound,
    }
    optimum = {name: value if math.isfinite(value) else None for name, value in found.items()}
    return optimum, {name: gap_to(length, best) for name, best in optimum.items()}


def gap_to(length: float | None, best: float | None) -> float | None:
    """Return length / best − 1; 0 where both are 0, ``None`` where either is unknown."""
    if length is None or best is None:
        return None
    if best == 0.0:
        return 0.0 if length == 0.0 else None
    gap = length / best - 1.0
    return 0.0 if abs(gap) < 8 * np.finfo(np.float64).eps else gap
