"""``pathloom study run``: the papers' own ablations, and studies that files describe."""

from typing import Any

import click

from pathloom.cli import asking, studying


@click.command("run")
@click.argument("name", required=False)
@click.option("--full", is_flag=True, help="All maps and runs; else a few, which takes minutes.")
@click.option("--runs", type=int, help="Runs of each variant on each map, other than the file says.")
@click.option("--maps", metavar="NAME|FILE,…", help="Maps other than the file's.")
@click.option("--out", metavar="FILE", help="The study's file; default NAME.db. Taken up where it stopped.")
@asking.options(*studying.WORKERS)
@click.pass_context
def command(ctx: click.Context, /, name: str | None, **options: Any) -> None:
    """Run an ablation of a paper by its NAME, or a study that a file in TOML describes; without NAME: list them."""
    from pathlib import Path

    from pathloom.cli import DONE, console
    from pathloom.study.papers import names, read

    if name is None:
        from rich.table import Table

        table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), show_header=False)
        for known, (question, source) in names().items():
            table.add_row(known, f"{question} {source}.")
        console.out().print(table)
        ctx.exit(DONE)
    changes = {"runs": options["runs"], "maps": None if options["maps"] is None else studying.split(options["maps"])}
    options["out"] = options["out"] if options["out"] is not None else f"{Path(name).stem}.db"
    studying.check_out(options)
    design = read(name, full=options["full"], changes={k: v for k, v in changes.items() if v is not None})
    code = studying.carried_out(design, options)
    if code == DONE and not options["as_json"]:
        from pathloom.cli.study_summary import show
        from pathloom.study import Study
        from pathloom.study.report import summarised

        with Study.open(options["out"]) as study:
            console.out().print()
            show(summarised(study), console.out(), notes=not options["quiet"])
    ctx.exit(code)
