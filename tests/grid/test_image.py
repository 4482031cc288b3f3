import io
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from pathloom.grid import read_map

DARK_THEN_BRIGHT = np.array([[0, 127, 128, 255]], dtype=np.uint8)


def occupied(path: Path, **options) -> list[bool]:
    return read_map(path, **options).occupied[0].tolist()


def saved(folder: Path, image: Image.Image, name: str = "a.png", **options) -> Path:
    image.save(folder / name, **options)
    return folder / name


@pytest.mark.parametrize("name", ["a.png", "a.pgm", "a.bmp", "a.PNG"])
def test_dark_is_occupied_below_the_threshold(tmp_path: Path, name: str) -> None:
    path = saved(tmp_path, Image.fromarray(DARK_THEN_BRIGHT), name)
    assert occupied(path) == [True, True, False, False]
    assert occupied(path, threshold=129) == [True, True, True, False]
    assert occupied(path, threshold=0) == [False] * 4


def test_jpeg_is_read(tmp_path: Path) -> None:
    path = saved(tmp_path, Image.fromarray(np.repeat([[0] * 16 + [255] * 16], 16, axis=0).astype(np.uint8)), "a.jpg")
    assert occupied(path) == [True] * 16 + [False] * 16


@pytest.mark.parametrize(
    "content",
    [
        b"P2\n# a comment\n4 1\n# another\n255\n0 127 128 255\n",
        b"P2 4 1 255 0 127\n128 255",
        b"P5 # a comment\n4 1 255\n\x00\x7f\x80\xff",
        b"P5\n4 1\n65535\n\x00\x00\x7f\x00\x80\x80\xff\xff",
        b"P2\n4 1\n15\n0 7 8 15\n",
    ],
)
def test_pgm_may_be_ascii_or_binary_with_comments_and_any_depth(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "a.pgm"
    path.write_bytes(content)
    assert occupied(path) == [True, True, False, False]


def test_sixteen_bits_are_scaled_to_eight(tmp_path: Path) -> None:
    greys = np.array([[0, 0x7F7F, 0x8080, 0xFFFF]], dtype=np.uint16)
    assert occupied(saved(tmp_path, Image.fromarray(greys))) == [True, True, False, False]


def test_a_bitmap_and_a_palette_are_read_by_their_colours(tmp_path: Path) -> None:
    assert occupied(saved(tmp_path, Image.fromarray(np.array([[True, False]])))) == [False, True]
    image = Image.new("P", (3, 1))
    image.putpalette([255, 255, 255, 0, 0, 0, 255, 0, 0])
    image.putdata([0, 1, 2])
    assert occupied(saved(tmp_path, image)) == [False, True, True]


def test_transparent_pixels_show_white_paper(tmp_path: Path) -> None:
    image = Image.fromarray(np.array([[[0, 0, 0, 255], [0, 0, 0, 0], [255, 255, 255, 255]]], dtype=np.uint8))
    assert occupied(saved(tmp_path, image)) == [True, False, False]
    grey = Image.fromarray(np.array([[0, 200]], dtype=np.uint8))
    assert occupied(saved(tmp_path, grey, transparency=0)) == [False, False]


@pytest.mark.parametrize("threshold", [-1, 256, float("nan")])
def test_a_threshold_is_a_grey(tmp_path: Path, refused, threshold: float) -> None:
    path = saved(tmp_path, Image.fromarray(DARK_THEN_BRIGHT))
    assert "threshold: found" in refused(read_map, path, threshold=threshold)


def png_of_size(width: int, height: int) -> bytes:
    """Return a small PNG that claims to be as large as one likes."""

    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    body = zlib.compress(bytes(1000))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


@pytest.mark.parametrize("side", [8200, 10_000, 60_000])
def test_a_bomb_is_refused_before_it_is_decoded(tmp_path: Path, refused, side: int) -> None:
    path = tmp_path / "bomb.png"
    path.write_bytes(png_of_size(side, side))
    assert "allowed at most 67108864 pixels" in refused(read_map, path)


def test_damaged_images_are_refused(tmp_path: Path, refused) -> None:
    stream = io.BytesIO()
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (50, 50), dtype=np.uint8)).save(stream, "PNG")
    whole = stream.getvalue()
    path = tmp_path / "a.png"
    for content in (whole[:200], whole[:20], whole[:8], b"\x00" * 100, b"GIF89a" + bytes(50)):
        path.write_bytes(content)
        assert "image" in refused(read_map, path)
    path = tmp_path / "a.pgm"
    for content in (
        b"P5\n9 9\n255\nshort",
        b"P5\n",
        b"P2\n2 2\n255\n1 2 x 4",
        b"P5\n0 0\n255\n",
        b"P2\n2 2\n255\n1",
    ):
        path.write_bytes(content)
        refused(read_map, path)
