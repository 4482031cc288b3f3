import errno
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from pathloom.grid import OccupancyGrid, read_map, write_map

GRID = OccupancyGrid([[0, 1, 0], [1, 0, 0]])


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@given(
    cells=arrays(bool, array_shapes(min_dims=2, max_dims=2, max_side=12)),
    suffix=st.sampled_from([".map", ".csv", ".txt", ".npy", ".MAP"]),
)
@settings(deadline=None)
def test_what_is_written_is_read_again(tmp_path_factory, cells: np.ndarray, suffix: str) -> None:
    path = tmp_path_factory.getbasetemp() / f"round{suffix}"
    write_map(OccupancyGrid(cells), path)
    assert read_map(path) == OccupancyGrid(cells)


def test_the_files_are_what_other_programs_expect(tmp_path: Path) -> None:
    for name in ("a.map", "a.csv", "a.txt", "a.npy"):
        write_map(GRID, tmp_path / name)
    assert (tmp_path / "a.map").read_bytes() == b"type octile\nheight 2\nwidth 3\nmap\n.@.\n@..\n"
    assert (tmp_path / "a.csv").read_bytes() == b"0,1,0\n1,0,0\n"
    assert (tmp_path / "a.txt").read_bytes() == b"0 1 0\n1 0 0\n"
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), GRID.occupied)


def test_an_old_file_is_replaced_and_nothing_else_is_left(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("old")
    write_map(GRID, str(path))
    assert read_map(path) == GRID
    assert names(tmp_path) == ["a.csv"]


def test_a_failure_keeps_the_old_file_and_leaves_no_draft(tmp_path: Path, monkeypatch, refused) -> None:
    path = tmp_path / "a.csv"
    path.write_text("old")

    def full(self: Path, target: Path) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    assert "No space left on device" in refused(write_map, GRID, path)
    assert path.read_text() == "old"
    assert names(tmp_path) == ["a.csv"]


def test_a_file_written_is_as_readable_as_others(tmp_path: Path) -> None:
    (tmp_path / "other").touch()
    write_map(GRID, tmp_path / "a.csv")
    assert (tmp_path / "a.csv").stat().st_mode == (tmp_path / "other").stat().st_mode


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("a.mpa", "found the suffix '.mpa', allowed .map .csv .txt .npy; did you mean '.map'?"),
        ("a.yaml", "found the suffix '.yaml'"),
        ("a", "found no suffix"),
        ("none/a.map", "found no such folder, allowed a file in an existing folder"),
        ("folder.map", "found a folder or a device"),
        ("file/a.map", "found a place not writable"),
        ("a\0.map", "found a name that no file can have"),
        ("a" * 5000 + ".map", "found a place not writable"),
    ],
)
def test_what_cannot_be_written_is_refused(tmp_path: Path, refused, name: str, says: str) -> None:
    (tmp_path / "folder.map").mkdir()
    (tmp_path / "file").touch()
    assert says in refused(write_map, GRID, f"{tmp_path}/{name}")
    assert names(tmp_path) == ["file", "folder.map"]


def test_a_folder_without_permission_is_refused(tmp_path: Path, refused, forbidden) -> None:
    says = f"a place not writable ({os.strerror(errno.EACCES)})"
    assert says in refused(write_map, GRID, tmp_path / "a.map")
    assert names(tmp_path) == []
