"""``pathloom policy drive``: policies in the closed loop."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import NO_PATH, asking, learning
from pathloom.errors import ConfigError

if TYPE_CHECKING:
    from rich.console import Console

    from pathloom.kernel.component import Component
    from pathloom.local import ClosedLoop
    from pathloom.local.drivers.driver import Driver
    from pathloom.result import Result
    from pathloom.study.driving import Drives, Team
    from pathloom.study.instances import Instance

PLOTS = (".png", ".svg", ".pdf", ".gif")
DRIVES, PLANNER, MAPS = "rf,guarded:rf,pure-pursuit,dynamic-window", "dijkstra", "blocks-30:8%"


@click.command("drive")
@click.option(
    "--policies",
    default=DRIVES,
    show_default=True,
    metavar="NAME|DRIVER|DRIVER:NAME,…",
    help="Who drives: a policy (with the driver avoiding), a driver, or both, as in guarded:rf.",
)
@click.option(
    "--model",
    metavar="FILE",
    help="A trained model, which drives as well, under its file's name; in --policies also guarded:rf.skops.",
)
@asking.options(*learning.DATA, learning.SET)
@click.option("--maps", "--map", "maps", metavar="NAME|FILE,…", help=f"Maps; default {MAPS}.")
@click.option("--start", metavar="ROW,COL|CORNER", help="Where to start on every map; default bottom-left.")
@click.option("--goal", metavar="ROW,COL|CORNER", help="Where to go on every map; default top-right.")
@click.option(
    "--planner",
    default=PLANNER,
    show_default=True,
    metavar="NAME",
    help="Plans the path, on the map without what is not on it.",
)
@click.option("--radius", type=float, metavar="METRES", help="Radius of the robot; as --set robot.radius.")
@click.option("--episodes", type=click.IntRange(1, 100_000), default=20, show_default=True, help="Drives on each map.")
@click.option(
    "--plot",
    metavar="FILE",
    help="Draw the first drive on the first map: png, svg, pdf; gif shows the first policy drive.",
)
@asking.options(learning.SEED, asking.DARK)
@click.option("--out", metavar="FILE", help="Write the JSON document.")
@asking.options(asking.JSON, asking.QUIET)
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Let policies drive along a planned path, around obstacles that stand and walk where the map shows none.

    All meet the same obstacles and the same noise. A drive ends at the goal, in a collision, or late.
    Learned policies are trained on the examples before.
    """
    seed = learning.seed_of(options)
    asking.check_files(options, plot=PLOTS, out=None)
    from pathloom.cli import console
    from pathloom.study.driving import drive

    with console.compiling(quiet=options["quiet"]):
        loop, teams = _teams(options, seed)
        instances = _instances(options, loop)
        paths = []
        for instance in instances:
            path = _planned(instance, options, seed)
            paths.append(path)
            if not path.found:
                console.err().print(f"pathloom: {instance.name}: no path: {path.reason or path.status}", soft_wrap=True)
                ctx.exit(NO_PATH)
        with console.counting("drives", len(teams) * len(instances), quiet=options["quiet"]) as counted:
            drives = drive(teams, instances, paths, loop=loop, episodes=options["episodes"], seed=seed, tell=counted)
    document = drives.to_dict()
    if options["out"]:
        from pathloom.files import replace as rewrite

        rewrite(options["out"], console.json_line(document).encode())
    if options["as_json"]:
        console.print_json(document)
    else:
        _show(drives, console.out())
    if options["plot"]:
        _draw(drives, options)
    if not options["quiet"]:
        for note in _notes(drives):
            console.err().print(f"pathloom: {note}", soft_wrap=True)


