"""The report: one page, complete, well-formed, and legible in a browser."""

import html
import json
import os
import re
import shutil
import subprocess
from collections import Counter
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

import pathloom as pl
from pathloom.study import Study
from pathloom.study.report import report
from pathloom.study.report.citing import STATISTICS

NASTY = "<img src=x onerror=\"alert(1)\"> & 'quotes' {{ 7 * 7 }} $x_1$"
VOID = {"meta", "link", "br", "wbr", "hr", "img", "input"}
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
UNSEEN = (
    "no Chromium is installed here, so that nobody looks whether the page fits wide and narrow windows, whether its "
    "figures are shown in light and dark, and whether it asks for anything; on Debian: apt-get install chromium"
)


@dataclass(frozen=True, kw_only=True)
class Raising(pl.Mutation):
    """Fails, and says why in signs that HTML knows."""

    def apply(self, population, chosen, problem, rng):
        raise ValueError("<b>broken</b> & gone")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Two planners and one that raises, on two maps, one of them with a name of which nothing may come."""
    walls = np.zeros((8, 9), bool)
    walls[2, 1:] = walls[5, :-2] = True
    grids = [pl.OccupancyGrid(np.zeros((8, 8), bool), name=NASTY), pl.OccupancyGrid(walls, name="walls")]
    quick = {"population": 12, "termination": [{"use": "max-generations", "limit": 4}]}
    planners = {
        "imga": {"use": "imga", **quick},
        "roulette <&>": {"use": "imga", "selection": "roulette", **quick},
        "raising": pl.compose({"use": "imga", **quick}, mutation=Raising(rate=0.5)),
    }
    file = tmp_path_factory.mktemp("report") / "s.db"
    with pl.compare(planners, maps=grids, runs=3, budget="own", workers=1, out=file) as found:
        yield found


@pytest.fixture(scope="module")
def page(study):
    return report(study)


class Tree(HTMLParser):
    """Says which elements do not nest, and collects what a page refers to."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.refers: list[tuple[str, str]] = []
        self.tags: Counter[str] = Counter()
        self.figures: list[str] = []
        self.text: list[str] = []

    def handle_starttag(self, tag, attrs):
        self.tags[tag] += 1
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attrs:
            if name == "id":
                self.ids.append(value)
            if name in ("src", "href", "xlink:href", "srcset", "data", "action", "poster"):
                self.refers.append((tag, value))

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open[-1:] == [tag], f"</{tag}> closes {self.open[-3:]} at {self.getpos()}"
        self.open.pop()

    def handle_data(self, data):
        self.text.append(data)


def read(page: str) -> Tree:
    tree = Tree()
    tree.feed(page)
    tree.close()
    assert not tree.open
    return tree


def test_the_page_is_well_formed_and_every_name_in_it_is_unique(page):
    tree = read(page)
    assert [name for name, count in Counter(tree.ids).items() if count > 1] == []
    assert tree.tags["html"] == tree.tags["h1"] == tree.tags["main"] == 1


def test_the_page_refers_to_nothing_but_itself(page):
    tree = read(page)
    assert all(value.startswith(("#", "data:")) for _, value in tree.refers)
    assert {value[1:] for _, value in tree.refers if value.startswith("#")} <= set(tree.ids)
    assert set(re.findall(r"url\(([^)]*)\)", page)) <= {f"#{name}" for name in tree.ids}
    assert tree.tags["script"] == tree.tags["iframe"] == tree.tags["object"] == 0
    assert "@import" not in page


def test_every_figure_is_there(page):
    for name in ("ranks", "spread", "convergence", "targets", "profile"):
        assert f'id="figure-{name}"' in page
    assert page.count('class="map"') == 5  # best and worst of two; the third always fails alike
    assert page.count('class="figure"') == 5


def test_names_and_errors_of_others_are_text(page):
    assert "<img" not in page
    assert "<b>broken" not in page
    assert "&lt;b&gt;broken&lt;/b&gt; &amp; gone" in page
    assert "{{ 7 * 7 }}" in page
    text = "".join(read(page).text)
    assert NASTY in text
    assert "roulette <&>" in text


def test_verdicts_rates_methods_failures_and_versions_stand_in_the_page(study, page):
    text = " ".join("".join(read(page).text).split())
    assert "raising" in text
    assert "6 of 18 runs have no path" in text
    assert "ValueError" in text
    assert "Success rates have 95 % Wilson intervals" in text
    assert "seeds 0 to 2" in text
    assert "@article{li2021imga" in text
    assert "E. B. Wilson (1927), Probable Inference" in text
    assert "@article{wilson1927" in text
    assert f"pathloom {study.versions[0]['pathloom']}" in text
    assert '[planner]\nuse = "imga/imga"' in "".join(read(page).text)


def test_an_article_is_cited_with_initials_and_entered_in_tex():
    vargha = STATISTICS["a12"].work
    assert vargha.text == (
        "A. Vargha, H. D. Delaney (2000), A Critique and Improvement of the CL Common Language Effect Size Statistics of "
        "McGraw and Wong, Journal of Educational and Behavioral Statistics 25, 101-132"
    )
    assert vargha.bibtex.startswith("@article{vargha2000,\n  author  = {Vargha, Andr{\\'a}s and Delaney, Harold D.},\n")
    assert all(article.work.bibtex.isascii() for article in STATISTICS.values())


def test_the_same_study_makes_the_same_page(study, page):
    assert report(study) == page


