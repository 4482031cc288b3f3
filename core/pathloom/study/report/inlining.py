"""Figures of matplotlib as SVG within a page, in the page's own colours.

A figure is drawn once, on light ground. Its colours become the page's, so that
the same figure is legible on light and on dark ground, and on paper.
"""

import io
import re
from html import escape
from typing import TYPE_CHECKING

from markupsafe import Markup

from pathloom.draw.colours import DARK, LIGHT
from pathloom.draw.study import SERIES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS: dict[str, tuple[str, str, str]] = {
    light: (name, light, dark)
    for name, light, dark in (
        *((f"series-{i}", *pair) for i, pair in enumerate(zip(SERIES[False], SERIES[True], strict=True))),
        *((name, getattr(LIGHT, name), getattr(DARK, name)) for name in ("ink", "faint", "quiet")),
    )
}
"""By the colour on light ground: what the page calls it, and what it is on light and on dark ground."""


LARGER = 1.4
"""How much larger than drawn a figure may become, where there is room."""


def variables() -> tuple[dict[str, str], dict[str, str]]:
    """Return the colours by name, on light and on dark ground."""
    return {n: light for n, light, _ in COLOURS.values()}, {n: dark for n, _, dark in COLOURS.values()}


def inline(figure: "Figure", name: str, label: str) -> Markup:
    """Return a figure as an SVG element.

    Parameters
    ----------
    figure
        Drawn on light ground.
    name
        Unique within the page: what the figure's own names begin with.
    label
        What it shows, for those who do not see it.
    """
    import matplotlib as mpl

    picture = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": "pathloom", "svg.fonttype": "none"}):  # words stay words
        figure.savefig(picture, format="svg", transparent=True, metadata={"Date": None})
    text = picture.getvalue()
    found = re.search(r'<svg[^>]*viewBox="0 0 ([\d.]+) ([\d.]+)"[^>]*>(.*)</svg>', text, re.DOTALL)
    assert found, "matplotlib writes a view box"
    width, height, body = found.groups()
    body = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", body, flags=re.DOTALL)
    body = _own_names(body, name)
    body = re.sub(r"#[0-9a-f]{6}\b", lambda it: f"var(--{COLOURS[it[0]][0]})" if it[0] in COLOURS else it[0], body)
    body = re.sub(r"\n\s*", "\n", body)
    return Markup(  # noqa: S704 - a picture of ours; matplotlib has escaped its texts
        f'<svg class="figure" viewBox="0 0 {width} {height}" role="img" aria-label="{escape(label)}" '
        f'style="max-width:{LARGER * float(width) / 72:.3f}in">{body}</svg>'
    )


def _own_names(body: str, name: str) -> str:
    """Let names that are referred to begin with the figure's, and drop the others."""
    used = set(re.findall(r'(?:url\(#|href="#)([^)"]+)', body))
    body = re.sub(r'\sid="([^"]*)"', lambda it: f' id="{name}-{it[1]}"' if it[1] in used else "", body)
    return re.sub(r'(url\(#|xlink:href="#)', lambda it: f"{it[1].replace('xlink:', '')}{name}-", body)
