"""``pathloom study verify``: whether what a bundle says can be repeated."""

from typing import Any

import click


@click.command("verify")
@click.argument("bundle")
@click.option("--sample", type=click.IntRange(min=1), default=10, show_default=True, help="Runs that are made again.")
@click.option("--seed", type=click.IntRange(min=0), help="Which sample; default another one each time.")
@click.option("--workers", type=int, metavar="N", help="Processes; default one for each core.")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON document.")
@click.option("--quiet", is_flag=True, help="No progress, no messages.")
@click.pass_context
def command(ctx: click.Context, /, bundle: str, **options: Any) -> None:
    """Run a random sample of BUNDLE again, and compare paths and metrics byte for byte.

    Exit code 2 if any run is not as it was.
    """
    from pathloom.cli import BAD_INPUT, DONE, INTERRUPTED, console, studying
    from pathloom.study.bundle import verify
    from pathloom.study.bundle.verifying import LONGEST
    from pathloom.study.session import Workers

    with studying.named("workers"):
        workers = Workers(options["workers"], longest=LONGEST)
    try:
        with studying.progress(quiet=options["quiet"]) as watch, console.between_generations() as check:
            found = verify(
                bundle, sample=options["sample"], seed=options["seed"], workers=workers, watch=watch,
                check=lambda: check(False),
            )  # fmt: skip
    except KeyboardInterrupt:
        ctx.exit(INTERRUPTED)
    if options["as_json"]:
        checks = [{"variant": it.variant, "map": it.map, "seed": it.seed, "differs": it.differs} for it in found.checks]
        console.print_json(
            {
                "schema": "pathloom.study-verification/1",
                "same": found.same,
                "runs": found.runs,
                "repeatable": found.repeatable,
                "checks": checks,
                "notes": found.notes,
            }
        )
    else:
        out = console.out()
        for it in found.checks:
            if not it.same:
                out.print(
                    f"{it.variant} on {it.map}, seed {it.seed}: differs in {', '.join(it.differs)}", soft_wrap=True
                )
        same = sum(it.same for it in found.checks)
        out.print(f"{same} of {len(found.checks)} runs are as they were, of {found.runs} in the bundle", soft_wrap=True)
        if not options["quiet"]:
            for note in found.notes:
                console.err().print(f"pathloom: {note}", soft_wrap=True)
    ctx.exit(DONE if found.same else BAD_INPUT)
