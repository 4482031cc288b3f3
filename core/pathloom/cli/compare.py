"""``pathloom compare``: planners against each other."""

from typing import Any

import click

from pathloom.cli import asking, studying
from pathloom.errors import ConfigError


@click.command("compare")
@click.option("--planners", metavar="NAME|FILE,…", help="Planners, or configs in TOML.")
@asking.options(*studying.MAPS, *studying.RUNS, *studying.WORKERS)
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Hold planners against each other: the same maps, the same seeds, the same budget."""
    studying.check_out(options)
    from pathlib import Path

    from pathloom.config import read_config
    from pathloom.study.budget import Budget
    from pathloom.study.design import Design, comparison

    names = [] if options["planners"] is None else studying.split(options["planners"])
    if not names or not all(names):
        raise ConfigError("--planners: found none or an empty name, allowed names with commas between")
    with studying.named("budget"):
        budget = Budget.parse(options["budget"])
    planners: dict[str, Any] = {}
    for name in names:
        is_config = name.endswith(".toml")
        called = Path(name).stem if is_config else name
        if called in planners:
            raise ConfigError(f"--planners: found {called!r} twice, allowed each once")
        planners[called] = read_config(name).planner if is_config else name
    try:
        variants = comparison(planners)
    except ConfigError as error:
        raise ConfigError(f"--planners: {str(error).removeprefix('planner: ')}") from error
    with studying.named("maps", "cases", "runs", "seed", "time-limit", "start", "goal", "corners", "radius"):
        places = studying.instances(options, studying.spec_of(options))
        design = Design("compare", variants, places, options["runs"], options["seed"], budget, options["time_limit"])
    ctx.exit(studying.carried_out(design, options))
