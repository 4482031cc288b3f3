"""Observer: somebody who watches a run."""

from abc import ABC
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, TypeAlias

from pathloom.kernel.component import Component
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import State

if TYPE_CHECKING:
    from pathloom.kernel.planner import Planner

Tell: TypeAlias = Callable[[State], None]
"""Takes note of a new state."""


@dataclass(frozen=True, kw_only=True)
class Observer(Component, ABC):
    """Told of every state, in order. It changes nothing, and works only where a config names it.

    One that keeps nothing between two states has a method `observe`. One that
    opens something for the length of a run has, in its place, a context manager
    `watch`: what stands before its ``yield`` is done before the first state, what
    stands after it when the run is over, also one that was interrupted or failed.
    """

    kind: ClassVar[str] = "observer"

    def watch(self, problem: Problem, planner: "Planner") -> AbstractContextManager[Tell]:
        """Return the context of one run, which gives the function that is told every state of it."""
        return nullcontext(self.observe)

    def observe(self, state: State) -> None:
        """Take note of a new state."""
