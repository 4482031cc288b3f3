"""Cases: the best and the worst run of each variant, on its map."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from pathloom.exact import any_angle_search
from pathloom.study.report.pictures import picture
from pathloom.study.row import Row
from pathloom.study.statistics.metrics import Metric
from pathloom.study.statistics.summary import Summary
from pathloom.study.study import Study

MOST = 6
"""Variants whose cases are drawn."""
LARGEST = 40_000
"""Cells of a map beyond which its shortest path is not looked for again."""


@dataclass(frozen=True)
class Case:
    """A run on its map."""

    which: str
    """``best`` or ``worst``."""
    variant: str
    row: Row
    picture: Markup
    said: str


def cases(study: Study, summary: Summary, rows: Sequence[Row], metric: Metric) -> Iterator[Case]:
    """Yield the best and the worst run of the first variants; a run without a path is worse than any."""
    by_variant: dict[str, list[Row]] = {name: [] for name in summary.variants[:MOST]}
    for row in rows:
        if row.variant in by_variant and row.status != "unreachable":
            by_variant[row.variant].append(row)
    name = metric.name if metric.name != "success" else "length"

    def cost(row: Row) -> tuple[bool, float, float]:
        value = getattr(row, name)
        return value is None, 0.0 if value is None else metric.sign * value, row.length or 0.0

    for variant, mine in by_variant.items():
        if not mine:
            continue
        best, worst = min(mine, key=cost), max(mine, key=cost)
        yield _case(study, "best", variant, best, metric)
        if worst is not best:
            yield _case(study, "worst", variant, worst, metric)


def _case(study: Study, which: str, variant: str, row: Row, metric: Metric) -> Case:
    problem = study.problem(row)
    path = study.path(row)
    optimum = any_angle_search(problem).path if problem.grid.occupied.size <= LARGEST else None
    if path is None:
        said = f"no path: {row.status}"
    else:
        value = getattr(row, metric.name, None)
        said = f"{row.length:.3f} cells" if row.length is not None else ""
        if metric.name not in ("length", "success") and value is not None:
            said += f", {metric.label} {metric.show(value)}".replace(" %", "\N{NO-BREAK SPACE}%")
    label = f"{which} run of {variant}: map {row.map}, seed {row.seed}, {said}"
    return Case(which, variant, row, picture(problem, path, optimum, label), said)
