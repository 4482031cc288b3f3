"""What ``compare``, ``ablate`` and ``study`` share: options, maps, progress, and what is said at the end."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import DONE, INTERRUPTED, asking
from pathloom.errors import ConfigError

if TYPE_CHECKING:
    from pathloom.config import ProblemSpec
    from pathloom.study import Study
    from pathloom.study.design import Design
    from pathloom.study.instances import Instance
    from pathloom.study.session import Pace, Workers

MAPS = (
    click.option("--maps", metavar="NAME|FILE,…", help="Maps; random-20:75:x10 stands for ten."),
    click.option("--scenario", "scenarios", multiple=True, metavar="FILE", help="A Moving AI scenario; repeatable."),
    click.option("--cases", metavar="0-9,20|all", default="all", help="Which lines of each scenario, from 0."),
    click.option("--start", metavar="ROW,COL|CORNER", help="Where to start on every map; default bottom-left."),
    click.option("--goal", metavar="ROW,COL|CORNER", help="Where to go on every map; default top-right."),
    asking.CORNERS,
    click.option("--radius", type=float, help="Radius of the robot, in metres where a map has a resolution."),
)
"""The problems."""

RUNS = (
    click.option("--runs", type=int, default=30, show_default=True, help="Runs of each variant on each map."),
    click.option("--seed", type=int, default=0, help="The first seed; the others follow."),
    click.option(
        "--budget", metavar="evaluations[=N]|generations[=N]|seconds=S|own", default="evaluations", show_default=True,
        help="What every run may spend; without a number as much as the base, or the greediest planner, does.",
    ),
    click.option("--time-limit", type=float, metavar="SECONDS", help="A run answers with its best so far after this."),
    click.option("--out", metavar="FILE", help="The study's file; taken up where it stopped if it is there."),
)  # fmt: skip
"""How often, and where it is kept."""

WORKERS = (
    click.option("--workers", type=int, metavar="N", help="Processes; default one for each core."),
    click.option("--dask", metavar="ADDRESS", help="A running Dask cluster instead, e.g. tcp://host:8786."),
    click.option("--mixed", is_flag=True, help="Go on with a study that began with other versions."),
    asking.JSON,
    asking.QUIET,
)
"""Who does the work."""


def split(text: str) -> list[str]:
    """Return what stands between commas, but for those within brackets or quotes."""
    parts, depth, quote = [""], 0, ""
    for sign in text:
        if quote:
            quote = "" if sign == quote else quote
        elif sign in "\"'":
            quote = sign
        depth += (sign in "{[(") - (sign in "}])") if not quote else 0
        if sign == "," and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += sign
    return [part.strip() for part in parts]


def spec_of(options: Mapping[str, Any], base: "ProblemSpec | None" = None) -> "ProblemSpec":
    """Return start, goal, corner policy and radius that options ask for, on top of a config's."""
    from dataclasses import replace

    from pathloom.config import ProblemSpec, parse_place

    changes: dict[str, Any] = {n: options[n] for n in ("corners", "radius") if options[n] is not None}
    changes |= {end: parse_place(options[end], f"--{end}") for end in ("start", "goal") if options[end] is not None}
    return replace(base or ProblemSpec(), **changes)


def instances(options: Mapping[str, Any], spec: "ProblemSpec", otherwise: str | None = None) -> "tuple[Instance, ...]":
    """Return the problems that options ask for; without any, those on the map ``otherwise``."""
    from pathloom.study.instances import instances_of

    maps = [] if options["maps"] is None else split(options["maps"])
    if not maps and not options["scenarios"]:
        if otherwise is None:
            raise ConfigError("--maps: found none, allowed names or files with commas between, or --scenario FILE")
        maps = [otherwise]
    if options["cases"] != "all" and not options["scenarios"]:
        raise ConfigError("--cases: needs --scenario FILE")
    return instances_of(maps, scenarios=options["scenarios"], cases=options["cases"], spec=spec)


@contextmanager
def named(*options: str) -> Iterator[None]:
    """Let an error that begins with the name of an option begin with the option."""
    try:
        yield
    except ConfigError as error:
        said = str(error)
        for option in options:
            word = option.replace("-", " ")
            if said.startswith((f"{word}:", f"{word} ")):
                raise ConfigError(f"--{option}{said[len(word) :]}") from error
        raise


def check_out(options: Mapping[str, Any]) -> None:
    """Refuse to begin without a file that can be written."""
    if options["out"] is None:
        raise ConfigError("--out: found none, allowed a file such as study.db, in which every run is kept")
    asking.check_files(options, out=None)


