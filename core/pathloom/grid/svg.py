"""A map as SVG: bars of obstacle cells along rows, or an image where these would be too many."""

import base64
import io

import numpy as np
from numpy.typing import NDArray

MOST_BARS = 1500
"""Bars of obstacle cells beyond which the map becomes an image."""
WALL = (0x80, 0x86, 0x8E, 0xFF)
"""Grey that is told from light and from dark ground."""


def walls(occupied: NDArray[np.bool_]) -> str:
    """Return the obstacle cells (height, width) as one element, a cell being one unit wide and high."""
    edges = np.diff(np.pad(occupied, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    begins, ends = np.argwhere(edges == 1), np.argwhere(edges == -1)
    if len(begins) <= MOST_BARS:
        bars = (f"M{col} {row}h{end - col}v1h-{end - col}z"
                for (row, col), end in zip(begins.tolist(), ends[:, 1].tolist(), strict=True))  # fmt: skip
        return f'<path class="wall" d="{"".join(bars)}"/>'
    from PIL import Image

    pixels = np.zeros((*occupied.shape, 4), np.uint8)
    pixels[occupied] = WALL
    file = io.BytesIO()
    Image.fromarray(pixels).quantize(2).save(file, "png", optimize=True)
    rows, cols = occupied.shape
    data = base64.b64encode(file.getvalue()).decode("ascii")
    return f'<image class="walls" width="{cols}" height="{rows}" href="data:image/png;base64,{data}"/>'


def picture(occupied: NDArray[np.bool_]) -> str:
    """Return a map as an SVG document, for notebooks; its grey is seen on light and on dark ground."""
    rows, cols = occupied.shape
    scale = 320 / max(rows, cols)
    grey = "#" + bytes(WALL[:3]).hex()
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {cols} {rows}" width="{max(cols * scale, 1):.0f}" '
        f'height="{max(rows * scale, 1):.0f}" fill="{grey}" style="image-rendering:pixelated">{walls(occupied)}'
        f'<rect width="{cols}" height="{rows}" fill="none" stroke="{grey}" vector-effect="non-scaling-stroke"/></svg>'
    )
