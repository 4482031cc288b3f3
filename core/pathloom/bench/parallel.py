"""Parallel planning: two processes on two cores, and threads that must not disturb each other."""

import multiprocessing
import time
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from pathloom.bench.suite import problem_on
from pathloom.errors import PathloomError
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run
from pathloom.paths.context import Corners
from pathloom.planning import plan
from pathloom.result import Result

Planners = str | Mapping[str, Any]


class Time(NamedTuple):
    """Seconds, or shares of them."""

    wall: float
    cpu: float
    """Of the processor: what others do on the same machine counts for less."""


@dataclass(frozen=True)
class Parallel:
    """What happens to planning when others plan at the same time."""

    alone: "Time"
    """Of one process that plans alone."""
    together: "Time"
    """Of the slower of two that plan at the same time, each as much as the one alone."""
    sequence: float
    """Seconds of planning one after the other in one thread."""
    threads: float
    """Seconds of the same in four threads."""
    same: bool
    """Whether all results are the same."""

    @property
    def loss(self) -> "Time":
        """How much longer a process takes beside another, as shares."""
        return Time(*(b / max(a, 1e-9) - 1.0 for a, b in zip(self.alone, self.together, strict=True)))


def measured(planner: Planners, name: str, corners: Corners, runs: int, rounds: int = 3) -> Parallel:
    """Return the best of some rounds of each."""
    problem_on(name, corners)  # what is wrong with it is better said here
    times = [[_seconds(planner, name, corners, runs, processes) for processes in (1, 2)] for _ in range(rounds)]
    alone, together = (Time(*map(min, zip(*of, strict=True))) for of in zip(*times, strict=True))
    sequence, threads, same = _threads(planner, name, corners, runs)
    return Parallel(alone, together, sequence, threads, same)


def _seconds(planner: Planners, name: str, corners: Corners, runs: int, processes: int) -> Time:
    """Return how long the slowest of so many processes takes; all begin at once."""
    context = multiprocessing.get_context("spawn")
    ready, times = context.Barrier(processes), context.SimpleQueue()
    workers = [
        context.Process(target=_work, args=(planner, name, corners, runs, ready, times)) for _ in range(processes)
    ]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    found = [times.get() for _ in workers if not times.empty()]
    if len(found) < processes:
        raise PathloomError(f"{processes - len(found)} of {processes} processes ended without a result")
    return Time(*map(max, zip(*found, strict=True)))


def _work(planner: Planners, name: str, corners: Corners, runs: int, ready: Any, times: Any) -> None:
    problem, composed = problem_on(name, corners), compose(planner)
    run(problem, composed, 0)
    ready.wait()
    wall, cpu = time.perf_counter(), time.process_time()
    for seed in range(runs):
        run(problem, composed, seed)
    times.put((time.perf_counter() - wall, time.process_time() - cpu))


def _threads(planner: Planners, name: str, corners: Corners, runs: int) -> tuple[float, float, bool]:
    """Plan in sequence and in four threads; return both times, and whether all results are the same."""
    problem, composed = problem_on(name, corners), compose(planner)
    plan(problem, composed)

    def one(seed: int) -> Result:
        return plan(problem, composed, seed=seed)

    began = time.perf_counter()
    expected = [one(seed) for seed in range(runs)]
    sequence = time.perf_counter() - began
    with ThreadPoolExecutor(4) as pool:
        began = time.perf_counter()
        found = list(pool.map(one, range(runs)))
        threads = time.perf_counter() - began
    return sequence, threads, all(map(_same, expected, found))


def _same(one: Result, other: Result) -> bool:
    """Say whether two results are the same, bit for bit, but for their times."""
    paths = (one.path is None and other.path is None) or np.array_equal(one.path, other.path)  # type: ignore[arg-type]
    return bool(paths) and (one.history, one.metrics, one.fitness) == (other.history, other.metrics, other.fitness)
