"""The summary of a study: success rates, spreads, comparisons, verdicts."""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from html import escape
from typing import Any

import numpy as np

from pathloom.errors import ConfigError
from pathloom.naming import closest
from pathloom.study.row import STATUSES, Row
from pathloom.study.statistics.comparing import Comparison, Settings, compare
from pathloom.study.statistics.describing import Rate, Spread, spreads
from pathloom.study.statistics.metrics import GAPS, METRICS, SUCCESS, USUAL, Metric, metric
from pathloom.study.statistics.runs import FOUND, UNREACHABLE, Runs
from pathloom.study.statistics.verdicts import Verdict, verdicts
from pathloom.study.table import html

SCHEMA = "pathloom.study-summary/1"


@dataclass(frozen=True)
class Cell:
    """The runs of one variant on one instance."""

    variant: str
    instance: str
    rate: Rate
    spreads: dict[str, Spread]
    """For each metric."""


@dataclass(frozen=True)
class Overall:
    """The runs of one variant on all instances."""

    variant: str
    runs: int
    statuses: dict[str, int]
    """How many runs ended how; what never came about is left out."""
    rate: Rate
    """Over all runs, except those on instances that have no path."""
    medians: dict[str, float | None]
    """For each metric the median over the instances of the medians over runs, failures worst; None among failures."""


