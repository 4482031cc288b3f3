"""Storing: a state as one file, and back, bit for bit.

The file is numpy's ``.npz``: the arrays of the state, and a text in JSON that
says where in it they stand. Nothing in it is code: the classes are looked up
among those that the planner and its state are made of.
"""

import dataclasses
import io
import json
import math
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ConfigError
from pathloom.files import FilePath, content, one_line
from pathloom.kernel.planner import Planner
from pathloom.kernel.problem import Problem
from pathloom.kernel.registry import default_registry
from pathloom.kernel.state import State
from pathloom.zips import UNREADABLE

SCHEMA = "pathloom.state/1"
TEXT = "state"
"""Name of the text among the arrays."""
DAMAGE = (ValueError, TypeError, LookupError, AttributeError, OSError, *UNREADABLE)
"""What reading a file may raise that is not what `pack` made, or no longer is."""


def pack(state: State, planner: Planner) -> bytes:
    """Return a state as the bytes of a file, with what it may be taken up on.

    Raises
    ------
    ConfigError
        If the state holds something else than numbers, texts, arrays, tuples, lists,
        mappings and dataclasses of these.
    """
    writer = _Writer(state.problem)
    document = {
        "schema": SCHEMA,
        "planner": default_registry().name_of(type(planner)),
        "problem": state.problem.fingerprint,
        "state": writer.form(state),
    }
    text = np.frombuffer(json.dumps(document, allow_nan=False).encode(), np.uint8)
    parts: dict[str, Any] = {TEXT: text, **{str(i): array for i, array in enumerate(writer.arrays)}}
    file = io.BytesIO()
    np.savez(file, **parts)
    return file.getvalue()


def load_state(file: FilePath, problem: Problem, planner: Planner) -> State:
    """Return the state in a file of the observer ``snapshots``, to go on from: the next steps are the same ones.

    Raises
    ------
    ConfigError
        If the file is damaged, or its run had another problem or another planner.
    MapError
        If there is no such file, or it cannot be read.
    """
    data = content(file)
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as arrays:
            document = json.loads(arrays[TEXT].tobytes())
            if document["schema"] != SCHEMA:
                raise ValueError(f"it has the schema {document['schema']!r}")
            found = document["planner"], document["problem"]
            reader = _Reader({name: arrays[name] for name in arrays.files if name != TEXT}, problem, planner)
        name = default_registry().name_of(type(planner))
        if found[0] != name:
            raise ConfigError(f"{file}: found a state of the planner {found[0]!r}, allowed one of {name!r}")
        if found[1] != problem.fingerprint:
            raise ConfigError(f"{file}: found a state of another problem, allowed one of this map, with the same ends")
        state = reader.value(document["state"])
        if not isinstance(state, State):
            raise TypeError("it holds no state")
    except ConfigError:
        raise
    except DAMAGE as error:
        found_one = one_line(f"{type(error).__name__}: {error}")
        raise ConfigError(f"{file}: found no state ({found_one}), allowed a file of 'snapshots', undamaged") from error
    return state


class _Writer:
    """Turns values into JSON; arrays are put aside, and what occurs twice is written once."""

    def __init__(self, problem: Problem) -> None:
        self.arrays: list[NDArray[Any]] = []
        self._problem = problem
        self._known: dict[int, int] = {}
        self._kept: list[Any] = []

    def form(self, value: Any) -> Any:
        if value is None or isinstance(value, (bool, str)) or type(value) is int:
            return value
        if type(value) is float:
            return value if math.isfinite(value) else {"float": repr(value)}
        if value is self._problem:
            return {"problem": True}
        if id(value) in self._known:
            return {"same": self._known[id(value)]}
        made = self._made(value)
        self._known[id(value)] = len(self._kept)
        self._kept.append(value)  # so that no other value gets its id
        return made

    def _made(self, value: Any) -> dict[str, Any]:
        if isinstance(value, (np.ndarray, np.generic)) and value.dtype.kind in "biufcSU":
            self.arrays.append(np.asarray(value))
            return {"array" if isinstance(value, np.ndarray) else "number": len(self.arrays) - 1}
        if dataclasses.is_dataclass(value) and not isinstance(value, type):
            names = [field.name for field in dataclasses.fields(value)]
            return {"class": _named(type(value)), "fields": {name: self.form(getattr(value, name)) for name in names}}
        if isinstance(value, tuple) and hasattr(value, "_fields"):
            return {"class": _named(type(value)), "items": [self.form(item) for item in value]}
        if type(value) in (tuple, list):
            return {type(value).__name__: [self.form(item) for item in value]}
        if isinstance(value, Mapping):
            return {"mapping": [[self.form(key), self.form(item)] for key, item in value.items()]}
        raise ConfigError(f"a state cannot be saved that holds {_named(type(value))}: allowed is plain data")


class _Reader:
    """Turns JSON and arrays back into values."""

    def __init__(self, arrays: Mapping[str, NDArray[Any]], problem: Problem, planner: Planner) -> None:
        self._arrays = arrays
        self._problem = problem
        self._packages = {c.__module__.partition(".")[0] for c in type(planner).__mro__ if issubclass(c, Planner)}
        self._kept: list[Any] = []

    def value(self, form: Any) -> Any:
        if not isinstance(form, dict):
            return form
        if "float" in form:
            return float(form["float"])
        if "problem" in form:
            return self._problem
        if "same" in form:
            return self._kept[form["same"]]
        made = self._made(form)
        self._kept.append(made)
        return made

    def _made(self, form: dict[str, Any]) -> Any:
        if "array" in form:
            return self._arrays[str(form["array"])]
        if "number" in form:
            return self._arrays[str(form["number"])][()]
        if "mapping" in form:
            return {self.value(key): self.value(item) for key, item in form["mapping"]}
        if "tuple" in form:
            return tuple(self.value(item) for item in form["tuple"])
        if "list" in form:
            return [self.value(item) for item in form["list"]]
        kind = self._kind(form["class"])
        if "items" in form:
            return tuple.__new__(kind, [self.value(item) for item in form["items"]])
        made = object.__new__(kind)
        fields = {name: self.value(item) for name, item in form["fields"].items()}
        if set(fields) != {field.name for field in dataclasses.fields(kind)}:
            raise TypeError(f"{form['class']} has other fields by now")
        for name, item in fields.items():
            object.__setattr__(made, name, item)
        return made

    def _kind(self, name: str) -> type[Any]:
        """Return the class of plain data of this name: one of the planner's own package or of pathloom."""
        module, _, inner = name.partition(":")
        if module.partition(".")[0] in self._packages and module in sys.modules:
            found: Any = sys.modules[module]
            for part in inner.split("."):
                found = vars(found).get(part)
            if isinstance(found, type) and (dataclasses.is_dataclass(found) or issubclass(found, tuple)):
                return found
        raise TypeError(f"the planner knows no data of the kind {name!r}")


def _named(kind: type) -> str:
    return f"{kind.__module__}:{kind.__qualname__}"
