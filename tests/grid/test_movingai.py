import re
from pathlib import Path

import numpy as np
import pytest

from pathloom.grid import read_map

GOOD = "type octile\nheight 2\nwidth 3\nmap\n.G@\nSOT\n"
CELLS = [[0, 0, 1], [0, 1, 1]]


def written(folder: Path, text: str) -> Path:
    path = folder / "small.map"
    path.write_bytes(text.encode())
    return path


@pytest.mark.parametrize(
    "text", [GOOD, GOOD.rstrip("\n"), GOOD.replace("\n", "\r\n"), GOOD + "\n \r\n\n"], ids=str.encode
)
def test_line_ends_and_blank_lines_at_the_end_do_not_matter(tmp_path: Path, text: str) -> None:
    grid = read_map(written(tmp_path, text))
    np.testing.assert_array_equal(grid.occupied, np.array(CELLS, dtype=bool))
    assert grid.name == "small.map"
    assert grid.origin is None


def test_water_is_blocked(tmp_path: Path) -> None:
    assert read_map(written(tmp_path, "type octile\nheight 1\nwidth 2\nmap\nW.")).occupied.tolist() == [[True, False]]


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "octile",
            "octile-corner",
            "line 1, column 6: found the type 'octile-corner', allowed the type 'octile'",
        ),
        ("type", "tpye", "line 1: found 'tpye octile', allowed 'type octile'; did you mean 'type'?"),
        ("height 2\n", "", "line 2: found 'width 3', allowed 'height N'"),
        ("height 2", "height -2", "line 2, column 8: found '-2', allowed a whole number from 1"),
        ("height 2", "height 0", "line 2, column 8: found '0'"),
        ("width 3", "width 3.0", "line 3, column 7: found '3.0'"),
        ("width 3", "width " + "9" * 5000, "line 3, column 7"),
        ("height 2", "height ２", "line 2, column 8"),
        (
            "height 2",
            "height 999999999",
            "line 2: found a map of 999999999 x 3 cells, allowed at most 67108864 cells",
        ),
        ("map\n", "mop\n", "line 4: found 'mop', allowed 'map'"),
        (".G@", ".x@", "line 5, column 2: found 'x', allowed . G S (free), @ O T W (blocked)"),
        (".G@", ".G ", "line 5, column 3: found ' '"),
        (".G@", ".\x0b@", "line 5, column 2: found '\\x0b'"),
        (".G@", ".G", "line 5, column 3: found a row of 2 cells, allowed 3, as line 3 says"),
        (".G@", ".G@.", "line 5, column 4: found a row of 4 cells, allowed 3"),
        ("SOT\n", "", "line 6: found the end after 1 rows, allowed 2 rows"),
        ("SOT\n", "SOT\n...\n", "line 7: found more: '...', allowed 2 rows"),
        ("\n.G@\nSOT\n", "", "line 5: found the end after 0 rows"),
    ],
)
def test_the_message_says_where_what_was_found_and_what_is_allowed(tmp_path, refused, old, new, says) -> None:
    path = written(tmp_path, GOOD.replace(old, new))
    message = refused(read_map, path)
    assert message.startswith(f"{path}: ")
    assert says in message


def rows_of(manifest: Path) -> list[tuple[str, int, int, int]]:
    """Return file, height, width and free cells of each map in the manifest."""
    pattern = re.compile(r"^\| `(movingai/\S+\.map)` \|.*\| (\d+)x(\d+), (\d+) free", re.MULTILINE)
    return [(file, int(h), int(w), int(free)) for file, h, w, free in pattern.findall(manifest.read_text())]


@pytest.mark.data
def test_real_maps_have_the_size_and_free_cells_of_their_manifest(data: Path) -> None:
    rows = rows_of(data / "MANIFEST.md")
    assert len(rows) > 30
    for file, height, width, free in rows:
        grid = read_map(data / file)
        swamp_and_ground = sum((data / file).read_text().split("map\n", 1)[1].count(glyph) for glyph in ".GS")
        assert (grid.height, grid.width) == (height, width), file
        assert grid.free_count == swamp_and_ground == free, file


@pytest.mark.data
def test_the_real_map_of_another_type_is_refused(data: Path, refused) -> None:
    assert "line 1, column 6: found the type 'octile-corner'" in refused(
        read_map, data / "movingai/unsupported_type/adrenaline.map"
    )
