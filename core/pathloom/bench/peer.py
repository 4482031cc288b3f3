"""Peer: whoever plans paths in a benchmark, we ourselves among them."""

import math
import time
from abc import ABC, abstractmethod
from importlib.metadata import PackageNotFoundError, version
from typing import Any, ClassVar, Protocol, TypeAlias

from numpy.typing import NDArray

from pathloom.paths.problem import PathProblem

Answer: TypeAlias = NDArray[Any] | None
"""Rows and columns (k, 2) of a polyline, integers where its points are cells; ``None`` where none was found."""


class Solve(Protocol):
    """Plans on the problem that it was prepared for."""

    def __call__(self, seed: int, seconds: float = math.inf, target: float = 0.0, /) -> Answer:
        """Return a path from start to goal.

        Parameters
        ----------
        seconds
            Time after which the best path so far is the answer.
        target
            Length, in cells, that is short enough: who can stop there, does.
        """


class Peer(ABC):
    """A method under the name that tables give it."""

    name: str
    distribution: ClassVar[str]
    """The package that it comes with."""
    about: str
    """How it is used, and what it cannot do."""
    draws: ClassVar[bool] = True
    """Whether the path depends on the seed."""
    anytime: ClassVar[bool] = False
    """Whether it goes on improving for as long as it is let: it then gets our time, and ten times that."""

    def version(self) -> str | None:
        """Return the version that is installed, or ``None``."""
        try:
            return version(self.distribution)
        except PackageNotFoundError:
            return None

    @abstractmethod
    def prepare(self, problem: PathProblem) -> Solve:
        """Do what is done once for a problem, such as building a graph; its time is told apart."""


class Until:
    """When a search is to stop: its time is over, or its path short enough.

    Processor time, so that nobody loses what a busy machine does for others.
    """

    def __init__(self, seconds: float, target: float) -> None:
        self._end = time.process_time() + seconds
        self._target = target

    def over(self, length: float = math.inf) -> bool:
        """Say whether to stop with a valid path of this length."""
        return length <= self._target or time.process_time() >= self._end
