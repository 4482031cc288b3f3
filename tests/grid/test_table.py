import io
import os
from pathlib import Path

import numpy as np
import pytest

from pathloom.grid import read_map

CELLS = [[False, True, False], [False, False, True]]


def written(folder: Path, content: bytes, name: str) -> Path:
    path = folder / name
    path.write_bytes(content)
    return path


@pytest.mark.parametrize(
    "content",
    [
        b"0,1,0\n0,0,1\n",
        b"0, 1, 0\r\n0, 0, 1\r\n",
        b"0;1;0\n0;0;1",
        b"0\t1\t0\n0\t0\t1\n\n",
        b" 0 1 0\n 0 0 1 \n",
        b"010\n001\n",
        b"\xef\xbb\xbf0,1,0\n0,0,1\n",
        b"0.0,1.0,0.0\n0.000e+00,0,1.000e+00\n",
    ],
)
@pytest.mark.parametrize("name", ["a.csv", "a.txt"])
def test_values_may_be_apart_by_any_usual_sign(tmp_path: Path, content: bytes, name: str) -> None:
    assert read_map(written(tmp_path, content, name)).occupied.tolist() == CELLS


def test_what_numpy_saves_as_text_is_read(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "a.txt", CELLS)
    assert read_map(tmp_path / "a.txt").occupied.tolist() == CELLS


def test_a_single_column_is_a_map(tmp_path: Path) -> None:
    assert read_map(written(tmp_path, b"0\n1\n", "a.csv")).shape == (2, 1)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"0,1\n0,2\n", "line 2, column 2: found '2', allowed 0 (free) or 1 (occupied)"),
        (b"0,1\n0,\n", "line 2, column 2: found nothing"),
        (b"0,nan\n", "line 1, column 2: found 'nan'"),
        (b"01\n0x\n", "line 2, column 2: found 'x'"),
        (b"02\n", "line 1, column 2: found '2'"),
        (b"0 1\n0,1\n", "line 2, column 1: found '0,1'"),
        (b"0,1\n0\n", "line 2: found 1 values, allowed 2, as in line 1"),
        (b"0,1\n\n0,1\n", "line 2, column 1: found nothing"),
        (b"0 1\n\n0 1\n", "line 2: found 0 values"),
        (b"map,kind\n", "line 1, column 1: found 'map'"),
        (b"\n\n", "found nothing but blank lines"),
        (b"", "found an empty file"),
        (b"0,1\n\xff,0\n", "line 2: found the byte 0xff, which is not text in UTF-8"),
    ],
)
def test_other_values_and_ragged_rows_are_refused(tmp_path: Path, refused, content: bytes, says: str) -> None:
    path = written(tmp_path, content, "a.csv")
    assert refused(read_map, path).startswith(f"{path}: {says}")


def npy(array: np.ndarray, **options) -> bytes:
    stream = io.BytesIO()
    np.save(stream, array, **options)
    return stream.getvalue()


@pytest.mark.parametrize("kind", ["bool", "u1", "<i8", ">i4", "f2", "f8"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_npy_may_hold_any_kind_of_number_in_any_order(tmp_path: Path, kind: str, order: str) -> None:
    array = np.array(CELLS, dtype=kind, order=order)
    assert read_map(written(tmp_path, npy(array), "a.npy")).occupied.tolist() == CELLS


class Trap:
    """Leaves a trace when unpickled."""

    def __init__(self, trace: Path) -> None:
        self.trace = trace

    def __reduce__(self):
        return os.mkdir, (str(self.trace),)


def test_a_pickle_in_an_npy_is_never_run(tmp_path: Path, refused) -> None:
    array = np.array([[Trap(tmp_path / "trace")]], dtype=object)
    path = written(tmp_path, npy(array, allow_pickle=True), "a.npy")
    assert "type 'object'" in refused(read_map, path)
    assert not (tmp_path / "trace").exists()


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (npy(np.zeros(3)), "header: found an array of shape (3,)"),
        (npy(np.zeros((0, 3))), "found an array of shape (0, 3)"),
        (npy(np.array([[0, 2]])), "row 0, col 1: found 2"),
        (npy(np.array([[0, np.nan]])), "found nan"),
        (npy(np.array([["a"]])), "type '<U1'"),
        (npy(np.array([[1j]])), "type 'complex128'"),
        (npy(np.zeros((2, 2)))[:-1], "found 31 bytes of cells, allowed 32, as the header says"),
        (npy(np.zeros((2, 2))) + b"x", "found 33 bytes of cells"),
        (npy(np.zeros((2, 2), bool))[:-1] + b"\x07", "found 7"),
        (npy(np.zeros((2, 2))).replace(b"(2, 2)", b"(9, 9)"), "found 32 bytes of cells, allowed 648"),
        (npy(np.zeros((2, 2))).replace(b"(2, 2), }", b"(2, 2, }}"), "header: found a damaged one"),
        (b"\x93NUMPY\x09\x00" + bytes(40), "header: found a damaged one"),
        (b"PK\x03\x04 a zip file of arrays", "header: found a damaged one"),
    ],
)
def test_other_arrays_are_refused(tmp_path: Path, refused, content: bytes, says: str) -> None:
    assert says in refused(read_map, written(tmp_path, content, "a.npy"))


def test_a_header_that_claims_the_moon_allocates_nothing(tmp_path: Path, refused) -> None:
    stream = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": (10**9, 10**9)}
    np.lib.format.write_array_header_1_0(stream, header)
    path = written(tmp_path, stream.getvalue() + bytes(8), "a.npy")
    assert "header: found 1000000000000000000 cells, allowed at most" in refused(read_map, path)


@pytest.mark.data
def test_real_tables_have_the_obstacles_of_their_manifest(data: Path) -> None:
    import re

    row = re.compile(r"^\| `(ga_grids/\S+\.csv)` \|.*\| (\d+)x(\d+), (\d+), \(", re.MULTILINE)
    rows = row.findall((data / "MANIFEST.md").read_text())
    assert len(rows) == 10
    for file, height, width, obstacles in rows:
        grid = read_map(data / file)
        assert grid.shape == (int(height), int(width))
        assert grid.occupied.sum() == int(obstacles), file
