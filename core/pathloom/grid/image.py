"""Maps drawn as images, dark on bright: PNG, PGM, BMP and JPEG."""

import io
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import MapError
from pathloom.files import LARGEST_MAP, FilePath, content, refusal
from pathloom.grid.occupancy import OccupancyGrid

if TYPE_CHECKING:
    from PIL import Image

THRESHOLD = 128.0
"""Grey below which a pixel is occupied where nothing else is asked for."""

FORMATS = ("PNG", "PPM", "BMP", "JPEG")
"""What Pillow may decode here (it counts PGM to PPM); the fewer decoders, the safer."""

WHITE = 255.0


@dataclass(frozen=True, slots=True)
class Picture:
    """The grey levels of an image.

    Parameters
    ----------
    grey
        (H, W), 0 black to 255 white, the mean of the colour channels; levels of 16 bits
        lie in between.
    opacity
        (H, W), 0 to 1, or None for an image that has no transparency.
    """

    grey: NDArray[np.float64]
    opacity: NDArray[np.float64] | None


def read_image(path: FilePath, *, threshold: float | None = None) -> OccupancyGrid:
    """Return the map of an image, a pixel a cell, the top row of pixels first.

    A pixel is occupied when its grey is less than the threshold. Transparent parts show
    white paper beneath, so they are free.

    Parameters
    ----------
    path
        PNG, PGM (P2 and P5, with or without comments), BMP or JPEG.
    threshold
        Grey, 0 to 255; None is 128.

    Raises
    ------
    MapError
        If the file is not an image of these kinds, is damaged, or larger than
        `LARGEST_MAP` pixels.
    """
    picture = read_picture(path)
    grey = picture.grey
    if picture.opacity is not None:
        grey = WHITE - (WHITE - grey) * picture.opacity
    dark = grey < (THRESHOLD if threshold is None else threshold)
    return OccupancyGrid(dark, name=Path(path).name)


def read_picture(path: FilePath) -> Picture:
    """Return the grey levels of an image.

    Raises
    ------
    MapError
        As `read_image`.
    """
    from PIL import Image, UnidentifiedImageError

    data = content(path)
    # Our own limit is checked below, before anything is decoded, and is lower than Pillow's.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            with Image.open(io.BytesIO(data), formats=FORMATS) as image:
                _check_size(path, image)
                return _picture(image)
        except MapError:
            raise
        except UnidentifiedImageError as error:
            raise refusal(path, "", "something else than an image", "PNG, PGM, BMP or JPEG") from error
        except Image.DecompressionBombError as error:
            raise refusal(path, "", "far too many pixels", f"at most {LARGEST_MAP} pixels") from error
        except Exception as error:  # decoders raise nearly anything at broken data
            cause = str(error) or type(error).__name__
            raise refusal(path, "", f"a damaged image ({cause})", "PNG, PGM, BMP or JPEG") from error


def _check_size(path: FilePath, image: "Image.Image") -> None:
    if image.width * image.height > LARGEST_MAP:
        found = f"an image of {image.width} x {image.height} pixels"
        raise refusal(path, "", found, f"at most {LARGEST_MAP} pixels")


def _picture(image: "Image.Image") -> Picture:
    """Return the grey levels of an opened image, whatever its mode."""
    if image.mode.startswith("I"):  # 16 bits of grey; 65535 / 257 is 255
        return Picture(np.asarray(image, dtype=np.float64) / 257.0, None)
    if "transparency" in image.info or image.mode in {"LA", "La", "PA", "RGBA", "RGBa"}:
        levels = np.asarray(image.convert("RGBA"))
        return Picture(levels[..., :3].mean(axis=2), levels[..., 3] / 255.0)
    if image.mode in {"1", "L"}:
        return Picture(np.asarray(image.convert("L"), dtype=np.float64), None)
    return Picture(np.asarray(image.convert("RGB")).mean(axis=2), None)
