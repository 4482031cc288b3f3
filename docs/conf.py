"""The site: ``sphinx-build -W -c docs . site`` makes it of the pages where they stand, and of the docstrings.

The root of the repository is the folder of sources, so that a link between two pages is the same for whoever
reads them there and for the site. `PAGES` says which of them belong to it; README.md is the first one.
"""

import re
import shutil
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Any

from sphinx.ext import napoleon

project = "pathloom"
version = release = version_of("pathloom")
project_copyright = "The pathloom developers"

extensions = ["myst_parser", "sphinx.ext.autodoc"]
GUIDES = ("docs/from-pymoo", "docs/from-python-motion-planning", "docs/from-nav2")
PLANNERS = ("loom", "imga", "agacd", "imaga", "iga", "hga_aco", "baselines", "pymoo")
MORE = ("plugins/README", "core/pathloom/study/README", "docs/api", "CHANGELOG", "CONTRIBUTING")
PAPERS = tuple(f"plugins/pathloom_{name}/README" for name in PLANNERS)
PAGES = ("README", *GUIDES, *PAPERS, *MORE)
include_patterns = [f"{page}.md" for page in PAGES]
exclude_patterns = [".*", "site"]
root_doc = "README"

myst_heading_anchors = 3  # as GitHub makes them
myst_enable_extensions = ["attrs_inline"]
highlight_language = "text"
pygments_style = "friendly"
default_role = "code"  # a name between single backticks

autodoc_class_signature = "separated"  # parameters are said below; defaults that are components fill pages
autodoc_default_options = {"members": True, "show-inheritance": True}
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_typehints_format = "short"

html_theme = "furo"  # light and dark; neither fonts nor scripts from elsewhere
html_title = f"pathloom {version}"
html_copy_source = html_show_sourcelink = False
html_theme_options = {"light_css_variables": {"color-brand-primary": "#0b62a8", "color-brand-content": "#0b62a8"}}

PICTURE = re.compile(
    r'<picture>\s*<source [^>]*srcset="([^"]+)">\s*<img alt="([^"]*)" src="([^"]+)"[^>]*>\s*</picture>'
)

SPELT_OUT = {
    r"ndarray\[tuple\[Any, \.\.\.\], dtype\[(\w+)\]\]": r"NDArray[\1]",
    r"_Buffer \| _SupportsArray.*? \| _NestedSequence\[complex \| bytes \| str\]": "ArrayLike",
}
"""Names of numpy's types that Python resolves, and what the source says."""


def tree(caption: str, pages: tuple[str, ...]) -> str:
    """Return a table of contents for the sidebar."""
    return "\n".join(("", "```{toctree}", ":hidden:", f":caption: {caption}", "", *map("/{}".format, pages), "```", ""))


def read(_app: Any, page: str, source: list[str]) -> None:
    """Make of a page of GitHub one of the site: pictures in light and dark, and the sidebar's contents."""
    source[0] = PICTURE.sub(r"![\2](\3){.only-light}\n![\2](\1){.only-dark}", source[0])
    if page == root_doc:
        source[0] += tree("Coming from", GUIDES) + tree("Planners and papers", PAPERS) + tree("More", MORE)


def docstring(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Read numpy's sections. The whole extension would take "(k, 2): cells" below a field for a type and a text."""
    if what not in ("attribute", "property", "data"):
        lines[:] = napoleon.NumpyDocstring(lines, napoleon.Config(), app, what, name, thing, options).lines()


def signature(_app: Any, *what: Any) -> tuple[str | None, ...]:
    """Call types what the source calls them."""
    parts = list(what[-2:])
    for long, short in SPELT_OUT.items():
        parts = [part and re.sub(long, short, part) for part in parts]
    return tuple(parts)


def written(app: Any, failed: Exception | None) -> None:
    """Let whoever asks a server for the folder see the first page."""
    if failed is None and app.builder.format == "html":
        shutil.copyfile(Path(app.outdir, f"{root_doc}.html"), Path(app.outdir, "index.html"))


def setup(app: Any) -> None:
    """Tell Sphinx whom to call."""
    app.connect("source-read", read)
    app.connect("autodoc-process-docstring", docstring)
    app.connect("autodoc-process-signature", signature)
    app.connect("build-finished", written)
