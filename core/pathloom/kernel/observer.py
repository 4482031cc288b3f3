"""Observer: somebody who watches a run."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from pathloom.kernel.component import Component
from pathloom.kernel.state import State


@dataclass(frozen=True, kw_only=True)
class Observer(Component, ABC):
    """Told of every state, in order. It changes nothing, and works only where a config names it."""

    kind: ClassVar[str] = "observer"

    @abstractmethod
    def observe(self, state: State) -> None:
        """Take note of a new state."""
