"""Measuring: run everybody on the same problems, judge each path, and keep every number."""

import gc
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from pathloom import exact
from pathloom.bench.peer import Answer, Peer, Solve
from pathloom.bench.suite import Task, problem_on
from pathloom.exact.curves import validate_curve
from pathloom.paths.context import Corners
from pathloom.paths.problem import PathProblem

REPEATED = 1.0
"""Seconds after which who does not draw is not run again."""
MORE = 10
"""How many times our time an anytime planner gets besides."""


@dataclass(frozen=True)
class Reference:
    """What lengths are held against."""

    length: float
    exact: bool
    """Whether it is the optimum over the centres of cells, or a length that no path over them goes below."""
    plane: float
    """Length of the shortest way in the plane, which may turn anywhere: what no path at all goes below."""


@dataclass(frozen=True)
class Run:
    """One run of one method on one problem."""

    group: str
    task: str
    who: str
    seed: int
    seconds: float
    cpu: float
    """Processor time of all threads."""
    prepared: float
    """Seconds spent once for this problem, before the run."""
    length: float | None
    """Of a valid path, in cells."""
    gap: float | None
    """How much longer it is than the reference, as a share; at most that where the reference is a bound."""
    exact: bool
    """Whether the reference is exact."""
    over_plane: float | None
    """How much longer the path is than the shortest way in the plane, as a share."""
    fault: str
    """Why there is no valid path."""
    callback: float | None = None
    """Share of the time spent in our tests of states and motions, called from elsewhere."""


@dataclass(frozen=True)
class Limits:
    """How often, how long, and how well."""

    seeds: int = 2
    seconds: float = 3.0
    """After which whoever can stop has to."""
    target: float | None = None
    """A gap at which whoever can stop may; none: everybody goes on to the end."""


def reference(problem: PathProblem) -> Reference | None:
    """Return the any-angle optimum, or a certified lower bound where it is out of reach; ``None`` without any path."""
    if not problem.reachable:
        return None
    known = exact.any_angle_search(problem)
    plane = exact.taut_length(problem)
    return Reference(known.length if known.proven else known.bound, known.proven, plane)


def fault_of(path: Answer, problem: PathProblem) -> str:
    """Return what is wrong with a path; empty: nothing."""
    if path is None:
        return "found none"
    judge = exact.validate if path.dtype.kind in "iu" else validate_curve
    return judge(path, problem) or ""


def length_of(path: Answer) -> float:
    """Return the length of a path, in cells."""
    assert path is not None, "asked of a run that found nothing"
    return float(np.hypot(*np.diff(path.astype(float), axis=0).T).sum())


def compare(
    tasks: Iterable[Task],
    ours: Sequence[Peer],
    others: Sequence[Peer],
    limits: Limits,
    corners: Corners,
    tell: Callable[[str], None] = lambda _: None,
) -> Iterator[Run]:
    """Yield one run after the other: ours first, whose time is then that of the anytime planners.

    The first of ours that finds a path sets that time. Methods that are not
    installed are left out.
    """
    installed = [peer for peer in others if peer.version() is not None]
    for peer in (*ours, *installed):
        _warm_up(peer, corners)
    for task in tasks:
        tell(f"{task.name}: reference")
        against = reference(task.problem)
        if against is None:
            tell(f"{task.name}: no path")
            continue
        ours_took: float | None = None
        for peer in (*ours, *installed):
            for times in (1, MORE) if peer.anytime and ours_took is not None else (None,):
                tell(f"{task.name}: {peer.name}")
                seconds = limits.seconds if times is None or ours_took is None else times * ours_took
                who = peer.name if times is None else f"{peer.name}, {times} × our time"
                runs = list(_runs(peer, who, task, against, limits, seconds))
                found = [run.seconds for run in runs if not run.fault]
                if peer in ours and ours_took is None and found:
                    ours_took = float(np.median(found))
                yield from runs


def _runs(peer: Peer, who: str, task: Task, against: Reference, limits: Limits, seconds: float) -> Iterator[Run]:
    target = 0.0 if limits.target is None else (1.0 + limits.target) * against.length * (1.0 + 1e-12)
    prepared, spent = 0.0, 0.0
    solve: Solve | None = None
    trouble = ""
    began = time.perf_counter()
    try:
        solve = peer.prepare(task.problem)
        prepared = time.perf_counter() - began
    except Exception as error:
        trouble = _said(error)
    for seed in range(limits.seeds):
        path: Answer = None
        gc.collect()
        wall, cpu = time.perf_counter(), time.process_time()
        if solve is not None:
            try:
                path = solve(seed, seconds, target)
            except Exception as error:
                trouble = _said(error)
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        fault = trouble or fault_of(path, task.problem)
        length = None if fault else length_of(path)
        gap, over_plane = (_over(length, least) for least in (against.length, against.plane))
        if limits.target is not None and gap is not None and gap > limits.target + 1e-9:
            fault = f"ended {100 * gap:.2f} % above"
        inside = getattr(solve, "callback", None)
        share = None if inside is None else inside / max(wall, 1e-9)
        yield Run(
            task.group, task.name, who, seed, wall, cpu, prepared, length, gap, against.exact, over_plane,
            fault, share
        )  # fmt: skip
        spent += wall
        if not peer.draws and spent > REPEATED:
            return


def _over(length: float | None, least: float) -> float | None:
    """Return how much longer than the least a length is, as a share."""
    return None if length is None else length / least - 1.0 if least else 0.0


def _warm_up(peer: Peer, corners: Corners) -> None:
    """Let a method load what it loads once; what goes wrong here will be told of its runs."""
    with suppress(Exception):
        peer.prepare(problem_on("random-20:20%", corners))(0, 0.1)


def _said(error: Exception) -> str:
    return f"raised {type(error).__name__}: {' '.join(str(error).split())[:80]}"
