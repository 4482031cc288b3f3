"""Instances: the problems of a study, from names, files, scenarios or objects."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pathloom.config import ProblemSpec
from pathloom.errors import ConfigError, PathloomError
from pathloom.grid import OccupancyGrid, read_scenario
from pathloom.paths.maps import load_map, names_of
from pathloom.paths.problem import PathProblem

Maps = str | Path | OccupancyGrid | PathProblem | Iterable[str | Path | OccupancyGrid | PathProblem]
"""One map, or several."""
MOST = 100_000
"""Instances beyond which a list of maps is refused."""


@dataclass(frozen=True)
class Instance:
    """One problem of a study."""

    name: str
    """Unique within the study."""
    map: str
    """Name or file of the map."""
    problem: PathProblem
    stated: float | None = None
    """The octile optimum that a scenario states."""

    @property
    def identity(self) -> tuple[Any, ...]:
        """What makes it this problem and no other."""
        it = self.problem
        return it.grid.sha256, it.grid.resolution, it.ends, it.radius, it.corners


def instances_of(
    maps: Maps = (),
    *,
    scenarios: Sequence[str | Path] = (),
    cases: str | Sequence[int] = "all",
    spec: ProblemSpec | None = None,
) -> tuple[Instance, ...]:
    """Return the instances that maps and scenarios stand for.

    Parameters
    ----------
    maps
        Names, also of several generated maps (``random-20:75:x10``), files, grids or problems.
    scenarios
        Moving AI scenario files.
    cases
        Which lines of each, from 0: numbers, or a text such as ``0-9,20`` or ``all``.
    spec
        Start, goal, corner policy and radius for all maps; of scenarios the last two.

    Raises
    ------
    PathloomError
        If there is none, one comes twice, or a map or a place on it cannot be used.
    """
    spec = spec or ProblemSpec()
    if isinstance(maps, (str, Path, OccupancyGrid, PathProblem)):
        maps = [maps]
    found: list[Instance] = []
    taken: dict[str, int] = {}
    seen: dict[tuple[Any, ...], str] = {}
    every = [*_of_maps(maps, spec), *(i for file in scenarios for i in _of_scenario(file, cases, spec))]
    for instance in every:
        if instance.identity in seen:
            other = seen[instance.identity]
            same = "comes twice" if other == instance.name else f"is the same as {other!r}"
            raise ConfigError(f"maps: {instance.name!r} {same}, allowed each once")
        name = instance.name
        taken[name] = taken.get(name, 0) + 1
        if taken[name] > 1:  # another map of that name, from another folder
            name = f"{name} #{taken[name]}"
        seen[instance.identity] = name
        found.append(replace(instance, name=name))
    if not found:
        raise ConfigError("maps: found none, allowed one or more names or files")
    return tuple(found)


def _of_maps(maps: Iterable[Any], spec: ProblemSpec) -> Iterator[Instance]:
    count = 0
    for given in maps:
        if isinstance(given, PathProblem):
            count += 1
            name = given.grid.name or f"map {count}"
            yield Instance(_short(name), name, given)
        elif not isinstance(given, (str, Path)):
            count += 1
            grid = given if isinstance(given, OccupancyGrid) else OccupancyGrid(given)
            name = grid.name or f"map {count}"
            ends = {"start": spec.start, "goal": spec.goal, "radius": spec.radius, "corners": spec.corners}
            yield Instance(_short(name), name, _problem(name, lambda g=grid, e=ends: PathProblem(g, **e)))
        else:
            text = str(given)
            if not text:
                raise ConfigError("maps: found an empty name, allowed names or files")
            for name in names_of(text):
                one = ProblemSpec(**{**vars(spec), "map": name})
                yield Instance(_short(name), name, _problem(name, one.build))


def _problem(name: str, build: Any) -> PathProblem:
    try:
        problem: PathProblem = build()
    except PathloomError as error:
        said = str(error)
        raise type(error)(said if said.startswith(name) else f"{name}: {said}") from error
    return problem


def _of_scenario(file: str | Path, cases: str | Sequence[int], spec: ProblemSpec) -> Iterator[Instance]:
    scenario = read_scenario(file)
    chosen = _numbers(cases, len(scenario.cases), str(file))
    grids: dict[str, OccupancyGrid] = {}
    for number in chosen:
        case = scenario.case(number)
        path = str(scenario.map_path(case))
        if path not in grids:
            grids[path] = load_map(path, unknown=spec.unknown, threshold=spec.threshold)  # type: ignore[arg-type]
        scenario.check(case, grids[path])
        name = f"{Path(file).name}:{number}"
        ends = {"start": case.start, "goal": case.goal, "radius": spec.radius, "corners": spec.corners}
        problem = _problem(name, lambda g=grids[path], e=ends: PathProblem(g, **e))
        yield Instance(name, path, problem, case.optimum)


def _numbers(cases: str | Sequence[int], count: int, file: str) -> list[int]:
    """Return the numbers of cases that are asked for, in the order given."""
    if not isinstance(cases, str):
        listed = [int(number) for number in cases]
    elif cases.strip() == "all":
        listed = list(range(count))
    else:
        listed = []
        for part in cases.split(","):
            match = re.fullmatch(r"\s*(\d{1,9})(?:\s*-\s*(\d{1,9}))?\s*", part)
            if not match:
                raise ConfigError(f"cases: found {part!r}, allowed numbers and ranges such as 0-9,20, or all")
            first, last = int(match[1]), int(match[2] or match[1])
            if last < first:
                raise ConfigError(f"cases: found {part!r}, allowed ranges that go up, such as 0-9")
            if last >= count:
                raise ConfigError(f"cases: found {part!r}, allowed 0 to {count - 1} in {file}")
            listed += range(first, last + 1)
    for number in listed:
        if not 0 <= number < count:
            raise ConfigError(f"cases: found {number}, allowed 0 to {count - 1} in {file}")
    if len(listed) > MOST:
        raise ConfigError(f"cases: found {len(listed)}, allowed at most {MOST}")
    return listed


def _short(name: str) -> str:
    """Return the name of a map without its folder."""
    return re.split(r"[/\\]", name)[-1] if "/" in name or "\\" in name else name
