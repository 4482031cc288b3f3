"""``pathloom plugins check``: hold the components of a package against the contract."""

from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import asking
from pathloom.errors import PluginError

if TYPE_CHECKING:
    from pathloom.testing.package import Verdict


@click.command("check")
@click.argument("package", required=False)
@asking.JSON
@asking.QUIET
def check(package: str | None, as_json: bool, quiet: bool) -> None:
    """Try every promise that components make on those of PACKAGE, and show which are kept.

    PACKAGE is a plugin's namespace or the name of a distribution; without it, all plugins that did not come with
    pathloom are checked. Exit codes: 0 all promises are kept, 2 one is broken, or a plugin is.
    """
    from pathloom.cli import console
    from pathloom.testing.package import examined, plugins_of

    plugins, broken = plugins_of(package)
    verdicts = []
    with console.counting("checking", len(plugins), quiet=quiet) as next_is:
        for namespace in plugins:
            next_is(namespace)
            verdicts += list(examined(namespace))
    if as_json:
        console.print_json(_document(verdicts, broken))
    else:
        _print(verdicts, broken)
    faults = [v for v in verdicts if v.found == "broken"]
    if broken:
        raise next(iter(broken.values()))
    if faults:
        first = f"{faults[0].plugin}: {faults[0].kind} {faults[0].name!r} breaks {faults[0].check!r}"
        more = f", and {len(faults) - 1} more" if len(faults) > 1 else ""
        raise PluginError(f"{first}{more}: {faults[0].message}")


def _document(verdicts: "list[Verdict]", broken: dict[str, PluginError]) -> dict[str, Any]:
    from dataclasses import asdict

    return {
        "schema": "pathloom.check/1",
        "checks": [asdict(verdict) for verdict in verdicts],
        "broken": {name: str(error) for name, error in broken.items()},
    }


def _print(verdicts: "list[Verdict]", broken: dict[str, PluginError]) -> None:
    from rich.table import Table

    from pathloom.cli import console

    out = console.out()
    table = Table(box=None, pad_edge=False)
    for head in ("kind", "component", "kept", "broken", "not tried"):
        table.add_column(head, no_wrap=True)
    rows: dict[tuple[str, str], list[Verdict]] = {}
    for verdict in verdicts:
        rows.setdefault((verdict.kind, verdict.name), []).append(verdict)
    for (kind, name), its in rows.items():
        kept = sum(v.found == "kept" for v in its)
        wrong, untried = (", ".join(v.check for v in its if v.found == found) for found in ("broken", "not tried"))
        table.add_row(kind, name, str(kept), wrong, untried)
    if rows:
        out.print(table)
    for verdict in verdicts:
        if verdict.found == "broken":
            out.print(f"broken: {verdict.name}, {verdict.check}: {verdict.promise}", style="red", soft_wrap=True)
            out.print(f"  {verdict.message}", soft_wrap=True)
    for cause in broken.values():
        out.print(f"broken: {cause}", style="red", soft_wrap=True)
    if not rows and not broken:
        out.print("no plugin to check: none is installed but those that come with pathloom")
