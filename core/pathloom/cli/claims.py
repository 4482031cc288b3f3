"""``pathloom claims``: measure again what the papers say."""

import click


@click.command("claims")
@click.argument("plugin", required=False)
@click.option("--full", is_flag=True, help="As many runs as the papers; else a few that show the direction.")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON document.")
@click.option("--markdown", is_flag=True, help="Print a table in Markdown, as the plugins' pages show it.")
@click.option("--quiet", is_flag=True, help="No progress.")
def command(plugin: str | None, full: bool, as_json: bool, markdown: bool, quiet: bool) -> None:
    """Measure again what the papers say, all of them or one PLUGIN's: said, measured, verdict.

    Claims about times depend on the machine. Maps that a paper prints as a picture
    only are read from the folder PATHLOOM_DATA, where that is set.
    """
    from pathloom.claims import Bench, claims_of
    from pathloom.cli import console

    bench = Bench(full=full)
    found = []
    with console.compiling(quiet=quiet):
        claims = list(claims_of(plugin))
        with console.counting("claims", len(claims), quiet=quiet) as counted:
            for namespace, claim in claims:
                counted(f"{namespace}: {claim.name}")
                found += [(namespace, claim, finding) for finding in claim.examine(bench)]
    if as_json:
        rows = [
            {"plugin": namespace, "claim": claim.name, "source": claim.source, **vars(finding)}
            for namespace, claim, finding in found
        ]
        console.print_json({"schema": "pathloom.claims/1", "full": full, "claims": rows})
        return
    heads: tuple[str, ...] = ("where", "the paper says", "we measure", "verdict")
    many = plugin is None
    lines = [
        ((namespace,) if many else ()) + (finding.place, finding.says, finding.measured, finding.verdict)
        for namespace, _, finding in found
    ]
    if many:
        heads = ("plugin", *heads)
    if markdown:
        click.echo("\n".join("| " + " | ".join(row) + " |" for row in (heads, ("---",) * len(heads), *lines)))
        return
    from rich.table import Table

    colour = {"holds": "green", "holds in direction": "yellow", "does not hold": "red", "not testable": "dim"}
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for head in heads:
        table.add_column(head)
    for line in lines:
        table.add_row(*line, style=colour[line[-1]] if line[-1] == "does not hold" else None)
    console.out().print(table)
    verdicts = [line[-1] for line in lines]
    said = ", ".join(f"{verdicts.count(v)} {v}" for v in colour if v in verdicts)
    console.out().print(f"{len(lines)} statements: {said}.")
