"""``pathloom study``: look at a study, go on with it, and take its results elsewhere."""

from importlib import import_module
from typing import Any

import click

from pathloom.cli import Group, asking, studying
from pathloom.errors import ConfigError

ELSEWHERE: dict[str, tuple[str, str]] = {
    "summary": ("study_summary", "Show success rates, medians, tests and verdicts of a study."),
    "report": ("study_report", "Write a study as one HTML file to be read."),
    "bundle": ("study_bundle", "Pack a study with what another lab needs to repeat it."),
    "verify": ("study_verify", "Run a sample of a bundle again, and compare."),
    "run": ("study_run", "Run an ablation of a paper, or a study that a file describes."),
}
"""Sub-commands with a module of their own: its name in this folder, and what it is for; ``command`` is in it."""


class Commands(Group):
    """The sub-commands here, and those elsewhere, which are loaded when they are called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return [*super().list_commands(ctx), *ELSEWHERE]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name in ELSEWHERE:
            return import_module(f"pathloom.cli.{ELSEWHERE[cmd_name][0]}").command  # type: ignore[no-any-return]
        return super().get_command(ctx, cmd_name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        here = [(name, one.get_short_help_str(80)) for name, one in self.commands.items()]
        with formatter.section("Commands"):
            formatter.write_dl([*here, *((name, help_) for name, (_, help_) in ELSEWHERE.items())])


@click.group("study", cls=Commands)
def command() -> None:
    """Look at a study, go on with it, and take its results elsewhere."""


@command.command("status")
@click.argument("file")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON document.")
def status(file: str, as_json: bool) -> None:
    """Show how far a study is, and how its runs ended."""
    from pathloom.study import Study

    with Study.open(file) as study:
        studying.show(study, as_json=as_json, quiet=True)


@command.command("resume")
@click.argument("file")
@asking.options(*studying.WORKERS)
@click.pass_context
def resume(ctx: click.Context, /, **options: Any) -> None:
    """Carry out the runs that are missing."""
    from pathloom.study import Study

    ctx.exit(studying.resumed(Study.open(options["file"]), options))


@command.command("export")
@click.argument("file")
@click.option("--csv", metavar="FILE", help="Write a table with one line a run.")
@click.option("--parquet", metavar="FILE", help="Write a Parquet file (needs pyarrow).")
@click.option("--quiet", is_flag=True, help="No messages.")
def export(file: str, csv: str | None, parquet: str | None, quiet: bool) -> None:
    """Write all runs to a file."""
    if csv is None and parquet is None:
        raise ConfigError("study export: found no file to write, allowed --csv FILE and --parquet FILE")
    asking.check_files({"csv": csv, "parquet": parquet}, csv=None, parquet=None)
    from pathloom.cli import console
    from pathloom.study import Study

    with Study.open(file) as study:
        count = study.export(csv=csv, parquet=parquet)
    if not quiet:
        console.err().print(f"pathloom: {count} runs written", soft_wrap=True)
