"""A map that cannot be used costs one line, which says where the fault is and what is allowed."""

import struct
import zlib
from pathlib import Path

import pytest

from .conftest import moving_ai, one_line, write


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def bomb() -> bytes:
    head = struct.pack(">IIBBBBB", 100_000, 100_000, 8, 0, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


def ros(image: str = "a.pgm", occupied: str = "0.65", free: str = "0.196") -> str:
    head = f"image: {image}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
    return f"{head}occupied_thresh: {occupied}\nfree_thresh: {free}\n"


GOOD = moving_ai("...", ".@.", "...")
BROKEN = {
    "an empty file": ("a.map", b"", "empty file"),
    "a truncated map": ("a.map", GOOD[:-4], "line 7: found the end after 2 rows, allowed 3"),
    "a row too short": ("a.map", GOOD.replace("width 3", "width 4"), "line 5, column 4: found a row of 3 cells"),
    "a row too many": ("a.map", GOOD + "...\n", "line 8"),
    "an unknown glyph": ("a.map", GOOD.replace(".@.", ".x."), "line 6, column 2: found 'x', allowed . G S (free)"),
    "another type": ("a.map", GOOD.replace("octile", "octile-corner"), "found the type 'octile-corner'"),
    "junk for an image": ("a.png", bytes(range(256)), "found something else than an image"),
    "a decompression bomb": ("a.png", bomb(), "far too many pixels"),
    "a tag of Python in YAML": ("a.yaml", 'image: !!python/object/apply:os.mkdir ["x"]\n', "line 1: found the tag"),
    "an image that is not there": ("a.yaml", ros("gone.pgm"), "image: found no file 'gone.pgm'"),
    "an image outside the folder": ("a.yaml", ros("../outside.pgm"), "image: found"),
    "an image with a full path": ("a.yaml", ros("/nowhere/outside.pgm"), "image: found"),
    "an occupied threshold that is no number": ("a.yaml", ros(occupied=".nan"), "occupied_thresh: found nan"),
    "a free threshold that is no number": ("a.yaml", ros(free=".nan"), "free_thresh: found nan"),
    "a table with a hole": ("a.csv", "0,1\n0,\n", "line 2"),
    "a pickle for an array": ("a.npy", b"\x93NUMPY\x01\x00junk", "a.npy"),
}


@pytest.mark.parametrize(("name", "content", "says"), BROKEN.values(), ids=BROKEN)
def test_a_broken_map_is_refused_with_file_and_place(refused, folder: Path, name, content, says) -> None:
    write(folder / name, content)
    message = refused("plan", "--map", name)
    assert message.startswith(f"{name}: ")
    assert says in message


@pytest.mark.parametrize(("name", "content", "says"), BROKEN.values(), ids=BROKEN)
def test_check_says_of_a_broken_map_what_plan_says(refused, folder: Path, name, content, says) -> None:
    write(folder / name, content)
    assert refused("maps", "check", name) == refused("plan", "--map", name)


def test_a_missing_file_is_refused_with_the_one_probably_meant(refused, ring) -> None:
    assert refused("plan", "--map", "rnig.map").endswith("did you mean 'ring.map'?")


def test_a_folder_is_no_map(refused, folder: Path) -> None:
    (folder / "inner.map").mkdir()
    assert refused("plan", "--map", "inner.map") == "inner.map: found a folder, allowed a file"


def test_a_misspelt_name_of_a_map_is_refused_with_the_one_probably_meant(refused) -> None:
    assert "did you mean 'iga-map1'?" in refused("plan", "--map", "iga-mpa1")


def test_several_maps_are_not_one(refused) -> None:
    assert "stands for several" in refused("plan", "--map", "random-20:75:x3")


def test_a_name_with_line_ends_and_escapes_still_makes_one_harmless_line(refused) -> None:
    assert "\x1b" not in refused("plan", "--map", "a\n\x1b[31mb.map")


def test_an_unreachable_goal_is_said_at_once_with_a_code_of_its_own(cli, wall, monkeypatch) -> None:
    def never(*_args, **_keywords):
        pytest.fail("the planner was started")

    monkeypatch.setattr("pathloom.planning.run", never)
    message = one_line(cli("plan", "--map", wall), code=3)
    assert message == "no path: the goal 0,2 cannot be reached from 2,0 under the corner policy 'strict'"


def test_a_diagonal_gap_is_a_way_only_where_the_policy_allows_it(cli, folder: Path) -> None:
    write(folder / "gap.map", moving_ai("@.", ".@"))
    assert cli("plan", "--map", "gap.map", "--corners", "no-squeeze").code == 3
    assert cli("plan", "--map", "gap.map", "--corners", "allow").code == 0
