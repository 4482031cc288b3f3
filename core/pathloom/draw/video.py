"""Pictures as an MP4 video, by the program ffmpeg where it is installed."""

import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pathloom.errors import PathloomError
from pathloom.files import FilePath, one_line

if TYPE_CHECKING:
    from PIL.Image import Image


def check_ffmpeg(file: FilePath) -> str:
    """Return where ffmpeg is.

    Raises
    ------
    PathloomError
        If it is not installed.
    """
    program = shutil.which("ffmpeg")
    if program is None:
        raise PathloomError(f"{file}: found no program ffmpeg, which writes .mp4; install it, or write a .gif")
    return program


def encoded(file: FilePath, images: "Sequence[Image]", step: int, last: int) -> bytes:
    """Return images of one size as H.264 in MP4, with one frame of ``step`` milliseconds each.

    The last image stays for ``last`` milliseconds. ``file`` is what messages call the video.

    Raises
    ------
    PathloomError
        If ffmpeg is missing or fails.
    """
    program = check_ffmpeg(file)
    width, height = images[0].size
    stay = max(1, round(last / step))
    with tempfile.TemporaryDirectory() as folder:
        video = Path(folder, "video.mp4")  # MP4 is not written in one go, so it cannot come through a pipe
        command = [
            program, "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}",
            "-framerate", f"1000/{step}", "-i", "-", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
            "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-fflags", "+bitexact", "-flags:v", "+bitexact",
            str(video),
        ]  # fmt: skip
        raw = b"".join(image.convert("RGB").tobytes() for image in [*images, *[images[-1]] * (stay - 1)])
        done = subprocess.run(command, input=raw, capture_output=True, check=False)  # noqa: S603 - no word is a user's
        if done.returncode or not video.exists():
            said = one_line(done.stderr.decode(errors="replace").strip()) or f"it ended with {done.returncode}"
            raise PathloomError(f"{file}: ffmpeg could not write it: {said}")
        return video.read_bytes()