def _teams(options: Mapping[str, Any], seed: int) -> "tuple[ClosedLoop, dict[str, Team]]":
    """Return the loop, and who drives in it, trained."""
    import numpy as np

    from pathloom.cli import console
    from pathloom.kernel.compose import freeze
    from pathloom.kernel.registry import default_registry
    from pathloom.local import ClosedLoop, LearnedPolicy, Model, Policy, Rule, load_model
    from pathloom.local.drivers.driver import Driver
    from pathloom.study.driving import Team

    names = learning.names_in(options["policies"], "--policies")
    who = {name: _parts(name) for name in names}
    file = "" if options["model"] is None else Path(options["model"]).name
    if file in _called(Policy) | _called(Driver):
        raise ConfigError(f"--model: found {file!r}, which is a name already; call the file otherwise")
    if file and file not in {policy for _, policy in who.values()}:
        who[file] = ("avoiding", file)
    policies: dict[str, Policy] = {
        p: learning.policy_of(p, "--policies") for _, p in who.values() if p not in ("", file)
    }
    drivers: dict[str, Driver] = {d: _driver(d) for d, _ in who.values()}
    settings = list(options["settings"])
    if options["radius"] is not None:
        settings.append(f"robot.radius={options['radius']}")
    loop = learning.changed(settings, ClosedLoop(), policies, drivers)
    decides: dict[str, Any] = {name: it.decide for name, it in policies.items() if isinstance(it, Rule)}
    facts: dict[str, dict[str, Any]] = {}
    if file:
        model, manifest = load_model(options["model"])
        decides[file] = model.on_readings
        facts[file] = {"policy": manifest["policy"], "trained_on": manifest["examples"]}
    if any(isinstance(policy, LearnedPolicy) for policy in policies.values()):
        examples = learning.examples_of(options, loop, seed)
        if not options["quiet"]:
            for note in examples.notes:
                console.err().print(f"pathloom: {note}", soft_wrap=True)
        for name, policy in policies.items():
            if isinstance(policy, LearnedPolicy):
                trained = policy.trained(examples, np.random.default_rng([seed, 1]))
                decides[name] = trained.on_readings if isinstance(trained, Model) else trained
                facts[name] = {"trained_on": {"name": examples.name, "sha256": examples.sha256, "rows": len(examples)}}
    for name, policy in policies.items():
        facts[name] = {"policy": freeze(policy, default_registry()), **facts.get(name, {})}
    teams = {
        name: Team(drivers[driver], decides[policy] if policy else None, facts.get(policy, {}))
        for name, (driver, policy) in who.items()
    }
    for team in teams.values():
        if team.decide is not None:
            team.decide(np.full((1, 24), 2.0))  # compiled and loaded before the clock runs
    return loop, teams


def _parts(name: str) -> tuple[str, str]:
    """Return the names of the driver and of the policy, or of no policy, that a name stands for."""
    from pathloom.local.drivers.driver import Driver

    driver, colon, policy = name.partition(":")
    if colon:
        return driver, policy
    return (name, "") if name in _called(Driver) else ("avoiding", name)


def _called(kind: "type[Component]") -> set[str]:
    """Return the names of all components of a kind, with and without that of their plugin."""
    from pathloom.kernel.registry import default_registry

    return {n for e in default_registry().all_entries(kind) for n in (e.name, e.component.name)}


def _driver(name: str) -> "Driver":
    from pathloom.kernel.compose import build
    from pathloom.kernel.registry import default_registry
    from pathloom.local.drivers.driver import Driver

    return build(Driver, name, default_registry(), "--policies")


def _instances(options: Mapping[str, Any], loop: "ClosedLoop") -> "tuple[Instance, ...]":
    """Return the problems, with obstacles grown by the robot's radius in the units of each map."""
    from pathloom.cli import studying
    from pathloom.config import ProblemSpec, parse_place
    from pathloom.local.surroundings import cell_side
    from pathloom.paths.problem import PathProblem
    from pathloom.study.instances import instances_of

    places = {end: parse_place(options[end], f"--{end}") for end in ("start", "goal") if options[end] is not None}
    spec = ProblemSpec(**places)
    with studying.named("maps", "start", "goal"):
        found = instances_of(studying.split(options["maps"] or MAPS), spec=spec)
    grown = []
    for it in found:
        radius = loop.robot.radius * it.problem.grid.resolution / cell_side(it.problem.grid, loop.cell)
        start, goal = it.problem.ends
        grown.append(replace(it, problem=PathProblem(it.problem.grid, start=start, goal=goal, radius=radius)))
    return tuple(grown)


def _planned(instance: "Instance", options: Mapping[str, Any], seed: int) -> "Result":
    from pathloom.planning import plan

    try:
        return plan(instance.problem, options["planner"], seed=seed, map_name=instance.map)
    except ConfigError as error:
        raise ConfigError(f"--{error}") from error


