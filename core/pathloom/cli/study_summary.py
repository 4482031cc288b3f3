"""``pathloom study summary``: what a study shows, in tables and sentences."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from pathloom.study.statistics import Summary

MOST = 40
"""Lines of the table of instances that are shown."""
LONG = 36
"""Letters beyond which the names of variants may be broken."""


@click.command("summary")
@click.argument("file")
@click.option("--metrics", metavar="NAME,…", help="What to compare; default success, gap, length, and what is usual.")
@click.option(
    "--baseline", metavar="VARIANT", help="Compare the others with this one; default of an ablation its base."
)
@click.option("--all-pairs", is_flag=True, help="Compare all pairs, in an ablation too.")
@click.option("--instances", is_flag=True, help="Also a table of every variant on every map.")
@click.option("--alpha", type=click.FloatRange(0.0, 1.0, min_open=True, max_open=True), default=0.05, show_default=True,
              help="Level of the tests.")  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="Print a JSON document.")
@click.option("--latex", "as_latex", is_flag=True, help="Print tables in LaTeX, for booktabs.")
@click.option("--quiet", is_flag=True, help="No notes.")
def command(file: str, **options: Any) -> None:
    """Show success rates, medians, tests and verdicts of a study."""
    from pathloom.cli import console
    from pathloom.errors import ConfigError
    from pathloom.study import Study
    from pathloom.study.statistics import latex, summary

    if options["as_json"] and options["as_latex"]:
        raise ConfigError("study summary: found --json and --latex, allowed one of them")
    names = None if options["metrics"] is None else [name.strip() for name in options["metrics"].split(",")]
    with Study.open(file) as study:
        variants = list(study.variants)
        baseline = options["baseline"]
        if baseline is None and study.kind in ("ablate", "tune") and not options["all_pairs"]:
            baseline = variants[0]
        begun = {variant for variant, counts in study.status.variants.items() if counts}
        found = summary(
            study.each(),
            metrics=names,
            baseline=baseline if baseline in begun or options["baseline"] else None,
            variants=[variant for variant in variants if variant in begun] or None,
            alpha=options["alpha"],
        )
        left = study.status.total - study.status.done
    if options["as_json"]:
        console.print_json(found.to_dict())
    elif options["as_latex"]:
        click.echo(latex(found), nl=False)
    else:
        show(found, console.out(), instances=options["instances"], notes=not options["quiet"])
    if left and not options["quiet"]:
        console.err().print(f"pathloom: {left} runs are still missing; this is what there is", soft_wrap=True)


def show(summary: "Summary", console: "Console", *, instances: bool = False, notes: bool = True) -> None:
    """Print a summary: a table of the variants, one of the instances if asked for, and the verdicts."""
    console.print(overall_table(summary))
    if instances:
        console.print()
        console.print(instance_table(summary))
        if len(summary.cells) > MOST:
            console.print(f"{MOST} of {len(summary.cells)} lines; --json gives all.")
    if summary.verdicts:
        console.print()
    for verdict in summary.verdicts:
        console.print(verdict.text, style="bold" if verdict.shown else None, soft_wrap=True)
    if notes:
        console.print()
        for note in summary.notes:
            console.print(note, style="dim", soft_wrap=True)


def overall_table(summary: "Summary") -> "Table":
    """Return one line for each variant: success first, then medians over the maps."""
    from pathloom.study.statistics.metrics import METRICS

    shown = [METRICS[name] for name in summary.metrics if name != "success"]
    failing = [kind for kind in ("failed", "timeout", "crashed") if any(kind in it.statuses for it in summary.overall)]
    table = _table(
        ["variant", "found", "found, 95 % interval (%)", *failing, *(metric.head for metric in shown)], summary.variants
    )
    for it in summary.overall:
        rate = it.rate
        share = "–" if rate.share is None else f"{100 * rate.low:.0f}–{100 * rate.high:.0f}"
        counts = [str(it.statuses.get(kind, 0)) for kind in failing]
        medians = [metric.number(it.medians[metric.name]) for metric in shown]
        table.add_row(it.variant, f"{rate.found}/{rate.runs}", share, *counts, *medians)
    return table


def instance_table(summary: "Summary") -> "Table":
    """Return one line for each variant on each map: success, then median and quartiles of the known values."""
    from pathloom.study.statistics.metrics import METRICS

    shown = [METRICS[name] for name in summary.metrics if name != "success"]
    table = _table(["map", "variant", "found", *(metric.head for metric in shown)], summary.variants)
    cells = sorted(summary.cells, key=lambda cell: summary.instances.index(cell.instance))
    for cell in cells[:MOST]:
        values = []
        for metric in shown:
            it = cell.spreads[metric.name]
            number = metric.number
            spread = f" [{number(it.lower)}, {number(it.upper)}]" if it.known > 1 and it.lower != it.upper else ""
            values.append(f"{number(it.median)}{spread}")
        table.add_row(cell.instance, cell.variant, f"{cell.rate.found}/{cell.rate.runs}", *values)
    return table


def _table(heads: Sequence[str], names: Sequence[str]) -> "Table":
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    short = max(map(len, names)) <= LONG
    for head in heads:
        named = head in ("variant", "map")
        table.add_column(head, justify="left" if named else "right", overflow="fold", no_wrap=named and short)
    return table
