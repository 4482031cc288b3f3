"""State of a multi-objective run."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from pathloom import Floats, State
from pathloom.kernel.front import Front


@dataclass(frozen=True, kw_only=True)
class FrontState(State):
    """A state with what pymoo's algorithms go by; ``demes`` has the one population.

    ``best`` is the individual of the front with the least weighted sum of
    objectives, and its ``generation`` the last one that changed the front, so that
    `Stagnation` waits for the front. ``answer`` is the compromise of the front.
    """

    violation: Floats
    """(n,), by how much each individual breaks the constraints in all."""
    marks: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    """What the survival found out of each individual, (n,): rank, crowding and the like."""
    memory: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    """What the survival has to remember of the generations before."""
    archive: Front
    """The trade-offs of all generations so far that break no constraint."""
