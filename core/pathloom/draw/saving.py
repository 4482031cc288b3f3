"""Save a figure: the same figure gives the same bytes, whole or not at all."""

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pathloom.errors import PathloomError
from pathloom.files import FilePath, replace
from pathloom.naming import meant

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# What each format would say of the time at which it was written, left out.
METADATA: dict[str, dict[str, Any]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None},
    ".pdf": {"CreationDate": None},
}
DPI = 220
"""Of pixel images, and of the map within vector ones."""


def save(figure: "Figure", file: FilePath) -> None:
    """Save a figure in the format that the suffix names, replacing a file that stands there.

    Parameters
    ----------
    figure
        As ``path_figure`` returns it, or any other of matplotlib.
    file
        ``.png``, ``.svg`` or ``.pdf``.

    Raises
    ------
    PathloomError
        If the suffix is none of these, or the folder is missing or not writable.
    """
    suffix = check_suffix(file, METADATA)
    import matplotlib as mpl

    picture = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "pathloom", "pdf.fonttype": 42}):
        figure.savefig(picture, format=suffix[1:], dpi=DPI, metadata=METADATA[suffix], facecolor=figure.get_facecolor())
    replace(file, picture.getvalue())


def svg(figure: "Figure") -> str:
    """Return a figure as an SVG document, as a notebook shows it."""
    import matplotlib as mpl

    picture = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": "pathloom"}):
        figure.savefig(picture, format="svg", metadata={"Date": None}, facecolor=figure.get_facecolor())
    return picture.getvalue()


def check_suffix(file: FilePath, allowed: "dict[str, Any] | tuple[str, ...]") -> str:
    """Return the suffix of a file, in lower case, if it is an allowed one.

    Raises
    ------
    PathloomError
        If it is another.
    """
    suffix = Path(file).suffix.lower()
    if suffix in allowed:
        return suffix
    found = f"the suffix {suffix!r}" if suffix else "no suffix"
    hint = meant(suffix, allowed)
    raise PathloomError(f"{file}: found {found}, allowed {' '.join(allowed)}{'; ' if hint else ''}{hint}")