@dataclass(frozen=True)
class Summary:
    """What a study shows."""

    variants: tuple[str, ...]
    instances: tuple[str, ...]
    runs: int
    metrics: tuple[str, ...]
    settings: Settings
    overall: tuple[Overall, ...]
    cells: tuple[Cell, ...]
    comparisons: tuple[Comparison, ...]
    verdicts: tuple[Verdict, ...]
    notes: tuple[str, ...]
    """What a reader of the numbers ought to know."""

    def cell(self, variant: str, instance: str) -> Cell:
        """Return the runs of one variant on one instance."""
        return next(cell for cell in self.cells if (cell.variant, cell.instance) == (variant, instance))

    def comparison(self, name: str) -> Comparison:
        """Return the comparison in one metric."""
        return next(it for it in self.comparisons if it.metric.name == name)

    def _repr_html_(self) -> str:
        """Return medians and success rates by variant, and the verdicts, for notebooks."""
        shown = [METRICS[name] for name in self.metrics if name != SUCCESS.name]
        rows = (
            (it.variant, f"{it.rate.found} of {it.rate.runs}", *(m.number(it.medians.get(m.name)) for m in shown))
            for it in self.overall
        )
        heads = ("variant", "found", *(metric.head for metric in shown))
        said = "".join(f"<li>{escape(verdict.text)}</li>" for verdict in self.verdicts)
        return html(heads, rows, f"medians over {len(self.instances)} maps") + f"<ul>{said}</ul>"

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON document, schema ``pathloom.study-summary/1``."""
        document = {"schema": SCHEMA, **asdict(self)}
        for cell, mine in zip(document["cells"], self.cells, strict=True):
            cell["rate"]["share"] = mine.rate.share
        for overall, whole in zip(document["overall"], self.overall, strict=True):
            overall["rate"]["share"] = whole.rate.share
        document["metrics"] = {name: asdict(METRICS[name]) for name in self.metrics}
        for comparison in document["comparisons"]:
            comparison["metric"] = comparison["metric"]["name"]
        return document


def summary(
    rows: Iterable[Row],
    *,
    metrics: Sequence[str] | None = None,
    baseline: str | None = None,
    variants: Sequence[str] | None = None,
    alpha: float = 0.05,
    resamples: int = 1000,
    seed: int = 0,
) -> Summary:
    """Summarise the runs of a study.

    Parameters
    ----------
    rows
        Read once, one after the other.
    metrics
        Names of ``METRICS``; else success rate, the sharpest known gap, and what is usual and known.
    baseline
        The variant that all others are compared with; else all pairs are.
    variants
        Order of the variants; else that in which they first come.
    alpha
        Level of all tests, after Holm's correction within a metric.
    resamples, seed
        Of the bootstrap: the same rows and seed give the same summary.

    Raises
    ------
    ConfigError
        If there are no rows, or a metric or variant is unknown.
    """
    runs = Runs.read(rows)
    if not len(runs):
        raise ConfigError("summary: the study has no runs yet")
    if variants is not None:
        runs = runs.ordered(variants)
    if baseline is not None and baseline not in runs.variants:
        raise ConfigError(f"baseline: no variant is called {baseline!r}; {closest(baseline, runs.variants)}")
    settings = Settings(alpha=alpha, resamples=resamples, seed=seed, baseline=baseline)
    asked = _asked(runs, metrics)
    tables = {it.name: runs.table(runs.costs(it)) for it in asked}
    comparisons: tuple[Comparison, ...] = ()
    if len(runs.variants) > 1:
        comparisons = tuple(compare(runs.variants, tables[it.name], it, settings) for it in asked)
    cells = _cells(runs, asked, tables)
    return Summary(
        runs.variants,
        runs.instances,
        len(runs),
        tuple(it.name for it in asked),
        settings,
        tuple(_overall(runs, asked, cells)),
        cells,
        comparisons,
        tuple(verdict for it in comparisons for verdict in verdicts(it, alpha)),
        tuple(_notes(runs, asked, comparisons)),
    )


def _asked(runs: Runs, names: Sequence[str] | None) -> list[Metric]:
    """Return the metrics that are asked for, or the usual ones, as far as any run knows them."""
    if names is None:
        gap = next((name for name in GAPS if runs.knows(METRICS[name])), None)
        names = [SUCCESS.name, *([gap] if gap else []), *USUAL]
    return [it for it in map(metric, dict.fromkeys(names)) if runs.knows(it)]


def _cells(runs: Runs, asked: Sequence[Metric], tables: dict[str, Any]) -> tuple[Cell, ...]:
    success = runs.table(runs.costs(SUCCESS)).reshape(len(runs.variants) * len(runs.instances), -1)
    found, counted = (success == SUCCESS.sign).sum(axis=1).tolist(), (~np.isnan(success)).sum(axis=1).tolist()
    described = {it.name: spreads(tables[it.name].reshape(len(found), -1), it) for it in asked if it is not SUCCESS}
    rates = {pair: Rate.of(*pair) for pair in set(zip(found, counted, strict=True))}
    places = [(variant, instance) for variant in runs.variants for instance in runs.instances]
    return tuple(
        Cell(*place, rates[found[i], counted[i]], {name: column[i] for name, column in described.items()})
        for i, place in enumerate(places)
    )


def _overall(runs: Runs, asked: Sequence[Metric], cells: Sequence[Cell]) -> Iterable[Overall]:
    wide = len(runs.instances)
    for number, variant in enumerate(runs.variants):
        mine = runs.variant == number
        counts = np.bincount(runs.status[mine], minlength=len(STATUSES)).tolist()
        statuses: dict[str, int] = {status: count for status, count in zip(STATUSES, counts, strict=True) if count}
        own = cells[number * wide : (number + 1) * wide]
        medians = {it.name: _middle([cell.spreads[it.name] for cell in own], it) for it in asked if it is not SUCCESS}
        rate = Rate.of(counts[FOUND], sum(counts) - counts[UNREACHABLE])
        yield Overall(variant, int(mine.sum()), statuses, rate, medians)


def _middle(spread: Sequence[Spread], it: Metric) -> float | None:
    costs = [np.inf if s.median_of_all is None else it.sign * s.median_of_all for s in spread if s.known or s.missing]
    middle = float(np.median(costs)) if costs else np.inf
    return it.sign * middle if np.isfinite(middle) else None


def _notes(runs: Runs, asked: Sequence[Metric], comparisons: Sequence[Comparison]) -> Iterable[str]:
    yield (
        "A run without a path counts in the success rate; in every test it ranks worst; quartiles, best and worst are "
        "of the runs that have a value."
    )
    tests = {pair.test for it in comparisons for pair in it.pairs}
    if "signed rank" in tests:
        yield "Tests compare medians over runs, map by map; p is corrected by Holm within each metric, not across."
    elif tests:
        maps = "this map" if len(runs.instances) == 1 else f"these {len(runs.instances)} maps"
        yield f"With so few instances tests compare runs, within each map: what is shown holds for {maps}."
    per_cell = np.bincount(runs.variant * len(runs.instances) + runs.instance,
                           minlength=len(runs.variants) * len(runs.instances))  # fmt: skip
    if per_cell.min() != per_cell.max():
        yield f"The study is uneven: from {per_cell.min()} to {per_cell.max()} runs a variant and instance."
    nowhere = int((runs.status == UNREACHABLE).sum())
    if nowhere:
        yield f"{nowhere} runs on instances that have no path are left out."
    for it in asked:
        unknown = int(np.isnan(runs.costs(it)).sum()) - nowhere
        if unknown:
            yield f"{it.label}: {unknown} runs have no value, for a reason other than failure, and are left out."
        if it.name == "fitness":
            yield "Fitness compares only variants with the same objectives and weights."
