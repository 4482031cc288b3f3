"""``pathloom plan``: one path."""

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import DONE, INTERRUPTED, NO_PATH
from pathloom.errors import ConfigError, MapError, ProblemError

if TYPE_CHECKING:
    from pathloom.config import Config

EXPORTS = (".csv", ".json")
PLOTS = (".png", ".svg", ".pdf", ".gif")


@click.command("plan")
@click.argument("config", required=False)
@click.option("--planner", metavar="NAME", help="The planner, e.g. imga; `pathloom plugins list` shows all.")
@click.option("--map", "map_", metavar="NAME|FILE", help="A registered or generated map, or a file.")
@click.option("--scenario", metavar="FILE", help="A Moving AI scenario: sets map, start and goal.")
@click.option("--case", type=int, default=None, help="Line of the scenario, counted from 0.")
@click.option("--start", metavar="ROW,COL|CORNER", help="Where to start; default bottom-left.")
@click.option("--goal", metavar="ROW,COL|CORNER", help="Where to go; default top-right.")
@click.option("--world", is_flag=True, help="Start and goal are X,Y in metres.")
@click.option("--corners", metavar="POLICY", help="strict (default), no-squeeze or allow.")
@click.option(
    "--radius",
    type=float,
    help="Radius of the robot, in metres where the map has a resolution, else in cells.",
)
@click.option("--unknown", metavar="occupied|free", help="What unknown cells of a ROS map count as.")
@click.option(
    "--threshold",
    type=click.IntRange(0, 255),
    metavar="GREY",
    help="Grey (0 to 255) below which a pixel is an obstacle.",
)
@click.option("--seed", type=int, help="An integer from 0 on; the same seed gives the same result.")
@click.option("--set", "settings", multiple=True, metavar="SLOT=COMPONENT|SLOT.FIELD=VALUE", help="Change one part.")
@click.option("--time-limit", type=float, metavar="SECONDS", help="Answer with the best so far after this time.")
@click.option("--optimum", is_flag=True, help="Compute the exact optima and the gaps to them.")
@click.option("--smooth", metavar="NAME", help="Also make a smooth curve of the path: b-spline or cubic-bezier.")
@click.option("--freeze", is_flag=True, help="Print the complete config instead of planning.")
@click.option("--plot", metavar="FILE", help="Draw map, path and convergence: png, svg, pdf; gif shows the evolution.")
@click.option("--dark", is_flag=True, help="Draw on a dark background.")
@click.option("--out", metavar="FILE", help="Write the JSON document.")
@click.option("--export", metavar="FILE", help="Write the path: csv of cells and metres, json of a nav_msgs/Path.")
@click.option("--json", "as_json", is_flag=True, help="Print the JSON document instead of table and picture.")
@click.option("--quiet", is_flag=True, help="No progress, no messages.")
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Plan one path.

    With no argument at all: the default planner on a generated map. CONFIG is a
    TOML file; options go before what it says.
    """
    quiet = options["quiet"]
    config, facts = _config(options)
    _check_files(options)

    from pathloom.cli import console
    from pathloom.config import frozen

    with console.compiling(quiet=quiet):
        planner = _planner(config, options)
        problem = _problem(config, options)
        if facts is not None:
            facts["scenario"].check(facts["case"], problem.grid)
        name = config.problem.map
        table = frozen(problem, name, planner, config.seed, config.time_limit, config.smooth)
        table["problem"] |= {"unknown": config.problem.unknown}
        if config.problem.threshold is not None:
            table["problem"]["threshold"] = config.problem.threshold
        if options["freeze"]:
            import tomli_w

            if Path(name).is_file():  # the frozen config may be kept anywhere: name the file in full
                table["problem"]["map"] = str(Path(name).resolve())
            click.echo(tomli_w.dumps(table), nl=False)
            return
        ctx.exit(_run(config, planner, problem, options, facts, table))


def _run(config: "Config", planner: Any, problem: Any, options: dict[str, Any], facts: Any, table: Any) -> int:
    from pathloom.cli import console, report
    from pathloom.planning import plan

    frames: list[Any] = []
    animated = bool(options["plot"]) and Path(options["plot"]).suffix.lower() == ".gif"
    with console.planning(planner, quiet=options["quiet"]) as tell, console.between_generations() as check:

        def watch(state: Any) -> None:
            tell(state)
            if animated:
                frames.append(report.frame(state))
            check(planner.done(state))

        result = plan(
            problem,
            planner,
            seed=config.seed,
            time_limit=config.time_limit,
            optimum=options["optimum"],
            smooth=config.smooth,
            map_name=config.problem.map,
            watch=watch,
        )
    result = replace(result, config=table, problem={**result.problem, **(facts["said"] if facts else {})})
    if options["as_json"]:
        console.print_json(result.to_dict())
    elif result.status != "unreachable":
        report.show(result, console.out())
    unwritten = [] if result.status == "unreachable" else report.write(result, options, frames)
    if not options["quiet"]:
        missing = (f"{name}: not written, for there is no path" for name in unwritten)
        for note in (*report.notes(result), *missing):
            console.err().print(f"pathloom: {note}", soft_wrap=True)
    if result.interrupted:
        return INTERRUPTED
    return DONE if result.found else NO_PATH


def _config(options: dict[str, Any]) -> tuple["Config", dict[str, Any] | None]:
    from pathloom.config import Config, parse_place, read_config, smoother
    from pathloom.kernel.run import check_seed

    config = read_config(options["config"]) if options["config"] else Config()
    world = options["world"] or config.problem.world
    changes: dict[str, Any] = {}
    facts = None
    if options["case"] is not None and not options["scenario"]:
        raise ConfigError("--case: needs --scenario FILE")
    if options["scenario"]:
        from pathloom.grid import read_scenario

        for name in ("map_", "start", "goal"):
            if options[name] is not None:
                raise ConfigError(f"--scenario: sets map, start and goal; leave --{name.rstrip('_')} away")
        scenario = read_scenario(options["scenario"])
        case = scenario.case(options["case"] or 0)
        changes.update(map=str(scenario.map_path(case)), start=case.start, goal=case.goal, world=False)
        said = {"file": options["scenario"], "case": options["case"] or 0, "stated_optimum": case.optimum}
        facts = {
            "scenario": scenario,
            "case": case,
            "said": {"scenario": {**said, "tolerance": case.tolerance}},
        }
    if options["map_"] is not None:
        changes["map"] = options["map_"]
    for end in ("start", "goal"):
        if options[end] is not None:
            changes[end] = parse_place(options[end], f"--{end}", world=world)
        elif options["world"] and not config.problem.world and not isinstance(getattr(config.problem, end), str):
            raise ConfigError(f"--world: needs --{end} as well, for the config gives it as a cell")
    if world:
        changes.setdefault("world", True)
    for name in ("corners", "radius", "unknown", "threshold"):
        if options[name] is not None:
            changes[name] = options[name]
    try:
        config = replace(config, problem=replace(config.problem, **changes))
    except ConfigError as error:
        raise ConfigError(f"--{error}") from error
    if options["planner"] is not None:
        config = replace(config, planner={"use": options["planner"]})
    if options["seed"] is not None:
        config = replace(config, seed=options["seed"])
    if options["time_limit"] is not None:
        config = replace(config, time_limit=options["time_limit"])
    if options["smooth"] is not None:
        config = replace(config, smooth=smoother(_value(options["smooth"]), "--smooth"))
    check_seed(config.seed)
    if config.time_limit is not None and not config.time_limit > 0:
        raise ConfigError(f"--time-limit: found {config.time_limit!r}, allowed seconds above 0")
    return config, facts


def _planner(config: "Config", options: dict[str, Any]) -> Any:
    from pathloom.kernel.compose import compose, override

    try:
        planner = compose(config.planner)
    except ConfigError as error:
        by_option = options["planner"] is not None
        raise ConfigError(f"--{error}" if by_option else f"{options['config']}: {error}") from error
    for setting in options["settings"]:
        path, equals, text = (part.strip() for part in setting.partition("="))
        if not all(path.split(".")) or not equals:
            raise ConfigError(f"--set {setting}: found no SLOT or no '=', allowed SLOT=COMPONENT or SLOT.FIELD=VALUE")
        try:
            planner = override(planner, path, _value(text))
        except ConfigError as error:
            said = str(error)
            raise ConfigError(f"--set {said if said.startswith(path) else f'{path}: {said}'}") from error
    return planner


def _problem(config: "Config", options: dict[str, Any]) -> Any:
    """Build the problem; what is wrong with it is told with the option or the file that says so."""
    try:
        return config.problem.build()
    except (ConfigError, ProblemError) as error:
        key = str(error).partition(":")[0]
        if options.get(key) is not None:
            raise type(error)(f"--{error}") from error
        if options["scenario"] and key in ("start", "goal"):
            raise type(error)(f"{options['scenario']}: case {options['case'] or 0}: {error}") from error
        if options["config"]:
            raise type(error)(f"{options['config']}: problem.{error}") from error
        raise


def _value(text: str) -> Any:
    """Return what a value means in TOML; a bare word is a name."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):  # no TOML, or a number of thousands of digits
        return text


def _check_files(options: dict[str, Any]) -> None:
    """Refuse files that could not be written, before any work is done."""
    for option, allowed in (("plot", PLOTS), ("export", EXPORTS), ("out", None)):
        name = options[option]
        if name is None:
            continue
        if not name:
            raise ConfigError(f"--{option}: found no name, allowed a file")
        file = Path(name)
        if allowed and file.suffix.lower() not in allowed:
            raise ConfigError(f"--{option}: found the suffix {file.suffix!r}, allowed {' '.join(allowed)}")
        from os import W_OK, access

        if not file.parent.is_dir() or not access(file.parent, W_OK):
            raise MapError(f"{name}: the folder {str(file.parent)!r} does not exist or is not writable")
        if file.is_dir():
            raise MapError(f"{name}: is a folder")
