"""JSON lines: a log of a run, which other programs can follow."""

import json
import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from pathloom.files import appending
from pathloom.kernel.observer import Observer, Tell
from pathloom.kernel.planner import Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.state import State


@dataclass(frozen=True, kw_only=True)
class JsonLines(Observer):
    """Write one line of JSON a generation into a file, where it can be read at once.

    A line has ``generation``, ``evaluations``, ``best``, ``generation_best``,
    ``mean``, ``diversity``, ``seconds``, the objectives' ``values`` of the fittest
    individual, and ``counts``. What is not known yet is null.
    """

    file: str = "run.jsonl"
    """The file, from the folder in which one works; a run writes it anew."""

    @contextmanager
    def watch(self, problem: Problem, planner: Planner) -> Iterator[Tell]:
        with appending(self.file) as write:
            yield lambda state: write(json.dumps(line(state, planner), allow_nan=False) + "\n")


def line(state: State, planner: Planner) -> dict[str, Any]:
    """Return what is told of one generation."""
    record = state.history.records[-1]._asdict() if state.history.records else {}
    best = state.best
    values = dict(zip(planner.terms.labels, best.values.tolist(), strict=False)) if best is not None else {}
    return {
        "generation": state.generation,
        "evaluations": state.evaluations,
        **{name: _finite(record.get(name)) for name in ("best", "generation_best", "mean", "diversity")},
        "seconds": state.seconds,
        "values": {label: _finite(value) for label, value in values.items()},
        "counts": dict(sorted(state.counts.items())),
    }


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
