"""``plan --smooth``: a curve in the document, the table, the picture, the export and the frozen config."""

import json
import math
from pathlib import Path

import pytest

from .conftest import timeless, write

MAP1 = ("plan", "--map", "iga-map1", "--corners", "allow", "--seed", "7")
S_RRT = ("plan", "--planner", "s-rrt", "--map", "blocks-20:20%", "--seed", "3")


def test_the_document_has_a_curve_from_start_to_goal(cli) -> None:
    done = cli(*MAP1, "--smooth", "b-spline", "--json")
    assert (done.code, done.err) == (0, "")
    curve = done.document["curve"]
    assert set(curve) == {"points", "length", "min_clearance", "max_curvature", "fallback", "inserted"}
    assert curve["points"][0] == [9.0, 0.0]
    assert curve["points"][-1] == [0.0, 9.0]
    assert all(len(point) == 2 and all(type(x) is float for x in point) for point in curve["points"])
    assert curve["length"] == pytest.approx(sum(map(math.dist, curve["points"], curve["points"][1:])), rel=1e-3)
    assert curve["fallback"] is False
    assert done.document["config"]["run"]["smooth"]["use"] == "b-spline"


def test_without_being_asked_there_is_none_and_the_rest_is_the_same(cli) -> None:
    plain, smooth = cli(*MAP1, "--json").document, cli(*MAP1, "--smooth", "cubic-bezier", "--json").document
    assert plain["curve"] is None
    assert "smooth" not in plain["config"]["run"]
    for key in ("path", "metrics", "objectives", "fitness", "history"):
        assert smooth[key] == plain[key]


def test_a_planner_that_smooths_does_so_unasked_and_otherwise_where_asked(cli) -> None:
    own = cli(*S_RRT, "--json").document
    assert own["curve"]["fallback"] is False
    assert own["metrics"]["polyline_length"] < own["metrics"]["length"] + 2
    assert own["metrics"]["polyline_nodes"] >= 2
    other = cli(*S_RRT, "--smooth", "cubic-bezier", "--json").document
    assert other["curve"] != own["curve"]
    assert other["path"] == own["path"]
    assert cli(*S_RRT, "--set", "smoothing=none", "--json").document["curve"] is None


def test_a_frozen_config_makes_the_same_curve(cli, folder: Path) -> None:
    for options in ((*MAP1, "--smooth", "{ use = 'b-spline', degree = 2, tolerance = 0.01 }"), S_RRT):
        frozen = cli(*options, "--freeze").out
        write(folder / "frozen.toml", frozen)
        assert timeless(cli("plan", "frozen.toml", "--json").document) == timeless(cli(*options, "--json").document)
        assert cli("plan", "frozen.toml", "--freeze").out == frozen


def test_a_config_asks_for_a_curve_and_an_option_for_another_or_none(cli, folder: Path) -> None:
    for value in ('"b-spline"', '{ use = "b-spline", degree = 4 }'):
        write(folder / "mine.toml", f'[problem]\nmap = "iga-map1"\n[run]\nsmooth = {value}\n')
        assert cli("plan", "mine.toml", "--json").document["config"]["run"]["smooth"]["use"] == "b-spline"
    other = cli("plan", "mine.toml", "--smooth", "cubic-bezier", "--json").document
    assert other["config"]["run"]["smooth"]["use"] == "cubic-bezier"
    assert cli("plan", "mine.toml", "--smooth", "none", "--json").document["curve"] is None


BAD = {
    "b-splin": "--smooth: no smoother is called 'b-splin'; did you mean 'b-spline'?",
    "roulette": "--smooth: 'roulette' is a selection, not a smoother",
    "3": "--smooth: a smoother is a name or a table with 'use'; got 3",
    "{ use = 'b-spline', degre = 2 }": "--smooth.degre: 'b-spline' has no such parameter; did you mean 'degree'?",
    "{ use = 'b-spline', degree = 0 }": "--smooth.degree is an integer in [1, 30]; got 0",
    "{ use = 'cubic-bezier', reach = 2 }": "--smooth.reach is a number in (0.0, 1.5]; got 2",
    "{ use = 'b-spline', tolerance = 0 }": "--smooth.tolerance is a number in [1e-06, inf); got 0",
}


@pytest.mark.parametrize("value", BAD)
def test_a_bad_smoother_costs_one_line(refused, value) -> None:
    assert refused("plan", "--smooth", value) == BAD[value]


