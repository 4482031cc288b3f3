"""Config: what a TOML file or a command line asks for, and its complete form."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pathloom.errors import ConfigError, MapError, PathloomError, ProblemError
from pathloom.files import neighbour, reason
from pathloom.fronts.asked import Asked
from pathloom.grid import OccupancyGrid
from pathloom.kernel.compose import NONE, build, compose, freeze
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import check_seed
from pathloom.kernel.termination import WallTime
from pathloom.naming import closest
from pathloom.paths.curves import Smoother
from pathloom.paths.maps import SUFFIXES, load_map
from pathloom.paths.problem import CORNER_NAMES, PathProblem

DEFAULT_PLANNER = "loom/loom"
DEFAULT_MAP = "blocks-30:25%"
"""The map that is planned on when nobody names one."""

SECTIONS = ("problem", "planner", "run", "front")
RUN = ("seed", "time_limit", "smooth")


@dataclass(frozen=True)
class ProblemSpec:
    """A path problem as text and numbers, before any file is read."""

    map: str = DEFAULT_MAP
    start: Any = "bottom-left"
    goal: Any = "top-right"
    corners: str = "strict"
    radius: float = 0.0
    world: bool = False
    """Whether start and goal are x and y in metres."""
    unknown: str = "occupied"
    threshold: int | None = None

    def __post_init__(self) -> None:
        """Check what can be checked without the map; `PathProblem` checks the rest."""
        grey = self.threshold
        for key, allowed, fits in (
            ("map", "a name or a file", isinstance(self.map, str)),
            ("world", "true or false", isinstance(self.world, bool)),
            ("unknown", "'occupied' or 'free'", self.unknown in ("occupied", "free")),
            ("threshold", "an integer from 0 to 255", grey is None or (type(grey) is int and 0 <= grey <= 255)),
        ):
            if not fits:
                raise ConfigError(f"{key}: found {getattr(self, key)!r}, allowed {allowed}")

    def build(self) -> PathProblem:
        """Read the map and return the problem."""
        grid = load_map(
            self.map,
            unknown=self.unknown,  # type: ignore[arg-type]
            threshold=self.threshold,
            corners=self.corners if self.corners in ("allow", "no-squeeze") else "strict",  # type: ignore[arg-type]
        )
        start, goal = (self._cell(grid, end) for end in ("start", "goal"))
        return PathProblem(grid, start=start, goal=goal, radius=self.radius, corners=self.corners)  # type: ignore[arg-type]

    def _cell(self, grid: OccupancyGrid, end: str) -> Any:
        """Return start or goal as a cell or the name of a corner."""
        place = getattr(self, end)
        if not self.world or isinstance(place, str):
            return place
        try:
            x, y = (float(v) for v in place)
        except (TypeError, ValueError):
            raise ConfigError(f"{end}: found {place!r}, allowed x and y in metres") from None
        try:
            return grid.cell_at(x, y)
        except MapError as error:
            raise ProblemError(f"{end}: {error}") from error


@dataclass(frozen=True)
class Config:
    """Everything that a run of ``plan`` or ``pareto`` depends on."""

    problem: ProblemSpec = field(default_factory=ProblemSpec)
    planner: Mapping[str, Any] | Planner = field(default_factory=lambda: {"use": DEFAULT_PLANNER})
    seed: int = 0
    time_limit: float | None = None
    smooth: Smoother | None = None
    """What makes a curve of the path; empty: whatever the planner has for it."""
    front: Asked = field(default_factory=Asked)
    """What is asked of a front; ``plan`` has no use for it."""

    def composed(self) -> "Config":
        """Return the config with its planner built."""
        if isinstance(self.planner, Planner):
            return self
        return replace(self, planner=compose(self.planner))


def read_config(path: str | Path, default_planner: str = DEFAULT_PLANNER) -> Config:
    """Return the config in a TOML file, with a planner in case that it names none.

    Raises
    ------
    ConfigError
        If the file cannot be read or is no TOML, or says something unknown;
        the message names file, key, what was found, and what was probably meant.
    """
    text = str(path)
    try:
        with Path(path).open("rb") as file:
            document = tomllib.load(file)
    except FileNotFoundError:
        hint = neighbour(path, ".toml")
        found = f"{text}: found no such file, allowed a config in TOML"
        raise ConfigError(f"{found}; {hint}" if hint else found) from None
    except OSError as error:
        raise ConfigError(f"{text}: found an unreadable file ({reason(error)}), allowed a config in TOML") from error
    except (ValueError, RecursionError) as error:  # no TOML, no UTF-8, a huge number or a deep nest
        raise ConfigError(f"{text}: no TOML: {' '.join(str(error).split())}") from error
    try:
        return from_document(document, Path(path).parent, default_planner)
    except PathloomError as error:
        raise type(error)(f"{text}: {error}") from error


def from_document(
    document: Mapping[str, Any], folder: Path | None = None, default_planner: str = DEFAULT_PLANNER
) -> Config:
    """Return the config in a table with the sections ``problem``, ``planner``, ``run`` and ``front``.

    ``folder``: what file names of maps are relative to.
    """
    _known("", document, SECTIONS)
    problem, planner, run, front = (_table(document, name) for name in SECTIONS)
    _known("problem", problem, list(ProblemSpec.__dataclass_fields__))
    _known("run", run, RUN)
    try:
        spec = ProblemSpec(**problem)
    except ConfigError as error:
        raise ConfigError(f"problem.{error}") from error
    if folder is not None and "map" in problem and _is_file_name(spec.map):
        spec = replace(spec, map=str(folder / spec.map))
    limit = run.get("time_limit")
    if limit == "none":
        limit = None
    if limit is not None and (isinstance(limit, bool) or not isinstance(limit, (int, float)) or not limit > 0):
        raise ConfigError(f"run.time_limit: found {limit!r}, allowed seconds above 0")
    try:
        seed = check_seed(run.get("seed", 0))
    except ConfigError as error:
        raise ConfigError(f"run.{error}") from error
    curve = smoother(run.get("smooth"), "run.smooth")
    return Config(spec, {"use": default_planner, **planner}, seed, limit, curve, Asked.read(front))


def smoother(value: Any, where: str) -> Smoother | None:
    """Return the smoother that a name, a table with ``use`` or a component stands for; ``none``: none of its own."""
    return None if value is None or value == NONE else build(Smoother, value, default_registry(), where)


def lasting(planner: Planner, time_limit: float | None) -> Planner:
    """Return an anytime planner with the time limit, if there is one, in place of the termination that it brings."""
    if time_limit is None or not planner.anytime or planner.termination != type(planner)().termination:
        return planner
    return replace(planner, termination=(WallTime(seconds=time_limit),))


def frozen(
    problem: PathProblem,
    map_name: str,
    planner: Planner,
    seed: int,
    time_limit: float | None,
    smooth: Smoother | None = None,
) -> dict[str, Any]:
    """Return the complete config of a run, every default filled in."""
    return {
        "problem": {
            "map": map_name,
            "start": list(problem.ends[0]),
            "goal": list(problem.ends[1]),
            "corners": problem.corners,
            "radius": problem.radius,
        },
        "planner": freeze(planner),
        "run": {
            "seed": seed,
            "time_limit": time_limit if time_limit is not None else NONE,
            **({} if smooth is None else {"smooth": freeze(smooth)}),
        },
    }


def parse_place(text: str, name: str, *, world: bool = False) -> Any:
    """Return what ``ROW,COL``, ``X,Y`` (metres) or the name of a corner stands for."""
    if text in CORNER_NAMES:
        return text
    parts = text.split(",")
    try:
        if len(parts) != 2:
            raise ValueError
        return tuple((float if world else int)(part) for part in parts)
    except ValueError:
        kind = "X,Y in metres" if world else "ROW,COL"
        raise ConfigError(
            f"{name}: found {text!r}, allowed {kind} or a corner; {closest(text, CORNER_NAMES)}"
        ) from None


def _is_file_name(name: str) -> bool:
    return Path(name).suffix.lower() in SUFFIXES or "/" in name or "\\" in name


def _table(document: Mapping[str, Any], name: str) -> dict[str, Any]:
    value = document.get(name, {})
    if not isinstance(value, Mapping):
        raise ConfigError(f"{name}: found {value!r}, allowed a table")
    return dict(value)


def _known(section: str, table: Mapping[str, Any], allowed: Any) -> None:
    for key in table:
        if key not in allowed:
            at = f"{section}.{key}" if section else key
            raise ConfigError(f"{at}: no such {'key' if section else 'section'}; {closest(key, allowed)}")
