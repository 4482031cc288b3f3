"""Worker: what happens in another process, for one order at a time.

Orders and replies are small. What many orders share, planners and problems, a
worker keeps; when it is asked for one that it has not, it says so and the
driver sends it along.
"""

import ctypes
import math
import os
import pickle
import platform
import signal
import threading
import zlib
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from multiprocessing import connection, parent_process
from typing import Any, Literal, NamedTuple

import numpy as np

from pathloom.exact import any_angle_search, exact_front, octile_path, validate
from pathloom.files import one_line
from pathloom.fronts import verified
from pathloom.grid import OccupancyGrid
from pathloom.kernel.compose import freeze
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.planner import Planner
from pathloom.kernel.plugins import installed
from pathloom.kernel.state import State
from pathloom.kernel.termination import MaxGenerations, WallTime
from pathloom.paths.metrics import metrics
from pathloom.paths.problem import PathProblem
from pathloom.planning import plan
from pathloom.result import versions
from pathloom.study.budget import unhurried
from pathloom.study.store import References, packed

MOST_CELLS = 1 << 22
"""Cells of the problems that a worker keeps, beyond the last one."""
SPARSER = 1.02
"""Of the answers, those are measured between which the evaluations have grown by this factor."""
LONGEST = 500
"""Signs of an error's message that are kept."""

Job = Literal["run", "references", "spending"]


class Order(NamedTuple):
    """What one worker is to do."""

    job: Job
    variant: str
    """Under which the worker keeps the planner."""
    instance: str
    """Under which the worker keeps the problem."""
    seed: int = 0
    time_limit: float | None = None
    parts: Mapping[str, bytes] = {}
    """Planners and problems, for a worker that does not know them."""
    patience: float | None = None
    """Seconds after which the worker itself ends the order; where nobody else can."""


@dataclass(frozen=True)
class Reply:
    """What came of an order."""

    missing: tuple[str, ...] = ()
    """What the worker has to be told first; nothing was done."""
    measures: Mapping[str, Any] = field(default_factory=dict)
    history: bytes | None = None
    path: bytes | None = None
    front: bytes | None = None
    references: References | None = None


class Overtime(BaseException):
    """Raised in a run that does not stop by itself; no planner's ``except Exception`` catches it."""


_parts: "OrderedDict[str, Any]" = OrderedDict()
_warm: set[str] = set()


def part(value: Planner | PathProblem) -> bytes:
    """Return a planner or a problem as it is sent to workers."""
    return zlib.compress(pickle.dumps(value), 1)


