"""What commands share on the terminal: two consoles, and progress on long work."""

import json
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import replace
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bar

from pathloom.compiled.jit import listening
from pathloom.draw import Live
from pathloom.kernel.planner import Planner
from pathloom.kernel.progress import Progress

PATIENCE = 0.7
"""Seconds of work before progress is shown."""


class _Console(Console):
    """A console that prints text as it is: brackets and colons in a file's name are no markup."""

    def __init__(self, *, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, highlight=False, markup=False, emoji=False)

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError  # rich would exit with 1 here; whoever stopped reading has seen enough


def out() -> Console:
    """Return the console for results. Piped, it neither colours nor folds its lines at 80 columns."""
    console = _Console()
    if not console.is_terminal:
        console.width = 120
    return console


def err() -> Console:
    """Return the console for progress and messages."""
    return _Console(stderr=True)


def json_line(document: Any) -> str:
    """Return one line of JSON in ASCII, which every terminal, pipe and file can take."""
    return json.dumps(document, allow_nan=False) + "\n"


def print_json(document: Any) -> None:
    """Print one JSON document, and nothing else, on standard output."""
    sys.stdout.write(json_line(document))


@contextmanager
def compiling(*, quiet: bool) -> Iterator[None]:
    """Say that kernels are compiled, the first time on a machine, and how far that is."""
    if quiet:
        yield
        return
    console = err()
    bar = _bar(console)
    task = bar.add_task("compiling kernels, once", total=None)
    told = False

    def tell(done: int, total: int) -> None:
        nonlocal told
        if not told:
            told = True
            if console.is_terminal:
                bar.start()
            else:
                console.print("compiling kernels, once; this takes some seconds")
        bar.update(task, completed=done, total=total)

    try:
        with listening(tell):
            yield
    finally:
        _stop(bar)


def watched(planner: Planner, *, quiet: bool) -> Planner:
    """Return the planner with somebody who shows progress when the work takes long, unless the config names one.

    Quiet, nobody writes to the terminal, whatever the config names.
    """
    showing = [
        one for one in planner.observers if isinstance(one, Progress) or (isinstance(one, Live) and not one.file)
    ]
    if quiet:
        return replace(planner, observers=tuple(one for one in planner.observers if one not in showing))
    return planner if showing else replace(planner, observers=(*planner.observers, Progress(patience=PATIENCE)))


@contextmanager
def printing_aside() -> Iterator[None]:
    """Let what an operator prints go to standard error: standard output is for the result."""
    with redirect_stdout(sys.stderr):
        yield


@contextmanager
def counting(what: str, total: int, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Give a function that is told what is done next, of so many things, and shows it where somebody looks."""
    console = err()
    bar = _bar(console)
    task = bar.add_task(what, total=total)
    done = -1

    def next_is(name: str) -> None:
        nonlocal done
        done += 1
        if not quiet and console.is_terminal:
            bar.start()
            bar.update(task, completed=done, description=name)

    try:
        yield next_is
    finally:
        _stop(bar)


@contextmanager
def between_generations() -> Iterator[Callable[[bool], None]]:
    """Give a function that raises KeyboardInterrupt once Ctrl-C was pressed; told of the last one, it stops listening.

    Within a compiled kernel an interrupt would end in a SystemError, and the
    best path so far be lost. So the first Ctrl-C waits until the function is
    called; a second one does not wait.
    """
    if threading.current_thread() is not threading.main_thread():  # no other thread may listen to signals
        yield lambda _: None
        return
    before = signal.getsignal(signal.SIGINT)
    pressed = False

    def press(*_: object) -> None:
        nonlocal pressed
        pressed = True
        signal.signal(signal.SIGINT, signal.default_int_handler)

    def check(last: bool) -> None:
        if pressed:
            raise KeyboardInterrupt
        if last:
            signal.signal(signal.SIGINT, signal.default_int_handler)

    signal.signal(signal.SIGINT, press)
    try:
        yield check
    finally:
        signal.signal(signal.SIGINT, before)


def _bar(console: Console) -> Bar:
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    return Bar(*columns, console=console, transient=True)


def _stop(bar: Bar) -> None:
    """Take a bar away that was shown; rich would print a blank line for one that was not."""
    if bar.live.is_started:
        bar.stop()
