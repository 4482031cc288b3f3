"""Counting what happens inside operators, which remember nothing themselves.

An operator says ``count("mutation failed", 3)``; whoever runs it says
``with counting() as counts``. Threads and nested runs do not mix.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar

_counts: ContextVar[dict[str, int] | None] = ContextVar("pathloom_counts", default=None)


def count(event: str, times: int = 1) -> None:
    """Add ``times`` to the count of ``event`` in the surrounding run; outside of one, do nothing."""
    counts = _counts.get()
    if counts is not None and times:
        counts[event] = counts.get(event, 0) + int(times)


@contextmanager
def counting() -> Iterator[dict[str, int]]:
    """Collect the counts of everything that runs inside."""
    counts: dict[str, int] = {}
    token = _counts.set(counts)
    try:
        yield counts
    finally:
        _counts.reset(token)


def total(before: Mapping[str, int], more: Mapping[str, int]) -> dict[str, int]:
    """Return the sums of two counts."""
    summed = dict(before)
    for event, times in more.items():
        summed[event] = summed.get(event, 0) + times
    return summed
