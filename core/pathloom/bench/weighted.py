"""Weighted sums: how far above the exact optimum over cell paths planners stay that minimise one."""

import time
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import groupby
from typing import Any

import numpy as np

from pathloom.bench.ours import shown
from pathloom.bench.rows import planners_of
from pathloom.bench.suite import Task, named
from pathloom.errors import ConfigError
from pathloom.exact import additive_optimum
from pathloom.kernel.compose import compose
from pathloom.kernel.evaluation import ReciprocalOfSum, Terms
from pathloom.kernel.run import run
from pathloom.kernel.search import Search
from pathloom.paths.context import Corners

HEADS = ("maps", "planner", "found", "mean gap", "worst", "at or below 0", "evaluations", "ms, median")


def terms_of(text: str) -> Terms:
    """Return the objectives of a planner by its name, or those of a table in TOML.

    Raises
    ------
    ConfigError
        If it is neither.
    """
    if not text.lstrip().startswith("{"):
        return compose(text).terms
    try:
        table = tomllib.loads(f"of = {text}")["of"]
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"--objectives: {error}") from None
    return compose({"use": "evolution", "sampling": "perturbed-trees", "objectives": table}).terms


def rows(maps: str, planners: str, objectives: Terms, corners: Corners, seeds: range) -> Iterator[tuple[str, ...]]:
    """Yield the cells of `HEADS` for each group of maps and planner.

    All planners get the same objectives and weights, and the reciprocal of their sum
    as fitness; the gap is that of the fittest individual. Cell paths have no gap
    below zero; paths at any angle may.

    Raises
    ------
    ConfigError
        If an objective is not additive, or a planner weighs no objectives.
    """
    asked = [(shown(planner), _weighing(planner, objectives)) for planner in planners_of(planners)]
    for group, tasks in groupby(named(maps, corners), key=lambda task: task.group):
        listed = list(tasks)
        for name, planner in asked:
            yield group, name, *_row(listed, planner, seeds)


def _weighing(planner: str | Mapping[str, Any], objectives: Terms) -> Search:
    composed = compose(planner)
    if not isinstance(composed, Search):
        raise ConfigError(f"planners: {shown(planner)!r} weighs no objectives")
    return replace(composed, objectives=objectives, weighting=None, fitness=ReciprocalOfSum())


def _row(tasks: list[Task], planner: Search, seeds: range) -> tuple[str, ...]:
    gaps, evaluations, times = [], [], []
    for task in tasks:
        optimum = additive_optimum(task.problem, planner)
        if optimum is None:
            raise ConfigError("--objectives: found one that is not additive, of which no exact optimum is known")
        for seed in seeds:
            began = time.process_time()
            state = run(task.problem, planner, seed).state
            times.append(1000 * (time.process_time() - began))
            if state is not None and state.best is not None:
                gaps.append(float(state.best.values @ planner.weights(task.problem)) / optimum.cost - 1.0)
                evaluations.append(state.evaluations)
    found, spent = f"{len(gaps)} of {len(times)}", f"{np.median(times):.1f}"
    if not gaps:
        return found, *["–"] * 4, spent
    share = 100 * np.mean(np.array(gaps) <= 1e-9)
    mean, worst = (round(100 * float(gap), 2) + 0.0 for gap in (np.mean(gaps), max(gaps)))  # + 0.0: no "-0.00"
    shares = f"{mean:.2f} %", f"{worst:.2f} %", f"{share:.0f} %"
    return found, *shares, f"{np.mean(evaluations):.0f}", spent
