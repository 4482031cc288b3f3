"""The report of a study: what was asked, what came of it, and how it was done, in one HTML file."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import tomli_w
from markupsafe import Markup

from pathloom.errors import ConfigError
from pathloom.study.report.cases import MOST as MOST_CASES
from pathloom.study.report.cases import cases
from pathloom.study.report.failures import failures
from pathloom.study.report.figures import figures, sharpest
from pathloom.study.report.inlining import variables
from pathloom.study.report.methods import changes, entries, methods, question, said_of
from pathloom.study.statistics.metrics import METRICS, SUCCESS, Metric
from pathloom.study.statistics.summary import Cell, Summary, summary
from pathloom.study.statistics.verdicts import Verdict
from pathloom.study.study import Study

MOST_SAID = 12
"""Sentences that stand in the open; the others are a click away."""
MOST_PAIRS = 60
"""Pairs of a metric's table in the open."""
MOST_MAPS = 100
"""Maps of the table of maps."""
MOST_CONFIGS = 60
"""Variants whose configs are written out."""


def report(study: Study, *, baseline: str | None = None, alpha: float = 0.05) -> str:
    """Return a study as a page in HTML, complete in itself.

    Parameters
    ----------
    baseline
        The variant that all others are compared with; by default the base of an
        ablation or of tuning, and of a comparison all pairs.
    alpha
        Level of the tests.

    Raises
    ------
    ConfigError
        If the study has no runs yet, or no variant has the name.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    found = summarised(study, baseline, alpha)
    rows = study.rows()
    metric = sharpest(found)
    failed, count = failures(rows)
    light, dark = variables()
    drawn = list(cases(study, found, rows, metric))
    pages = Environment(
        loader=PackageLoader("pathloom.study.report"), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True, keep_trailing_newline=True,
    )  # fmt: skip
    pages.filters |= {"joints": joints, "units": lambda text: text.replace(" %", "\N{NO-BREAK SPACE}%")}
    return pages.get_template("report.html").render(
        study=study,
        name=Path(study.name).name,
        status=study.status,
        facts=study.facts,
        question=question(study),
        source=said_of(study, "source").rstrip("."),
        changes=changes(study),
        summary=found,
        statuses=[s for s in ("failed", "timeout", "crashed") if any(s in it.statuses for it in found.overall)],
        main=metric,
        shown=[METRICS[name] for name in found.metrics if name != SUCCESS.name],
        lead=_lead(found),
        verdicts=_in_order(found, metric),
        most_pairs=MOST_PAIRS,
        figures=list(figures(study, found, rows)),
        cases=drawn,
        cases_left=max(0, len(found.variants) - MOST_CASES),
        maps=_maps(study, found, metric),
        maps_left=max(0, len(found.instances) - MOST_MAPS),
        columns=_columns(found, metric),
        failures=failed,
        failed=count,
        methods=(said := methods(study, found)),
        bibtex=entries(said.works),
        configs={n: tomli_w.dumps({"planner": c}) for n, c in list(study.variants.items())[:MOST_CONFIGS]},
        light=light,
        dark=dark,
    )


def summarised(study: Study, baseline: str | None = None, alpha: float = 0.05) -> Summary:
    """Return the summary that a report is about: an ablation against its base, a comparison all pairs."""
    begun = [variant for variant, counts in study.status.variants.items() if counts]
    if not begun:
        raise ConfigError(f"{study.name}: the study has no runs yet")
    if baseline is None and study.kind in ("ablate", "tune") and next(iter(study.variants)) in begun:
        baseline = next(iter(study.variants))
    return summary(study.each(), baseline=baseline, variants=begun, alpha=alpha)


def _lead(found: Summary) -> str:
    """Return what the tests say, in one sentence."""
    shown = list(dict.fromkeys(METRICS[it.metric].label for it in found.verdicts if it.shown))
    if not shown:
        return "No effect was shown in any metric; what could have been seen stands beside each."
    return f"Shown: an effect on {' and '.join([', '.join(shown[:-1]), shown[-1]]) if len(shown) > 1 else shown[0]}."


def _in_order(found: Summary, metric: Metric) -> tuple[list[Verdict], list[Verdict]]:
    """Return what the tests say: of success and the main metric, and what was shown; then all the rest."""
    first = (SUCCESS.name, metric.name)
    ordered = sorted(
        found.verdicts,
        key=lambda it: (first.index(it.metric) if it.metric in first else len(first), not it.shown),
    )
    said = sum(it.metric in first or it.shown for it in ordered)
    return ordered[: min(said, MOST_SAID)], ordered[min(said, MOST_SAID) :]


def joints(name: str) -> Markup:
    """Return a name that may be broken where it has joints."""
    return Markup("<wbr>").join(re.findall(r"[^=/,+_]*[=/,+_]*", name))


def _columns(found: Summary, metric: Metric) -> list[Metric]:
    """Return the metrics of the table of maps."""
    wanted = (metric.name, "length", "turns", "evaluations_to_first", "evaluations_to_one_percent")
    return [METRICS[name] for name in dict.fromkeys(wanted) if name in found.metrics and name != SUCCESS.name]


def _maps(study: Study, found: Summary, metric: Metric) -> list[dict[str, Any]]:
    """Return the maps, each with what is known of it and the cells of its variants."""
    known = study.instances
    by_map: dict[str, list[Cell]] = {name: [] for name in found.instances[:MOST_MAPS]}
    for cell in found.cells:
        if cell.instance in by_map:
            by_map[cell.instance].append(cell)
    return [
        {
            "name": name,
            "size": f"{grid.height} × {grid.width}",
            "occupied": grid.occupied.mean(),
            "known": known[name],
            "cells": mine,
            "best": _best(mine, metric),
        }
        for name, mine in by_map.items()
        for grid in [study.problem(name).grid]
    ]


def _best(cells: Sequence[Cell], metric: Metric) -> float | None:
    """Return the best median of a map, if not all are alike."""
    values = [cell.spreads[metric.name].median_of_all for cell in cells] if metric is not SUCCESS else []
    known = [value for value in values if value is not None]
    if not known or (len(set(known)) == 1 and len(known) == len(values)):
        return None
    return metric.sign * min(metric.sign * value for value in known)
