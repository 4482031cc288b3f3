"""What commands ask alike: their options, and the config, planner and problem that follow."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from pathloom.errors import ConfigError, MapError, ProblemError

if TYPE_CHECKING:
    from pathloom.config import Config

F = TypeVar("F", bound=Callable[..., Any])

CORNERS = click.option("--corners", metavar="POLICY", help="strict (default), no-squeeze or allow.")
DARK = click.option("--dark", is_flag=True, help="Draw on a dark background.")
JSON = click.option("--json", "as_json", is_flag=True, help="Print a JSON document.")
QUIET = click.option("--quiet", is_flag=True, help="No progress, no messages.")

PROBLEM = (
    click.option("--map", "map_", metavar="NAME|FILE", help="A registered or generated map, or a file."),
    click.option("--scenario", metavar="FILE", help="A Moving AI scenario: sets map, start and goal."),
    click.option("--case", type=int, default=None, help="Line of the scenario, counted from 0."),
    click.option("--start", metavar="ROW,COL|CORNER", help="Where to start; default bottom-left."),
    click.option("--goal", metavar="ROW,COL|CORNER", help="Where to go; default top-right."),
    click.option("--world", is_flag=True, help="Start and goal are X,Y in metres."),
    CORNERS,
    click.option(
        "--radius",
        type=float,
        help="Radius of the robot, in metres where the map has a resolution, else in cells.",
    ),
    click.option("--unknown", metavar="occupied|free", help="What unknown cells of a ROS map count as."),
    click.option(
        "--threshold",
        type=click.IntRange(0, 255),
        metavar="GREY",
        help="Grey (0 to 255) below which a pixel is an obstacle.",
    ),
)
"""Map, start, goal and robot."""

RUN = (
    click.option("--seed", type=int, help="An integer from 0 on; the same seed gives the same result."),
    click.option(
        "--set", "settings", multiple=True, metavar="SLOT=COMPONENT|SLOT.FIELD=VALUE", help="Change one part."
    ),
    click.option("--time-limit", type=float, metavar="SECONDS", help="Answer with the best so far after this time."),
)
"""The run."""

ANSWER = (
    DARK,
    click.option("--freeze", is_flag=True, help="Print the complete config instead of planning."),
    click.option("--out", metavar="FILE", help="Write the JSON document."),
    click.option("--json", "as_json", is_flag=True, help="Print the JSON document instead of tables and picture."),
    QUIET,
)
"""What becomes of a plan or a front, beside what each of them draws and writes."""


def options(*which: Callable[[F], F]) -> Callable[[F], F]:
    """Return a decorator that adds options in this order."""

    def add(command: F) -> F:
        for option in reversed(which):
            command = option(command)
        return command

    return add


def config_of(
    given: Mapping[str, Any], *, named: str = "planner", default_planner: str | None = None
) -> tuple["Config", dict[str, Any] | None]:
    """Return the config that options and a file ask for, options first, and what a scenario says of its case.

    ``named``: the option that names the planner.
    """
    from pathloom.config import DEFAULT_PLANNER, Config, parse_place, read_config
    from pathloom.kernel.run import check_seed

    planner = default_planner or DEFAULT_PLANNER
    config = read_config(given["config"], planner) if given["config"] else Config(planner={"use": planner})
    world = given["world"] or config.problem.world
    changes: dict[str, Any] = {}
    facts = None
    if given["case"] is not None and not given["scenario"]:
        raise ConfigError("--case: needs --scenario FILE")
    if given["scenario"]:
        from pathloom.grid import read_scenario

        for name in ("map_", "start", "goal"):
            if given[name] is not None:
                raise ConfigError(f"--scenario: sets map, start and goal; leave --{name.rstrip('_')} away")
        scenario = read_scenario(given["scenario"])
        case = scenario.case(given["case"] or 0)
        changes.update(map=str(scenario.map_path(case)), start=case.start, goal=case.goal, world=False)
        said = {"file": given["scenario"], "case": given["case"] or 0, "stated_optimum": case.optimum}
        facts = {
            "scenario": scenario,
            "case": case,
            "said": {"scenario": {**said, "tolerance": case.tolerance}},
        }
    if given["map_"] is not None:
        changes["map"] = given["map_"]
    for end in ("start", "goal"):
        if given[end] is not None:
            changes[end] = parse_place(given[end], f"--{end}", world=world)
        elif given["world"] and not config.problem.world and not isinstance(getattr(config.problem, end), str):
            raise ConfigError(f"--world: needs --{end} as well, for the config gives it as a cell")
    if world:
        changes.setdefault("world", True)
    for name in ("corners", "radius", "unknown", "threshold"):
        if given[name] is not None:
            changes[name] = given[name]
    try:
        config = replace(config, problem=replace(config.problem, **changes))
    except ConfigError as error:
        raise ConfigError(f"--{error}") from error
    if given[named] is not None:
        config = replace(config, planner={"use": given[named]})
    if given["seed"] is not None:
        config = replace(config, seed=given["seed"])
    if given["time_limit"] is not None:
        config = replace(config, time_limit=given["time_limit"])
    check_seed(config.seed)
    if config.time_limit is not None and not config.time_limit > 0:
        raise ConfigError(f"--time-limit: found {config.time_limit!r}, allowed seconds above 0")
    return config, facts


def changed(planner: Any, settings: tuple[str, ...]) -> Any:
    """Return the planner with what ``--set`` changes of it."""
    from pathloom.kernel.compose import override

    for setting in settings:
        path, equals, text = (part.strip() for part in setting.partition("="))
        if not all(path.split(".")) or not equals:
            raise ConfigError(f"--set {setting}: found no SLOT or no '=', allowed SLOT=COMPONENT or SLOT.FIELD=VALUE")
        try:
            planner = override(planner, path, value_of(text))
        except ConfigError as error:
            said = str(error)
            raise ConfigError(f"--set {said if said.startswith(path) else f'{path}: {said}'}") from error
    return planner


def problem_of(config: "Config", given: Mapping[str, Any], facts: dict[str, Any] | None) -> Any:
    """Build the problem; what is wrong with it is told with the option or the file that says so."""
    try:
        problem = config.problem.build()
    except (ConfigError, ProblemError) as error:
        key = str(error).partition(":")[0]
        if given.get(key) is not None:
            raise type(error)(f"--{error}") from error
        if given["scenario"] and key in ("start", "goal"):
            raise type(error)(f"{given['scenario']}: case {given['case'] or 0}: {error}") from error
        if given["config"]:
            raise type(error)(f"{given['config']}: problem.{error}") from error
        raise
    if facts is not None:
        facts["scenario"].check(facts["case"], problem.grid)
    return problem


def table_of(config: "Config", planner: Any, problem: Any) -> dict[str, Any]:
    """Return the complete config, with how the map is read."""
    from pathloom.config import frozen

    table = frozen(problem, config.problem.map, planner, config.seed, config.time_limit, config.smooth)
    table["problem"] |= {"unknown": config.problem.unknown}
    if config.problem.threshold is not None:
        table["problem"]["threshold"] = config.problem.threshold
    return table


def print_frozen(table: dict[str, Any]) -> None:
    """Print the complete config as TOML. It may be kept anywhere, so that a map's file is named in full."""
    import tomli_w

    name = table["problem"]["map"]
    if Path(name).is_file():
        table["problem"]["map"] = str(Path(name).resolve())
    click.echo(tomli_w.dumps(table), nl=False)


def value_of(text: str) -> Any:
    """Return what a value means in TOML; a bare word is a name."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):  # no TOML, or a number of thousands of digits
        return text


def check_files(given: Mapping[str, Any], **allowed: tuple[str, ...] | None) -> None:
    """Refuse files that could not be written, before any work is done; ``allowed``: suffixes by option."""
    from os import W_OK, access

    for option, suffixes in allowed.items():
        name = given[option]
        if name is None:
            continue
        if not name:
            raise ConfigError(f"--{option}: found no name, allowed a file")
        file = Path(name)
        if suffixes and file.suffix.lower() not in suffixes:
            raise ConfigError(f"--{option}: found the suffix {file.suffix!r}, allowed {' '.join(suffixes)}")
        if not file.parent.is_dir() or not access(file.parent, W_OK):
            raise MapError(f"{name}: the folder {str(file.parent)!r} does not exist or is not writable")
        if file.is_dir():
            raise MapError(f"{name}: is a folder")
