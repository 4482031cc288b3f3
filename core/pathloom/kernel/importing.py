"""Importing what somebody else wrote: it may hang, print, or be written for another pathloom."""

import os
import sys
import threading
import traceback
import types
from collections.abc import Callable, Iterable
from contextlib import redirect_stdout
from importlib.metadata import version
from io import StringIO
from typing import TypeVar

from pathloom.errors import PluginError

T = TypeVar("T")

LIMIT = 30.0
"""Seconds that a plugin may take to be imported, where PATHLOOM_PLUGIN_SECONDS says nothing else.

A first import may compile kernels."""


def time_limit() -> float:
    """Return the seconds that a plugin may take to be imported."""
    try:
        return max(0.0, float(os.environ["PATHLOOM_PLUGIN_SECONDS"]))
    except (KeyError, ValueError):
        return LIMIT


def within_limits(work: Callable[[], T]) -> tuple[T, str]:
    """Return what a function returns, and what it printed on standard output.

    The function runs in a thread of its own. Nothing can stop it from outside: when
    the time is over it is left alone, and ends with the process.

    Raises
    ------
    PluginError
        If the time is over; the message says which line it has come to.
    """
    results: list[T] = []
    errors: list[BaseException] = []

    def run() -> None:
        try:
            results.append(work())
        except BaseException as error:
            errors.append(error)

    thread, printed, limit = threading.Thread(target=run, daemon=True), StringIO(), time_limit()
    with redirect_stdout(printed):
        thread.start()
        thread.join(limit)
    if errors:
        raise errors[0]
    if not results:
        raise PluginError(
            f"is still not imported after {limit:g} s{_where(thread)} (PATHLOOM_PLUGIN_SECONDS allows another time)"
        )
    return results[0], printed.getvalue()


def _where(thread: threading.Thread) -> str:
    """Return the line that a thread has come to, leaving the import system aside."""
    frame = sys._current_frames().get(thread.ident or 0)
    lines = [line for line in traceback.extract_stack(frame) if not line.filename.startswith("<frozen")]
    if frame is None or not lines:
        return ""
    return f", at {lines[-1].filename}:{lines[-1].lineno}: {lines[-1].line}"


def misfit(requirements: Iterable[str]) -> str:
    """Return which pathloom a distribution with these requirements is built for, if it is not the one installed."""
    from packaging.requirements import InvalidRequirement, Requirement
    from packaging.utils import canonicalize_name

    for text in requirements:
        try:
            requirement = Requirement(text)
        except InvalidRequirement:
            continue
        if canonicalize_name(requirement.name) != "pathloom" or (
            requirement.marker and not requirement.marker.evaluate()
        ):
            continue
        if not requirement.specifier.contains(installed := version("pathloom"), prereleases=True):
            return f"is built for pathloom {requirement.specifier}; installed is {installed}"
    return ""


def cause(error: BaseException) -> str:
    """Return in words why an import failed."""
    lacks = f"; pathloom {version('pathloom')} has no such name" if _asks_pathloom(error) else ""
    return f"does not import: {type(error).__name__}: {error}{lacks}"


def _asks_pathloom(error: BaseException) -> bool:
    """Say whether something was imported, or looked up, that pathloom does not have."""
    name = ""
    if isinstance(error, ImportError):
        name = error.name or ""
    elif isinstance(error, AttributeError) and isinstance(error.obj, types.ModuleType):
        name = error.obj.__name__
    return name.partition(".")[0] == "pathloom"