def test_a_bad_smoother_in_a_config_is_refused_with_file_and_key(refused, folder: Path) -> None:
    write(folder / "mine.toml", '[run]\nsmooth = "b-splin"\n')
    message = "mine.toml: run.smooth: no smoother is called 'b-splin'; did you mean 'b-spline'?"
    assert refused("plan", "mine.toml") == message


def test_the_table_tells_what_the_curve_is_like(cli) -> None:
    curve = cli(*MAP1, "--smooth", "b-spline", "--json").document["curve"]
    shown = cli(*MAP1, "--smooth", "b-spline")
    line = next(line for line in shown.out.splitlines() if line.startswith("curve"))
    assert f"{curve['length']:.4f} cells, least radius {1 / curve['max_curvature']:.3f} cells" in line
    assert "clearance 0.000 cells" in line
    assert shown.err == ""


def test_a_curve_that_keeps_to_the_segments_is_said_to(cli) -> None:
    done = cli(*MAP1, "--smooth", "{ use = 'b-spline', halvings = 0 }")
    assert "with corners" in done.out
    assert "the curve keeps to the straight segments where it would collide" in done.err
    straight = cli("plan", "--map", "empty-9", "--smooth", "b-spline")
    line = next(line for line in straight.out.splitlines() if line.startswith("curve"))
    assert line.split() == ["curve", "11.3137", "cells,", "least", "radius", "infinite,", "no", "obstacles"]


@pytest.mark.parametrize("name", ["a.png", "a.svg", "dark.png"])
def test_the_picture_has_the_curve(cli, folder: Path, name) -> None:
    dark = ("--dark",) if name.startswith("dark") else ()
    assert cli(*S_RRT, "--plot", name, *dark).code == 0
    with_curve = (folder / name).read_bytes()
    assert cli(*S_RRT, "--set", "smoothing=none", "--plot", name, *dark).code == 0
    assert (folder / name).read_bytes() != with_curve


def test_exports_stay_those_of_the_path_and_json_has_the_curve_beside_it(cli, folder: Path) -> None:
    for name in ("a.csv", "a.json"):
        document = cli(*MAP1, "--smooth", "b-spline", "--export", name, "--json").document
    rows = (folder / "a.csv").read_text().splitlines()
    assert rows == ["row,col", *(f"{r},{c}" for r, c in document["path"])]
    message = json.loads((folder / "a.json").read_text())
    assert len(message["poses"]) == len(document["path"])
    curve = message["curve"]
    assert set(curve) == {"header", "poses"}
    places = [(pose["pose"]["position"]["x"], pose["pose"]["position"]["y"]) for pose in curve["poses"]]
    assert places == [pytest.approx((col + 0.5, 10 - row - 0.5)) for row, col in document["curve"]["points"]]
    cli(*MAP1, "--export", "b.json")
    assert set(json.loads((folder / "b.json").read_text())) == {"header", "poses"}


def test_a_curve_on_a_ros_map_is_exported_in_metres(cli, folder: Path) -> None:
    write(folder / "hall.pgm", b"P5\n6 4\n255\n" + bytes([254] * 24))
    text = "image: hall.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
    write(folder / "hall.yaml", f"{text}occupied_thresh: 0.65\nfree_thresh: 0.196\n")
    assert cli("plan", "--map", "hall.yaml", "--smooth", "b-spline", "--export", "a.json").code == 0
    poses = json.loads((folder / "a.json").read_text())["curve"]["poses"]
    assert [poses[i]["pose"]["position"]["x"] for i in (0, -1)] == [-0.75, 1.75]
    assert [poses[i]["pose"]["position"]["y"] for i in (0, -1)] == [2.25, 3.75]


def test_the_document_of_a_search_without_result_has_no_curve(cli) -> None:
    done = cli(
        "plan", "--planner", "rrt", "--map", "maze-41:1", "--set", "samples=500", "--smooth", "b-spline", "--json"
    )
    assert done.code == 3
    assert done.document["curve"] is None
    assert "500 samples made a tree of" in done.err
    assert "perturbed-trees" not in done.err


def test_the_schema_knows_smoothers(cli) -> None:
    import jsonschema

    validator = jsonschema.Draft202012Validator(cli("plugins", "schema").document)
    assert validator.is_valid({"run": {"smooth": "b-spline"}})
    assert validator.is_valid({"run": {"smooth": {"use": "cubic-bezier", "reach": 0.5}}})
    assert validator.is_valid({"run": {"smooth": "none"}})
    assert not validator.is_valid({"run": {"smooth": "b-splin"}})
    assert not validator.is_valid({"run": {"smooth": {"use": "b-spline", "degree": 0}}})
