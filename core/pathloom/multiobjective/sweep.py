"""A planner of fronts beside a sweep of exact searches, where no exact front can be had.

The sweep is the best that exact search offers for length, clearance and turn
angle, of which clearance is not additive: 66 searches, each for the cheapest
path under one weighting of length and turn angle among the cells that are at
least so far from obstacles. It is made twice, with 11 distances times 6 weightings
and with 6 times 11 (and more weightings, where there are fewer distances), and the
better one counts. The planner then has as much
processor time as that sweep took. Reference point: a tenth of the range of both
fronts together beyond their common nadir.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pathloom.exact.aloof import distances, moves_at
from pathloom.exact.scalarised import ASIDE, Optima
from pathloom.fronts.indicators import hypervolume, non_dominated, reference_point
from pathloom.grid import read_scenario
from pathloom.kernel.evaluation import Floats, Terms, measure
from pathloom.multiobjective.composing import front_planner
from pathloom.multiobjective.quality import timed
from pathloom.multiobjective.running import DEFAULT_PLANNER
from pathloom.paths.additive import additive_terms
from pathloom.paths.maps import load_map
from pathloom.paths.objectives import Clearance, Length, TurnAngle
from pathloom.paths.problem import PathProblem

OBJECTIVES = Terms({"length": Length(), "clearance": Clearance(), "turn-angle": TurnAngle()})
SHAPES = ((11, 6), (6, 11))
"""Distances and weightings: 66 searches each."""
FAR = 200.0
"""Least length of the optimum of a scenario's case that is taken, in cells."""


@dataclass(frozen=True)
class Sweep:
    """The fronts of several seeds on one map beside the sweep's."""

    map: str
    shape: tuple[int, int]
    length: float
    """Of the shortest path that the sweep found, in cells."""
    seconds: float
    """Processor time of the sweep, after which a run of the planner ends."""
    longest: float
    """Processor time of the longest run, whose first population or last generation may take it beyond."""
    points: int
    """Of the sweep's front."""
    ratios: tuple[float, ...]
    """Hypervolume of each run over that of the sweep: above 1 it is better."""
    sizes: tuple[int, ...]
    """Points of each run's front."""


def sweeps(paths: Sequence[str], planner: Any = DEFAULT_PLANNER, *, seed: int = 0, runs: int = 5) -> Iterator[Sweep]:
    """Yield how a planner does beside the sweep on each of several scenarios (``.scen``) and maps."""
    used = front_planner(planner, OBJECTIVES)
    for path in paths:
        problem = far_apart(path)
        problem.context.distance, problem.context.moves  # noqa: B018 - both need them, neither pays for them
        for shape in SHAPES:
            swept(problem, shape, 1)  # what is loaded once does not count
        timed(problem, used, seed, 0.0)
        done = []
        for shape in SHAPES:
            began = time.process_time()
            done.append((swept(problem, shape), time.process_time() - began, shape))
        corner = reference_point(np.concatenate([front for front, *_ in done]))
        front, seconds, shape = max(done, key=lambda one: hypervolume(one[0], corner))
        fronts, spent = [], []
        for number in range(runs):
            began = time.process_time()
            fronts.append(timed(problem, used, seed + number, seconds)[0])
            spent.append(time.process_time() - began)
        corner = reference_point(non_dominated(np.concatenate((front, *fronts))))
        volume = hypervolume(front, corner)
        yield Sweep(
            Path(path).stem, shape, float(front[:, 0].min()), seconds, max(spent), len(front),
            tuple(hypervolume(one, corner) / volume for one in fronts), tuple(map(len, fronts)),
        )  # fmt: skip


def swept(problem: PathProblem, shape: tuple[int, int], most: int | None = None) -> Floats:
    """Return the front of the sweep, or of its first searches."""
    levels, weightings = shape
    prices = additive_terms(Terms(term for term in OBJECTIVES if term.label != "clearance"), problem)
    assert prices is not None
    search = Optima(problem, prices, np.random.default_rng(0))
    for weights in ((1.0, ASIDE), (ASIDE, 1.0)):  # the ranges by which weights are scaled
        search.run(np.array(weights))
    found = (0.0, *distances(problem, levels - 1))
    shares = np.linspace(0.0, 1.0, levels * weightings // len(found))
    tries = [(level, share) for level in found for share in shares]
    scale = search.scale
    for level, share in tries[:most]:
        search.run(np.maximum((share, 1.0 - share), ASIDE) / scale, moves_at(problem, level))
    return non_dominated(measure(list(OBJECTIVES.objectives()), search.population, problem))


def far_apart(path: str) -> PathProblem:
    """Return a problem whose ends lie far apart and clear of obstacles.

    Of a scenario: the case of at least `FAR` whose ends are farthest from obstacles.
    Of a map: its widest spot, and of those half as wide that can be reached the farthest one, as the crow flies.
    """
    if path.endswith(".scen"):
        scenario = read_scenario(path)
        long = [case for case in scenario.cases if case.optimum >= FAR]
        grid = load_map(str(scenario.map_path(long[0])))
        wide = PathProblem(grid, start=long[0].start, goal=long[0].goal).context
        clear = wide.distance.reshape(wide.rows, wide.cols)
        case = max(long, key=lambda one: (min(clear[one.start], clear[one.goal]), one.optimum))
        return PathProblem(grid, start=case.start, goal=case.goal)
    grid = load_map(path)
    free = np.argwhere(~grid.occupied)
    context = PathProblem(grid, start=tuple(free[0]), goal=tuple(free[0])).context
    widest = int(np.argmax(context.distance))
    start = divmod(widest, context.cols)
    rows, cols = np.indices((context.rows, context.cols))
    away = np.hypot(rows - start[0], cols - start[1])
    roomy = (context.distance >= 0.5 * context.distance[widest]).reshape(away.shape)
    roomy &= PathProblem(grid, start=start, goal=start).context.component
    return PathProblem(grid, start=start, goal=divmod(int(np.argmax(np.where(roomy, away, -1.0))), context.cols))


def markdown(rows: Sequence[Sweep]) -> str:
    """Return a table: one line for each map."""
    heads = (
        "map", "shortest", "sweep", "s CPU", "s CPU of the planner", "its points", "points of the planner",
        "hypervolume over the sweep's", "least",
    )  # fmt: skip
    lines = [
        (s.map, f"{s.length:.0f}", f"{s.shape[0]} × {s.shape[1]}", f"{s.seconds:.1f}", f"{s.longest:.1f}", s.points,
         f"{np.median(s.sizes):.0f}", f"{np.mean(s.ratios):.4f}", f"{min(s.ratios):.4f}")
        for s in rows
    ]  # fmt: skip
    rows_of_text = [heads, ("---",) * len(heads), *lines]
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in rows_of_text) + "\n"
