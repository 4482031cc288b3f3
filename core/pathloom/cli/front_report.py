"""How ``pareto`` shows a front in the terminal."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from pathloom.fronts import ParetoResult, Placement
from pathloom.fronts.thinning import thinned

ROWS = 12
"""Members of a front that are shown."""


def show(result: ParetoResult, console: Console) -> None:
    """Print a picture of the suggested path, a table of the front, its indicators, and who stands beside it."""
    if result.found:
        _picture(result, console)
        console.print(_front(result))
        if len(result) > ROWS:
            console.print(f"{ROWS} of {len(result)} trade-offs; --json and --out give all.")
        if result.against:
            console.print(_against(result))
    table = Table(box=None, show_header=False, pad_edge=False)
    for name, value in _rows(result):
        table.add_row(name, value)
    console.print(table)


def notes(result: ParetoResult, unwritten: str | None) -> Iterator[str]:
    """Yield what a reader of the numbers ought to know."""
    if not result.found:
        yield f"no path: {result.reason}"
    elif result.reason:
        yield result.reason
    if result.found and result.interrupted:
        yield "interrupted; this is the front so far"
    if unwritten:
        yield f"{unwritten}: not written, for there is no front"


def _picture(result: ParetoResult, console: Console) -> None:
    """Print the map with the path of the preferred member, or of the knee."""
    from pathloom.draw import picture

    problem, choice = result.path_problem, result.choice
    if problem is None or choice is None:
        return
    shown = choice.knee if choice.preferred is None else choice.preferred
    console.print(
        picture(
            problem.grid.occupied,
            closed=problem.context.occupied if problem.radius else None,
            start=problem.ends[0],
            goal=problem.ends[1],
            path=result.paths[shown],
            width=min(console.width, 100),
        )
    )


def _front(result: ParetoResult) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("", justify="right")
    for label in result.objectives:
        table.add_column(label, justify="right")
    table.add_column("")
    for i in thinned(result, ROWS):
        marks = ", ".join(_marks(result, i))
        style = "bold" if result.choice and i in (result.choice.knee, result.choice.preferred) else None
        table.add_row(str(i), *map(number, result.values[i].tolist()), marks, style=style)
    return table


def _marks(result: ParetoResult, i: int) -> Iterator[str]:
    """Yield what is special about a member."""
    if result.choice is not None and i == result.choice.preferred:
        yield "preferred"
    if result.choice is not None and i == result.choice.knee:
        yield "knee"
    if len(result) > 1:
        for label, column in zip(result.objectives, result.values.T, strict=True):
            if i == int(np.argmin(column)) and np.ptp(column) > 0:
                yield f"least {label}"


def _against(result: ParetoResult) -> Table:
    """Return one line for each planner and kind of path: medians where there are several seeds."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for head in ("against", "path"):
        table.add_column(head)
    for label in result.objectives:
        table.add_column(label, justify="right")
    table.add_column("it is")
    table.add_column("worse by")
    for planner in dict.fromkeys(rival.planner for rival in result.against):
        rivals = [rival for rival in result.against if rival.planner == planner]
        placements = [placement for rival in rivals for placement in rival.placements]
        if not placements:
            table.add_row(planner, "none found", *("" for _ in result.objectives), rivals[0].status, "")
        for which in ("unrefined", "refined"):
            placed = [placement for placement in placements if placement.which == which]
            if placed:
                kind = which if all(p.cells for p in placed) else f"{which}, any angle"
                table.add_row(planner, kind, *map(number, _median(p.values for p in placed)), *_said(placed, rivals))
    return table


def _said(placed: Sequence[Placement], rivals: Sequence[Any]) -> tuple[str, str]:
    """Return the verdicts, counted where there are several, and how much worse than a member the path is."""
    excess = [p.excess for p in placed if p.excess]
    worse = ", ".join(map(number, _median(excess))) if excess else ""
    if len(rivals) == 1:
        return placed[0].verdict, worse
    counted = Counter(placement.verdict for placement in placed)
    return ", ".join(f"{verdict} {times}/{len(rivals)}" for verdict, times in sorted(counted.items())), worse


def _median(rows: Any) -> list[float]:
    return np.median(np.array(list(rows)), axis=0).tolist()  # type: ignore[no-any-return]


def _rows(result: ParetoResult) -> Iterator[tuple[str, str]]:
    said, found = result.problem, result.indicators
    radius = f", radius {said['radius']:g}" if said["radius"] else ""
    yield "map", f"{said['map']}, {said['height']} × {said['width']}, corners {said['corners']}{radius}"
    many = f", {len(result)} trade-off{'s' * (len(result) != 1)}" if result.found else ""
    yield "planner", f"{result.planner}, seed {result.seed}: {result.status}{many}"
    if found:
        yield "hypervolume", f"{found['hypervolume']:.6g} up to ({', '.join(map(number, found['reference_point']))})"
        yield "ideal", ", ".join(map(number, found["ideal"]))
        yield "nadir", ", ".join(map(number, found["nadir"]))
    if "exact_size" in found:
        ratio = found["hypervolume_ratio"]
        share = "no hypervolume" if ratio is None else f"hypervolume ratio {ratio:.6f}"
        gaps = f"IGD+ {found['igd_plus']:.4g}, additive ε {found['additive_epsilon']:.4g}"
        yield "exact front", f"{found['exact_found']} of {found['exact_size']} found, {share}, {gaps}"
    if result.choice is not None and result.choice.preference:
        yield "preference", ", ".join(f"{k} {v:.3g}" for k, v in result.choice.preference.items())
    spent = result.budget
    if spent:
        phases = ", ".join(f"{k} {v:.3f}" for k, v in spent["phases"].items())
        yield "effort", f"{spent['generations']} generations, {spent['evaluations']} evaluations"
        beside = ", ".join(f"{k} {v:.3f}" for k, v in spent.get("references", {}).items())
        yield "time", f"{spent['seconds']:.3f} s ({phases})" + (f"; {beside}" if beside else "")
        if spent["counts"]:
            yield "counted", ", ".join(f"{k} {v}" for k, v in spent["counts"].items())


def number(value: float) -> str:
    """Return a whole number as one, any other with four digits after the point."""
    return f"{value + 0.0:.0f}" if value == round(value) and abs(value) < 1e15 else f"{value:.4f}"
