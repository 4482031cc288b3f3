"""The page in a real browser: drawn on, run, paused, scrubbed, compared, and taken out to the command line."""

import json
import re
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import pathloom as pl
from pathloom.cli import main
from studio.conftest import moving_ai, write


class Page:
    """One open page, with what a test does to it."""

    def __init__(self, page: Any, address: str) -> None:
        from playwright.sync_api import expect

        expect.set_options(timeout=30_000)
        self.page, self.expect = page, expect
        self.errors: list[str] = []
        self.asked: list[str] = []
        page.on("console", lambda said: said.type in ("error", "warning") and self.errors.append(said.text))
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", lambda request: self.asked.append(request.url))
        self.open(address)

    def open(self, address: str) -> None:
        self.page.goto(address)
        self.page.wait_for_selector("html[data-ready]")

    def __getattr__(self, name: str) -> Any:
        return getattr(self.page, name)

    def says(self, selector: str, text: Any) -> None:
        self.expect(self.page.locator(selector).first).to_contain_text(text)

    def take(self, rows: list[str], folder: Any) -> None:
        """Open a map from a file."""
        with self.page.expect_response("**/look"):
            self.page.set_input_files("#map-file", write(folder, "drawn.map", moving_ai(*rows)))
        label = re.compile(f"Map of {len(rows)} rows and {len(rows[0])} columns")
        self.expect(self.page.locator(".stage canvas").first).to_have_attribute("aria-label", label)

    def at(self, row: int, col: int, lane: int = 0) -> tuple[float, float]:
        """Return where a cell is on the screen."""
        canvas = self.page.locator(".stage canvas").nth(lane)
        canvas.scroll_into_view_if_needed()
        box = canvas.bounding_box()
        rows, cols = map(int, re.findall(r"(\d+) rows and (\d+)", canvas.get_attribute("aria-label"))[0])
        return box["x"] + box["width"] * (col + 0.5) / cols, box["y"] + box["height"] * (row + 0.5) / rows

    def drag(self, *cells: tuple[int, int]) -> None:
        """Press on the first cell, and go over the others."""
        self.page.mouse.move(*self.at(*cells[0]))
        self.page.mouse.down()
        for cell in cells[1:]:
            self.page.mouse.move(*self.at(*cell), steps=4)
        with self.page.expect_response("**/look"):
            self.page.mouse.up()
            self.page.mouse.move(0, 0)

    def settle(self, planner: str, lane: int = 0, generations: int | None = None) -> None:
        """Choose a planner, and after how many generations it ends."""
        self.page.select_option(f'.planner[data-lane="{lane}"] > select', planner)
        if generations is not None:
            form = self.page.locator(f'.planner[data-lane="{lane}"]')
            if form.locator("details.group", has_text="Operators").get_attribute("open") != "":
                form.locator("summary", has_text="Operators").click()
            form.locator("summary", has_text="termination").click()
            form.locator("summary", has_text="max-generations: settings").click()
            form.get_by_label("limit").fill(str(generations))
            form.get_by_label("limit").press("Tab")

    def run(self) -> None:
        """Run to the end, as fast as can be."""
        self.page.select_option("#speed", "Infinity")
        self.page.click("#run")
        self.says("#run", "Run again")

    def saved(self, what: str, folder: Any, lane: int = 0) -> Any:
        """Save something from the menu of a stage, and return its file."""
        stage = self.page.locator(".stage").nth(lane)
        stage.locator("summary").click()
        with self.page.expect_download() as coming:
            stage.locator(f"[data-save={what}]").click()
        file = folder / coming.value.suggested_filename
        coming.value.save_as(file)
        return file


@pytest.fixture(scope="module")
def address(studios: Any) -> str:
    return studios().stdout.readline().strip()


