"""The figures of a report: which there are, and what a reader sees in each."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from markupsafe import Markup

from pathloom.draw import study as draw
from pathloom.draw.study import Curve, Effect, Sheet
from pathloom.kernel.evaluation import Floats
from pathloom.study.report.inlining import inline
from pathloom.study.row import Row
from pathloom.study.statistics.curves import (
    Steps,
    band,
    common_grid,
    ecdf,
    performance_profile,
    reached_by_variant,
)
from pathloom.study.statistics.metrics import GAPS, METRICS, Metric
from pathloom.study.statistics.summary import Summary
from pathloom.study.study import Study

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = Sheet(width=3.7)
"""A page has its own headings, and is light or dark as its reader likes."""
MOST_HISTORIES = 4000
"""Runs whose history is read; of more, as many are taken, evenly from all variants, maps and seeds."""
HIGHEST = 0.5
"""Gap up to which convergence is drawn; first paths at random are off by hundreds of percent."""
CROWDED = 60.0
"""Ratio of the ends of an axis from which only powers of ten have room on it."""
MOST_VARIANTS = 8
"""Variants that a figure with lines shows: as many as there are colours."""


@dataclass(frozen=True)
class Plot:
    """A figure of a study: one of ``ranks``, ``spread``, ``convergence``, ``targets``, ``profile``, ``effects``."""

    name: str
    title: str
    figure: "Figure"
    caption: str

    @property
    def picture(self) -> Markup:
        """The figure within a page."""
        return inline(self.figure, self.name, f"{self.title}. {self.caption}")


def figures(study: Study, summary: Summary, rows: Sequence[Row], sheet: Sheet = PAGE) -> Iterator[Plot]:
    """Yield the figures that the runs of a study allow."""
    yield from _Figures(study, summary, rows, sheet).all()


def sharpest(summary: Summary) -> Metric:
    """Return the metric that a report is about: the sharpest gap known, else what fronts dominate, or length."""
    names = (*GAPS, "hypervolume_ratio", "hypervolume", "length", "success")
    return METRICS[next(name for name in names if name in summary.metrics)]


class _Figures:
    def __init__(self, study: Study, summary: Summary, rows: Sequence[Row], sheet: Sheet) -> None:
        self.sheet = sheet
        self.study, self.summary, self.rows = study, summary, rows
        self.metric = sharpest(summary)
        self.shown = summary.variants[:MOST_VARIANTS]
        left = len(summary.variants) - len(self.shown)
        self.rest = f" {left} more variants are in the tables." if left else ""

    def all(self) -> Iterator[Plot]:
        yield from self.critical_difference()
        yield from self.spread()
        yield from self.of_histories()
        yield from self.profile()
        yield from self.main_effects()

    def plot(self, name: str, title: str, figure: "Figure", caption: str) -> Plot:
        return Plot(name, title, figure, caption)

    def critical_difference(self) -> Iterator[Plot]:
        if not self.summary.comparisons:
            return
        comparison = self.summary.comparison(self.metric.name)
        ranking = comparison.ranking
        if ranking is None or len(ranking.ranks) > 40:
            return
        by_pairs = self.summary.settings.baseline is None
        groups = ranking.holm_groups if by_pairs else ranking.groups
        how = "pairwise tests with Holm's correction" if by_pairs else "Nemenyi's critical difference"
        figure = draw.critical_difference_figure(
            ranks={name: ranking.ranks[name] for name in self.summary.variants if name in ranking.ranks},
            groups=groups, critical=None if by_pairs else ranking.critical, sheet=self.sheet,
        )  # fmt: skip
        yield self.plot(
            "ranks",
            f"Critical difference: {self.metric.label}",
            figure,
            f"Average rank over {ranking.instances} maps, 1 is best. A bar joins variants that {how} cannot tell "
            "apart.",
        )

    def spread(self) -> Iterator[Plot]:
        name = self.metric.name
        if name == "success":
            return
        values: dict[str, list[float]] = {variant: [] for variant in self.summary.variants[:24]}
        missing = dict.fromkeys(values, 0)
        for row in self.rows:
            if row.variant in values:
                value = getattr(row, name)
                if value is not None:
                    values[row.variant].append(value)
                elif row.status != "unreachable":
                    missing[row.variant] += 1
        figure = draw.spread_figure(
            values, missing=missing, x_label=self.metric.label, percent=self.metric.unit == "%", sheet=self.sheet
        )
        yield self.plot(
            "spread",
            f"Every run: {self.metric.label}",
            figure,
            "A dot is a run; the box spans the quartiles, and the thick line is the median."
            + (" Runs without a value are counted beside the name." if any(missing.values()) else ""),
        )

    def of_histories(self) -> Iterator[Plot]:
        """Yield what is drawn of the runs' ways to their answers."""
        kept = [row for row in self.rows if row.variant in self.shown and row.status != "unreachable"]
        some = kept[:: -(-len(kept) // MOST_HISTORIES)] if kept else []
        if len(some) < len(kept):  # every n-th would meet some variants more often than others
            places = np.random.default_rng(0).choice(len(kept), MOST_HISTORIES, replace=False)
            some = [kept[i] for i in np.sort(places)]
        taken = f" From {len(some)} of {len(kept)} runs, drawn at random." if len(some) < len(kept) else ""
        optima = self._optima()
        found: list[tuple[str, float, Any, Any]] = []
        for row in some:
            history = self.study.history(row)
            if row.map in optima:
                none = np.empty(0)
                spent = none if history is None else np.maximum(history.answer_evaluations, 1)
                found.append((row.variant, optima[row.map], spent, none if history is None else history.answer_lengths))
        if not any(len(spent) for _, _, spent, _ in found):
            return
        yield self._bands(found, taken)
        yield self._targets(found, taken)

    def _optima(self) -> dict[str, float]:
        """Return by instance what gaps are measured from: the any-angle optimum, or what is known instead."""
        known = {
            name: next((v for v in (it.any_angle, it.any_angle_bound, it.grid) if v is not None), None)
            for name, it in self.study.instances.items()
        }
        return {name: value for name, value in known.items() if value}

    def _bands(self, found: Sequence[tuple[str, float, Any, Any]], taken: str) -> Plot:
        grid = common_grid([spent for _, _, spent, _ in found])
        spent = [row.evaluations for row in self.rows if row.evaluations]
        if spent:
            grid = np.unique(np.append(grid, float(np.median(spent))))
        curves = {}
        for variant in self.shown:
            mine = [(e, np.asarray(lengths) / best - 1.0) for v, best, e, lengths in found if v == variant]
            it = band(mine, grid)
            curves[variant] = Curve(it.evaluations, it.median, it.low, it.high)
        figure = draw.bands_figure(curves, y_label="gap to the optimum", percent=True, sheet=self.sheet)
        axes = figure.axes[0]
        cut = axes.get_ylim()[1] > HIGHEST
        above = f" Gaps above {100 * HIGHEST:g} % are cut off." if cut else ""
        if cut:
            axes.set_ylim(-0.02 * HIGHEST, HIGHEST)
        low, high = axes.get_xlim()
        if high > CROWDED * low:
            axes.set_xticks([10.0**k for k in range(12) if low <= 10.0**k <= high])
        return self.plot(
            "convergence",
            "Convergence",
            figure,
            "The gap of the best path so far, refined as the final answer is, over all maps: median and quartiles. A "
            f"line begins where half of the runs have a path.{above}{taken}{self.rest}",
        )

    def _targets(self, found: Sequence[tuple[str, float, Any, Any]], taken: str) -> Plot:
        reached = reached_by_variant(found)
        curves = {v: _curve(ecdf(reached[v])) for v in self.shown if v in reached}
        spent = [row.evaluations for row in self.rows if row.evaluations]
        figure = draw.ecdf_figure(curves, budget=float(max(spent)) if spent else None, sheet=self.sheet)
        return self.plot(
            "targets",
            "Targets reached (ECDF)",
            figure,
            "The share of runs and targets reached after so many evaluations. Targets are gaps of 50 %, 20 %, 10 %, "
            f"5 %, 2 %, 1 %, 0.5 %, 0.2 %, 0.1 % and 0.{taken}{self.rest}",
        )

    def profile(self) -> Iterator[Plot]:
        names = ("evaluations_to_one_percent", "evaluations_to_first", "length")
        metric = next((METRICS[name] for name in names if name in self.summary.metrics), None)
        if metric is None:
            return
        costs = np.array([[self._cost(v, i, metric.name) for v in self.shown] for i in self.summary.instances])
        finite = costs[np.isfinite(costs)]
        if not len(finite) or (finite <= 0.0).any():
            return
        curves = {name: _curve(steps) for name, steps in performance_profile(self.shown, costs).items()}
        figure = draw.profile_figure(curves, y_label="share of maps", sheet=self.sheet)
        yield self.plot(
            "profile",
            f"Performance profile: {metric.label}",
            figure,
            f"On which share of the maps a variant needs at most so many times the least of all, by median "
            f"{metric.label}."
            f" A line that ends below 100 % fails on the other maps.{self.rest}",
        )

    def _cost(self, variant: str, instance: str, metric: str) -> float:
        cell = self._cells[variant, instance]
        value = cell.spreads[metric].median_of_all
        return np.inf if value is None else value

    @property
    def _cells(self) -> Mapping[tuple[str, str], Any]:
        if not hasattr(self, "_by_place"):
            self._by_place = {(cell.variant, cell.instance): cell for cell in self.summary.cells}
        return self._by_place

    def main_effects(self) -> Iterator[Plot]:
        """Yield what each factor does, where several were changed at once."""
        changes, configs = self.study.changes, self.study.variants
        if not any(len(changed) > 1 for changed in changes.values()):
            return
        levels: dict[str, dict[str, list[float]]] = {}
        scale = 100.0 if self.metric.unit == "%" else 1.0
        medians = {it.variant: it.medians.get(self.metric.name) for it in self.summary.overall}
        for factor in dict.fromkeys(slot for changed in changes.values() for slot in changed):
            tried = {changed[factor] for changed in changes.values() if factor in changed}
            for variant, changed in changes.items():
                if self.study.kind == "tune" and not (changed or own(configs[variant], factor) in tried):
                    continue  # the base, where it is no part of the design
                value = medians.get(variant)
                level = changed.get(factor, own(configs[variant], factor))
                if value is not None:
                    levels.setdefault(factor, {}).setdefault(level, []).append(scale * value)
        effects = [_effect(factor, found) for factor, found in levels.items() if len(found) > 1]
        if not effects:
            return
        every = [v for found in levels.values() for values in found.values() for v in values]
        figure = draw.main_effects_figure(
            effects, mean=float(np.mean(every)), y_label=self.metric.head, sheet=self.sheet
        )
        yield self.plot(
            "effects",
            f"Main effects: {self.metric.label}",
            figure,
            "The mean over all variants with a level, of the medians over runs and maps; bars are standard errors.",
        )


def own(config: Mapping[str, Any], slot: str) -> str:
    """Return what a config has in a slot, as a study calls it."""
    value: Any = config
    for key in slot.split("."):
        if isinstance(value, list):
            value = next((v for v in value if isinstance(v, dict) and v.get("use", "").endswith(key)), None)
        else:
            value = value.get(key) if isinstance(value, dict) else None
    if isinstance(value, dict):
        value = value.get("use", ", ".join(value))
    if isinstance(value, list):
        value = "+".join(str(v.get("use", v)) if isinstance(v, dict) else str(v) for v in value)
    return "none" if value is None else str(value)


def _effect(factor: str, found: Mapping[str, Sequence[float]]) -> Effect:
    with suppress(ValueError):  # numbers go up, whatever came first
        found = dict(sorted(found.items(), key=lambda it: float(it[0])))
    values = [np.asarray(v, np.float64) for v in found.values()]
    errors: Floats = np.array([v.std(ddof=1) / np.sqrt(len(v)) if len(v) > 1 else np.nan for v in values])
    return Effect(factor, list(found), np.array([v.mean() for v in values]), errors)


def _curve(steps: Steps) -> Curve:
    return Curve(steps.at, steps.shares)
