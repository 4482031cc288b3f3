"""Deprecation: what has got a new name, or goes, works on for a version and says so."""

import functools
import warnings
from collections.abc import Callable
from typing import NamedTuple, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


class PathloomDeprecationWarning(FutureWarning):
    """Something is used that the next version will not have. Shown by default: it concerns whoever runs the program."""


class Renamed(NamedTuple):
    """What has taken a name's place, and since which version."""

    new: str
    since: str


def deprecated(since: str, instead: str = "") -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Return a decorator that lets a function work on, and warns whoever calls it.

    Parameters
    ----------
    since
        The version that is the first to warn; the one after it may be without the function.
    instead
        What to use in its place.
    """

    def mark(function: Callable[P, R]) -> Callable[P, R]:
        @functools.wraps(function)
        def warned(*args: P.args, **keywords: P.kwargs) -> R:
            warn(f"{function.__name__}()", since, instead, depth=3)
            return function(*args, **keywords)

        return warned

    return mark


def warn(what: str, since: str, instead: str = "", *, depth: int = 2) -> None:
    """Warn that something is going; ``depth``: how many calls up it was used."""
    use = f"; use {instead}" if instead else ""
    message = f"{what} is deprecated since {since} and will be gone in the next version{use}"
    warnings.warn(message, PathloomDeprecationWarning, stacklevel=depth)
