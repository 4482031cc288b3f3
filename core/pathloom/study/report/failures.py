"""Failures: which runs found no path, and why."""

from collections.abc import Iterable
from dataclasses import dataclass

from pathloom.study.row import Row

MOST = 100
"""Kinds of failure that are listed."""


@dataclass(frozen=True)
class Failure:
    """Runs of a variant that ended alike."""

    variant: str
    status: str
    error: str
    count: int
    example: Row
    """The first of them."""
    maps: int


def failures(rows: Iterable[Row]) -> tuple[list[Failure], int]:
    """Return the runs without a path, those of one cause together, and how many there are of all kinds."""
    found: dict[tuple[str, str, str], list[Row]] = {}
    total = 0
    for row in rows:
        if row.status != "found":
            total += 1
            found.setdefault((row.variant, row.status, row.error or ""), []).append(row)
    listed = [Failure(*key, len(like), like[0], len({row.map for row in like})) for key, like in found.items()]
    return sorted(listed, key=lambda it: -it.count)[:MOST], total