def prepare(memory: int | None) -> None:
    """Make a process a worker: deaf to Ctrl-C, which the driver hears; bounded in memory; gone when the driver is."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if memory is not None:
        with suppress(ImportError, OSError, ValueError):
            import resource

            resource.setrlimit(resource.RLIMIT_AS, (memory, resource.getrlimit(resource.RLIMIT_AS)[1]))
    threading.Thread(target=_leave_with_parent, daemon=True).start()


def _leave_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os._exit(1)


def hello() -> tuple[int, dict[str, Any]]:
    """Return this process and its versions."""
    return os.getpid(), environment()


def environment(configs: Iterable[Any] | None = None) -> dict[str, Any]:
    """Return on what a result may depend, and the machine that the times are of.

    Plugins are those that configs name; without any, all that are not ours.
    """
    plugins = {s.namespace: f"{s.distribution} {s.version}" for s in installed() if not s.ours}
    if configs is not None:
        named = {name for config in configs for name in _namespaces(config)}
        plugins = {name: version for name, version in plugins.items() if name in named}
    return {
        **versions(), "plugins": plugins,
        "platform": f"{platform.system()} {platform.machine()}", "cores": os.cpu_count() or 1,
    }  # fmt: skip


def _namespaces(config: Any) -> Iterator[str]:
    """Yield the plugins that a config names."""
    if isinstance(config, Mapping):
        if isinstance(use := config.get("use"), str):
            yield use.partition("/")[0]
        config = list(config.values())
    if isinstance(config, list):
        for inner in config:
            yield from _namespaces(inner)


def perform(order: Order) -> Reply:
    """Do what is ordered; whatever goes wrong in a planner is part of the reply."""
    _keep(order.parts)
    missing = tuple(key for key in (order.variant, order.instance) if key and key not in _parts)
    if missing:
        return Reply(missing=missing)
    planner: Any = _parts.get(order.variant)
    problem: Any = _parts.get(order.instance)
    try:
        with _ended(order.patience):
            if isinstance(planner, Exception):
                raise planner
            if order.job == "references":
                return Reply(references=references(problem, planner))
            if order.job == "spending":
                return Reply(measures=spending(problem, planner))
            return performed(problem, planner, order.seed, order.time_limit)
    except Overtime:
        return Reply(measures={"status": "timeout", "error": "it did not stop when its time was over, and was ended"})
    except BaseException as error:  # also a planner that calls sys.exit
        return Reply(measures={"status": "failed", "error": _said(error)})


def _said(error: BaseException) -> str:
    text = one_line(f"{type(error).__name__}: {error}".strip().removesuffix(":"))
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"


def _keep(parts: Mapping[str, bytes]) -> None:
    for key, blob in parts.items():
        try:
            _parts[key] = pickle.loads(zlib.decompress(blob))  # noqa: S301 - from our own driver
        except Exception as error:
            cause = _said(error)
            _parts[key] = ImportError(
                f"the planner does not load in the worker ({cause}); is its plugin installed there?"
            )
        _parts.move_to_end(key)
    held = [key for key, value in _parts.items() if isinstance(value, PathProblem)]
    total = sum(_parts[key].grid.occupied.size for key in held)
    for key in held[:-1]:  # the oldest go first, the last one stays
        if total <= MOST_CELLS:
            break
        total -= _parts.pop(key).grid.occupied.size


@contextmanager
def _ended(patience: float | None) -> Iterator[None]:
    """Raise `Overtime` in the block after so many seconds, if it runs in Python then."""
    if patience is None:
        yield
        return
    thread = ctypes.c_ulong(threading.get_ident())
    timer = threading.Timer(patience, ctypes.pythonapi.PyThreadState_SetAsyncExc, (thread, ctypes.py_object(Overtime)))
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


# One run.


def performed(problem: PathProblem, planner: Planner, seed: int, time_limit: float | None) -> Reply:
    """Run a planner, and return all that is kept of it."""
    if time_limit is not None or any(isinstance(t, WallTime) for t in planner.termination):
        _warm_up(planner)
    if isinstance(planner, FrontPlanner):
        return _front(problem, planner, seed, time_limit)
    answers = _Answers()
    result = plan(problem, planner, seed=seed, time_limit=time_limit, watch=answers.watch)
    found, history = result.metrics, result.history
    trajectory = answers.lengths(problem, planner)
    kept = None if answers.first is None and not history else packed({**history, **trajectory})
    names = ("length", "turns", "turn_angle", "min_clearance", "unsafe_nodes", "nodes")
    measures = {
        "status": result.status,
        **{name: found.get(name) for name in names},
        "fitness": _finite(result.fitness),
        "evaluations_to_first": answers.first,
        "error": one_line(result.reason) or None,
        "objectives": dict(result.objectives),
        "trajectory": trajectory,
        **_spent(result.budget),
    }
    return Reply(measures=measures, history=kept, path=None if result.path is None else packed(result.path.tolist()))


def _front(problem: PathProblem, planner: FrontPlanner, seed: int, time_limit: float | None) -> Reply:
    from pathloom.multiobjective import pareto

    answers = _Answers()
    result = pareto(problem, planner, seed=seed, time_limit=time_limit, watch=answers.watch)
    measures = {
        "status": result.status,
        "evaluations_to_first": answers.first,
        "error": one_line(result.reason) or None,
        **_spent(result.budget),
    }
    if not result.found:
        return Reply(measures=measures, history=packed(dict(result.history)))
    every = [metrics(path, problem) for path in result.paths]
    shortest = int(np.argmin([one["length"] for one in every]))
    names = ("length", "turns", "turn_angle", "min_clearance", "unsafe_nodes", "nodes")
    measures |= {name: every[shortest].get(name) for name in names}
    front = {"objectives": list(result.objectives), "values": result.values.tolist(),
             "paths": [path.tolist() for path in result.paths]}  # fmt: skip
    path = packed(result.paths[shortest].tolist())
    return Reply(measures=measures, history=packed(dict(result.history)), path=path, front=packed(front))


def _spent(budget: Mapping[str, Any]) -> dict[str, Any]:
    return {name: budget.get(name) for name in ("evaluations", "generations", "seconds", "phases", "counts")}


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None


class _Answers:
    """The states at which a planner's answer changed, to be measured when the run, and its clock, are over."""

    def __init__(self) -> None:
        self.first: int | None = None
        self.states: list[State] = []
        self._last: Any = None
        self._bucket = -1

    def watch(self, state: State) -> None:
        if state.answer is None or state.answer is self._last:
            return
        self._last = state.answer
        if self.first is None:
            self.first = state.evaluations
        bucket = int(math.log(max(state.evaluations, 1)) / math.log(SPARSER))
        if bucket == self._bucket and len(self.states) > 1:
            self.states[-1] = state
        else:
            self.states.append(state)
        self._bucket = bucket

    def lengths(self, problem: PathProblem, planner: Planner) -> dict[str, list[Any]]:
        """Return evaluations and length of the answers, as the planner would have given them, refined."""
        spent, lengths = [], []
        for state in self.states:
            row = planner.result(state).solution
            length: float | None = None
            if row is not None:
                path = problem.representation.decode(row)
                if validate(path, problem) is None:
                    length = float(np.hypot(*np.diff(path, axis=0).T).sum())
            spent.append(state.evaluations)
            lengths.append(length)
        return {"answer_evaluations": spent, "answer_lengths": lengths}


def _warm_up(planner: Planner) -> None:
    """Let a planner load its kernels before its time counts."""
    key = repr(freeze(planner))
    if key not in _warm:
        _warm.add(key)
        small = PathProblem(OccupancyGrid(np.zeros((6, 6), bool)))
        brief = replace(planner, termination=(MaxGenerations(limit=2), *planner.termination))
        with suppress(Exception):
            plan(small, brief, time_limit=10.0)


# What is known of an instance, and what a planner spends.


def references(problem: PathProblem, planner: Planner | None) -> References:
    """Return the exact optima of an instance, and the exact front of a planner's objectives where that is feasible."""
    if not problem.reachable:
        return References(reachable=False)
    known = any_angle_search(problem)
    front = None
    if isinstance(planner, FrontPlanner) and not getattr(planner, "constraints", ()):
        exact = exact_front(problem, planner.objectives)
        if exact is not None:
            front = packed(verified(exact, problem, planner.objectives).values.tolist())
    return References(
        reachable=True,
        grid=_finite(octile_path(problem)[0]),
        any_angle=_finite(known.length) if known.proven else None,
        any_angle_bound=_finite(known.bound),
        exact_front=front,
    )


def spending(problem: PathProblem, planner: Planner) -> dict[str, Any]:
    """Return how much a planner spends if nothing but its own limits stops it."""
    free = unhurried(planner)
    if isinstance(free, FrontPlanner):
        return dict(performed(problem, free, 0, None).measures)
    result = plan(problem, free, seed=0)
    return {"status": result.status, **_spent(result.budget)}
