"""Drivers: run a planner on a problem, all of it or state by state."""

import math
import time
from collections.abc import Callable, Generator
from contextlib import ExitStack, closing
from dataclasses import dataclass, field

import numpy as np

from pathloom.errors import ConfigError
from pathloom.kernel.planner import Outcome, Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Individual, State


@dataclass(frozen=True)
class Run:
    """A finished run: its last state, its answer and what it took."""

    state: State | None
    outcome: Outcome
    phases: dict[str, float] = field(default_factory=dict)
    """Seconds spent in ``sampling``, ``evolution`` and ``refinement``."""
    interrupted: bool = False
    first: float | None = None
    """Seconds until there was an answer."""
    best: float | None = None
    """Seconds until the answer was found that stayed."""


def check_seed(seed: object) -> int:
    """Return the seed, a whole number that is at least zero.

    Raises
    ------
    ConfigError
        If it is anything else.
    """
    if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or seed < 0:
        raise ConfigError(f"seed is an integer in [0, inf); got {seed!r}")
    return int(seed)


def check_interrupt(error: BaseException) -> None:
    """Raise the error again unless somebody pressed Ctrl-C: within a compiled kernel that surfaces as a SystemError."""
    if not isinstance(error, KeyboardInterrupt) and not isinstance(error.__cause__, KeyboardInterrupt):
        raise error


def first_generator(seed: int) -> np.random.Generator:
    """Return the generator with which a run of this seed begins."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(check_seed(seed))))


def iterate(
    problem: Problem, planner: Planner, seed: int = 0, *, state: State | None = None
) -> Generator[State, None, None]:
    """Yield the first state and then one a generation, until the planner is done.

    Every state can be kept, pickled, and stepped on from again. With ``state``
    that one is the first, and the seed of no importance: its generator goes on.
    """
    with ExitStack() as watching:
        told = [watching.enter_context(observer.watch(problem, planner)) for observer in planner.observers]
        if state is None:
            state = planner.start(problem, first_generator(seed))
        while True:
            for tell in told:
                tell(state)
            yield state
            if planner.done(state):
                return
            state = planner.step(state)


def run(
    problem: Problem,
    planner: Planner,
    seed: int = 0,
    *,
    time_limit: float | None = None,
    watch: Callable[[State], None] | None = None,
    clock: Callable[[], float] = time.perf_counter,
) -> Run:
    """Run a planner to its end, or until the time is over or somebody interrupts.

    Parameters
    ----------
    time_limit
        Seconds after which the best found so far is the answer. What a planner
        does within one step is not cut short.
    watch
        Called with every state.
    clock
        Gives the seconds of which the phases are made; the time limit is one of real time.
    """
    began, until = clock(), time.perf_counter() + (math.inf if time_limit is None else time_limit)
    first = best = None
    answer: Individual | None = None
    phases: dict[str, float] = {}
    state: State | None = None
    interrupted = False
    try:
        with closing(iterate(problem, planner, seed)) as states:
            for state in states:
                if watch is not None:
                    watch(state)
                now = clock() - began
                phases.setdefault("sampling", now)
                if state.answer is not None and state.answer is not answer:
                    answer, best = state.answer, now
                    first = now if first is None else first
                if time.perf_counter() >= until:
                    break
    except (KeyboardInterrupt, SystemError) as error:
        check_interrupt(error)
        interrupted = True
    searched = clock() - began
    phases.setdefault("sampling", searched)
    phases["evolution"] = searched - phases["sampling"]
    outcome = Outcome(None, reason="interrupted before the first individual")
    if state is not None:
        try:
            outcome = planner.result(state)
        except (KeyboardInterrupt, SystemError) as error:  # the answer as it was found is better than none
            check_interrupt(error)
            interrupted = True
            outcome = Outcome(state.answer.row if state.answer else None, state.answer, "interrupted")
    phases["refinement"] = clock() - began - searched
    return Run(state, outcome, phases, interrupted, first, best)
