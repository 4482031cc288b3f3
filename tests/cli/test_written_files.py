"""The files that ``plan`` writes: ``--out``, ``--export`` and ``--plot``."""

import csv
import json
import math
from pathlib import Path

import pytest

from .conftest import moving_ai, timeless, write

QUICK = ("plan", "--set", "termination.limit=3", "--map", "iga-map1", "--corners", "allow")


@pytest.fixture
def hall(folder: Path) -> str:
    """An empty ROS map of 4 × 6 cells of half a metre, with its lower-left corner at (-1, 2)."""
    write(folder / "hall.pgm", b"P5\n6 4\n255\n" + bytes([254] * 24))
    text = "image: hall.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
    return write(folder / "hall.yaml", f"{text}occupied_thresh: 0.65\nfree_thresh: 0.196\n").name


def test_out_holds_the_document_that_json_prints(cli, folder: Path) -> None:
    done = cli(*QUICK, "--json", "--out", "a.json")
    assert (folder / "a.json").read_text() == done.out


def test_out_is_written_beside_table_and_picture(cli, folder: Path) -> None:
    done = cli(*QUICK, "--out", "a.json")
    assert "length" in done.out
    assert json.loads((folder / "a.json").read_text())["status"] == "found"


def test_a_search_without_result_is_written_like_any_other(cli, folder: Path) -> None:
    assert cli("plan", "--map", "maze-21:1:s1", "--planner", "imga", "--out", "a.json").code == 3
    assert json.loads((folder / "a.json").read_text())["status"] == "not-found"


def test_for_an_unreachable_goal_nothing_is_written(cli, folder: Path, wall) -> None:
    assert cli("plan", "--map", wall, "--out", "a.json", "--plot", "a.png", "--export", "a.csv").code == 3
    assert not list(folder.glob("a.*"))


def test_what_is_written_can_be_read_by_the_package(cli, folder: Path) -> None:
    import pathloom

    document = cli(*QUICK, "--json", "--out", "a.json").document
    again = pathloom.Result.from_json((folder / "a.json").read_text()).to_dict()
    assert timeless(again) == timeless(document)


def test_a_file_in_the_way_is_replaced_whole(cli, folder: Path) -> None:
    write(folder / "a.json", "x" * 1_000_000)
    cli(*QUICK, "--out", "a.json")
    json.loads((folder / "a.json").read_text())
    assert [p.name for p in folder.iterdir()] == ["a.json"]


def test_csv_of_a_map_without_a_place_in_the_world_lists_cells(cli, folder: Path) -> None:
    path = cli(*QUICK, "--json", "--export", "a.csv").document["path"]
    head, *rows = csv.reader((folder / "a.csv").read_text().splitlines())
    assert head == ["row", "col"]
    assert [[int(v) for v in row] for row in rows] == path


def test_csv_of_a_ros_map_lists_cells_and_metres(cli, folder: Path, hall) -> None:
    cli("plan", "--map", hall, "--export", "a.csv")
    head, first, *_, last = csv.reader((folder / "a.csv").read_text().splitlines())
    assert head == ["row", "col", "x", "y"]
    # The centres of the lower-left and of the upper-right cell.
    assert [float(v) for v in first] == [3, 0, -0.75, 2.25]
    assert [float(v) for v in last] == [0, 5, 1.75, 3.75]