def workers_of(options: Mapping[str, Any]) -> "Workers":
    """Return who is to do the work."""
    from pathloom.study.session import Workers

    with named("workers"):
        return Workers(options["workers"], options["dask"])


def carried_out(design: "Design", options: Mapping[str, Any]) -> int:
    """Carry a design out, say how it ended, and return the exit code."""
    from pathloom.study import carry_out

    def work(watch: Any, check: Any) -> "Study":
        return carry_out(
            design, options["out"], workers=workers_of(options), mixed=options["mixed"], watch=watch, check=check
        )

    return _shown(work, options["out"], options)


def resumed(study: "Study", options: Mapping[str, Any]) -> int:
    """Carry out what is missing of a study, say how it ended, and return the exit code."""

    def work(watch: Any, check: Any) -> "Study":
        return study.resumed(workers_of(options), mixed=options["mixed"], watch=watch, check=check)

    return _shown(work, study.name, options)


def _shown(work: Callable[[Any, Any], "Study"], out: str, options: Mapping[str, Any]) -> int:
    from pathloom.cli import console

    try:
        with progress(quiet=options["quiet"]) as watch, console.between_generations() as check:
            study = work(watch, lambda: check(False))
    except KeyboardInterrupt:
        if not options["quiet"]:
            console.err().print(f"pathloom: interrupted; {_kept(out)}", soft_wrap=True)
        return INTERRUPTED
    with study:
        show(study, as_json=options["as_json"], quiet=options["quiet"])
    return DONE


def _kept(out: str) -> str:
    from pathloom.errors import PathloomError
    from pathloom.study import Study

    try:
        with Study.open(out) as study:
            status = study.status
    except PathloomError:
        return "nothing was done yet"
    return f"{status.done} of {status.total} runs are kept in {out}: start again to go on"


@contextmanager
def progress(*, quiet: bool) -> Iterator["Callable[[Pace, str], None] | None"]:
    """Give a function that shows how far a study is, how fast it goes, and how long it will take."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    from pathloom.cli import console

    terminal = console.err()
    if quiet or not terminal.is_terminal:
        yield None
        return
    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TextColumn("{task.fields[pace]}"),
        TimeElapsedColumn(),
    )  # fmt: skip
    with Progress(*columns, console=terminal, transient=True) as bar:
        task = bar.add_task("starting", total=None, pace="")

        def watch(pace: "Pace", what: str) -> None:
            left = "" if pace.remaining is None else f", {duration(pace.remaining)} left"
            bar.update(task, description=what, completed=pace.done, total=pace.total, pace=f"{pace.rate:.0f}/s{left}")

        yield watch


def duration(seconds: float) -> str:
    """Return a time in words of two units at most."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


def show(study: "Study", *, as_json: bool, quiet: bool = False) -> None:
    """Print how far a study is, and how its runs ended."""
    from pathloom.cli import console

    status = study.status
    if as_json:
        console.print_json(document(study))
        return
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    kinds = [kind for kind in _kinds() if any(kind in counts for counts in status.variants.values())]
    table.add_column("variant")
    for kind in (*kinds, "of"):
        table.add_column(kind, justify="right")
    for variant, counts in status.variants.items():
        table.add_row(variant, *(str(counts.get(kind, 0)) for kind in kinds), str(status.instances * status.runs))
    console.out().print(table)
    if not quiet:
        for note in study.facts["notes"]:
            console.err().print(f"pathloom: {note}", soft_wrap=True)
    console.out().print(
        f"{Path(study.name).name}: {status.done} of {status.total} runs, {len(status.variants)} variants x "
        f"{status.instances} maps x {status.runs} seeds, {status.budget}",
        soft_wrap=True,
    )


def document(study: "Study") -> dict[str, Any]:
    """Return the JSON document of ``study status``."""
    status = study.status
    return {
        "schema": "pathloom.study-status/1",
        "study": study.name,
        "kind": status.kind,
        "complete": status.complete,
        "total": status.total,
        "done": status.done,
        "variants": {name: dict(counts) for name, counts in status.variants.items()},
        "maps": status.instances,
        "runs": status.runs,
        "budget": study.facts["budget"],
        "time_limit": study.facts["time_limit"],
        "notes": study.facts["notes"],
        "created": study.facts["created"],
        "versions": study.versions,
    }


def _kinds() -> tuple[str, ...]:
    from pathloom.study.row import STATUSES

    return STATUSES
