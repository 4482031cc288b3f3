"""``pathloom pareto``: a front of paths, none better than another in every objective."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import DONE, INTERRUPTED, NO_PATH, asking
from pathloom.errors import ConfigError
from pathloom.naming import closest

if TYPE_CHECKING:
    from pathloom.config import Config
    from pathloom.fronts.asked import Asked
    from pathloom.kernel.front import FrontPlanner

PLOTS = (".png", ".svg", ".pdf")


@click.command("pareto")
@click.argument("config", required=False)
@click.option("--algorithm", metavar="NAME", help="What finds the front: nsga2 (default), nsga3, …")
@click.option("--objectives", metavar="NAME,NAME,…", help="Two to five objectives, all minimised.")
@click.option(
    "--constraint", "constraints", multiple=True, metavar="TEXT",
    help="What every path keeps to, e.g. 'clearance>=0.3' or 'length<=1.2xoptimum'; repeatable.",
)  # fmt: skip
@asking.options(*asking.PROBLEM, *asking.RUN)
@click.option("--exact", is_flag=True, help="Compute the exact front as well, and measure against it.")
@click.option("--against", metavar="PLANNER,…", help="Place the paths of planners of one path beside the front.")
@click.option("--runs", type=int, metavar="N", help="Run each planner of --against with so many seeds.")
@click.option(
    "--prefer", metavar="NAME=WEIGHT,…|WEIGHTING", help="What matters, e.g. length=2,turns=1, or agacd/delphi-ratio."
)
@click.option("--reference", metavar="VALUE,…", help="Reference point of the hypervolume.")
@click.option("--plot", metavar="FILE", help="Draw the front and its paths on the map: png, svg, pdf.")
@click.option("--colour", metavar="NAME", help="The objective by which --plot colours the paths; the first one.")
@asking.options(*asking.ANSWER)
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Plan a front: trade-offs between two to five objectives.

    With no argument at all: the default algorithm on a generated map. CONFIG is a
    TOML file; options go before what it says.
    """
    asking.check_files(options, plot=PLOTS, out=None)
    from pathloom.cli import console
    from pathloom.multiobjective import DEFAULT_PLANNER

    config, facts = asking.config_of(options, named="algorithm", default_planner=DEFAULT_PLANNER)
    config = replace(config, front=_asked(config.front, options))
    with console.compiling(quiet=options["quiet"]):
        planner = _planner(config, options)
        _check_asked(config.front, planner, options)
        problem = asking.problem_of(config, options, facts)
        table = {**asking.table_of(config, planner, problem), "front": config.front.frozen()}
        if options["freeze"]:
            asking.print_frozen(table)
            return
        ctx.exit(_run(config, planner, problem, options, facts, table))


def _run(
    config: "Config", planner: "FrontPlanner", problem: Any, options: dict[str, Any], facts: Any, table: Any
) -> int:
    from pathloom.cli import console, front_report
    from pathloom.files import replace as write_file
    from pathloom.multiobjective import pareto

    asked = config.front
    with console.printing_aside(), console.between_generations() as check:

        def watch(state: Any) -> None:
            check(planner.done(state))

        result = pareto(
            problem,
            console.watched(planner, quiet=options["quiet"]),
            seed=config.seed,
            time_limit=config.time_limit,
            exact=asked.exact,
            against=asked.against,
            runs=asked.runs,
            prefer=asked.prefer,
            reference=asked.reference,
            map_name=config.problem.map,
            watch=watch,
        )
    result = replace(result, config=table, problem={**result.problem, **(facts["said"] if facts else {})})
    if options["as_json"]:
        console.print_json(result.to_dict())
    elif result.status != "unreachable":
        front_report.show(result, console.out())
    if options["out"] and result.status != "unreachable":
        write_file(options["out"], console.json_line(result.to_dict()).encode())
    if options["plot"] and result.found:
        result.plot(options["plot"], colour=options["colour"], dark=options["dark"])
    if not options["quiet"]:
        missing = options["plot"] if not result.found and result.status != "unreachable" else None
        for note in front_report.notes(result, missing):
            console.err().print(f"pathloom: {note}", soft_wrap=True)
    if result.interrupted:
        return INTERRUPTED
    return DONE if result.found else NO_PATH


def _asked(asked: "Asked", options: dict[str, Any]) -> "Asked":
    """Return what is asked of the front, options before the config."""
    changes: dict[str, Any] = {"exact": True} if options["exact"] else {}
    if options["against"] is not None:
        changes["against"] = _names(options["against"])
    if options["runs"] is not None:
        changes["runs"] = options["runs"]
    if options["prefer"] is not None:
        changes["prefer"] = _preference(options["prefer"])
    if options["reference"] is not None:
        changes["reference"] = tuple(asking.value_of(part) for part in _names(options["reference"]))
    try:
        return replace(asked, **changes)
    except ConfigError as error:
        raise ConfigError(f"--{error}") from error


def _check_asked(asked: "Asked", planner: "FrontPlanner", options: dict[str, Any]) -> None:
    """Check what is asked of the front against its objectives, before any work is done."""
    if options["colour"] is not None and options["colour"] not in (labels := planner.objectives.labels):
        hint = closest(options["colour"], labels)
        raise ConfigError(f"--colour: no objective of this front is {options['colour']!r}; {hint}")
    try:
        asked.check(planner.objectives)
        asked.rivals()
    except ConfigError as error:
        key = str(error).partition(":")[0]
        if options.get(key) is not None:
            raise ConfigError(f"--{error}") from error
        raise ConfigError(f"{options['config']}: front.{error}" if options["config"] else str(error)) from error


def _planner(config: "Config", options: dict[str, Any]) -> "FrontPlanner":
    """Return the planner of the front; what is wrong with it is told with the option or the file that says so."""
    from pathloom.multiobjective import front_planner

    objectives = None if options["objectives"] is None else _names(options["objectives"])
    try:
        planner = front_planner(config.planner, objectives, options["constraints"])
    except ConfigError as error:
        said = str(error).removeprefix("planner.").removeprefix("planner: ")
        for word, option in (("objectives", "objectives"), ("constraint", "constraints")):
            if said.startswith(word) and options[option]:
                raise ConfigError(f"--{word}{said.removeprefix(word).removeprefix('s')}") from error
        if options["algorithm"] and str(error).startswith("planner:"):
            raise ConfigError(f"--algorithm: {said}") from error
        raise ConfigError(f"{options['config']}: {error}" if options["config"] else str(error)) from error
    return front_planner(asking.changed(planner, options["settings"]))


def _names(text: str) -> list[str]:
    """Return what stands between commas."""
    return [part.strip() for part in text.split(",")]


def _preference(text: str) -> Any:
    """Return the weights in ``NAME=WEIGHT,…``, or what else the text means in TOML."""
    if "=" not in text or text.lstrip().startswith("{"):
        return asking.value_of(text)
    pairs = [part.partition("=") for part in _names(text)]
    for name, equals, _ in pairs:
        if not (name and equals):
            raise ConfigError(f"--prefer: found {text!r}, allowed NAME=WEIGHT,… or the name of a weighting")
    return {name.strip(): asking.value_of(weight.strip()) for name, _, weight in pairs}