@pytest.fixture
def open_page(browser: Any, address: str) -> Iterator[Any]:
    """Open pages; at the end none of them may have complained, or asked anybody else for anything."""
    contexts, pages = [], []

    def opened(width: int = 1280, height: int = 900, **options: Any) -> Page:
        contexts.append(browser.new_context(viewport={"width": width, "height": height}, **options))
        pages.append(Page(contexts[-1].new_page(), address))
        return pages[-1]

    yield opened
    for page in pages:
        assert page.errors == []
        home = address.partition("?")[0]
        assert [url for url in page.asked if not url.startswith((home, home.replace("http", "ws"), "blob:"))] == []
    for context in contexts:
        context.close()


@pytest.fixture
def plan(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Any:
    """Return what ``pathloom plan`` makes of a config that was saved."""

    def planned(config: Any) -> dict[str, Any]:
        monkeypatch.setattr(sys, "argv", ["pathloom", "plan", str(config), "--json", "--quiet"])
        capsys.readouterr()
        with pytest.raises(SystemExit) as left:
            main()
        assert not left.value.code
        return json.loads(capsys.readouterr().out)

    return planned


def test_a_wall_is_drawn_and_the_path_avoids_it_here_and_on_the_command_line(open_page, plan, tmp_path):
    page = open_page()
    page.take(["." * 12] * 12, tmp_path)
    page.drag((0, 6), (10, 6))  # a wall from the top, open at the bottom
    page.fill("#seed", "5")
    page.settle("imga/imga", generations=15)
    page.run()
    page.says(".answer", "Answer, proven free")

    config, drawn = page.saved("config", tmp_path), page.saved("map", tmp_path)
    page.says("#note", "")
    expected = np.zeros((12, 12), bool)
    expected[:11, 6] = True
    assert np.array_equal(pl.load_map(drawn).occupied, expected)
    result = plan(config)
    shown = np.loadtxt(page.saved("path", tmp_path), delimiter=",", skiprows=1, dtype=int)
    assert shown.tolist() == result["path"]
    problem = pl.PathProblem(pl.OccupancyGrid(expected))
    assert pl.validate(shown, problem) is None
    assert result["seed"] == 5
    assert json.loads(page.saved("result", tmp_path).read_text())["path"] == result["path"]
    assert page.saved("picture", tmp_path).read_bytes().startswith(b"\x89PNG")


def test_a_run_is_paused_stepped_and_scrubbed(open_page, tmp_path):
    page = open_page()
    page.click("#step")
    page.says("#generation", "generation 0 of 50")
    page.click("#step")
    page.says("#generation", "generation 1 of 50")
    page.keyboard.press(".")
    page.says("#generation", "generation 2 of 50")
    page.select_option("#speed", "6")
    page.locator("#speed").blur()
    page.keyboard.press("p")
    page.says("#run", "Pause")
    page.says("#generation", re.compile(r"generation ([5-9]|\d\d) of 50"))
    page.locator("body").press("p")
    page.says("#run", "Go on")
    page.wait_for_timeout(250)
    held = page.inner_text("#generation")
    page.wait_for_timeout(250)
    assert page.inner_text("#generation") == held  # paused is paused
    page.locator("#scrub").focus()
    page.keyboard.press("Home")
    page.says("#generation", "generation 0 of 50")
    page.says(".status", " 100 evaluations")
    page.keyboard.press("ArrowRight")
    page.says("#generation", "generation 1 of 50")
    page.says(".status", " 200 evaluations")
    page.run()
    page.says("#generation", "generation 50 of 50")


def test_two_planners_run_on_the_same_map_and_seed_and_each_config_gives_its_path(open_page, plan, tmp_path):
    page = open_page()
    page.take(
        ["............", ".....@@.....", "............", "..@@@@@@@...", "............", "............"], tmp_path
    )
    page.check("#compare")
    page.settle("imga/imga", 0, 8)
    page.settle("iga/iga", 1, 6)
    page.run()
    assert [page.inner_text(f".stage .name >> nth={lane}") for lane in (0, 1)] == ["imga", "iga"]
    for lane in (0, 1):
        folder = tmp_path / str(lane)
        folder.mkdir()
        config = page.saved("config", folder, lane)
        page.saved("map", folder, lane)
        shown = np.loadtxt(page.saved("path", folder, lane), delimiter=",", skiprows=1, dtype=int)
        result = plan(config)
        assert result["planner"] == ("imga", "iga")[lane]
        assert shown.tolist() == result["path"]


def test_operators_and_weights_chosen_in_the_form_are_in_the_config(open_page, tmp_path):
    import tomllib

    page = open_page()
    form = page.locator('.planner[data-lane="0"]')
    form.get_by_label("Weight of safety").fill("2.5")
    form.locator("summary", has_text="Operators").click()
    form.get_by_label("selection").select_option("tournament")
    form.locator("summary", has_text="tournament: settings").click()
    form.get_by_label("size").fill("4")
    form.get_by_label("mutation", exact=True).select_option("reroute")
    form.get_by_label("Leave out energy").click()
    table = tomllib.loads(page.saved("config", tmp_path).read_text())["planner"]
    assert table["selection"] == {"use": "tournament", "size": 4}
    assert (table["mutation"]["use"], table["mutation"]["rate"]) == ("reroute", 0.2)  # the rate is the slot's
    assert {label: term["weight"] for label, term in table["objectives"].items()} == {"length": 6.0, "safety": 2.5}
    form.get_by_label("population").fill("-3")
    form.get_by_label("population").press("Tab")
    page.click("#run")
    page.says(".planner .fault", "population is an integer in [1, 2147483647]; got -3")


def test_an_unreachable_goal_is_said_where_the_finger_is(open_page, tmp_path):
    page = open_page(390, 844, has_touch=True)
    page.take(["........"] * 8, tmp_path)
    page.drag((0, 4), (7, 4))
    bubble = page.locator(".bubble").first
    page.expect(bubble).to_contain_text("cannot be reached")
    box, (x, y) = bubble.bounding_box(), page.at(7, 4)
    assert box["x"] <= x <= box["x"] + box["width"]
    assert 0 < y - (box["y"] + box["height"]) < 60  # above the finger, and near it
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= 390
    page.click("#run")
    page.says("#generation", "no run yet")
    page.click("#undo")
    page.expect(bubble).to_be_hidden()
    page.drag((7, 0), (2, 2))  # the start, by hand
    page.expect(page.locator(".stage canvas").first).to_have_attribute("aria-label", re.compile("start 2, 2"))


def test_all_can_be_done_by_keyboard(open_page, tmp_path):
    page = open_page()
    page.take(["........"] * 8, tmp_path)
    canvas = page.locator(".stage canvas").first
    canvas.focus()
    for key in ("ArrowUp", "ArrowRight", "Space", "ArrowUp", "s", "Shift+ArrowRight", "g"):
        page.keyboard.press(key)
    page.expect(canvas).to_have_attribute("aria-label", re.compile(r"start 5, 1, goal 5, 6$"))
    expected = np.zeros((8, 8), bool)
    expected[6, 1] = True
    page.wait_for_timeout(150)
    assert np.array_equal(pl.load_map(page.saved("map", tmp_path)).occupied, expected)
    page.select_option("#speed", "Infinity")
    page.locator("#speed").blur()
    page.keyboard.press("p")
    page.says("#run", "Run again")


def test_a_dot_of_the_front_shows_its_path(open_page, tmp_path):
    page = open_page()
    page.take(
        [
            "..........",
            "..@..@....",
            "...@......",
            ".@...@.@..",
            "...@....@.",
            "......@...",
            ".@..@.....",
            "..........",
        ],
        tmp_path,
    )
    page.settle("pymoo/nsga2", generations=8)
    page.run()
    front = page.locator(".chart.front canvas").first
    front.scroll_into_view_if_needed()
    page.says(".chart.front p", "knee")
    before = page.locator(".stage canvas").first.evaluate("canvas => canvas.toDataURL()")
    front.focus()
    for _ in range(8):
        page.keyboard.press("ArrowLeft")
    page.says(".chart.front p", re.compile(r"^\d+ of \d+: length "))
    page.wait_for_function("before => document.querySelector('.stage canvas').toDataURL() !== before", arg=before)
    shown = np.loadtxt(page.saved("path", tmp_path), delimiter=",", skiprows=1, dtype=int)
    length = float(re.findall(r"length ([\d.]+)", page.inner_text(".chart.front p >> nth=0"))[0])
    assert np.hypot(*np.diff(shown, axis=0).T).sum() == pytest.approx(length, abs=1e-3)


def test_a_link_holds_map_planners_and_seed_and_a_damaged_one_says_so(open_page, address, tmp_path):
    page = open_page()
    page.take(["......", ".@@@..", "......"], tmp_path)
    page.fill("#seed", "11")
    page.settle("iga/iga")
    page.click("#share")
    page.says("#note", "seed")
    link = page.url
    assert "token" not in link
    assert "#studio1." in link
    page.goto("about:blank")
    page.open(link)
    assert page.input_value("#seed") == "11"
    assert page.inner_text(".stage .name >> nth=0") == "iga"
    label = re.compile("3 rows and 6 columns")
    page.expect(page.locator(".stage canvas").first).to_have_attribute("aria-label", label)
    page.evaluate("location.hash = '#studio1.AAAA'")
    page.says("#note", "damaged")
    assert "3 rows" in page.locator(".stage canvas").first.get_attribute("aria-label")


def test_a_map_of_512_by_512_is_drawn_on_and_planned_on(open_page, tmp_path):
    page = open_page()
    page.take(["." * 512] * 512, tmp_path)
    page.select_option("#brush", "7")
    page.drag((100, 100), (400, 300))
    page.settle("loom/loom")
    page.run()
    page.says(".answer", "Answer, proven free")


def test_runs_of_60_individuals_and_150_generations_leave_no_memory_behind(open_page, tmp_path):
    page = open_page()
    page.take(["." * 20] * 20, tmp_path)
    page.settle("agacd/agacd", generations=150)
    assert page.input_value(".planner >> input >> nth=0") == "60"
    devtools = page.context.new_cdp_session(page.page)
    devtools.send("Performance.enable")

    def used() -> float:
        page.run()
        page.says("#generation", "generation 150 of 150")
        devtools.send("HeapProfiler.collectGarbage")
        metrics = {entry["name"]: entry["value"] for entry in devtools.send("Performance.getMetrics")["metrics"]}
        return metrics["JSHeapUsedSize"]

    first, second = used(), used()
    assert second < first + 2**19  # half of what the frames of a run take


def test_when_the_server_is_killed_the_page_says_so(studios, browser):
    studio = studios()
    page = Page(browser.new_page(), studio.stdout.readline().strip())
    page.click("#run")
    page.says("#run", "Pause")
    studio.kill()
    page.says("#banner", "The studio has ended")
    assert page.is_disabled("#run")
    assert all("WebSocket" in error or "ERR_" in error for error in page.errors)  # the browser's own words only
    page.page.close()


def test_nothing_is_wider_than_the_window_and_the_theme_is_the_systems(open_page):
    page = open_page()
    page.check("#compare")
    for title in page.locator("summary", has_text="Operators").all():
        title.click()
    for width, scheme in ((1280, "light"), (390, "dark")):
        page.set_viewport_size({"width": width, "height": 844})
        page.emulate_media(color_scheme=scheme)
        page.wait_for_function("width => document.documentElement.scrollWidth <= width", arg=width)
        ground = page.evaluate("getComputedStyle(document.body).backgroundColor")
        assert (sum(map(int, re.findall(r"\d+", ground)[:3])) < 120) is (scheme == "dark")
    page.click("#theme")  # from auto to light
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
