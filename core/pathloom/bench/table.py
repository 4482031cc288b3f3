"""Tables of what was measured: for the terminal, in Markdown, and as one JSON document."""

import platform
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np

from pathloom.bench.measure import Limits, Run
from pathloom.bench.peer import Peer

if TYPE_CHECKING:
    from rich.table import Table

HEADS = (
    "maps",
    "method",
    "found",
    "mean gap %",
    "worst",
    "in the plane",
    "ms CPU",
    "ms wall",
    "prepared ms",
    "remarks",
)
NOT_INSTALLED = "not installed"


@dataclass(frozen=True)
class Row:
    """One method on one group of maps."""

    group: str
    who: str
    runs: int
    found: int
    """Runs that ended with a valid path, and within the target where there is one."""
    mean_gap: float | None
    worst_gap: float | None
    """Shares, over the runs that found a path."""
    exact: bool
    """Whether all gaps are to exact optima; else they are at most what is said."""
    over_plane: float | None
    """Mean share above the shortest way in the plane, which is below zero for nobody."""
    cpu: float
    seconds: float
    prepared: float
    """Medians over all runs, in seconds."""
    faults: dict[str, int]
    callback: float | None
    """Mean share of the time spent in tests of states and motions."""


def rows_of(runs: Iterable[Run]) -> list[Row]:
    """Return one row for each method on each group, in the order of the runs."""
    together: dict[tuple[str, str], list[Run]] = {}
    for run in runs:
        together.setdefault((run.group, run.who), []).append(run)
    groups = list(dict.fromkeys(group for group, _ in together))
    ordered = sorted(together.items(), key=lambda item: groups.index(item[0][0]))
    return [_row(group, who, found) for (group, who), found in ordered]


def cells(row: Row) -> tuple[str, ...]:
    """Return a row as text."""
    most = "" if row.exact else "≤ "
    gaps = [_percent(row.mean_gap, most), _percent(row.worst_gap, most), _percent(row.over_plane)]
    times = [_milliseconds(seconds) for seconds in (row.cpu, row.seconds, row.prepared)]
    remarks = [f"{n} × {fault}" for fault, n in row.faults.items()]
    if row.callback is not None:
        remarks.append(f"{100 * row.callback:.0f} % of it in our motion test")
    return row.group, row.who, f"{row.found} of {row.runs}", *gaps, *times, "; ".join(remarks)


def table(rows: Sequence[Row]) -> "Table":
    """Return the table for a terminal, a rule between groups."""
    from rich.table import Table

    shown = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for head in HEADS:
        shown.add_column(head, justify="left" if head in ("maps", "method", "remarks") else "right")
    before = ""
    for row in rows:
        group, *rest = cells(row)
        if row.group == before:
            group = ""
        elif before:
            shown.add_section()
        before = row.group
        shown.add_row(group, *rest)
    return shown


def markdown(heads: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    return "\n".join("| " + " | ".join(line) + " |" for line in (heads, ["---"] * len(heads), *lines))


def methods(peers: Iterable[Peer]) -> list[tuple[str, str, str]]:
    """Return for each method its name, its package's version, and how it is used."""
    return [(p.name, NOT_INSTALLED if (v := p.version()) is None else f"{p.distribution} {v}", p.about) for p in peers]


def document(runs: Sequence[Run], peers: Iterable[Peer], limits: Limits, corners: str) -> dict[str, Any]:
    """Return all that was measured, as plain values for JSON."""
    return {
        "schema": "pathloom.bench/1",
        "corners": corners,
        "limits": asdict(limits),
        "versions": {name: version(name) for name in ("pathloom", "numpy", "numba")}
        | {"python": platform.python_version(), "platform": platform.platform()},
        "methods": [dict(zip(("name", "version", "about"), method, strict=True)) for method in methods(peers)],
        "rows": [asdict(row) for row in rows_of(runs)],
        "runs": [asdict(run) for run in runs],
    }


def _row(group: str, who: str, runs: Sequence[Run]) -> Row:
    gaps = [run.gap for run in runs if run.gap is not None]
    over_plane = [run.over_plane for run in runs if run.over_plane is not None]
    shares = [run.callback for run in runs if run.callback is not None]
    cpu, seconds, prepared = np.median([(run.cpu, run.seconds, run.prepared) for run in runs], axis=0)
    return Row(
        group=group,
        who=who,
        runs=len(runs),
        found=sum(not run.fault for run in runs),
        mean_gap=float(np.mean(gaps)) if gaps else None,
        worst_gap=max(gaps, default=None),
        exact=all(run.exact for run in runs),
        over_plane=float(np.mean(over_plane)) if over_plane else None,
        cpu=float(cpu),
        seconds=float(seconds),
        prepared=float(prepared),
        faults=dict(Counter(_kind(run.fault) for run in runs if run.fault).most_common()),
        callback=float(np.mean(shares)) if shares else None,
    )


def _kind(fault: str) -> str:
    """Return a fault without the place where it lies, so that like ones are counted together."""
    for cut in (" between ", " near ", " at "):
        if not fault.startswith("raised "):
            fault = fault.partition(cut)[0]
    return "missed the target" if fault.startswith("ended ") else fault


def _percent(share: float | None, most: str = "") -> str:
    return "–" if share is None else f"{most}{round(100 * share, 2) + 0.0:.2f}"


def _milliseconds(seconds: float) -> str:
    return f"{1000 * seconds:.3g}" if seconds < 0.1 else f"{1000 * seconds:.0f}"
