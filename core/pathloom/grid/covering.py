"""From a fine raster to cells: a cell that any part of an obstacle touches is an obstacle."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pathloom.errors import MapError


def full_cell_cover(raster: ArrayLike, factor: int) -> NDArray[np.bool_]:
    """Return the cells (⌈rows / factor⌉, ⌈cols / factor⌉) of a raster, each blocked if any of its pixels is.

    Parameters
    ----------
    raster
        (rows, cols), true for obstacles. Pixels that fill no whole cell at the
        right and lower edge make up cells of their own.
    factor
        Pixels to a cell's side, at least 1.

    Raises
    ------
    MapError
        If the raster has not two dimensions or the factor is below 1.

    Notes
    -----
    As Li et al. 2021, section 3.2, turn a drawing into a grid.
    """
    pixels = np.asarray(raster, dtype=bool)
    if pixels.ndim != 2 or factor < 1:
        raise MapError(f"cover: found {pixels.ndim} dimensions and factor {factor}, allowed 2 and an integer from 1 on")
    rows, cols = (-(-side // factor) for side in pixels.shape)
    padded = np.zeros((rows * factor, cols * factor), np.bool_)
    padded[: pixels.shape[0], : pixels.shape[1]] = pixels
    return np.asarray(padded.reshape(rows, factor, cols, factor).any(axis=(1, 3)))
