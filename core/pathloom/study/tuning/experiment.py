"""Tune: try settings by an orthogonal array, predict the best one, and see whether it holds."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from pathloom.config import ProblemSpec
from pathloom.errors import ConfigError
from pathloom.kernel.compose import freeze
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry
from pathloom.study import Study, Workers, carry_out
from pathloom.study.budget import Budget
from pathloom.study.design import Design, Variant
from pathloom.study.instances import Instance, Maps, instances_of
from pathloom.study.statistics.metrics import SUCCESS, metric
from pathloom.study.statistics.runs import Runs
from pathloom.study.statistics.summary import summary
from pathloom.study.tuning.factors import Experiment, experiment, variant_at
from pathloom.study.tuning.model import By, model
from pathloom.study.tuning.response import response
from pathloom.study.tuning.result import Tuning

Carry = Callable[[Design, str | Path | None], Study]
"""Carries out a design, and keeps it in a file if there is one."""
OPTIMUM = "predicted best"
"""Name of the confirmed variant."""


def tune(
    base: str | Mapping[str, Any] | Planner,
    factors: Mapping[str, Sequence[Any]],
    *,
    maps: Maps = (),
    scenarios: Sequence[str | Path] = (),
    cases: str | Sequence[int] = "all",
    start: Any = "bottom-left",
    goal: Any = "top-right",
    corners: str = "strict",
    radius: float = 0.0,
    array: str | None = None,
    by: By = "levels",
    measure: str | None = None,
    runs: int = 10,
    confirm: int | None = None,
    seed: int = 0,
    budget: str | Budget = "evaluations",
    time_limit: float | None = None,
    out: str | Path | None = None,
    workers: int | None = None,
    dask: str | None = None,
    watch: Any = None,
) -> Tuning:
    """Find good values of a planner's parameters.

    Parameters
    ----------
    base
        A planner's name, a table as in a config, or a planner.
    factors
        Parameters, as in ``--set``, and two or three values of each, from low to high.
    maps, scenarios, cases, start, goal, corners, radius, budget, time_limit, workers, dask, watch
        As in `ablate`.
    array
        ``L9``, ``L18``, ``L27``, or ``full`` for all combinations; else the smallest that fits.
    by
        What the optimum is read off: ``levels``, the mean response of each level;
        ``ols``, a linear model by least squares; ``paper``, a linear model with the
        divisor of Hao et al. 2021, section 5.2.1.
    measure
        The response, a metric such as ``length``; else the sharpest known gap.
    runs
        Of each setting on each map.
    confirm
        Runs of base and predicted best on each map, with seeds that were not used; else ``runs``; 0 for none.
    seed
        The first seed.
    out
        The study's file; that of the confirmation has ``-confirmation`` in its name.

    Raises
    ------
    PathloomError
        If anything asked for cannot be used; nothing is run then.
    """
    spec = ProblemSpec(start=start, goal=goal, corners=corners, radius=radius)
    places = instances_of(maps, scenarios=scenarios, cases=cases, spec=spec)
    return tuned(
        experiment(base, factors, array), places, by=by, measure=measure, runs=runs, confirm=confirm, seed=seed,
        budget=Budget.parse(budget), time_limit=time_limit, out=out,
        carry=lambda what, file: carry_out(what, file, workers=Workers(workers, dask), watch=watch),
    )  # fmt: skip


def tuned(
    plan: Experiment,
    places: tuple[Instance, ...],
    *,
    carry: Carry,
    by: By = "levels",
    measure: str | None = None,
    runs: int = 10,
    confirm: int | None = None,
    seed: int = 0,
    budget: Budget | None = None,
    time_limit: float | None = None,
    out: str | Path | None = None,
) -> Tuning:
    """Carry out an experiment on instances, and confirm what it predicts; all else is as in `tune`."""
    if by not in ("levels", "ols", "paper"):
        raise ConfigError(f"by: found {by!r}, allowed levels, ols or paper")
    if measure is not None and metric(measure) is SUCCESS:
        raise ConfigError(
            "measure: found 'success', which is no number of single runs; allowed gap_any_angle, length, …"
        )
    if confirm is not None and (isinstance(confirm, bool) or not isinstance(confirm, int) or confirm < 0):
        raise ConfigError(f"confirm: found {confirm!r}, allowed a whole number from 0")
    budget = budget or Budget()
    for factor in plan.factors:
        budget.refuse_swapped(factor.path)
    own, settings = _variants(plan)
    asked = list(settings) if own in settings else [own, *settings]
    asked.sort(key=lambda variant: variant is not own)  # the base comes first: the budget is what it spends
    design = Design("tune", tuple(asked), places, runs, seed, budget, time_limit)
    study = carry(design, out)
    found = Runs.read(study.each())
    names = tuple(variant.name for variant in settings)
    answer = response(found, names, measure)
    fitted = model(plan, answer, by)
    tuning = Tuning(own.name, plan, names, answer, fitted, _mean_of(own.name, found, names, answer.metric.name), study)
    count = runs if confirm is None else confirm
    best = replace(variant_at(plan.base, fitted.optimum), name=OPTIMUM)
    if not count or freeze(best.planner) == freeze(plan.base):
        return tuning
    again = replace(design, variants=(own, best), runs=count, seed=seed + runs, budget=study.budget)
    return _confirmed(tuning, carry(again, _beside(out)))


def _variants(plan: Experiment) -> tuple[Variant, tuple[Variant, ...]]:
    """Return the base, and the settings; where one of them is the base, it is the same variant."""
    name = default_registry().name_of(type(plan.base)).rpartition("/")[2]
    own, table = Variant(name, plan.base), freeze(plan.base)
    return own, tuple(own if freeze(it.planner) == table else it for it in plan.variants())


def _mean_of(name: str, runs: Runs, settings: Sequence[str], measure: str) -> float:
    """Return the mean response of one variant, on the level of all settings."""
    among = list(dict.fromkeys([*settings, name]))
    return float(response(runs, among, measure).trials[among.index(name)].mean())


def _confirmed(tuning: Tuning, study: Study) -> Tuning:
    """Return the tuning with what the confirmation says."""
    rows = study.rows()
    study.close()
    name = tuning.response.metric.name
    trials = response(Runs.read(rows), (OPTIMUM, tuning.base), name).trials
    error = float(np.sqrt(trials.var(axis=1, ddof=1).mean() / trials.shape[1])) if trials.shape[1] > 1 else np.nan
    best, base = trials.mean(axis=1).tolist()
    measured = list(dict.fromkeys([SUCCESS.name, name, "length", "fitness", "evaluations_to_first"]))
    said = summary(rows, metrics=measured, baseline=tuning.base)
    return replace(tuning, confirmation=said, confirmed={"optimum": best, "base": base, "error": error})


def _beside(out: str | Path | None) -> Path | None:
    return None if out is None else Path(out).with_stem(f"{Path(out).stem}-confirmation")
