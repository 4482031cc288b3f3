"""Examples: what a robot sensed, and what it was right to do."""

import hashlib
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError
from pathloom.kernel.evaluation import Floats
from pathloom.local.actions import Action
from pathloom.local.sectors import WIDTHS

Actions = NDArray[np.int64]
"""(n,) numbers of `Action`."""


@dataclass(frozen=True, eq=False)
class Examples:
    """Distances, each row with the action that belongs to it, in the order in which they were recorded.

    Raises
    ------
    ConfigError
        If the arrays do not fit each other, a distance is no number from 0 on, or an action is unknown.
    """

    distances: Floats
    """(n, k) metres; k is 2 (front, left), 4 (front, left, right, back) or 24 (all sensors)."""
    actions: Actions
    """(n,)"""
    name: str = "examples"
    """What messages and manifests call them."""
    notes: tuple[str, ...] = ()
    """What was odd about the file that they come from."""

    def __post_init__(self) -> None:
        distances = np.ascontiguousarray(self.distances, np.float64)
        actions = np.asarray(self.actions)
        if distances.ndim != 2 or distances.shape[1] not in WIDTHS or len(distances) == 0:
            found = f"distances of shape {distances.shape}"
            raise ConfigError(f"{self.name}: found {found}, allowed (n, k), n 1 or more, k one of 2, 4 and 24")
        if actions.shape != (len(distances),):
            raise ConfigError(f"{self.name}: found actions of shape {actions.shape}, allowed ({len(distances)},)")
        if not (np.isfinite(distances) & (distances >= 0.0)).all():
            raise ConfigError(f"{self.name}: found a distance that is no number from 0 on, allowed metres")
        if actions.dtype.kind not in "iu" or not np.isin(actions, list(Action)).all():
            raise ConfigError(f"{self.name}: found an unknown action, allowed the numbers 0 to {len(Action) - 1}")
        object.__setattr__(self, "distances", distances)
        object.__setattr__(self, "actions", actions.astype(np.int64))

    def __len__(self) -> int:
        """Return the number of examples."""
        return len(self.actions)

    @property
    def width(self) -> int:
        """Number of distances of each example: 2, 4 or 24."""
        return int(self.distances.shape[1])

    def take(self, rows: NDArray[np.intp]) -> "Examples":
        """Return some of the examples."""
        return Examples(self.distances[rows], self.actions[rows], self.name)

    @cached_property
    def sha256(self) -> str:
        """Hex digest of distances and actions, whatever file they came from."""
        digest = hashlib.sha256(f"{len(self)} {self.width}\n".encode("ascii"))
        digest.update(self.distances.astype("<f8").tobytes())
        digest.update(self.actions.astype("<i8").tobytes())
        return digest.hexdigest()
