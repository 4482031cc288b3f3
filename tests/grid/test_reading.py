import errno
import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from pathloom.grid import read_map, read_scenario


def test_content_counts_for_more_than_the_suffix(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("type octile\nheight 1\nwidth 2\nmap\n.@\n")
    Image.fromarray(np.array([[255, 0]], dtype=np.uint8)).save(tmp_path / "a.map", "PNG")
    np.save(tmp_path / "b.npy", np.array([[0, 1]]))
    (tmp_path / "b.npy").rename(tmp_path / "grid")
    for name in ("a.txt", "a.map", "grid"):
        assert read_map(tmp_path / name).occupied.tolist() == [[False, True]]


def test_paths_may_be_text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, refused) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text("0,1\n")
    assert read_map("a.csv").name == "a.csv"
    assert refused(read_map, "./b.csv") == "./b.csv: found no such file, allowed an existing one; did you mean 'a.csv'?"


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("hall.mpa", "found the suffix '.mpa', allowed a map: .map .yaml"),
        ("hall.mpa", "did you mean '.map'?"),
        ("hall", "found no suffix"),
        ("hall.map.scen", "found a scenario, allowed a map"),
    ],
)
def test_a_file_of_no_known_format_is_refused(tmp_path: Path, refused, name: str, says: str) -> None:
    (tmp_path / name).write_text("what is this")
    assert says in refused(read_map, tmp_path / name)


@pytest.mark.parametrize("read", [read_map, read_scenario])
def test_what_is_no_readable_file_is_refused(tmp_path: Path, refused, read) -> None:
    (tmp_path / "empty.map").touch()
    (tmp_path / "folder.map").mkdir()
    os.mkfifo(tmp_path / "pipe.map")
    assert "found an empty file" in refused(read, tmp_path / "empty.map")
    assert "found a folder" in refused(read, tmp_path / "folder.map")
    assert "found a device or a pipe" in refused(read, tmp_path / "pipe.map")
    assert "found a device or a pipe" in refused(read, "/dev/zero")
    assert "did you mean 'empty.map'?" in refused(read, tmp_path / "emty.map")
    assert "found no such file" in refused(read, tmp_path / "no folder" / "a.map")
    assert "found a name that no file can have" in refused(read, "a\0b.map")
    assert "found a name that no file can have" in refused(read, "\ud800.map")
    assert "unreadable" in refused(read, "a" * 5000 + ".map")
    assert "a?[31mb c.map" in refused(read, tmp_path / "a\x1b[31mb\nc.map")
    (tmp_path / "loop.map").symlink_to(tmp_path / "loop.map")
    assert "unreadable" in refused(read, tmp_path / "loop.map")


def test_a_file_without_permission_is_refused(tmp_path: Path, refused, request) -> None:
    path = tmp_path / "a.csv"
    path.write_text("0\n")
    request.getfixturevalue("forbidden")
    assert f"an unreadable file ({os.strerror(errno.EACCES)})" in refused(read_map, path)
