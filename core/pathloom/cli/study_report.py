"""``pathloom study report``: a study as one page to be read."""

import click


@click.command("report")
@click.argument("file")
@click.option("-o", "--out", "out", metavar="FILE", help="The page; default the study's name with .html.")
@click.option(
    "--baseline", metavar="VARIANT", help="Compare the others with this one; default of an ablation its base."
)
@click.option("--alpha", type=click.FloatRange(0.0, 1.0, min_open=True, max_open=True), default=0.05, show_default=True,
              help="Level of the tests.")  # fmt: skip
@click.option("--quiet", is_flag=True, help="No messages.")
def command(file: str, out: str | None, baseline: str | None, alpha: float, quiet: bool) -> None:
    """Write a study as one HTML file that needs nothing else: answer, tables, figures, cases, methods."""
    from pathlib import Path

    from pathloom.cli import asking, console
    from pathloom.files import replace
    from pathloom.study import Study
    from pathloom.study.report import report

    target = out if out is not None else str(Path(file).with_suffix(".html"))
    asking.check_files({"out": target}, out=(".html", ".htm"))
    with Study.open(file) as study:
        page = report(study, baseline=baseline, alpha=alpha).encode("utf-8", "backslashreplace")
    replace(target, page)
    if not quiet:
        console.err().print(f"pathloom: {target} written, {len(page) / 1024:.0f} KiB", soft_wrap=True)
