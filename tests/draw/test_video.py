"""MP4: where ffmpeg is installed it is written, where it is not one line says so, before any work."""

import os
import shutil
import sys

import numpy as np
import pytest

import pathloom as pl
from pathloom.draw import animate


def frames() -> list:
    path = np.array([(9, 0), (0, 9)])
    return [(n, [path], path, 0.1 * n) for n in range(4)]


def write(file) -> None:
    animate(frames(), file, occupied=np.zeros((10, 10), bool), start=(9, 0), goal=(0, 9))


def stand_in(folder, monkeypatch, body: str) -> None:
    """Put a program called ffmpeg, which is a little Python, first on the way."""
    if os.name == "nt":
        pytest.skip("a script is no program on Windows")
    program = folder / "ffmpeg"
    program.write_text(f"#!{sys.executable}\nimport sys\nframes = sys.stdin.buffer.read()\n{body}\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder), prepend=os.pathsep)


def test_without_ffmpeg_one_line_says_so_and_nothing_is_written(tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(pl.PathloomError, match=r"found no program ffmpeg, .* or write a \.gif") as error:
        write(tmp_path / "a.mp4")
    assert "\n" not in str(error.value)
    assert not list(tmp_path.iterdir())


def test_ffmpeg_gets_every_frame_and_the_last_one_for_longer(tmp_path, monkeypatch) -> None:
    stand_in(tmp_path, monkeypatch, "open(sys.argv[-1], 'wb').write(' '.join(sys.argv).encode() + b'|' + frames)")
    write(tmp_path / "a.mp4")
    words, pixels = (tmp_path / "a.mp4").read_bytes().split(b"|", 1)
    width, height = map(int, words.split(b"-s ")[1].split()[0].split(b"x"))
    shown = np.frombuffer(pixels, np.uint8).reshape(-1, height, width, 3)
    assert len(shown) == 4 + 5  # 400 ms a frame, 2500 for the last
    assert (shown[3:] == shown[3]).all()
    assert (shown[0] != shown[3]).any()


def test_what_ffmpeg_says_of_its_failure_becomes_one_line(tmp_path, monkeypatch) -> None:
    stand_in(tmp_path, monkeypatch, "sys.exit('no such\\nencoder')")
    with pytest.raises(pl.PathloomError, match=r"ffmpeg could not write it: no such encoder"):
        write(tmp_path / "a.mp4")
    assert not (tmp_path / "a.mp4").exists()


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")
def test_the_video_is_an_mp4(tmp_path) -> None:
    write(tmp_path / "a.mp4")
    assert (tmp_path / "a.mp4").read_bytes()[4:8] == b"ftyp"
