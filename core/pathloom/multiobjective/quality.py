"""How much of the exact front a planner finds in a given time, map by map."""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pathloom.exact.front import exact_front
from pathloom.fronts.indicators import hypervolume_ratio, indicators
from pathloom.kernel.compose import compose
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.run import first_generator
from pathloom.multiobjective.composing import Objectives, front_planner
from pathloom.multiobjective.running import DEFAULT_PLANNER
from pathloom.paths.maps import load_map
from pathloom.paths.problem import PathProblem

SMALL = tuple(f"random-20:{75 + round(85 * k / 9)}:s{k}" for k in range(10))
MIDDLE = ("random-40:15%:s1", "random-40:15%:s2", "random-50:20%:s1", "random-50:20%:s2")
LARGE = ("rooms-100", "rooms-100:s1", "maze-100:1", "maze-100:2")
MAPS = {**dict.fromkeys(SMALL, 0.5), **dict.fromkeys(MIDDLE, 1.5), **dict.fromkeys(LARGE, 3.0)}
"""Seconds for each map."""
LABELS = 60_000_000
"""Limit of the exact search: on ``maze-100:2`` it takes a minute and several gigabytes."""


@dataclass(frozen=True)
class Quality:
    """The fronts of several seeds on one map, against the exact one."""

    map: str
    seconds: float
    """Processor time that each run had."""
    exact: int
    """Points of the exact front; 0: it could not be had."""
    ratios: tuple[float, ...]
    """Hypervolume of each run as a share of the exact front's, with its reference point."""
    shares: tuple[float, ...]
    """Share of the exact front's points that each run found."""
    generations: float
    """Median."""


def quality(
    maps: Sequence[str] = tuple(MAPS),
    planner: Any = DEFAULT_PLANNER,
    *,
    objectives: Objectives | None = None,
    seconds: float | None = None,
    seed: int = 0,
    runs: int = 10,
) -> Iterator[Quality]:
    """Yield how a planner does on each map; ``seconds`` are those of `MAPS`, else 1, unless they are given."""
    used = front_planner(planner, objectives)
    for name in maps:
        limit = MAPS.get(name, 1.0) if seconds is None else seconds
        problem = PathProblem(load_map(name))
        front = exact_front(problem, used.objectives, labels=LABELS)
        if front is None:
            yield Quality(name, limit, 0, (), (), 0.0)
            continue
        timed(problem, used, seed, 0.0)  # what is loaded once does not count
        ratios, shares, generations = [], [], []
        for number in range(runs):
            values, generation = timed(problem, used, seed + number, limit)
            ratios.append(hypervolume_ratio(values, front.values) or 0.0)
            shares.append(indicators(values, front.values)["exact_found"] / len(front))
            generations.append(generation)
        yield Quality(name, limit, len(front), tuple(ratios), tuple(shares), float(np.median(generations)))


def timed(problem: PathProblem, planner: FrontPlanner, seed: int, seconds: float) -> tuple[Floats, int]:
    """Return the values of the front after so much processor time, and the number of generations.

    The generation under way is finished. Processor time of this process counts, so
    that other work on the machine does not.
    """
    endless = compose(planner, termination=[{"use": "wall-time", "seconds": 1e9}])
    assert isinstance(endless, FrontPlanner)
    began = time.process_time()
    state = endless.start(problem, first_generator(seed))
    state = endless.step(state) if seconds == 0.0 else state
    while time.process_time() - began < seconds:
        state = endless.step(state)
    return endless.front(state).values, state.generation


def markdown(rows: Sequence[Quality]) -> str:
    """Return a table: one line for each map."""
    heads = ("map", "s CPU", "points of the exact front", "hypervolume ratio, mean", "least", "found", "generations")
    lines = [
        (q.map, f"{q.seconds:g}", q.exact, f"{np.mean(q.ratios):.5f}", f"{min(q.ratios):.5f}",
         f"{100 * np.mean(q.shares):.1f} %", f"{q.generations:.0f}")
        if q.exact
        else (q.map, f"{q.seconds:g}", "none to be had", "", "", "", "")
        for q in rows
    ]  # fmt: skip
    rows_of_text = [heads, ("---",) * len(heads), *lines]
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in rows_of_text) + "\n"
