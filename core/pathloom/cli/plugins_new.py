"""``pathloom plugins new``: a package for a plugin, to begin with."""

from pathlib import Path

import click

from pathloom.cli import asking


@click.command("new")
@click.argument("name")
@click.option("--into", metavar="DIR", default=".", help="Where the folder is made; default here.")
@asking.JSON
def new(name: str, into: str, as_json: bool) -> None:
    """Write a complete package for a plugin into a new folder NAME.

    NAME is the prefix of its components, as in acme/nudge. The package brings two operators, one for single paths and
    one for populations, with their tests: it installs, passes, and is to be changed.
    """
    from pathloom.cli import console
    from pathloom.scaffold import write_package

    folder = write_package(name, Path(into))
    files = sorted(file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file())
    if as_json:
        console.print_json({"folder": str(folder), "files": files})
        return
    out = console.out()
    for file in files:
        out.print(f"{folder.as_posix()}/{file}")
    out.print(f"Now: cd {folder.as_posix()}, then pip install -e '.[dev]' and pytest; README.md says more.")