def _notes(drives: "Drives") -> list[str]:
    """Return what a reader of the numbers ought to know."""
    from pathloom.local.driving import points_along
    from pathloom.local.surroundings import Surroundings, cell_side

    notes = []
    radius = drives.loop.robot.radius
    for instance, path in zip(drives.instances, drives.paths, strict=True):
        grid, cell = instance.problem.grid, cell_side(instance.problem.grid, drives.loop.cell)
        walls = Surroundings(grid, cell)  # the path's own clearance is that to obstacles grown by the radius
        room = min(walls.clearance(x, y, radius) for x, y in points_along(path.path, grid.height, cell))  # type: ignore[arg-type]
        if room < radius:
            near = f"the path comes as near as {room:.2f} m to a wall"
            notes.append(
                f"{instance.name}: {near}, nearer than the robot's radius of {radius:g} m; try --planner dijkstra"
            )
    first = drives.all_of(next(iter(drives.teams)))
    asked = (drives.loop.hazards.standing + drives.loop.hazards.walking) * len(first)
    placed = sum(e.standing + e.walking for e in first)
    if placed < asked:
        notes.append(
            f"{asked - placed} of {asked} hazards found no place near the path with room to pass, and were left out"
        )
    return notes


def _show(drives: "Drives", out: "Console") -> None:
    from rich.table import Table

    from pathloom.study.driving import ARRIVED, CLEARANCE, SECONDS, UNHURT

    loop, (_, verdicts) = drives.loop, drives.compared()
    episodes = len(drives.all_of(next(iter(drives.teams)))) // len(drives.instances)
    out.print(
        f"{len(drives.instances)} maps × {episodes} drives, {loop.hazards.standing} hazards that stand and "
        f"{loop.hazards.walking} that walk; 95 % intervals in brackets, medians of time and clearance"
    )
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("who drives")
    for head in ("collided (%)", "arrived (%)", "time (s)", "clearance (m)", "progress (%)", "steps/s", "ms/decision"):
        table.add_column(head, justify="right")
    for name in drives.teams:
        timing = drives.timing(name)
        table.add_row(
            name, _rate(drives.collisions(name)), _rate(drives.rate(name, ARRIVED)),
            SECONDS.number(drives.median(name, SECONDS)), CLEARANCE.number(drives.median(name, CLEARANCE)),
            f"{100 * sum(e.progress for e in drives.all_of(name)) / len(drives.all_of(name)):.0f}",
            f"{timing['steps_per_second']:.0f}", f"{timing['milliseconds_per_decision']:.3f}",
        )  # fmt: skip
    out.print(table)
    shown = [verdict for verdict in verdicts if verdict.shown and verdict.metric in (UNHURT.name, ARRIVED.name)]
    if shown:
        out.print()
    for verdict in shown:
        out.print(verdict.text, soft_wrap=True)
    if len(shown) < len(verdicts):
        out.print(f"{len(verdicts) - len(shown)} more, of time and clearance or without an effect: --json gives all.")


def _rate(rate: Any) -> str:
    return f"{100 * rate.share:.0f} [{100 * rate.low:.0f}, {100 * rate.high:.0f}]"


def _draw(drives: "Drives", options: Mapping[str, Any]) -> None:
    """Draw the first episode on the first map, driven once more to be recorded."""
    from pathloom.draw import save
    from pathloom.draw.local import Moment, animate_drive, drive_figure
    from pathloom.local.surroundings import cell_side

    instance, path = drives.instances[0], drives.paths[0]
    grid, loop = instance.problem.grid, drives.loop
    again = {
        name: loop.drive(grid, path.path, team.driver, team.decide, seed=drives.seed, record=True)  # type: ignore[arg-type]
        for name, team in drives.teams.items()
    }
    moments = {name: [Moment(*f.pose, f.discs, f.decided) for f in e.frames] for name, e in again.items()}
    ends = {name: e.end for name, e in again.items()}
    shared: dict[str, Any] = {
        "occupied": grid.occupied, "path": path.path, "cell": cell_side(grid, loop.cell), "radius": loop.robot.radius,
        "dark": options["dark"],
    }  # fmt: skip
    if Path(options["plot"]).suffix.lower() == ".gif":
        name = next(iter(moments))
        animate_drive(moments[name], options["plot"], title=name, end=ends[name], step=loop.step, **shared)
        return
    standing = next(iter(again.values())).standing
    figure = drive_figure(moments, ends, standing=standing, title=f"One drive on {instance.name}", **shared)
    save(figure, options["plot"])
