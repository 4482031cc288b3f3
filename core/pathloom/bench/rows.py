"""Rows for the pages of plugins: runs of planners on maps, in Markdown."""

import time
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from pathloom.bench.ours import shown
from pathloom.bench.suite import problem_on
from pathloom.errors import ConfigError
from pathloom.exact import any_angle_path, octile_path
from pathloom.kernel.compose import compose
from pathloom.kernel.run import run
from pathloom.paths.context import Corners
from pathloom.paths.problem import PathProblem
from pathloom.planning import plan

HEADS = ("map", "planner", "found", "mean length", "best", "over octile", "over any-angle", "best after", "ms, best",
         "median")  # fmt: skip


def planners_of(text: str) -> list[str | Mapping[str, Any]]:
    """Return the planners that a text names: names, or tables in TOML, with commas between.

    Raises
    ------
    ConfigError
        If it is neither.
    """
    listed = text if "{" in text else ", ".join(f'"{name.strip()}"' for name in text.split(",") if name.strip())
    try:
        return tomllib.loads(f"of = [{listed}]")["of"]  # type: ignore[no-any-return]
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"--planners: found {text!r}, allowed names or TOML tables with commas: {error}") from None


def rows(maps: str, planners: str, corners: Corners, seeds: range) -> Iterator[tuple[str, ...]]:
    """Yield for each map and planner the cells of `HEADS`.

    Lengths and gaps are over the runs that found a path; times are processor
    time, loading of kernels left out.
    """
    for name in maps.split(","):
        problem = problem_on(name, corners)
        optima = octile_path(problem)[0], any_angle_path(problem)[0]
        for planner in planners_of(planners):
            yield _row(name, planner, problem, optima, seeds)


def _row(
    name: str, planner: str | Mapping[str, Any], problem: PathProblem, optima: tuple[float, float], seeds: range
) -> tuple[str, ...]:
    composed = compose(planner)
    results = [plan(problem, composed, seed=seed) for seed in seeds]
    lengths = np.array([result.length for result in results if result.found])
    times = []
    for seed in seeds:
        began = time.process_time()
        run(problem, composed, seed)
        times.append(1000 * (time.process_time() - began))
    found = f"{len(lengths)} of {len(results)}"
    measured = ["–"] * 5
    if len(lengths):
        gaps = [f"{100 * (lengths / optimum - 1).mean():.1f} %" for optimum in optima]
        settled = np.mean([result.convergence for result in results if result.found])
        measured = [f"{lengths.mean():.4f}", f"{lengths.min():.4f}", *gaps, f"{settled:.1f}"]
    return name, shown(planner), found, *measured, f"{min(times):.1f}", f"{np.median(times):.1f}"
