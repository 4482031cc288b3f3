"""Progress: a bar for whoever looks on."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Annotated

from pathloom.kernel.component import NonNegative, Unit
from pathloom.kernel.observer import Observer, Tell
from pathloom.kernel.planner import Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import State


@dataclass(frozen=True, kw_only=True)
class Progress(Observer):
    """Show on standard error how far a run is, where that is a terminal; elsewhere nothing."""

    patience: Annotated[NonNegative, Unit("seconds")] = 0.0
    """How long a run takes before anything is shown."""

    @contextmanager
    def watch(self, problem: Problem, planner: Planner) -> Iterator[Tell]:
        if sys.stderr is None or not sys.stderr.isatty():
            yield lambda _: None
            return
        from rich.console import Console
        from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
        from rich.progress import Progress as Bar

        columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
        bar = Bar(*columns, console=Console(stderr=True, highlight=False, markup=False, emoji=False), transient=True)
        task = bar.add_task(planner.name, total=1.0)
        began = time.perf_counter()

        def tell(state: State) -> None:
            if time.perf_counter() - began < self.patience:
                return
            bar.start()
            words = f"{planner.name}, generation {state.generation}"
            bar.update(task, completed=planner.progress(state), description=words)

        try:
            yield tell
        finally:
            if bar.live.is_started:  # rich would print a blank line for one that was not
                bar.stop()
