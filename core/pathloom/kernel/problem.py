"""Problem: what is to be solved, and in which representation."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from pathloom.kernel.component import Component
from pathloom.kernel.representation import Representation


@dataclass(frozen=True, kw_only=True)
class Problem(Component, ABC):
    """Something to be solved. Operators receive it and read their data from it.

    What is good is not the problem's business but the objectives': one problem
    can be solved for one objective or for several.
    """

    kind: ClassVar[str] = "problem"

    @property
    @abstractmethod
    def representation(self) -> Representation:
        """How the solutions are written in arrays."""

    @property
    def fingerprint(self) -> str:
        """What tells it from other problems, alike in every process: a saved state is taken up on its own one only."""
        return repr(self)
