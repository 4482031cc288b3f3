import math
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from pathloom.grid import read_map
from pathloom.grid.ros import read_ros

YAML = """image: hall.png
resolution: 0.5
origin: [1.0, -2, 0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""
GREYS = [0, 90, 205, 206, 255]  # p: 1, 0.647, 0.19608, 0.19216, 0


def written(folder: Path, text: str = YAML, greys=None, name: str = "hall.png") -> Path:
    pixels = np.array([GREYS] if greys is None else greys, dtype=np.uint8)
    Image.fromarray(pixels).save(folder / name)
    path = folder / "hall.yaml"
    path.write_text(text)
    return path


def classes(path: Path) -> str:
    """Return the first row: `#` occupied, `.` free, `?` unknown."""
    found = read_ros(path)
    pairs = zip(found.occupied[0], found.free[0], found.unknown[0], strict=True)
    return "".join("#" if occupied else "." if free else "?" * bool(unknown) for occupied, free, unknown in pairs)


def test_trinary_is_the_mode_where_none_is_given(tmp_path: Path) -> None:
    assert classes(written(tmp_path)) == "#??.."
    assert classes(written(tmp_path, YAML + "mode: trinary\n")) == "#??.."


@pytest.mark.parametrize("negate", ["1", "true"])
def test_negate_takes_bright_for_occupied(tmp_path: Path, negate: str) -> None:
    assert classes(written(tmp_path, YAML.replace("negate: 0", f"negate: {negate}"))) == ".?###"


def test_thresholds_bound_the_unknown_in_trinary_and_belong_to_the_classes_in_scale(tmp_path: Path) -> None:
    exact = YAML.replace("0.65", "0.8").replace("0.196", "0.2")
    greys = [[50, 51, 52, 203, 204, 205]]  # p of 51 is 0.8, of 204 is 0.2
    assert classes(written(tmp_path, exact, greys)) == "#????."
    assert classes(written(tmp_path, exact + "mode: scale\n", greys)) == "##??.."


def test_scale_takes_transparent_pixels_for_unknown(tmp_path: Path) -> None:
    greys = [[[0, 255], [0, 254], [255, 255], [255, 0]]]
    assert classes(written(tmp_path, YAML + "mode: scale\n", greys)) == "#?.?"
    assert classes(written(tmp_path, YAML, greys)) == "##.."


def test_raw_takes_the_grey_for_a_percentage(tmp_path: Path) -> None:
    assert classes(written(tmp_path, YAML + "mode: raw\n", [[0, 19, 20, 65, 66, 100, 101, 255]])) == "..??##??"


def test_colour_counts_by_the_mean_of_its_channels(tmp_path: Path) -> None:
    assert classes(written(tmp_path, YAML, [[[255, 0, 0], [0, 0, 0], [255, 255, 255], [255, 180, 183]]])) == "##.."
    assert classes(written(tmp_path, YAML, [[[255, 180, 180]]])) == "?"


def test_unknown_cells_become_what_is_asked_for(tmp_path: Path, refused) -> None:
    path = written(tmp_path)
    assert read_map(path).occupied.tolist() == [[True, True, True, False, False]]
    assert read_map(path, unknown="free").occupied.tolist() == [[True, False, False, False, False]]
    assert "unknown: found 'fre'" in refused(read_map, path, unknown="fre")
    assert "unknown: found 'fre'" in refused(read_ros(path).grid, unknown="fre")


def test_the_map_lies_where_its_yaml_says(tmp_path: Path) -> None:
    grid = read_map(written(tmp_path))
    assert (grid.resolution, grid.origin, grid.name) == (0.5, (1.0, -2.0, 0.0), "hall.yaml")
    assert grid.world([(0, 0)]).tolist() == [[1.25, -1.75]]


@pytest.mark.parametrize("number", ["5e-1", "5.0e-1", "0.500000", "'5E-1'"])
def test_numbers_may_be_written_as_ros_writes_them(tmp_path: Path, number: str) -> None:
    assert read_map(written(tmp_path, YAML.replace("resolution: 0.5", f"resolution: {number}"))).resolution == 0.5


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("0.65", ".nan", "occupied_thresh: found nan"),
        ("0.65", "1.5", "occupied_thresh: found 1.5, allowed a number from 0 to 1"),
        ("0.65", "high", "occupied_thresh: found 'high', allowed a finite number"),
        ("0.65", "true", "occupied_thresh: found True"),
        ("0.65", "0.1", "free_thresh: found 0.196, allowed at most occupied_thresh"),
        ("0.196", "-.inf", "free_thresh: found -inf"),
        ("0.5", "0", "resolution: found 0, allowed metres per cell above 0"),
        ("0.5", "-0.5", "resolution: found -0.5"),
        ("0.5", "0x" + "f" * 5000, "resolution: found a huge int"),
        ("0.5", "9" * 5000, "found a value that YAML cannot take"),
        ("negate: 0", "negate: 2", "negate: found 2, allowed 0 or 1"),
        ("negate: 0", "negate: 0.0", "negate: found 0.0"),
        ("negate: 0", "negate: 2001-99-99", "found a value that YAML cannot take"),
        ("[1.0, -2, 0]", "[1.0, -2]", "origin: found [1.0, -2], allowed [x, y, yaw]"),
        ("[1.0, -2, 0]", "[1.0, -2, north]", "origin: found 'north'"),
        ("[1.0, -2, 0]", "[1.0, -2, .inf]", "origin: found inf"),
        ("[1.0, -2, 0]", "{}", "origin: found {}"),
        (
            "negate: 0",
            "negate: 0\nmode: scaled",
            "mode: found 'scaled', allowed trinary, scale, raw; did you mean",
        ),
        ("negate: 0", "negate: 0\nmode: [raw]", "mode: found ['raw']"),
        ("occupied_thresh", "occupied_tresh", "occupied_thresh: found no such key"),
        ("occupied_thresh", "occupied_tresh", "did you mean 'occupied_tresh'?"),
        ("hall.png", "hull.png", "image: found no file 'hull.png', allowed an image that exists"),
        ("hall.png", "hull.png", "did you mean 'hall.png'?"),
        ("hall.png", "http://example.org/hall.png", "image: found the address 'http://"),
        ("hall.png", "''", "image: found '', allowed the path of an image"),
        ("hall.png", "[a]", "image: found ['a']"),
        ("hall.png", "../..", "found a folder"),
        ("hall.png", "hall.yaml", "found something else than an image"),
        ("hall.png", "a" * 5000, "image: found 'aaa"),
        ("hall.png", r'"a\0b"', "image: found no file"),
        ("hall.png", "!!python/object/apply:os.system [exit]", "line 1: found the tag 'tag:yaml.o"),
        ("hall.png", "!!python/name:os.system", "allowed plain values"),
        ("hall.png", "[", "line 3, column 7: found a mistake (expected ',' or ']'"),
        ("hall.png", "&a [*a]", "line 1: found an alias"),
        ("hall.png", "[" * 5000, "more than 8 levels"),
        (YAML, "", "found an empty file"),
        (YAML, "# nothing\n", "found a NoneType"),
        (YAML, "- a\n- b\n", "found a list, allowed keys and values"),
        (YAML, "a: b\n---\nc: d\n", "allowed plain YAML"),
        (YAML, "{? [1, 2] : 3}", "found a mistake (found unhashable key), allowed plain YAML"),
        (YAML, "#" * 100_000, "found 100000 characters"),
        (YAML, f"? 0x{'f' * 5000}\n: 1\n", "image: found no such key"),
    ],
)
def test_a_wrong_yaml_is_refused_in_one_line(tmp_path: Path, refused, old: str, new: str, says: str) -> None:
    path = written(tmp_path, YAML.replace(old, new, 1))
    message = refused(read_map, path)
    assert says in message
    assert str(tmp_path) in message
    assert len(message) < 400


def test_a_tag_is_never_executed(tmp_path: Path, refused) -> None:
    trace = tmp_path / "trace"
    path = written(tmp_path, YAML.replace("hall.png", f"!!python/object/apply:os.mkdir ['{trace}']"))
    refused(read_map, path)
    assert not trace.exists()


def test_the_image_counts_from_the_folder_of_the_yaml(tmp_path: Path) -> None:
    (tmp_path / "images").mkdir()
    written(tmp_path / "images")
    path = tmp_path / "office.yml"
    path.write_text(YAML.replace("hall.png", "images/hall.png"))
    assert read_map(path).shape == (1, 5)
    path.write_text(YAML.replace("hall.png", str(tmp_path / "images" / "hall.png")))
    assert read_map(path).shape == (1, 5)


@pytest.mark.data
def test_real_maps_have_the_three_counts_of_their_manifest(data: Path, tmp_path: Path) -> None:
    row = re.compile(
        r"^\| `ros/(\S+)\.yaml`.*: (\d+)x(\d+) px, .*, ([0-9.]+) m, origin \[([^]]*)\].*"
        r"trinary counts occupied (\d+), free (\d+), unknown (\d+)",
        re.MULTILINE,
    )
    rows = row.findall((data / "MANIFEST.md").read_text())
    assert len(rows) == len(list((data / "ros").glob("*.yaml"))) == 10
    for name, width, height, resolution, origin, occupied, free, unknown in rows:
        # The manifest counts every map as trinary, also the one whose mode is scale.
        text = (data / "ros" / f"{name}.yaml").read_text().replace("mode: scale", "mode: trinary")
        path = tmp_path / f"{name}.yaml"
        path.write_text(re.sub(r"image: (\S+)", lambda m: f"image: {data / 'ros' / m[1]}", text))
        found = read_ros(path)
        counts = [int(cells.sum()) for cells in (found.occupied, found.free, found.unknown)]
        assert counts == [int(occupied), int(free), int(unknown)], name
        assert found.occupied.shape == (int(height), int(width))
        assert found.resolution == float(resolution)
        np.testing.assert_allclose(found.origin, [float(number) for number in origin.split(",")], rtol=1e-5)


@pytest.mark.data
def test_a_real_speed_mask_keeps_its_graded_cells_unknown(data: Path) -> None:
    found = read_ros(data / "ros/depot_speed.yaml")
    greys = np.asarray(Image.open(data / "ros/depot_speed.pgm"))
    np.testing.assert_array_equal(found.occupied, greys == 0)
    np.testing.assert_array_equal(found.free, greys == 255)


@pytest.mark.data
def test_a_real_map_with_yaw_is_turned(data: Path) -> None:
    grid = read_map(data / "ros/stata_basement.yaml")
    x, y = grid.world([(grid.height - 1, 0)])[0]
    half = 0.0504 / 2
    assert math.dist((x, y), (25.9, 48.5)) == pytest.approx(half * math.sqrt(2))
    assert x < 25.9
    assert y < 48.5
    assert grid.cell_at(x, y) == (grid.height - 1, 0)


@pytest.mark.data
def test_ascii_and_binary_images_without_a_yaml_are_maps_too(data: Path) -> None:
    assert read_map(data / "ros/willow-full.pgm").shape == (526, 584)
    assert read_map(data / "ros/columbia.pgm").shape == (350, 435)
