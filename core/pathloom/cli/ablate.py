"""``pathloom ablate``: change one part of a planner at a time."""

from typing import Any

import click

from pathloom.cli import asking, studying
from pathloom.errors import ConfigError


@click.command("ablate")
@click.argument("base")
@click.option(
    "--swap", "swaps", multiple=True, metavar="SLOT=NAME,…",
    help="What takes the place of a slot or a parameter, one at a time, e.g. selection=roulette; repeatable.",
)  # fmt: skip
@click.option("--without", "without", multiple=True, metavar="SLOT", help="A part that is left out; repeatable.")
@click.option("--factorial", is_flag=True, help="All combinations instead of one change at a time.")
@click.option("--add-one-in", is_flag=True, help="Also without all of --without at once, and with each alone of them.")
@asking.options(*studying.MAPS, *studying.RUNS, *studying.WORKERS)
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Change one part of BASE at a time, and see what comes of it.

    BASE is a planner's name or a config in TOML. All variants meet the same maps
    with the same seeds, and may spend the same budget.
    """
    studying.check_out(options)
    from pathlib import Path

    from pathloom.config import Config, read_config
    from pathloom.study.budget import Budget
    from pathloom.study.design import Design, ablation

    base, is_file = options["base"], options["base"].endswith(".toml") or Path(options["base"]).is_file()
    config = read_config(base) if is_file else Config(planner={"use": base})
    with studying.named("budget", "swap", "without", "factorial", "add-one-in"):
        budget = Budget.parse(options["budget"])
        variants, notes = ablation(
            config.planner, swap=_swaps(options["swaps"]), without=options["without"],
            factorial=options["factorial"], add_one_in=options["add_one_in"], budget=budget,
        )  # fmt: skip
    spec = studying.spec_of(options, config.problem)
    with studying.named("maps", "cases", "runs", "seed", "time-limit", "start", "goal", "corners", "radius"):
        places = studying.instances(options, spec, config.problem.map if is_file else None)
        limit = options["time_limit"] if options["time_limit"] is not None else config.time_limit
        design = Design("ablate", variants, places, options["runs"], options["seed"], budget, limit, notes)
    ctx.exit(studying.carried_out(design, options))


def _swaps(given: tuple[str, ...]) -> dict[str, list[Any]]:
    """Return by slot what takes its place."""
    swaps: dict[str, list[Any]] = {}
    for text in given:
        slot, equals, values = (part.strip() for part in text.partition("="))
        listed = studying.split(values)
        if not slot or not equals or not all(listed):
            raise ConfigError(f"--swap {text}: found no SLOT, no '=' or an empty name, allowed SLOT=NAME,NAME,…")
        swaps.setdefault(slot, []).extend(asking.value_of(value) for value in listed)
    return swaps
