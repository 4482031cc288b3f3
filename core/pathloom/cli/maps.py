"""``pathloom maps``: list, show, check and make maps."""

from typing import Any

import click

from pathloom.cli import BAD_INPUT, Group
from pathloom.errors import ConfigError, PathloomError


@click.group("maps", cls=Group)
def command() -> None:
    """List, show, check and make maps."""


@command.command("list")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON document.")
def list_(as_json: bool) -> None:
    """List the maps and the families of maps that have a name."""
    from rich.table import Table

    from pathloom.cli import console
    from pathloom.kernel.registry import default_registry
    from pathloom.paths.maps import Map, MapFamily

    rows = []
    for entry in default_registry().all_entries(Map):
        about = (entry.component.__doc__ or "").strip().partition("\n")[0]
        name = entry.component.name
        if issubclass(entry.component, MapFamily):
            name = f"{name}-SIZE" + (f":{entry.component.usual}" if entry.component.usual else "")
        rows.append({"name": name, "plugin": entry.source.namespace, "about": about, "source": entry.component.source})
    if as_json:
        console.print_json({"maps": rows})
        return
    table = Table(box=None, pad_edge=False)
    for head in ("name", "plugin", "what it is"):
        table.add_column(head)
    for row in rows:
        table.add_row(row["name"], row["plugin"], row["about"])
    console.out().print(table)
    console.out().print("A family's map is FAMILY-SIZE:OBSTACLES:sSEED, for example random-20:75:s3 or blocks-50:20%.")


@command.command("show")
@click.argument("map_", metavar="NAME|FILE")
@click.option("--corners", default="strict", help="Policy under which free cells are connected.")
@click.option("--unknown", default="occupied", help="What unknown cells of a ROS map count as.")
@click.option("--threshold", type=click.IntRange(0, 255), help="Grey below which a pixel is an obstacle.")
@click.option("--json", "as_json", is_flag=True, help="Print a JSON document.")
def show(map_: str, corners: str, unknown: str, threshold: int | None, as_json: bool) -> None:
    """Show a map and what it consists of."""
    import numpy as np

    from pathloom.cli import console
    from pathloom.draw import picture
    from pathloom.grid import labels

    grid = _load(map_, corners, unknown, threshold)
    found = labels(grid.occupied, corners)
    sizes = np.sort(np.bincount(found.ravel())[1:])[::-1]
    facts = {
        "map": map_,
        "height": grid.height,
        "width": grid.width,
        "obstacles": int(grid.occupied.sum()),
        "free": grid.free_count,
        "resolution": grid.resolution,
        "origin": list(grid.origin) if grid.origin else None,
        "regions": len(sizes),
        "largest_region": int(sizes[0]) if len(sizes) else 0,
        "sha256": grid.sha256,
    }
    if as_json:
        console.print_json(facts)
        return
    out = console.out()
    ends = ((grid.height - 1, 0), (0, grid.width - 1))
    out.print(picture(grid.occupied, start=ends[0], goal=ends[1], width=min(out.width, 100)))
    share = facts["obstacles"] / grid.occupied.size
    out.print(f"{grid.height} × {grid.width} cells, {facts['obstacles']} obstacles ({100 * share:.1f} %)")
    out.print(f"{facts['regions']} connected regions under {corners!r}, the largest of {facts['largest_region']} cells")
    if grid.origin:
        x, y, yaw = grid.origin
        out.print(f"{grid.resolution:g} m a cell, lower-left corner at ({x:g}, {y:g}) m, yaw {yaw:g} rad")
    out.print(f"sha256 {grid.sha256}")


@command.command("check")
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@click.pass_context
def check(ctx: click.Context, files: tuple[str, ...]) -> None:
    """Read maps and scenarios and say what is wrong with them, one line each."""
    from pathloom.cli import console
    from pathloom.grid import read_map, read_scenario

    failed = False
    for file in files:
        try:
            if file.endswith(".scen"):
                scenario = read_scenario(file)
                for case in {c.map_name: c for c in scenario.cases}.values():
                    scenario.check(case, read_map(scenario.map_path(case)))
                said = f"{len(scenario.cases)} cases"
            else:
                grid = read_map(file)
                said = f"{grid.height} × {grid.width} cells, {grid.free_count} free"
            console.out().print(f"{file}: ok, {said}", soft_wrap=True)
        except PathloomError as error:
            failed = True
            console.err().print(f"pathloom: {error}", soft_wrap=True)
    ctx.exit(BAD_INPUT if failed else 0)


@command.command("make")
@click.argument("family")
@click.option("--size", type=int, default=20, show_default=True, help="Height and width in cells.")
@click.option("--density", type=float, help="Share of obstacle cells, from 0 to 1.")
@click.option("--obstacles", help="A number of cells or a share such as 20%; rooms and mazes: cells between walls.")
@click.option("--seed", type=int, default=0, show_default=True, help="An integer from 0 on.")
@click.option("--corners", default="strict", show_default=True, help="Policy under which the corners are connected.")
@click.option("--out", metavar="FILE", help="Write .map, .csv, .txt or .npy instead of printing.")
def make(
    family: str,
    size: int,
    density: float | None,
    obstacles: str | None,
    seed: int,
    corners: str,
    out: str | None,
) -> None:
    """Make a map of a family and print it in Moving AI's format, or write it to a file."""
    from math import isqrt

    from pathloom.files import LARGEST_MAP
    from pathloom.grid import write_map
    from pathloom.grid.movingai import render_movingai

    if density is not None:
        if obstacles is not None:
            raise ConfigError("--density and --obstacles: found both, allowed one of them")
        if not 0 <= density <= 1:
            raise ConfigError(f"--density: found {density:g}, allowed a share from 0 to 1")
        obstacles = str(round(density * size * size))
    if seed < 0 or size < 1:
        bad = ("--seed", seed, 0) if seed < 0 else ("--size", size, 1)
        raise ConfigError(f"{bad[0]}: found {bad[1]}, allowed an integer from {bad[2]} on")
    if size * size > LARGEST_MAP:
        raise ConfigError(f"--size: found {size}, allowed an integer up to {isqrt(LARGEST_MAP)}")
    name = f"{family}-{size}" + (f":{obstacles}" if obstacles is not None else "") + (f":s{seed}" if seed else "")
    grid = _load(name, corners, "occupied", None)
    if out:
        write_map(grid, out)
    else:
        click.echo(render_movingai(grid), nl=False)


def _load(name: str, corners: str, unknown: str, threshold: int | None) -> Any:
    from typing import get_args

    from pathloom.naming import closest
    from pathloom.paths.context import Corners
    from pathloom.paths.maps import load_map

    if corners not in get_args(Corners):
        known = get_args(Corners)
        raise ConfigError(f"--corners: found {corners!r}; {closest(corners, known)}")
    if unknown not in ("occupied", "free"):
        raise ConfigError(f"--unknown: found {unknown!r}, allowed occupied or free")
    return load_map(name, unknown=unknown, threshold=threshold, corners=corners)  # type: ignore[arg-type]
