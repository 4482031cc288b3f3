"""An animation of an evolution: a population's paths on the map, generation by generation."""

import io
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.draw.colours import Theme, rgb, theme
from pathloom.draw.raster import coarse
from pathloom.draw.saving import check_suffix
from pathloom.draw.video import check_ffmpeg, encoded
from pathloom.errors import PathloomError
from pathloom.files import FilePath, replace

if TYPE_CHECKING:
    from PIL.Image import Image

Cell = tuple[int, int]
Frame: TypeAlias = tuple[int, Sequence[ArrayLike], ArrayLike | None, float | None]
"""Generation, paths (k, 2) of the population, path (k, 2) and fitness of its best one."""

SUFFIXES = (".gif", ".mp4")
MOST_FRAMES = 120
LAST = 2500
"""Milliseconds that the last frame stays."""
SIDE = 600
"""Pixels, about, of the map's longer side."""
MARGIN, HEADER = 12, 34
NARROWEST = 380
"""Pixels that the text above the map needs."""

# A pixel is an index into one palette: tone of the map x crowd of paths x best path,
# then the steps from ground to ink for text and from disc to letter.
TONES, CROWDS, BESTS, STEPS = 4, 12, 4, 8
INK = TONES * CROWDS * BESTS
SMOOTH = 200_000
"""Points of a crowd up to which its lines have smooth edges; beyond it one would not see them."""
VEIL = 0.2
"""Share of a pixel's colour that one path of the population takes."""


def animate(
    frames: Iterable[Frame],
    file: FilePath,
    *,
    occupied: ArrayLike,
    closed: ArrayLike | None = None,
    start: Cell,
    goal: Cell,
    dark: bool = False,
) -> None:
    """Write an animation of a population that evolves, as GIF or MP4, replacing a file that stands there.

    Of more than 120 frames as many are taken, evenly, the first and the last among
    them; the last one stays longer.

    Parameters
    ----------
    frames
        Generation, population, best path and its fitness; the population's paths and
        the best are (k, 2) cells, and the best may be ``None``.
    file
        ``.gif``, or ``.mp4`` where the program ffmpeg is installed.
    occupied, closed
        (rows, cols) bool: obstacles, and what a robot's radius closes.
    start, goal
        (row, column).
    dark
        For dark ground.

    Raises
    ------
    PathloomError
        If there is no frame, the suffix is another, ffmpeg is missing or fails, or the folder is
        missing or not writable.
    """
    suffix = check_suffix(file, SUFFIXES)
    if suffix == ".mp4":
        check_ffmpeg(file)
    shown = list(frames)
    if not shown:
        raise PathloomError(f"{file}: found no frames, allowed one or more")
    if len(shown) > MOST_FRAMES:
        shown = [shown[i] for i in np.linspace(0, len(shown) - 1, MOST_FRAMES).round().astype(int)]
    walls = np.asarray(occupied, bool)
    rims = walls if closed is None else np.asarray(closed, bool)
    stage = Stage(walls, rims, (start, goal), theme(dark=dark))
    images = [stage.draw(*frame) for frame in shown]
    step = int(min(max(8000 / len(images), 60), 400)) // 10 * 10  # a GIF counts hundredths of a second
    if suffix == ".mp4":
        replace(file, encoded(file, images, step, LAST))
        return
    buffer = io.BytesIO()
    images[0].save(
        buffer, "GIF", save_all=True, append_images=images[1:], loop=0, optimize=False, disposal=1,
        duration=[step] * (len(images) - 1) + [LAST],
    )  # fmt: skip
    replace(file, buffer.getvalue())


