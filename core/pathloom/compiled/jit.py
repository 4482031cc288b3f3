"""Decorators that compile a kernel for one signature, and tell who listens how far that is.

Signatures are explicit and integers are always int64: each kernel is compiled
once, when its family is loaded, and never again for another type. Where no
cache folder can be written the kernels are compiled in every process; nothing
else changes.
"""

import importlib.util
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

Kernel = Callable[..., Any]

USUAL = ("random", "rows", "segments", "measures", "insertion", "exchange", "identity")
"""Modules that most runs load: their kernels make up the work that is announced, with the family asked for."""

Listener = Callable[[int, int], None]
"""Called after a kernel was compiled (not: taken from the cache), with the number of kernels done and in all."""

_lock = threading.RLock()
_listeners: list[Listener] = []
_progress = {"done": 0, "all": 0}
_seconds = 0.0


def seconds_loading() -> float:
    """Return how long this process has spent on loading families, compilation included."""
    return _seconds


@contextmanager
def loading(family: str) -> Iterator[None]:
    """Count the kernels of a family while it is loaded; one thread at a time loads."""
    global _seconds  # noqa: PLW0603 - one clock a process, under the lock
    with _lock:
        began = time.perf_counter()
        names = [f"{__package__}.{name}" for name in dict.fromkeys((*USUAL, family))]
        ahead = sum(_kernels_in(name) for name in names if name not in sys.modules)
        _progress["all"] = _progress["done"] + ahead
        try:
            yield
        finally:
            _seconds += time.perf_counter() - began


def _kernels_in(module: str) -> int:
    spec = importlib.util.find_spec(module)
    text = Path(spec.origin).read_text(encoding="utf-8") if spec and spec.origin else ""
    return text.count("\n@kernel(") + text.count("\n@part(")


@contextmanager
def listening(listener: Listener) -> Iterator[None]:
    """Tell ``listener`` of every kernel that has to be compiled meanwhile."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def _compiled(signature: str, function: Kernel) -> Kernel:
    import numba  # by far the most of what importing pathloom would take: whoever only lists plugins does without

    njit: Any = numba.njit  # its annotations leave options out
    began = time.perf_counter()
    try:
        kernel = njit(signature, cache=True, nogil=True, no_cfunc_wrapper=True)(function)
    except RuntimeError as error:
        if "cannot cache" not in str(error):
            raise
        kernel = njit(signature, nogil=True, no_cfunc_wrapper=True)(function)
    _progress["done"] += 1
    stats = getattr(kernel, "stats", None)  # a plain function where compilation is switched off
    hit = stats is not None and sum(stats.cache_hits.values()) > 0
    if stats is not None and not hit and time.perf_counter() - began > 0.02:
        for listener in _listeners:
            listener(_progress["done"], _progress["all"])
    return kernel  # type: ignore[no-any-return]


def kernel(signature: str) -> Callable[[Kernel], Kernel]:
    """Compile a function that Python calls.

    Types go by numba's short names: i8 is int64, u1 uint8, f8 float64, b1
    boolean; ``[::1]`` is a contiguous array.
    """
    return lambda function: _compiled(signature, function)


def part(signature: str) -> Callable[[Kernel], Kernel]:
    """Compile a function that only kernels call."""
    return lambda function: _compiled(signature, function)
