"""``pathloom plan``: one path."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import DONE, INTERRUPTED, NO_PATH, asking
from pathloom.errors import ConfigError

if TYPE_CHECKING:
    from pathloom.config import Config

EXPORTS = (".csv", ".json")
MOVING = (".gif", ".mp4")
PLOTS = (".png", ".svg", ".pdf", *MOVING)


@click.command("plan")
@click.argument("config", required=False)
@click.option("--planner", metavar="NAME", help="The planner, e.g. imga; `pathloom plugins list` shows all.")
@asking.options(*asking.PROBLEM, *asking.RUN)
@click.option("--optimum", is_flag=True, help="Compute the exact optima and the gaps to them.")
@click.option("--smooth", metavar="NAME", help="Also make a smooth curve of the path: b-spline or cubic-bezier.")
@click.option("--export", metavar="FILE", help="Write the path: csv of cells and metres, json of a nav_msgs/Path.")
@click.option(
    "--plot", metavar="FILE", help="Draw map, path and convergence: png, svg, pdf; gif and mp4 show the evolution."
)
@asking.options(*asking.ANSWER)
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Plan one path.

    With no argument at all: the default planner on a generated map. CONFIG is a
    TOML file; options go before what it says.
    """
    quiet = options["quiet"]
    config, facts = asking.config_of(options)
    if options["smooth"] is not None:
        from pathloom.config import smoother

        config = replace(config, smooth=smoother(asking.value_of(options["smooth"]), "--smooth"))
    asking.check_files(options, plot=PLOTS, export=EXPORTS, out=None)
    if options["plot"] and Path(options["plot"]).suffix.lower() == ".mp4":
        from pathloom.draw.video import check_ffmpeg

        check_ffmpeg(options["plot"])  # said before the work, not after it

    from pathloom.cli import console
    from pathloom.config import lasting

    with console.compiling(quiet=quiet):
        planner = lasting(asking.changed(_planner(config, options), options["settings"]), config.time_limit)
        problem = asking.problem_of(config, options, facts)
        table = asking.table_of(config, planner, problem)
        if options["freeze"]:
            asking.print_frozen(table)
            return
        ctx.exit(_run(config, planner, problem, options, facts, table))


def _run(config: "Config", planner: Any, problem: Any, options: dict[str, Any], facts: Any, table: Any) -> int:
    from pathloom.cli import console, report
    from pathloom.planning import plan

    frames: list[Any] = []
    animated = bool(options["plot"]) and Path(options["plot"]).suffix.lower() in MOVING
    with console.searching() as check:

        def watch(state: Any) -> None:
            if animated:
                frames.append(report.frame(state))
            check(planner.done(state))

        result = plan(
            problem,
            console.watched(planner, quiet=options["quiet"]),
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


def _planner(config: "Config", options: dict[str, Any]) -> Any:
    from pathloom.kernel.compose import compose

    try:
        return compose(config.planner)
    except ConfigError as error:
        by_option = options["planner"] is not None
        raise ConfigError(f"--{error}" if by_option else f"{options['config']}: {error}") from error
