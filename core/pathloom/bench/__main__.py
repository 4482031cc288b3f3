"""``python -m pathloom.bench``."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click

from pathloom.errors import ConfigError, PathloomError

DONE, BAD_INPUT, INTERRUPTED = 0, 2, 130

CORNERS = click.option(
    "--corners", type=click.Choice(("strict", "no-squeeze", "allow")), default="allow", show_default=True,
    help="Corner policy.",
)  # fmt: skip
PLANNERS = "Names, or tables in TOML, with commas"
COUNT = click.IntRange(min=1)


@click.group(invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--suite", "suite_", default="small", show_default=True, help="small, movingai or scale.")
@click.option("--maps", help="Maps instead of a suite, with commas: random-20:30%:x50 are 50; of movingai, files.")
@click.option("--data", metavar="FOLDER", help="Where the Moving AI scenarios are; default PATHLOOM_DATA.")
@click.option("--cases", type=COUNT, default=3, show_default=True, help="Cases of each scenario, spread over it.")
@click.option("--first", is_flag=True, help="The first cases of each scenario instead.")
@click.option("--planners", help=f"{PLANNERS}; default loom and imga. 'none': none.")
@click.option("--peers", help="Words with commas: peers whose names have one; 'none'. Default all.")
@click.option("--seeds", type=COUNT, default=2, show_default=True, help="Runs on each map.")
@click.option(
    "--time-limit",
    type=click.FloatRange(0, min_open=True),
    default=3.0,
    show_default=True,
    help="Seconds for those who can be limited; anytime planners get our time, and ten times that.",
)
@click.option(
    "--target", type=click.FloatRange(0), metavar="PERCENT",
    help="Let everybody stop within so much of the reference: times are then times to that.",
)  # fmt: skip
@CORNERS
@click.option("--markdown", is_flag=True, help="Print Markdown.")
@click.option("--json", "json_", metavar="FILE", help="Write every number.")
@click.option("--quiet", is_flag=True, help="No progress.")
@click.pass_context
def bench(ctx: click.Context, /, **options: Any) -> None:
    """Measure our planners beside what one would take instead: time, gap, success.

    All on the same maps, in one run. Paths are judged by our exact validators under
    one corner policy. Gaps are to the exact any-angle optimum over the centres of
    cells, or at most to a certified lower bound. OMPL's points may lie anywhere, so
    that its gaps can be below zero; 'in the plane' is above the shortest way of all,
    in per cent. Limits of OMPL are wall time, others processor time.
    """
    if ctx.invoked_subcommand is None:
        _compare(**options)


def _compare(
    suite_: str, maps: str | None, data: str | None, cases: int, first: bool, planners: str | None, peers: str | None,
    seeds: int, time_limit: float, target: float | None, corners: Any, markdown: bool, json_: str | None, quiet: bool,
) -> None:  # fmt: skip
    from pathloom.bench.measure import Limits, Run, compare
    from pathloom.bench.ours import EXACT, Ours, usual
    from pathloom.bench.rows import planners_of
    from pathloom.bench.suite import named, suite
    from pathloom.bench.table import HEADS, cells, document, methods, rows_of, table
    from pathloom.bench.table import markdown as in_markdown

    _check_folder(json_, "--json")
    asked = usual() if planners is None else [] if planners == "none" else planners_of(planners)
    ours = [*map(Ours, asked), *EXACT]
    others = _peers(peers)
    if maps is not None and suite_ == "small":
        tasks = named(maps, corners)
    else:
        tasks = suite(suite_, corners, data, cases, first, maps or "")
    limits = Limits(seeds, time_limit, None if target is None else target / 100)
    runs: list[Run] = []
    with _telling(quiet) as tell:
        runs.extend(compare(tasks, ours, others, limits, corners, tell))
    rows = rows_of(runs)
    heads, who = ("method", "version", "used how"), methods([*ours, *others])
    if json_ is not None:
        _write(json_, document(runs, [*ours, *others], limits, corners))
    if markdown:
        click.echo(in_markdown(HEADS, map(cells, rows)) + "\n\n" + in_markdown(heads, who))
        return
    console = _console()
    console.print(table(rows))
    console.print()
    console.print(_plain(heads, who))


@bench.command("scale")
@click.option("--planner", help="A name, or a table in TOML; default loom, else imga over perturbed trees.")
@click.option("--sizes", default="64,128,256,512,1024,2048", show_default=True, help="Sides of the maps.")
@click.option("--seeds", type=COUNT, default=3, show_default=True, help="Runs on each map.")
@CORNERS
@click.option("--plot", metavar="FILE", help="Draw times over sizes: png, svg or pdf.")
@click.option("--dark", is_flag=True, help="Draw on a dark background.")
@click.option("--no-memory", is_flag=True, help="Leave the memory out, which takes a process for each map.")
@click.option("--markdown", is_flag=True, help="Print Markdown.")
@click.option("--json", "json_", metavar="FILE", help="Write every number.")
@click.option("--quiet", is_flag=True, help="No progress.")
def scale(
    planner: str | None, sizes: str, seeds: int, corners: Any, plot: str | None, dark: bool, no_memory: bool,
    markdown: bool, json_: str | None, quiet: bool,
) -> None:  # fmt: skip
    """Measure how time and memory grow with the map, and fit N log N."""
    from pathloom.bench.ours import shown
    from pathloom.bench.scale import HEADS, figure, fits, measured
    from pathloom.bench.table import markdown as in_markdown
    from pathloom.draw.saving import METADATA, check_suffix, save

    if plot is not None:
        check_suffix(plot, METADATA)
        _check_folder(plot, "--plot")
    _check_folder(json_, "--json")
    chosen = _planner(planner)
    with _telling(quiet) as tell:
        points = list(measured(chosen, corners, _sizes(sizes), seeds, with_memory=not no_memory, tell=tell))
    found = fits(points)
    if plot is not None:
        save(figure(points, f"{shown(chosen)}: time over the number of cells", dark=dark), plot)
    if json_ is not None:
        tables = {"points": [asdict(point) for point in points], "fits": [asdict(fit) for fit in found]}
        _write(json_, {"schema": "pathloom.bench.scale/1", "planner": shown(chosen), "corners": corners, **tables})
    lines = [point.line() for point in points]
    if markdown:
        click.echo(in_markdown(HEADS, lines) + "\n\n" + "\n".join(map(str, found)))
        return
    console = _console()
    console.print(_plain(HEADS, lines))
    for fit in found:
        console.print(str(fit))


@bench.command("parallel")
@click.option("--planner", help="A name, or a table in TOML; default loom, else imga over perturbed trees.")
@click.option("--map", "map_", default="random-100:20%", show_default=True, help="A map, by name or file.")
@click.option("--runs", type=COUNT, default=40, show_default=True, help="Runs of each process.")
@CORNERS
def parallel(planner: str | None, map_: str, runs: int, corners: Any) -> None:
    """Measure what two processes lose that plan at once, and whether threads change results."""
    from pathloom.bench.ours import shown
    from pathloom.bench.parallel import measured

    chosen = _planner(planner)
    found = measured(chosen, map_, corners, runs)
    console = _console()
    console.print(f"{shown(chosen)} on {map_}, {runs} runs")
    for clock in ("wall", "cpu"):
        alone, together, loss = (getattr(of, clock) for of in (found.alone, found.together, found.loss))
        console.print(f"{clock}: one process alone {alone:.3f} s, each of two at once {together:.3f} s, "
                      f"a loss of {100 * loss:.0f} %")  # fmt: skip
    console.print(f"in sequence {found.sequence:.3f} s; in four threads {found.threads:.3f} s, "
                  f"results {'the same' if found.same else 'NOT the same'}")  # fmt: skip


@bench.command("rows")
@click.argument("planners")
@click.argument("maps")
@CORNERS
@click.option("--seeds", type=COUNT, default=10, show_default=True, help="Runs on each map.")
@click.option("--first", type=click.IntRange(min=0), default=0, show_default=True, help="The first seed.")
def rows(planners: str, maps: str, corners: Any, seeds: int, first: int) -> None:
    """Print rows of PLANNERS on MAPS in Markdown, as the pages of the plugins show them.

    Runs that found a path, mean and best length, the mean gap to the octile and to
    the any-angle optimum, the mean generation that found the best, and milliseconds
    a run (best and median processor time). MAP@START@GOAL sets other ends than from
    the lower left to the upper right.
    """
    from pathloom.bench.rows import HEADS
    from pathloom.bench.rows import rows as measured
    from pathloom.bench.table import markdown as in_markdown

    for number, line in enumerate(measured(maps, planners, corners, range(first, first + seeds))):
        if number == 0:
            click.echo(in_markdown(HEADS, ()))
        click.echo("| " + " | ".join(line) + " |")


@bench.command("weighted")
@click.option("--maps", default="random-20:20%:x20,random-50:20%:x10", show_default=True, help="Maps with commas.")
@click.option("--planners", default="loom, imga, agacd", show_default=True, help=f"{PLANNERS}.")
@click.option(
    "--objectives", default="imga", show_default=True,
    help="Those of a planner, or a table in TOML: '{length = 1, unsafe-cells = 1, turns = 1}'.",
)  # fmt: skip
@click.option("--seeds", type=COUNT, default=3, show_default=True, help="Runs on each map.")
@CORNERS
def weighted(maps: str, planners: str, objectives: str, seeds: int, corners: Any) -> None:
    """Print how far above the exact optimum of a weighted sum over cell paths planners stay, in Markdown.

    The optimum is that over paths of single steps, by search over cell and heading.
    A path at any angle can be below it.
    """
    from pathloom.bench.table import markdown as in_markdown
    from pathloom.bench.weighted import HEADS, terms_of
    from pathloom.bench.weighted import rows as measured

    lines = list(measured(maps, planners, terms_of(objectives), corners, range(seeds)))
    click.echo(in_markdown(HEADS, lines))


def main() -> None:
    """Run, and exit with a code: one line for whatever is wrong with the input."""
    try:
        code = bench.main(prog_name="python -m pathloom.bench", standalone_mode=False)
    except PathloomError as error:
        code = _say(str(error), BAD_INPUT)
    except click.ClickException as error:
        code = _say(error.format_message(), BAD_INPUT)
    except (KeyboardInterrupt, click.Abort):
        code = _say("interrupted", INTERRUPTED)
    except OSError as error:
        code = _say(f"{error.filename or 'output'}: {error.strerror or error}", BAD_INPUT)
    sys.exit(code or DONE)


def _say(message: str, code: int) -> int:
    from pathloom.files import one_line

    click.echo(one_line("pathloom.bench: " + " ".join(message.split())), err=True)
    return code


def _peers(words: str | None) -> list[Any]:
    from pathloom.bench.peers import PEERS
    from pathloom.naming import closest

    if words is None:
        return list(PEERS.values())
    chosen: dict[str, Any] = {}
    for word in filter(None, (part.strip() for part in words.split(","))):
        found = {name: peer for name, peer in PEERS.items() if word.lower() in name.lower()}
        if not found and word != "none":
            raise ConfigError(f"--peers: no peer is called {word!r}; {closest(word, PEERS)}")
        chosen |= found
    return list(chosen.values())


def _planner(text: str | None) -> Any:
    from pathloom.bench.ours import TREES, usual
    from pathloom.bench.rows import planners_of

    if text is None:
        first = usual()[0]
        return first if first == "loom" else TREES
    planners = planners_of(text)
    if len(planners) != 1:
        raise ConfigError(f"--planner: found {len(planners)} planners, allowed one")
    return planners[0]


def _sizes(text: str) -> list[int]:
    try:
        sizes = [int(part) for part in text.split(",")]
    except ValueError:
        sizes = []
    if not sizes or min(sizes) < 2:
        raise ConfigError(f"--sizes: found {text!r}, allowed whole numbers from 2 with commas between")
    return sorted(set(sizes))


def _check_folder(file: str | None, option: str) -> None:
    """Refuse a file that could not be written, before any work is done."""
    if file is not None and (not file or not Path(file).parent.is_dir() or Path(file).is_dir()):
        raise ConfigError(f"{option}: found {file!r}, allowed a file in a folder that exists")


def _write(file: str, document: Any) -> None:
    import json

    from pathloom.files import replace

    replace(file, (json.dumps(document, indent=1, allow_nan=False) + "\n").encode())


def _console() -> Any:
    from rich.console import Console

    console = Console(highlight=False, markup=False, emoji=False)
    if not console.is_terminal:
        console.width = 200
    return console


def _plain(heads: Sequence[str], lines: Sequence[Sequence[str]]) -> Any:
    from rich.table import Table

    shown = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for head in heads:
        shown.add_column(head)
    for line in lines:
        shown.add_row(*line)
    return shown


@contextmanager
def _telling(quiet: bool) -> Iterator[Callable[[str], None]]:
    """Give a function that says what is done next, where somebody looks."""
    from rich.console import Console

    console = Console(stderr=True, highlight=False, markup=False, emoji=False)
    if quiet or not console.is_terminal:
        yield lambda _: None
        return
    with console.status("") as status:
        yield status.update


if __name__ == "__main__":
    main()
