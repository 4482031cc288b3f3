"""The drawing that follows a run."""

import io
import sys

import pytest
from PIL import Image

import pathloom as pl
from pathloom.draw import Live

SHORT = {"use": "imga", "population": 20, "termination": {"use": "max-generations", "limit": 7}}


@pytest.fixture
def problem():
    return pl.PathProblem(pl.load_map("iga-map1"), corners="allow")


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def shown(monkeypatch, problem):
    """Plan before a terminal, and return what it was sent."""

    def plan(observer):
        monkeypatch.setenv("TERM", "xterm")
        monkeypatch.setattr(sys, "stderr", Terminal())
        pl.plan(problem, pl.compose(SHORT, observers=[observer]))
        return sys.stderr.getvalue()

    return plan


def test_a_file_holds_the_last_state_in_the_end(tmp_path, problem):
    file = tmp_path / "live.png"
    pl.plan(problem, pl.compose(SHORT, observers=[Live(file=str(file), every=1000.0)]))
    with Image.open(file) as image:
        assert min(image.size) > 500
    assert [p.name for p in tmp_path.iterdir()] == ["live.png"]


def test_the_terminal_shows_the_path_and_the_generation(shown):
    seen = shown(Live(every=0.0))
    assert "imga, generation 0, best fitness" in seen
    assert "imga, generation 7" in seen
    assert "S" in seen
    assert "G" in seen


def test_a_bar_shows_how_far_a_run_is(shown):
    assert "imga, generation" in shown("progress")


def test_a_bar_waits_as_long_as_it_should(shown):
    assert shown({"use": "progress", "patience": 1000.0}) == ""


@pytest.mark.parametrize("name", ["live", "progress"])
def test_where_there_is_no_terminal_nothing_is_drawn(capfd, problem, name):
    pl.plan(problem, pl.compose(SHORT, observers=[name]))
    assert capfd.readouterr() == ("", "")


def test_another_suffix_is_refused_when_the_planner_is_composed():
    with pytest.raises(pl.PathloomError, match=r"live.bmp: found the suffix '.bmp', allowed .png .svg .pdf"):
        pl.compose(SHORT, observers={"use": "live", "file": "live.bmp"})
