"""Live: a drawing that follows a run."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

from numpy.typing import NDArray

from pathloom.draw.figure import path_figure
from pathloom.draw.saving import METADATA, check_suffix, save
from pathloom.draw.terminal import picture
from pathloom.errors import ConfigError
from pathloom.kernel.component import NonNegative, Unit
from pathloom.kernel.observer import Observer, Tell
from pathloom.kernel.planner import Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import Record, State
from pathloom.paths.problem import PathProblem


@dataclass(frozen=True, kw_only=True)
class Live(Observer):
    """Draw the best path so far, again and again: in the terminal, or into a file that a viewer follows.

    In the terminal it is drawn on standard error, and taken away in the end; where
    that is no terminal nothing is drawn. A file shows how the fitness converges too.
    """

    works_on: ClassVar[str] = "cells"

    file: str | None = None
    """A ``.png``, ``.svg`` or ``.pdf``, which is written anew each time; without one: the terminal."""
    every: Annotated[NonNegative, Unit("seconds")] = 0.5
    """Time from one drawing to the next, at least; the last state is drawn in any case."""
    dark: bool = False
    """Whether the file is for dark ground."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.file is not None:
            check_suffix(self.file, METADATA)

    @contextmanager
    def watch(self, problem: Problem, planner: Planner) -> Iterator[Tell]:
        if not isinstance(problem, PathProblem):
            raise ConfigError(f"observer {self.name!r} draws paths; got a problem of kind {problem.name!r}")
        if self.file is not None:
            yield from self._paced(lambda state: self._write(state, problem, planner))
        elif sys.stderr is None or not sys.stderr.isatty():
            yield lambda _: None
        else:
            from rich.console import Console, Group
            from rich.live import Live as Display
            from rich.text import Text

            console = Console(stderr=True, highlight=False, markup=False, emoji=False)
            with Display(console=console, auto_refresh=False, transient=True) as display:

                def show(state: State) -> None:
                    room = {**_map(problem), "width": min(console.width, 100), "height": max(console.height - 2, 3)}
                    drawn = picture(**room, path=_best(state))
                    display.update(Group(drawn, Text(_words(state, planner))), refresh=True)

                yield from self._paced(show)

    def _paced(self, draw: Tell) -> Iterator[Tell]:
        """Give a function that draws as often as it should, and the last state when all is over."""
        last: State | None = None
        drawn = -float("inf")

        def tell(state: State) -> None:
            nonlocal last, drawn
            last = state
            if time.perf_counter() - drawn >= self.every:
                draw(state)
                last, drawn = None, time.perf_counter()

        try:
            yield tell
        finally:
            if last is not None:
                draw(last)

    def _write(self, state: State, problem: PathProblem, planner: Planner) -> None:
        assert self.file is not None, "only then"
        history = {name: getattr(state.history, name) for name in Record._fields}
        resolution = problem.grid.resolution if problem.grid.metric else None
        figure = path_figure(
            **_map(problem), path=_best(state), history=history, title=_words(state, planner), resolution=resolution,
            dark=self.dark,
        )  # fmt: skip
        save(figure, self.file)


def _map(problem: PathProblem) -> dict[str, Any]:
    closed = problem.context.occupied if problem.radius else None
    return {"occupied": problem.grid.occupied, "closed": closed, "start": problem.ends[0], "goal": problem.ends[1]}


def _best(state: State) -> NDArray[Any] | None:
    """Return the path that would be the answer if the run ended here, before refinement."""
    best = state.answer or state.best
    path: NDArray[Any] | None = None if best is None else state.problem.representation.decode(best.row)
    return path


def _words(state: State, planner: Planner) -> str:
    best = "" if state.best is None else f", best fitness {state.best.fitness:.6g}"
    return f"{planner.name}, generation {state.generation}{best}"
