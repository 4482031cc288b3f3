"""The site builds without a warning, its links lead somewhere, it fetches nothing, and it knows all that is public."""

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest

ROOT = Path(__file__).parent.parent
ELSEWHERE = re.compile(r"(\w+:)?//")


class Page(HTMLParser):
    """A page's anchors, where it leads, and what it loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str | None] = set()
        self.links: set[str] = set()
        self.loads: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        has = dict(attrs)
        self.anchors |= {has.get("id"), has.get("name")}
        if tag == "a" and "href" in has:
            self.links.add(has["href"])
        if "src" in has:
            self.loads.add(has["src"])
        if tag == "link" and has.get("rel") in ("stylesheet", "preload", "icon", "shortcut icon"):
            self.loads.add(has["href"])


@pytest.mark.skipif(
    not (ROOT / "core").is_dir(), reason="beside a wheel there are no sources, whose pages the site has"
)
def test_the_site_builds_without_a_warning_and_all_in_it_is_there(tmp_path):
    site = tmp_path / "site"
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-c", str(ROOT / "docs")]
    built = subprocess.run(
        [*command, "-d", str(tmp_path / "cache"), str(ROOT), str(site)], capture_output=True, text=True, check=False
    )
    assert built.returncode == 0, built.stdout + built.stderr
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}
    check_pages(site)
    check_links(pages)
    check_loads(site, pages)
    check_reference(pages[site / "docs" / "api.html"])


def check_pages(site):
    """Every page that is written for it is in it, and what a server shows first."""
    written = {path.relative_to(site).with_suffix("").as_posix() for path in site.rglob("*.html")}
    plugins = {path.relative_to(ROOT).with_suffix("").as_posix() for path in (ROOT / "plugins").rglob("README.md")}
    assert {"index", "README", *plugins, *(f"docs/{path.stem}" for path in (ROOT / "docs").glob("*.md"))} <= written


def check_links(pages):
    """Links within the site lead to a file, and to an anchor in it."""
    checked = 0
    for path, page in pages.items():
        for link in page.links:
            target, anchor = urldefrag(link)
            if re.match(r"\w+:", target):
                continue
            found = path.parent.joinpath(unquote(target)).resolve() if target else path
            assert found.is_file(), f"{path}: {link}"
            assert not anchor or found not in pages or unquote(anchor) in pages[found].anchors, f"{path}: {link}"
            checked += 1
    assert checked > 500


def check_loads(site, pages):
    """Pictures, styles and scripts are there; none comes from the network."""
    for path, page in pages.items():
        for load in page.loads:
            assert not ELSEWHERE.match(load), f"{path}: {load}"
            if not load.startswith("data:"):
                assert path.parent.joinpath(unquote(load.partition("?")[0])).is_file(), f"{path}: {load}"
    for style in site.rglob("*.css"):
        assert not re.search(r"url\(['\"]?(https?:)?//|@import", style.read_text(encoding="utf-8")), style


def check_reference(page):
    """Every public name has its place."""
    listed = (ROOT / "tests" / "public_api.txt").read_text(encoding="utf-8")
    public = set(re.findall(r"^(?:class )?(pathloom(?:\.testing)?\.\w+)", listed, re.MULTILINE))
    assert len(public) > 100
    assert public <= page.anchors
