"""A drive as an animated GIF."""

import io
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pathloom.draw.animation import HEADER, MARGIN, MOST_FRAMES, NARROWEST, SIDE
from pathloom.draw.colours import rgb, theme
from pathloom.draw.local.drive import Moment
from pathloom.draw.raster import coarse
from pathloom.draw.saving import check_suffix
from pathloom.errors import PathloomError
from pathloom.files import FilePath, replace

if TYPE_CHECKING:
    from PIL.Image import Image

SMOOTH = 2
"""Drawn so many times as large, for smooth edges."""


def animate_drive(
    moments: Sequence[Moment],
    file: FilePath,
    *,
    occupied: ArrayLike,
    path: ArrayLike,
    cell: float,
    radius: float,
    step: float,
    end: str,
    title: str = "",
    dark: bool = False,
) -> None:
    """Write a drive as an animated GIF: the robot, its trail, and what the map does not show.

    The robot is filled while it follows the path, and ringed while a policy decides. Of more than 120
    moments as many are taken, evenly.

    Parameters
    ----------
    moments
        Every ``step`` seconds.
    occupied, path, cell, radius
        As `drive_figure`.
    end
        How it ended; written over the last image.

    Raises
    ------
    PathloomError
        If there is no moment, the suffix is not ``.gif``, or the file cannot be written.
    """
    check_suffix(file, (".gif",))
    if not moments:
        raise PathloomError(f"{file}: found no frames, allowed one or more")
    chosen = range(len(moments))
    if len(moments) > MOST_FRAMES:
        chosen = np.linspace(0, len(moments) - 1, MOST_FRAMES).round().astype(int).tolist()
    stage = _Stage(np.asarray(occupied, bool), np.asarray(path, np.float64), cell, radius, dark=dark)
    images = []
    for number in chosen:
        last = number == len(moments) - 1
        words = f"{title}, {number * step:.1f} s" + (f", {end}" if last else "")
        images.append(stage.draw(moments[: number + 1], words.removeprefix(", ")))
    pause = int(min(max(8000 / len(images), 60), 400)) // 10 * 10  # a GIF counts hundredths of a second
    buffer = io.BytesIO()
    images[0].save(
        buffer, "GIF", save_all=True, append_images=images[1:], loop=0, optimize=False,
        duration=[pause] * (len(images) - 1) + [2500],
    )  # fmt: skip
    replace(file, buffer.getvalue())


class _Stage:
    """The map in pixels, with the path, on which each moment is drawn."""

    def __init__(self, walls: np.ndarray, path: np.ndarray, cell: float, radius: float, *, dark: bool) -> None:
        from PIL import Image, ImageDraw, ImageFont

        rows, cols = walls.shape
        self.colours = theme(dark=dark)
        self.scale = SMOOTH * SIDE / max(rows, cols) / cell  # pixels a metre
        self.height, self.radius = rows * cell, radius
        high, wide = round(self.scale * rows * cell), round(self.scale * cols * cell)
        self.left = max(SMOOTH * MARGIN, (SMOOTH * NARROWEST - wide) // 2)
        size = wide + 2 * self.left, high + SMOOTH * (HEADER + MARGIN)
        self.back = Image.new("RGB", size, self.colours.ground)
        shown = np.where(coarse(walls, high, wide)[..., np.newaxis], rgb(self.colours.wall), rgb(self.colours.free))
        self.back.paste(Image.fromarray(shown.astype(np.uint8)), (self.left, SMOOTH * HEADER))
        self.font = ImageFont.load_default(15 * SMOOTH)
        border = self.left, SMOOTH * HEADER, self.left + wide, SMOOTH * HEADER + high
        ImageDraw.Draw(self.back).rectangle(border, outline=self.colours.wall, width=SMOOTH)
        ways = [self._at((col + 0.5) * cell, (rows - 0.5 - row) * cell) for row, col in path]
        ImageDraw.Draw(self.back).line(ways, fill=self.colours.closed, width=4 * SMOOTH, joint="curve")

    def draw(self, moments: Sequence[Moment], words: str) -> "Image":
        """Return the last of the moments, with the trail of those before."""
        from PIL import Image, ImageDraw

        image = self.back.copy()
        draw = ImageDraw.Draw(image)
        colours, now = self.colours, moments[-1]
        if len(moments) > 1:
            trail = [self._at(moment.x, moment.y) for moment in moments]
            draw.line(trail, fill=colours.crowd, width=2 * SMOOTH, joint="curve")
        for x, y, size in now.discs:
            draw.ellipse(self._box(x, y, size), fill=colours.optimum, outline=colours.ink, width=SMOOTH)
        fill = colours.free if now.decided else colours.path
        draw.ellipse(self._box(now.x, now.y, self.radius), fill=fill, outline=colours.path, width=3 * SMOOTH)
        nose = now.x + self.radius * math.cos(now.heading), now.y + self.radius * math.sin(now.heading)
        draw.line([self._at(now.x, now.y), self._at(*nose)], fill=colours.ink, width=2 * SMOOTH)
        draw.text((SMOOTH * MARGIN, SMOOTH * HEADER // 2), words, fill=colours.ink, font=self.font, anchor="lm")
        return image.reduce(SMOOTH).quantize(64, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)

    def _at(self, x: float, y: float) -> tuple[float, float]:
        return self.left + x * self.scale, SMOOTH * HEADER + (self.height - y) * self.scale

    def _box(self, x: float, y: float, size: float) -> tuple[float, float, float, float]:
        col, row = self._at(x, y)
        return col - size * self.scale, row - size * self.scale, col + size * self.scale, row + size * self.scale
