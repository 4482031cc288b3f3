"""How ``plan`` shows and writes a result."""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from pathloom.cli.console import json_line
from pathloom.files import replace as write_file
from pathloom.result import Result


def show(result: Result, console: Console) -> None:
    """Print a summary table and a picture of map and path."""
    from pathloom.draw import picture

    problem = result.path_problem
    if problem is not None:
        console.print(
            picture(
                problem.grid.occupied,
                closed=problem.context.occupied if problem.radius else None,
                start=problem.ends[0],
                goal=problem.ends[1],
                path=result.path,
                width=min(console.width, 100),
            )
        )
    table = Table(box=None, show_header=False, pad_edge=False)
    for name, value in _rows(result):
        table.add_row(name, value)
    console.print(table)


def _rows(result: Result) -> Iterator[tuple[str, str]]:
    said = result.problem
    yield (
        "map",
        f"{said['map']}, {said['height']} × {said['width']}, corners {said['corners']}"
        + (f", radius {said['radius']:g}" if said["radius"] else ""),
    )
    yield "planner", f"{result.planner}, seed {result.seed}: {result.status}"
    found = result.metrics
    if result.found:
        metres = f" ({found['length_m']:.3f} m)" if "length_m" in found else ""
        yield "length", f"{found['length']:.4f} cells{metres}, {found['nodes']} nodes"
        yield "turns", f"{found['turns']}, together {math.degrees(found['turn_angle']):.1f}°"
        clearance = "no obstacles" if found["min_clearance"] is None else f"{found['min_clearance']:.3f} cells"
        contacts = f"{found['touches']} touches, {found['squeezes']} squeezes"
        yield "clearance", f"{clearance}; {found['unsafe_nodes']} unsafe nodes, {contacts}"
    if result.curve is not None:
        curve = result.curve
        tightest = "with corners" if math.isinf(curve.max_curvature) else f"least radius {_radius(curve.max_curvature)}"
        near = "no obstacles" if curve.min_clearance is None else f"clearance {curve.min_clearance:.3f} cells"
        yield "curve", f"{curve.length:.4f} cells, {tightest}, {near}"
    if result.optimum is not None:
        gaps = result.gap or {}
        for name, title in (("any_angle", "any-angle optimum"), ("grid", "octile optimum")):
            best, bound = (result.optimum.get(key) for key in (name, f"{name}_bound"))
            gap = gaps.get(name if best is not None else f"{name}_bound")
            if best is not None:
                yield title, f"{best:.4f} cells" + (f", gap {100 * gap:+.3f} %" if gap is not None else "")
            elif bound is not None:
                proven = f", gap at most {100 * gap:.3f} %" if gap is not None else ""
                yield title, f"at least {bound:.4f} cells{proven}: the exact search was given up"
            else:
                yield title, "not known"
    objectives = ", ".join(f"{k} {v:.4g}" for k, v in result.objectives.items())
    if objectives:
        yield (
            "objectives",
            f"{objectives}" + (f"; fitness {result.fitness:.6g}" if result.fitness is not None else ""),
        )
    spent = result.budget
    if spent:
        phases = ", ".join(f"{k} {v:.3f}" for k, v in spent["phases"].items())
        yield "effort", f"{spent['generations']} generations, {spent['evaluations']} evaluations"
        yield "time", f"{spent['seconds']:.3f} s ({phases})"
        counted = ", ".join(f"{k} {v}" for k, v in spent["counts"].items())
        if counted:
            yield "counted", counted


def _radius(curvature: float) -> str:
    """Return a radius of curvature in words."""
    return f"{1.0 / curvature:.3f} cells" if curvature else "infinite"


def notes(result: Result) -> Iterator[str]:
    """Yield what a reader of the numbers ought to know."""
    if result.found and result.reason:
        yield result.reason
    if not result.found:
        yield f"no path: {result.reason}{_advice(result)}"
    elif result.interrupted:
        yield "interrupted; this is the best so far"
    if result.curve is not None and result.curve.fallback:
        yield "the curve keeps to the straight segments where it would collide, with corners there"
    scenario = result.problem.get("scenario")
    grid = (result.optimum or {}).get("grid")
    same = not result.problem["radius"]  # a scenario's robot is a point
    if scenario and same and grid is not None and abs(grid - scenario["stated_optimum"]) > scenario["tolerance"]:
        yield (
            f"the scenario states an optimum of {scenario['stated_optimum']:g}; "
            f"the exact one under {result.problem['corners']!r} is {grid:.8f}"
        )


