"""Suites: which problems a benchmark is about."""

import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from pathloom.errors import ConfigError, MapError
from pathloom.grid import read_scenario
from pathloom.naming import closest
from pathloom.paths.context import Corners
from pathloom.paths.maps import load_map
from pathloom.paths.problem import PathProblem

SMALL = ("random-20:10%", "random-20:20%", "random-20:30%", "random-50:20%", "random-50:30%", "rooms-50", "maze-41")
SIZES = (64, 128, 256, 512, 1024, 2048)
FAMILIES = ("empty-{n}", "random-{n}:20%", "rooms-{n}:32", "maze-{n}:7")
"""Maps of any size n; rooms and corridors are as wide in all sizes."""


@dataclass(frozen=True)
class Task:
    """One problem, loaded when it is its turn, and the group in which a table counts it."""

    group: str
    name: str
    load: Callable[[], PathProblem]

    @cached_property
    def problem(self) -> PathProblem:
        """The problem."""
        return self.load()


def problem_on(name: str, corners: Corners) -> PathProblem:
    """Return the problem on a map by name or file, ``MAP@START@GOAL`` with ends of its own.

    Ends are corners such as ``top-left``, or ``ROW;COL``. Without any: from the
    lower left to the upper right.
    """
    source, *ends = name.split("@")
    if len(ends) not in (0, 2):
        raise ConfigError(f"{name}: found {len(ends)} ends, allowed MAP or MAP@START@GOAL")
    start, goal = map(_end, ends or ("bottom-left", "top-right"))
    return PathProblem(load_map(source, corners=corners), start=start, goal=goal, corners=corners)


def named(maps: str, corners: Corners) -> list[Task]:
    """Return the tasks of maps with commas between; ``random-20:30%:x50`` stands for the seeds 0 to 49."""
    tasks = []
    for text in filter(None, (part.strip() for part in maps.split(","))):
        many = re.fullmatch(r"(?P<map>[^@]*?):x(?P<count>[1-9]\d{0,5})(?P<ends>@.*)?", text)
        if many is None:
            tasks.append(_task(text, text, corners))
            continue
        group, ends = many["map"], many["ends"] or ""
        tasks += [_task(text, f"{group}:s{seed}{ends}", corners) for seed in range(int(many["count"]))]
    if not tasks:
        raise ConfigError("--maps: found no map, allowed names or files with commas between")
    return tasks


def small(corners: Corners) -> list[Task]:
    """Return the maps of 20 × 20 to 50 × 50 cells that are generated."""
    return named(",".join(SMALL), corners)


def scale(corners: Corners, sizes: tuple[int, ...] = SIZES) -> list[Task]:
    """Return generated maps of growing size."""
    return named(",".join(family.format(n=n) for n in sizes for family in FAMILIES), corners)


def movingai(corners: Corners, folder: str | None, cases: int, first: bool = False, only: str = "") -> list[Task]:
    """Return cases of every scenario below a folder, in a group for each map.

    Parameters
    ----------
    folder
        With the scenarios anywhere below; by default ``PATHLOOM_DATA``.
    cases
        How many of each scenario: spread evenly over it, or the ``first`` ones.
    only
        Words with commas; a scenario counts if its file's name has one of them.
    """
    folder = folder or os.environ.get("PATHLOOM_DATA")
    if not folder:
        raise ConfigError("--data: found no folder, allowed one with Moving AI scenarios, or PATHLOOM_DATA set to it")
    words = [word.strip() for word in only.split(",") if word.strip()]
    files = sorted(p for p in Path(folder).rglob("*.scen") if not words or any(word in p.name for word in words))
    if not files:
        raise MapError(f"{folder}: found no scenario (*.scen) there" + (f" named {only}" if words else ""))
    return [task for file in files for task in _cases(file, corners, cases, first)]


def suite(name: str, corners: Corners, folder: str | None, cases: int, first: bool, only: str = "") -> list[Task]:
    """Return the tasks of a suite by its name."""
    if name == "movingai":
        return movingai(corners, folder, cases, first, only)
    known = {"small": small, "scale": scale}
    if name not in known:
        raise ConfigError(f"--suite: no suite is called {name!r}; {closest(name, [*known, 'movingai'])}")
    return known[name](corners)


def _task(group: str, name: str, corners: Corners) -> Task:
    return Task(group, name, lambda: problem_on(name, corners))


def _end(text: str) -> tuple[int, int] | str:
    cell = re.fullmatch(r"(\d+);(\d+)", text)
    return (int(cell[1]), int(cell[2])) if cell else text


def _cases(file: Path, corners: Corners, cases: int, first: bool) -> Iterator[Task]:
    try:
        scenario = read_scenario(file)
        scenario.map_path(scenario.case(0))
    except MapError:
        return  # a scenario without its map is nothing to measure
    last = len(scenario.cases) - 1
    chosen = range(min(cases, last + 1)) if first else np.unique(np.linspace(0, last, cases + 1)[1:].astype(int))
    for index in chosen:
        case = scenario.cases[index]

        def load(index: int = int(index)) -> PathProblem:
            case = scenario.cases[index]
            grid = load_map(scenario.map_path(case))
            scenario.check(case, grid)
            return PathProblem(grid, start=case.start, goal=case.goal, corners=corners)

        yield Task(Path(case.map_name.replace("\\", "/")).stem, f"{file.name}#{index}", load)