def test_json_export_is_a_nav_msgs_path_that_looks_along_the_way(cli, folder: Path, hall) -> None:
    cli("plan", "--map", hall, "--export", "a.json")
    message = json.loads((folder / "a.json").read_text())
    assert message["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "map"}
    for pose in message["poses"]:
        assert set(pose) == {"header", "pose"}
        assert set(pose["pose"]["position"]) == {"x", "y", "z"}
        assert sum(v * v for v in pose["pose"]["orientation"].values()) == pytest.approx(1.0)
    places = [tuple(pose["pose"]["position"].values()) for pose in message["poses"]]
    assert places[0] == (-0.75, 2.25, 0.0)
    assert places[-1] == (1.75, 3.75, 0.0)
    yaw = math.atan2(places[1][1] - places[0][1], places[1][0] - places[0][0])
    first = message["poses"][0]["pose"]["orientation"]
    assert first == pytest.approx({"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)})


def test_a_way_straight_up_the_map_looks_north(cli, folder: Path, hall) -> None:
    cli("plan", "--map", hall, "--start", "3,2", "--goal", "0,2", "--export", "a.json")
    first = json.loads((folder / "a.json").read_text())["poses"][0]["pose"]["orientation"]
    assert first == pytest.approx({"x": 0.0, "y": 0.0, "z": math.sqrt(0.5), "w": math.sqrt(0.5)})


def test_a_map_without_a_place_in_the_world_counts_cells_from_the_lower_left_corner(cli, folder: Path, ring) -> None:
    cli("plan", "--map", ring, "--export", "a.json")
    poses = json.loads((folder / "a.json").read_text())["poses"]
    assert [poses[i]["pose"]["position"]["x"] for i in (0, -1)] == [0.5, 2.5]
    assert [poses[i]["pose"]["position"]["y"] for i in (0, -1)] == [0.5, 2.5]


def test_start_and_goal_in_one_cell_export_one_pose(cli, folder: Path, hall) -> None:
    cli("plan", "--map", hall, "--start", "1,1", "--goal", "1,1", "--export", "a.json")
    poses = json.loads((folder / "a.json").read_text())["poses"]
    assert [pose["pose"]["orientation"]["w"] for pose in poses] == [1.0]


@pytest.mark.parametrize("name", ["a.csv", "a.gif"])
def test_a_file_that_needs_a_path_is_not_written_without_one_and_that_is_said(cli, folder: Path, name) -> None:
    done = cli("plan", "--map", "maze-21:1:s1", "--planner", "imga", "--export" if name == "a.csv" else "--plot", name)
    assert done.code == 3
    assert f"{name}: not written" in done.err
    assert not (folder / name).exists()


MAGIC = {"a.png": b"\x89PNG\r\n\x1a\n", "a.svg": b"<?xml", "a.pdf": b"%PDF-", "a.gif": b"GIF89a", "A.PNG": b"\x89PNG"}


@pytest.mark.parametrize("name", MAGIC)
def test_a_plot_has_the_format_of_its_suffix(cli, folder: Path, name) -> None:
    done = cli(*QUICK, "--plot", name, "--quiet")
    assert (done.code, done.err) == (0, "")
    assert (folder / name).read_bytes().startswith(MAGIC[name])
    assert len(list(folder.iterdir())) == 1


def test_the_animation_has_a_frame_for_each_generation_and_one_for_the_answer(cli, folder: Path) -> None:
    from PIL import Image

    generations = cli(*QUICK, "--plot", "a.gif", "--json").document["budget"]["generations"]
    with Image.open(folder / "a.gif") as image:
        assert 2 <= image.n_frames <= generations + 2


def test_a_search_without_result_can_be_drawn(cli, folder: Path) -> None:
    assert cli("plan", "--map", "maze-21:1:s1", "--planner", "imga", "--plot", "a.png").code == 3
    assert (folder / "a.png").exists()


@pytest.mark.parametrize("name", ["[red]x[].map", "a b.map", "é–ü.map", "a:100:b.map"])
def test_any_name_of_a_map_comes_out_as_it_is(cli, folder: Path, name) -> None:
    write(folder / name, moving_ai("..", ".."))
    assert f"map         {name}, 2 × 2" in cli("plan", "--map", name).out
    assert cli("plan", "--map", name, "--json").document["problem"]["map"] == name


def test_the_sign_of_a_family_s_seed_is_no_picture(cli) -> None:
    assert "random-20:100:s3, 20 × 20" in cli("plan", "--map", "random-20:100:s3").out


def test_table_and_picture_show_what_the_document_says(cli) -> None:
    options = (*QUICK, "--optimum")
    shown, document = cli(*options).out, cli(*options, "--json").document
    assert f"{document['metrics']['length']:.4f} cells, {document['metrics']['nodes']} nodes" in shown
    assert f"{document['optimum']['any_angle']:.4f} cells, gap" in shown
    assert shown.startswith("┌")