def _advice(result: Result) -> str:
    """Return what may help where the planner's own sampling found nothing."""
    sampling = result.config["planner"].get("sampling")
    if not sampling or result.interrupted or result.budget.get("evaluations") != 0:
        return ""
    if sampling["use"] != "perturbed-trees":
        return "; try --set sampling=perturbed-trees"
    return ""


def frame(state: Any) -> Any:
    """Return one frame of the animation: generation, paths, fittest path so far and its fitness."""
    decode = state.problem.representation.decode
    paths = [decode(row) for row in state.population] if state.demes else []
    best = state.best
    return state.generation, paths, decode(best.row) if best else None, best.fitness if best else None


def write(result: Result, options: dict[str, Any], frames: list[Any]) -> list[str]:
    """Write the files that were asked for, each under a temporary name first; return those that need a path."""
    unwritten = []
    if options["out"]:
        write_file(options["out"], json_line(result.to_dict()).encode())
    if options["export"] and result.found:
        write_file(options["export"], export(result, Path(options["export"]).suffix.lower()).encode())
    elif options["export"]:
        unwritten.append(options["export"])
    if options["plot"]:
        from pathloom.draw.animation import SUFFIXES, animate

        if Path(options["plot"]).suffix.lower() in SUFFIXES:
            problem = result.path_problem
            usable = [f for f in frames if f[2] is not None]
            if problem is not None and usable:
                if result.path is not None:  # the last frame shows the answer as it is after refinement
                    usable.append((usable[-1][0], [], result.path, result.fitness))
                animate(
                    usable,
                    options["plot"],
                    occupied=problem.grid.occupied,
                    closed=problem.context.occupied if problem.radius else None,
                    start=problem.ends[0],
                    goal=problem.ends[1],
                    dark=options["dark"],
                )
            else:
                unwritten.append(options["plot"])
        else:
            result.plot(options["plot"], dark=options["dark"])
    return unwritten


def export(result: Result, suffix: str) -> str:
    """Return the path as CSV (cells, and metres where known) or as the JSON of a ``nav_msgs/Path``.

    Both stay the path's where there is a curve; the JSON then holds a second
    ``nav_msgs/Path`` of the curve's points, ``curve``.
    """
    path: Any = result.path if result.path is not None else np.empty((0, 2))
    world = result.world
    if suffix == ".csv":
        head = "row,col" + (",x,y" if world is not None else "")
        lines = [
            f"{r},{c}" + (f",{world[i][0]:.6f},{world[i][1]:.6f}" if world is not None else "")
            for i, (r, c) in enumerate(path)
        ]
        return "\n".join([head, *lines]) + "\n"
    message = _nav_path(_metres(result, path) if world is None else world)
    if result.curve is not None:
        message["curve"] = _nav_path(_metres(result, result.curve.points))
    return json.dumps(message, indent=1) + "\n"


def _metres(result: Result, points: Any) -> Any:
    """Return x and y of points (n, 2); without a place in the world cells are metres from the lower-left corner."""
    problem = result.path_problem
    if problem is not None and problem.grid.origin is not None:
        return problem.grid.world(points)
    return points[:, ::-1] * (1.0, -1.0) + (0.5, result.problem["height"] - 0.5)


def _nav_path(points: Any) -> dict[str, Any]:
    """Return a ``nav_msgs/Path``: poses at the way-points (n, 2), each looking along the way that leaves it."""
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "map"}
    poses: list[dict[str, Any]] = []
    places = points.tolist()
    yaw = 0.0
    for i, (x, y) in enumerate(places):
        if i + 1 < len(places):
            yaw = math.atan2(places[i + 1][1] - y, places[i + 1][0] - x)
        turn = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
        pose = {"position": {"x": x, "y": y, "z": 0.0}, "orientation": turn}
        poses.append({"header": header, "pose": pose})
    return {"header": header, "poses": poses}
