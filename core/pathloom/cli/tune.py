"""``pathloom tune``: good values of parameters, by designed experiments."""

from typing import Any

import click

from pathloom.cli import INTERRUPTED, asking, studying
from pathloom.errors import ConfigError

PLOTS = (".png", ".svg", ".pdf")


@click.command("tune")
@click.argument("base")
@click.option(
    "--factor", "factors", multiple=True, metavar="PARAMETER=VALUE,…",
    help="A parameter with two or three values, from low to high, e.g. population=40,50,60; repeatable.",
)  # fmt: skip
@click.option("--array", metavar="L9|L18|L27|full", help="The settings to try; default the smallest array that fits.")
@click.option(
    "--by", type=click.Choice(["levels", "ols", "paper"]), default="levels", show_default=True,
    help="Read the optimum off mean responses of levels, a linear model, or one with AGACD's divisor.",
)  # fmt: skip
@click.option("--measure", metavar="METRIC", help="The response, e.g. length; default the sharpest gap that is known.")
@click.option(
    "--confirm", type=int, metavar="N", help="Runs that confirm the predicted best; default --runs, 0 for none."
)
@asking.options(*studying.MAPS, *studying.RUNS)
@click.option("--plot", metavar="FILE", help="Draw the main effects: png, svg, pdf.")
@click.option("--dark", is_flag=True, help="Draw on a dark background.")
@asking.options(*studying.WORKERS)
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Try values of BASE's parameters, and predict the best.

    BASE is a planner's name or a config in TOML. Settings are chosen by an
    orthogonal array, so that few tell the effect of each parameter; the predicted
    best is run against BASE with fresh seeds.
    """
    studying.check_out(options)
    asking.check_files(options, plot=PLOTS)
    from pathlib import Path

    from pathloom.config import Config, read_config
    from pathloom.study.budget import Budget
    from pathloom.study.tuning.factors import experiment

    base, is_file = options["base"], options["base"].endswith(".toml") or Path(options["base"]).is_file()
    config = read_config(base) if is_file else Config(planner={"use": base})
    with studying.named("budget", "factor", "array"):
        budget = Budget.parse(options["budget"])
        plan = experiment(config.planner, _factors(options["factors"]), options["array"])
    spec = studying.spec_of(options, config.problem)
    with studying.named("maps", "cases", "start", "goal", "corners", "radius"):
        places = studying.instances(options, spec, config.problem.map if is_file else None)
    limit = options["time_limit"] if options["time_limit"] is not None else config.time_limit
    ctx.exit(_run(plan, places, budget, limit, options))


def _run(plan: Any, places: Any, budget: Any, limit: float | None, options: dict[str, Any]) -> int:
    from pathloom.cli import DONE, console
    from pathloom.study import carry_out
    from pathloom.study.tuning.experiment import tuned

    with studying.named("measure", "confirm", "runs", "seed", "time-limit", "maps", "budget"):
        try:
            with studying.progress(quiet=options["quiet"]) as watch, console.between_generations() as check:

                def carry(design: Any, out: Any) -> Any:
                    return carry_out(
                        design, out, workers=studying.workers_of(options), mixed=options["mixed"], watch=watch,
                        check=lambda: check(False),
                    )  # fmt: skip

                found = tuned(
                    plan, places, carry=carry, by=options["by"], measure=options["measure"], runs=options["runs"],
                    confirm=options["confirm"], seed=options["seed"], budget=budget, time_limit=limit,
                    out=options["out"],
                )  # fmt: skip
        except KeyboardInterrupt:
            if not options["quiet"]:
                said = f"pathloom: interrupted; finished runs are kept in {options['out']}: start again to go on"
                console.err().print(said, soft_wrap=True)
            return INTERRUPTED
    with found.study:
        if options["as_json"]:
            console.print_json(found.to_dict())
        else:
            _show(found, console.out())
        if options["plot"]:
            found.plot(options["plot"], dark=options["dark"])
    return DONE


def _factors(given: tuple[str, ...]) -> dict[str, list[Any]]:
    """Return by parameter the values to try."""
    factors: dict[str, list[Any]] = {}
    for text in given:
        path, equals, values = (part.strip() for part in text.partition("="))
        listed = studying.split(values)
        if not path or not equals or not all(listed):
            raise ConfigError(
                f"--factor {text}: found no parameter, no '=' or an empty value, allowed population=40,50,60"
            )
        if path in factors:
            raise ConfigError(f"--factor {path}: comes twice, allowed once, with all its values")
        factors[path] = [asking.value_of(value) for value in listed]
    return factors


def _show(found: Any, console: Any) -> None:
    """Print the settings with their means, the effects, and what they say."""
    from rich.table import Table

    metric = found.response.metric
    settings = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for factor in found.experiment.factors:
        settings.add_column(factor.path, justify="right")
    settings.add_column(metric.head, justify="right")
    for row, mean in zip(found.experiment.levels.tolist(), found.means.tolist(), strict=True):
        settings.add_row(*map(str, found.experiment.setting(row).values()), metric.number(mean))
    console.print(settings)
    console.print()
    for sentence in found.sentences():
        console.print(sentence)