class Stage:
    """The map in pixels, on which each generation is drawn."""

    def __init__(self, walls: NDArray[np.bool_], closed: NDArray[np.bool_], ends: tuple[Cell, Cell], colours: Theme):
        from PIL import ImageFont

        rows, cols = walls.shape
        self.scale = max(SIDE / max(rows, cols), 1 / max(1, min(rows, cols)))
        if self.scale > 2:
            self.scale = int(self.scale)
        self.size = round(rows * self.scale), round(cols * self.scale)
        self.canvas = HEADER + self.size[0] + MARGIN, max(self.size[1] + 2 * MARGIN, NARROWEST)
        self.corner = HEADER, (self.canvas[1] - self.size[1]) // 2
        self.thick = 4 if max(rows, cols) <= 60 else 3
        self.font = ImageFont.load_default(15)
        self.small = ImageFont.load_default(14)
        self.colours = colours
        self.palette = _palette(colours)
        self.tones = self._tones(walls, closed)
        self.discs = [self._disc(cell, letter, n) for n, (cell, letter) in enumerate(zip(ends, "SG", strict=True))]

    def draw(
        self, generation: int, population: Sequence[ArrayLike], best: ArrayLike | None, fitness: float | None
    ) -> "Image":
        """Return one generation as an image with the palette of them all."""
        from PIL import Image

        crowd = self._crowd([self._pixels(path) for path in population])
        line = self._best(self._pixels([] if best is None else best))
        pixels = np.full(self.canvas, INK, np.uint8)
        (top, left), (high, wide) = self.corner, self.size
        pixels[top : top + high, left : left + wide] = (self.tones * CROWDS + crowd) * BESTS + line
        for box, disc, inside in self.discs:
            pixels[box][inside] = disc[inside]
        words = f"generation {generation}"
        pixels[:HEADER] = INK + self._text(words, MARGIN)
        if fitness is not None:
            words = f"best fitness {fitness:.6g}"
            right = self._text(words, self.canvas[1] - MARGIN, anchor="rm")
            pixels[:HEADER] = np.maximum(pixels[:HEADER], INK + right)
        image = Image.fromarray(pixels)
        image.putpalette(self.palette)
        return image

    def _tones(self, walls: NDArray[np.bool_], closed: NDArray[np.bool_]) -> NDArray[np.uint8]:
        """Return free 0, closed 1, obstacle 2, line between cells 3."""
        tones = coarse(closed, *self.size).astype(np.uint8)
        tones[coarse(walls, *self.size)] = 2
        if self.scale >= 12:
            step = int(self.scale)
            for lines in (tones[::step], tones.T[::step]):
                lines[lines == 0] = 3
        return tones

    def _pixels(self, path: ArrayLike) -> NDArray[np.float64]:
        """Return the nodes of a path as pixels (row, column) of the map."""
        cells = np.asarray(path, np.float64).reshape(-1, 2)
        pixels: NDArray[np.float64] = (cells + 0.5) * self.scale - 0.5
        return pixels

    def _crowd(self, paths: Sequence[NDArray[np.float64]]) -> NDArray[np.uint8]:
        """Return how strongly the paths of a population cover each pixel, in steps."""
        some = [path for path in paths if len(path) > 1]
        if not some:
            return np.zeros(self.size, np.uint8)
        tails, heads = np.concatenate([p[:-1] for p in some]), np.concatenate([p[1:] for p in some])
        count = np.ceil(np.abs(heads - tails).max(axis=1)).astype(int)  # one point for each pixel crossed
        segment = np.repeat(np.arange(len(count)), count)
        share = (np.arange(count.sum()) - np.repeat(count.cumsum() - count, count) + 0.5) / count[segment]
        points = tails[segment] + share[:, np.newaxis] * (heads - tails)[segment]
        high, wide = self.size

        def cover(at: NDArray[np.int64], part: NDArray[np.float64] | None) -> NDArray[np.float64]:
            row, col = np.clip(at[:, 0], 0, high - 1), np.clip(at[:, 1], 0, wide - 1)
            return np.bincount(row * wide + col, part, minlength=high * wide).astype(np.float64)

        if len(points) > SMOOTH:
            covered = cover(np.rint(points).astype(np.int64), None)
        else:  # a point lies between four pixels, and each takes its part
            base = np.floor(points).astype(np.int64)
            off = points - base
            covered = np.zeros(high * wide)
            for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
                covered += cover(base + corner, np.abs(1 - np.array(corner) - off).prod(axis=1))
        veil = 1 - (1 - VEIL) ** covered
        return np.rint(veil * (CROWDS - 1)).astype(np.uint8).reshape(self.size)

    def _best(self, path: NDArray[np.float64]) -> NDArray[np.uint8]:
        """Return how much of each pixel the best path covers, in steps."""
        from PIL import Image, ImageDraw

        if len(path) == 0:
            return np.zeros(self.size, np.uint8)
        high, wide = self.size
        image = Image.new("L", (2 * wide, 2 * high))  # drawn at twice the size, for smooth edges
        draw = ImageDraw.Draw(image)
        points = [(2 * col + 1, 2 * row + 1) for row, col in path]
        draw.line(points, fill=255, width=2 * self.thick, joint="curve")
        reach = 2 * self.thick
        if self.scale >= 8:
            for x, y in points:
                draw.ellipse((x - reach, y - reach, x + reach, y + reach), fill=255)
        return np.rint(np.asarray(image.reduce(2)) / 255 * (BESTS - 1)).astype(np.uint8)

    def _text(self, words: str, x: int, anchor: str = "lm") -> NDArray[np.uint8]:
        """Return words as steps from ground to ink, on a strip as high as the header."""
        from PIL import Image, ImageDraw

        image = Image.new("L", (self.canvas[1], HEADER))
        ImageDraw.Draw(image).text((x, HEADER // 2), words, fill=255, font=self.font, anchor=anchor)
        return np.rint(np.asarray(image) / 255 * (STEPS - 1)).astype(np.uint8)

    def _disc(
        self, cell: Cell, letter: str, nth: int
    ) -> tuple[tuple[slice, slice], NDArray[np.uint8], NDArray[np.bool_]]:
        """Return where an end's disc lies on the canvas, its pixels, and which of them it covers."""
        from PIL import Image, ImageDraw

        radius = 10
        row, col = (round(float(v)) for v in self._pixels([cell])[0])
        side = 2 * radius + 1
        round_, text = Image.new("L", (side, side)), Image.new("L", (side, side))
        ImageDraw.Draw(round_).ellipse((0, 0, side - 1, side - 1), fill=255)
        ImageDraw.Draw(text).text((radius + 0.5, radius + 0.5), letter, fill=255, font=self.small, anchor="mm")
        steps = np.rint(np.asarray(text) / 255 * (STEPS - 1)).astype(np.uint8)
        top, left = (
            min(max(corner + at - radius, 0), length - side)
            for corner, at, length in zip(self.corner, (row, col), self.canvas, strict=True)
        )
        pixels = (INK + (1 + nth) * STEPS + steps).astype(np.uint8)
        return (slice(top, top + side), slice(left, left + side)), pixels, np.asarray(round_) > 127


def _palette(colours: Theme) -> list[int]:
    def mix(a: NDArray[np.float64], b: NDArray[np.float64], share: float) -> NDArray[np.float64]:
        return a + (b - a) * share

    def of(colour: str) -> NDArray[np.float64]:
        return np.array(rgb(colour), np.float64)

    entries = []
    for tone in (colours.free, colours.closed, colours.wall, colours.faint):
        for crowd in range(CROWDS):
            under = mix(of(tone), of(colours.crowd), crowd / (CROWDS - 1))
            entries += [mix(under, of(colours.best), best / (BESTS - 1)) for best in range(BESTS)]
    white = "#ffffff"
    for a, b in ((colours.ground, colours.ink), (colours.start, white), (colours.goal, white)):
        entries += [mix(of(a), of(b), step / (STEPS - 1)) for step in range(STEPS)]
    return [int(v) for v in np.rint(np.concatenate(entries))]
