"""The JSON document of ``plan``: its keys, their types, and that a seed settles it."""

import math
from pathlib import Path

import pytest

from .conftest import timeless, write

PROBLEM1 = ("plan", "--map", "iga-map1", "--corners", "allow", "--seed", 7)
MAP1 = (*PROBLEM1, "--planner", "imga")


def is_int(value: object) -> bool:
    return type(value) is int


def is_float(value: object) -> bool:
    return type(value) is float and math.isfinite(value)


def is_cell(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(map(is_int, value))


def is_text(value: object) -> bool:
    return isinstance(value, str)


def is_path(value: object) -> bool:
    return isinstance(value, list) and all(map(is_cell, value))


def is_table(value: object) -> bool:
    return isinstance(value, dict)


SHAPE = {
    "schema": lambda v: v == "pathloom.plan/1",
    "status": lambda v: v == "found",
    "planner": lambda v: v == "imga",
    "seed": is_int,
    "problem.map": is_text,
    "problem.map_sha256": lambda v: is_text(v) and len(v) == 64,
    "problem.height": is_int,
    "problem.width": is_int,
    "problem.resolution": is_float,
    "problem.start": is_cell,
    "problem.goal": is_cell,
    "problem.corners": is_text,
    "problem.radius": is_float,
    "path": is_path,
    "world": lambda v: v is None,
    "metrics.length": is_float,
    "metrics.nodes": is_int,
    "metrics.turns": is_int,
    "metrics.turn_angle": is_float,
    "metrics.min_clearance": is_float,
    "metrics.unsafe_nodes": is_int,
    "metrics.touches": is_int,
    "metrics.squeezes": is_int,
    "objectives.length": is_float,
    "objectives.safety": is_float,
    "objectives.energy": is_float,
    "fitness": is_float,
    "optimum.grid": is_float,
    "optimum.any_angle": is_float,
    "optimum.any_angle_bound": is_float,
    "gap.grid": is_float,
    "gap.any_angle": is_float,
    "gap.any_angle_bound": is_float,
    "budget.generations": is_int,
    "budget.evaluations": is_int,
    "budget.seconds": is_float,
    "budget.phases.sampling": is_float,
    "budget.phases.evolution": is_float,
    "budget.phases.refinement": is_float,
    "history.evaluations": lambda v: all(map(is_int, v)),
    "history.best": lambda v: all(map(is_float, v)),
    "history.mean": lambda v: all(map(is_float, v)),
    "history.diversity": lambda v: all(map(is_float, v)),
    "config.problem": is_table,
    "config.planner": is_table,
    "config.run": is_table,
    "versions.pathloom": is_text,
    "versions.python": is_text,
    "versions.numpy": is_text,
}


def test_every_key_of_the_interface_is_there_with_its_type(cli) -> None:
    document = cli(*MAP1, "--optimum", "--json").document
    for dotted, fits in SHAPE.items():
        value = document
        for key in dotted.split("."):
            value = value[key]
        assert fits(value), (dotted, value)


def test_the_default_planner_fills_the_same_document_with_its_own_objective(cli) -> None:
    document = cli(*PROBLEM1, "--optimum", "--json").document
    assert document["planner"] == "loom"
    assert document["objectives"] == {"length": pytest.approx(document["metrics"]["length"])}
    others = {key: fits for key, fits in SHAPE.items() if key != "planner" and not key.startswith("objectives.")}
    for dotted, fits in others.items():
        value = document
        for key in dotted.split("."):
            value = value[key]
        assert fits(value), (dotted, value)


@pytest.mark.parametrize("planner", ["loom", "imga"])
def test_a_document_says_when_the_first_path_was_there_and_when_the_best(cli, planner) -> None:
    budget = cli(*PROBLEM1, "--planner", planner, "--json").document["budget"]
    assert 0.0 < budget["seconds_to_first"] <= budget["seconds_to_best"] <= budget["seconds"]


@pytest.mark.parametrize("planner", ["loom", "imga"])
def test_the_numbers_of_a_document_belong_together(cli, planner) -> None:
    found = cli(*PROBLEM1, "--planner", planner, "--optimum", "--json").document
    path, history = found["path"], found["history"]
    assert path[0] == found["problem"]["start"] == [9, 0]
    assert path[-1] == found["problem"]["goal"] == [0, 9]
    assert found["metrics"]["nodes"] == len(path)
    assert found["metrics"]["length"] == pytest.approx(sum(map(math.dist, path, path[1:])))
    assert found["gap"]["grid"] == pytest.approx(found["metrics"]["length"] / found["optimum"]["grid"] - 1)
    assert found["optimum"]["any_angle"] <= found["optimum"]["grid"]
    assert len({len(series) for series in history.values()}) == 1
    assert history["evaluations"][-1] == found["budget"]["evaluations"]
    assert len(history["best"]) == found["budget"]["generations"] + 1
    assert found["budget"]["seconds"] == pytest.approx(sum(found["budget"]["phases"].values()))


def test_optimum_and_gap_are_null_unless_asked_for(cli) -> None:
    document = cli(*MAP1, "--json").document
    assert document["optimum"] is None
    assert document["gap"] is None


def test_json_is_one_line_and_the_only_thing_printed(cli) -> None:
    done = cli(*PROBLEM1, "--optimum", "--json")
    assert done.err == ""
    assert done.out.count("\n") == 1


@pytest.mark.parametrize("planner", ["loom", "imga"])
def test_same_seed_in_two_processes_gives_the_same_bytes_apart_from_times(process, planner) -> None:
    run = (*PROBLEM1, "--planner", planner)
    one, two = (process(*run, "--optimum", "--json", env={"PYTHONHASHSEED": seed}) for seed in ("1", "2"))
    assert one.code == two.code == 0
    assert str(timeless(one.document)) == str(timeless(two.document))


def test_another_seed_gives_another_history(cli) -> None:
    one, two = (cli("plan", "--map", "random-20:75", "--seed", s, "--json").document["history"] for s in (1, 2))
    assert one != two


def test_an_unreachable_goal_is_a_document_without_path(cli, wall) -> None:
    done = cli("plan", "--map", wall, "--optimum", "--json")
    document = done.document
    assert done.code == 3
    assert document["status"] == "unreachable"
    assert document["path"] is document["world"] is document["fitness"] is None
    assert set(document) >= {key.partition(".")[0] for key in SHAPE}


def test_a_search_that_finds_nothing_says_so_and_what_may_help(cli) -> None:
    # One try to draw each individual is not enough on this map.
    done = cli("plan", "--planner", "imga", "--map", "iga-map1", "--set", "sampling.tries=1", "--json")
    assert done.code == 3
    assert done.document["status"] == "not-found"
    assert done.document["path"] is None
    assert "try --set sampling=perturbed-trees" in done.err


def test_no_path_is_quiet_where_quiet_is_asked_for(cli, wall) -> None:
    done = cli("plan", "--map", wall, "--quiet")
    assert (done.code, done.out, done.err) == (3, "", "")


ORIGIN, RESOLUTION = (1.0, -2.0, 0.5), 0.25


@pytest.fixture
def hall(folder: Path) -> str:
    """A ROS map of 6 × 8 cells, turned by half a radian, with a wall of unknown cells but for one gap."""
    pixels = bytearray([254] * 48)
    for row in range(5):
        pixels[row * 8 + 4] = 205
    write(folder / "hall.pgm", b"P5\n# drawn by hand\n8 6\n255\n" + bytes(pixels))
    head = f"image: hall.pgm\nresolution: {RESOLUTION}\norigin: [1.0, -2.0, 0.5]\nnegate: 0\n"
    return write(folder / "hall.yaml", f"{head}occupied_thresh: 0.65\nfree_thresh: 0.196\n").name


def metres(row: int, col: int) -> tuple[float, float]:
    """The centre of a cell of the hall, in metres, from the definition of a ROS map."""
    x0, y0, yaw = ORIGIN
    along, up = (col + 0.5) * RESOLUTION, (6 - row - 0.5) * RESOLUTION
    return x0 + math.cos(yaw) * along - math.sin(yaw) * up, y0 + math.sin(yaw) * along + math.cos(yaw) * up


def test_a_ros_map_gives_the_path_in_metres_as_well(cli, hall) -> None:
    document = cli("plan", "--map", hall, "--json").document
    assert document["world"] == [pytest.approx(metres(*cell)) for cell in document["path"]]
    assert document["problem"]["resolution"] == RESOLUTION
    assert document["metrics"]["length_m"] == pytest.approx(document["metrics"]["length"] * RESOLUTION)


def test_start_and_goal_in_metres_stand_for_the_cells_that_hold_them(cli, hall) -> None:
    start, goal = (",".join(map(str, metres(*cell))) for cell in ((1, 2), (4, 6)))
    problem = cli("plan", "--map", hall, "--world", "--start", start, "--goal", goal, "--json").document["problem"]
    assert problem["start"] == [1, 2]
    assert problem["goal"] == [4, 6]


def test_a_point_outside_the_map_is_refused_in_metres(refused, hall) -> None:
    assert refused("plan", "--map", hall, "--world", "--goal", "99,1").startswith("--goal: hall.yaml: found the point")
    assert refused("plan", "--map", hall, "--world", "--goal", "nan,1").startswith("--goal: hall.yaml: found the point")


def test_a_ros_map_is_shown_with_its_place_in_the_world(cli, hall) -> None:
    shown = cli("maps", "show", hall).out
    assert "0.25 m a cell, lower-left corner at (1, -2) m, yaw 0.5 rad" in shown


def test_metres_that_are_no_numbers_are_refused(refused, hall, folder: Path) -> None:
    write(folder / "mine.toml", '[problem]\nmap = "hall.yaml"\nworld = true\nstart = [1, "x"]\n')
    message = "mine.toml: problem.start: found [1, 'x'], allowed x and y in metres"
    assert refused("plan", "mine.toml") == message


def test_a_config_in_metres_takes_options_in_metres(cli, hall, folder: Path) -> None:
    x, y = metres(1, 2)
    write(folder / "mine.toml", f'[problem]\nmap = "hall.yaml"\nworld = true\nstart = [{x}, {y}]\n')
    goal = ",".join(map(str, metres(4, 6)))
    problem = cli("plan", "mine.toml", "--goal", goal, "--json").document["problem"]
    assert (problem["start"], problem["goal"]) == ([1, 2], [4, 6])


def test_unknown_cells_are_free_on_request(cli, hall) -> None:
    ends = ("--start", "0,0", "--goal", "0,7")
    shut = cli("plan", "--map", hall, *ends, "--json").document["metrics"]["length"]
    through = cli("plan", "--map", hall, *ends, "--unknown", "free", "--json").document["metrics"]["length"]
    assert through == 7.0
    assert shut > 7.0


def test_a_radius_counts_in_metres_where_the_map_has_some(cli, hall) -> None:
    # The gap is one cell of 0.25 m wide: a disc of 0.1 m fits, one of 0.3 m does not.
    ends = ("--start", "0,0", "--goal", "0,7")
    assert cli("plan", "--map", hall, *ends, "--radius", 0.1).code == 0
    assert cli("plan", "--map", hall, *ends, "--radius", 0.3).code == 3
