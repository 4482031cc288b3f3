"""Snapshots: states kept in files, from which a run can be taken up again."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pathloom.files import make_folder, replace
from pathloom.kernel.component import Count, Unit
from pathloom.kernel.observer import Observer, Tell
from pathloom.kernel.planner import Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import State
from pathloom.kernel.storing import pack


@dataclass(frozen=True, kw_only=True)
class Snapshots(Observer):
    """Save states into a folder, ``generation-000010.npz`` and so on, the last one of the run among them.

    `load_state` reads one, and ``iterate(problem, planner, state=...)`` goes on from
    it exactly as the run did, or would have done had it not been interrupted.
    """

    folder: str = "snapshots"
    """The folder, from the one in which one works. It is made; files of the same names are replaced."""
    every: Annotated[Count, Unit("generations")] = 10
    """How often a state is saved."""

    @contextmanager
    def watch(self, problem: Problem, planner: Planner) -> Iterator[Tell]:
        folder = make_folder(self.folder)
        last: State | None = None
        saved = True

        def tell(state: State) -> None:
            nonlocal last, saved
            last, saved = state, state.generation % self.every == 0
            if saved:
                save(state, planner, folder)

        try:
            yield tell
        finally:
            if last is not None and not saved:
                save(last, planner, folder)


def save(state: State, planner: Planner, folder: Path) -> None:
    """Write a state into a folder, under the number of its generation."""
    replace(folder / f"generation-{state.generation:06d}.npz", pack(state, planner))
