"""``pathloom study bundle``: what another lab needs to repeat a study."""

import click


@click.command("bundle")
@click.argument("file")
@click.option("-o", "--out", "out", metavar="FILE", help="The bundle; default the study's name with .zip.")
@click.option("--quiet", is_flag=True, help="No messages.")
def command(file: str, out: str | None, quiet: bool) -> None:
    """Pack maps, configs, seeds, versions and results of a study into one zip file."""
    from pathlib import Path

    from pathloom.cli import asking, console
    from pathloom.study import Study
    from pathloom.study.bundle import bundle

    target = out if out is not None else str(Path(file).with_suffix(".zip"))
    asking.check_files({"out": target}, out=(".zip",))
    with Study.open(file) as study:
        size = bundle(study, target)
    if not quiet:
        console.err().print(f"pathloom: {target} written, {size / 1024:.0f} KiB", soft_wrap=True)