def test_a_study_of_one_variant_has_a_report(grid, opened):
    found = opened(pl.compare(["imga"], maps=[grid], runs=1, budget="evaluations=40", workers=1))
    tree = read(report(found))
    assert "nothing to compare it with" in " ".join(" ".join(tree.text).split())


def test_a_study_of_fronts_has_a_report(grid, opened):
    found = opened(pl.compare(["nsga2", "spea2"], maps=[grid], runs=2, budget="evaluations=200", workers=1))
    assert "hypervolume" in report(found)


def test_a_study_without_runs_says_so_in_one_line(grid, tmp_path, monkeypatch):
    with pl.compare(["imga"], maps=[grid], runs=1, budget="evaluations=40", workers=1, out=tmp_path / "s.db"):
        pass
    import sqlite3
    from contextlib import closing

    with closing(sqlite3.connect(tmp_path / "s.db")) as db:
        db.executescript("DELETE FROM traces; DELETE FROM runs;")
    with Study.open(tmp_path / "s.db") as empty, pytest.raises(pl.ConfigError, match="no runs yet"):
        report(empty)


def test_the_command_writes_the_page_and_refuses_other_suffixes(study, page, tmp_path, capsys):
    from pathloom.cli.study_report import command

    target = tmp_path / "r.html"
    command.main([study.name, "-o", str(target)], standalone_mode=False)
    written = target.read_text(encoding="utf-8")
    missing = "Parts of raising are not installed where this was written, and are not cited."
    assert missing not in page
    assert written.replace(f" {missing}", "") == page
    assert "KiB" in capsys.readouterr().err
    with pytest.raises(pl.ConfigError, match="suffix"):
        command.main([study.name, "-o", str(tmp_path / "r.pdf")], standalone_mode=False)
    with pytest.raises(pl.ConfigError, match="no variant is called"):
        command.main([study.name, "-o", str(target), "--baseline", "nobody"], standalone_mode=False)


# In a browser.

PROBE = """<script>
addEventListener("error", event => errors.push(String(event.message)));
var errors = [];
addEventListener("load", () => setTimeout(() => {
  const box = element => element.getBoundingClientRect();
  const seen = [...document.querySelectorAll("svg.figure, svg.map")].map(svg => {
    const it = box(svg), style = getComputedStyle(svg);
    const words = [...svg.querySelectorAll("text")].filter(text => {
      const at = box(text); return at.left < it.left - 1.5 || at.right > it.right + 1.5 || at.bottom > it.bottom + 1.5;
    }).map(text => text.textContent);
    return {width: it.width, height: it.height, left: it.left, right: it.right, words,
            shown: style.visibility === "visible" && style.display !== "none"};
  });
  const found = {inner: innerWidth, scroll: document.documentElement.scrollWidth, errors, seen,
                 requests: performance.getEntriesByType("resource").map(entry => entry.name),
                 ground: getComputedStyle(document.body).backgroundColor, ink: getComputedStyle(document.body).color};
  parent.postMessage(JSON.stringify(found), "*");
}, 50));
</script>"""
FRAME = """<!doctype html><iframe src="{}" width="{}" height="900" style="border: 0"></iframe><pre id="found"></pre>
<script>addEventListener("message", event => document.getElementById("found").textContent = event.data)</script>"""
"""A browser's window has a least width, a frame within it has none."""


@pytest.fixture(scope="module")
def browser():
    """A Chromium; where PATHLOOM_BROWSER is ``required``, tests fail without one."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        (pytest.fail if os.environ.get("PATHLOOM_BROWSER") == "required" else pytest.skip)(UNSEEN)
    return found


def probed(browser: str, page: str, folder: Path, width: int, *, dark: bool) -> dict:
    """Open a page in a browser, and return what it looks like there."""
    (folder / "page.html").write_text(page.replace("<head>", f"<head>{PROBE}", 1), encoding="utf-8")
    frame = folder / "frame.html"
    frame.write_text(FRAME.format("page.html", width), encoding="utf-8")
    done = subprocess.run(
        [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--enable-logging=stderr",
         f"--user-data-dir={folder / 'profile'}", f"--blink-settings=preferredColorScheme={0 if dark else 1}",
         "--window-size=1400,950", "--virtual-time-budget=4000", "--dump-dom", frame.as_uri()],
        capture_output=True, text=True, timeout=120, check=True,
    )  # fmt: skip
    assert "CONSOLE" not in done.stderr, done.stderr
    text = re.search(r'<pre id="found">(.*?)</pre>', done.stdout, re.DOTALL)
    assert text, done.stdout[-500:]
    return json.loads(html.unescape(text[1]))


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_a_browser_shows_all_of_it_and_asks_for_nothing(browser, page, tmp_path, width, dark):
    found = probed(browser, page, tmp_path, width, dark=dark)
    assert found["inner"] == width
    assert found["scroll"] <= width  # no part is wider than the page
    assert found["errors"] == found["requests"] == []
    assert len(found["seen"]) == 10
    for it in found["seen"]:
        assert it["shown"]
        assert min(it["width"] / 150, it["height"] / 60) > 1
        assert 0 <= it["left"] < it["right"] <= width
        assert it["words"] == []  # no word is cut off
    ground, ink = (sum(map(int, re.findall(r"\d+", found[name])[:3])) for name in ("ground", "ink"))
    assert (ground < 120 and ink > 600) if dark else (ground > 700 and ink < 120)
