"""Planners that do what planners should not, each in its own way."""

import os
import signal
import sys
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from pathloom.kernel.planner import Outcome, Planner
from pathloom.kernel.state import State
from pathloom.paths.cell_paths import flat_ids


@dataclass(frozen=True, kw_only=True)
class Straight(Planner):
    """A straight line from start to goal, whatever is between them; it takes a while."""

    seconds: float = 0.0

    def start(self, problem: Any, rng: np.random.Generator) -> State:
        time.sleep(self.seconds)
        self.misbehave(rng)
        return State(problem, rng.bit_generator.state, evaluations=1)

    def misbehave(self, rng: np.random.Generator) -> None:
        pass

    def step(self, state: State) -> State:
        return state

    def done(self, state: State) -> bool:
        return True

    def result(self, state: State) -> Outcome:
        return Outcome(flat_ids(np.array(state.problem.ends), state.problem.grid.width))


@dataclass(frozen=True, kw_only=True)
class Raising(Straight):
    def misbehave(self, rng):
        raise ValueError("no idea\nwhat to do")


@dataclass(frozen=True, kw_only=True)
class Leaving(Straight):
    def misbehave(self, rng):
        sys.exit("goodbye")


@dataclass(frozen=True, kw_only=True)
class Hanging(Straight):
    def misbehave(self, rng):
        while True:
            time.sleep(0.01)


@dataclass(frozen=True, kw_only=True)
class Dying(Straight):
    """Takes its process with it, for about every second seed."""

    always: bool = False

    def misbehave(self, rng):
        if self.always or rng.random() < 0.5:
            os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))  # on Windows the one is the other


@dataclass(frozen=True, kw_only=True)
class Insatiable(Straight):
    """Takes all memory that it gets."""

    def misbehave(self, rng):
        held = []
        while True:
            held.append(np.empty(1 << 24))
