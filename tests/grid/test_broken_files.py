"""Whatever a file holds, reading it ends: in a map, or in a MapError of one line."""

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from pathloom.errors import MapError
from pathloom.grid import OccupancyGrid, Scenario, read_map, read_scenario


def encoded(kind: str, **options) -> bytes:
    stream = io.BytesIO()
    pixels = np.arange(0, 240, 4, dtype=np.uint8).reshape(6, 10)
    Image.fromarray(pixels).save(stream, kind, **options)
    return stream.getvalue()


def npy() -> bytes:
    stream = io.BytesIO()
    np.save(stream, np.eye(4, dtype=np.uint8))
    return stream.getvalue()


VALID = {
    "a.map": b"type octile\nheight 2\nwidth 3\nmap\n.@.\nTTW\n",
    "a.csv": b"0,1,0\n0,0,1\n",
    "a.txt": b"0 1 0\n0 0 1\n",
    "a.npy": npy(),
    "a.png": encoded("PNG"),
    "a.bmp": encoded("BMP"),
    "a.jpg": encoded("JPEG"),
    "a.pgm": encoded("PPM"),
    "ascii.pgm": b"P2\n# made by hand\n3 2\n255\n0 1 2\n253 254 255\n",
    "a.yaml": b"image: b.png\nresolution: 0.05\norigin: [0, 0.0, 1]\nnegate: 0\noccupied_thresh: 0.65\n"
    b"free_thresh: 0.196\nmode: scale\n",
    "a.scen": b"version 1\n0\ta.map\t3\t2\t0\t0\t2\t0\t2\n1\ta.map\t3\t2\t0\t0\t0\t0\t1.41421\n",
}
SPICE = [
    b"\n",
    b"\r\n",
    b"\0",
    b"9" * 5000,
    b"-",
    b"nan",
    b"1e999",
    b"*a",
    b"&a",
    b"!!python/none",
    b"\xff\xfe",
]


@st.composite
def mutated(draw: st.DrawFn, valid: bytes) -> bytes:
    """Return a valid file with a few places cut, doubled, overwritten or spiced."""
    content = bytearray(valid)
    for _ in range(draw(st.integers(1, 4))):
        a, b = sorted(draw(st.tuples(*[st.integers(0, len(content))] * 2)))
        patch = draw(st.one_of(st.just(b""), st.binary(max_size=8), st.sampled_from(SPICE), st.just(content[a:b] * 2)))
        content[a : min(b, a + draw(st.integers(0, 12)))] = patch
    return bytes(content)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the image that the YAML names."""
    folder = tmp_path_factory.mktemp("broken")
    (folder / "b.png").write_bytes(VALID["a.png"])
    return folder


def ends_well(path: Path, content: bytes) -> None:
    path.write_bytes(content)
    read: Callable[[Path], OccupancyGrid | Scenario] = read_scenario if path.suffix == ".scen" else read_map
    try:
        read(path)
    except MapError as error:
        line = str(error)
    else:
        line = ""
    assert line.isprintable()
    assert len(line) < 1000


@pytest.mark.parametrize("name", VALID)
def test_the_files_that_are_broken_here_are_valid(folder: Path, name: str) -> None:
    (folder / name).write_bytes(VALID[name])
    assert read_scenario(folder / name) if name.endswith(".scen") else read_map(folder / name)


@pytest.mark.parametrize("name", VALID)
@given(choice=st.data())
@settings(deadline=None, max_examples=300, suppress_health_check=[HealthCheck.too_slow])
def test_a_valid_file_with_mistakes_is_read_or_refused(folder: Path, name: str, choice: st.DataObject) -> None:
    ends_well(folder / name, choice.draw(mutated(VALID[name])))


@pytest.mark.parametrize("name", VALID)
@given(content=st.binary(max_size=200))
@settings(deadline=None, max_examples=60)
def test_random_bytes_are_read_or_refused(folder: Path, name: str, content: bytes) -> None:
    ends_well(folder / name, content)


@given(source=st.text(alphabet="[]{}&*!|>-?:,#'\"%@` \n\tab01.", max_size=80))
@settings(deadline=None, max_examples=200)
def test_any_yaml_is_read_or_refused(folder: Path, source: str) -> None:
    ends_well(folder / "a.yaml", source.encode())
