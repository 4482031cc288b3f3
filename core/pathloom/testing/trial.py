"""Trial: one call of a component carried out, and all that it left behind."""

import io
import random
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from typing import Any

import numpy as np

from pathloom.kernel.component import Component
from pathloom.testing.calls import Call, calls_of
from pathloom.testing.plain import Plain, plain, tables
from pathloom.testing.problems import POLICIES

SEED = 4


@dataclass(frozen=True)
class Trial:
    """What a call was given, what it gave back, and what else it did."""

    call: Call
    inputs: tuple[Any, ...]
    """As the call left them."""
    output: Any
    error: Exception | None
    printed: str
    altered: str
    """What it changed of its inputs or of itself, in words; empty: nothing."""
    drew: str
    """Which global random generator it drew from or seeded; empty: none."""

    @property
    def problem(self) -> Any:
        """The problem on which it was."""
        assert self.call.place is not None
        return self.call.place.problem()


def carried_out(component: Component, call: Call, seed: int = SEED) -> Trial:
    """Carry a call out. The global generators are in the same state before every call, and afterwards as they were."""
    inputs = call.inputs()
    before, known, itself = plain(inputs), tables(inputs), plain(component)
    output, error, printed = None, None, io.StringIO()
    with global_generators() as drew, redirect_stdout(printed):
        try:
            output = call.use(component, *inputs, np.random.default_rng(seed))
        except Exception as raised:
            error = raised
        used = drew()
    after = tables(inputs)
    altered = [
        f"input {k + 1}" for k, (was, is_) in enumerate(zip(before[1], plain(inputs)[1], strict=True)) if was != is_
    ]
    altered += [f"the problem's table {name!r}" for name, table in known.items() if after.get(name) != table]
    altered += ["the component itself"] if plain(component) != itself else []
    return Trial(call, inputs, output, error, printed.getvalue(), ", ".join(altered), used)


@contextmanager
def global_generators() -> Iterator[Any]:
    """Seed the global generators, give a function that says which of them were used, and restore them."""
    python, of_numpy = random.getstate(), np.random.get_state()  # noqa: NPY002 - it is about these
    random.seed(0)
    np.random.seed(0)  # noqa: NPY002
    first, second = random.getstate(), plain(np.random.get_state())  # noqa: NPY002

    def used() -> str:
        names = ["random"] if random.getstate() != first else []
        names += ["numpy.random"] if plain(np.random.get_state()) != second else []  # noqa: NPY002
        return " and ".join(names)

    try:
        yield used
    finally:
        random.setstate(python)
        np.random.set_state(of_numpy)  # noqa: NPY002


_last: list[tuple[Component, list[Trial]]] = []
"""The component that was tried last, whose trials the next checks look at."""


def trials(component: Component) -> list[Trial]:
    """Return all calls of a component, carried out."""
    if not _last or _last[0][0] is not component:
        _last[:] = [(component, [carried_out(component, call) for call in calls_of(component)])]
    return _last[0][1]


def finished(component: Component) -> Iterator[Trial]:
    """Yield the calls of a component that raised nothing."""
    return (trial for trial in trials(component) if trial.error is None)


def some(component: Component) -> list[Call]:
    """Return a few calls of a component: those that are made again, where all would take long."""
    return calls_of(component)[: max(3, len(POLICIES))]


def outcome(trial: Trial) -> Plain:
    """Return what a call gave; an error by its class alone."""
    return type(trial.error).__name__ if trial.error else plain(trial.output)
