"""What is imported of somebody else comes back in time, with what it printed, or with the reason why not."""

import threading

import pytest

import pathloom as pl
from pathloom.kernel.importing import LIMIT, cause, misfit, time_limit, within_limits


def test_what_is_printed_meanwhile_is_handed_back_and_not_printed(capsys) -> None:
    def work() -> int:
        print("hello")
        return 7

    assert within_limits(work) == (7, "hello\n")
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("error", [KeyError("x"), SystemExit(3)], ids=repr)
def test_what_is_raised_is_raised(error) -> None:
    def work() -> None:
        raise error

    with pytest.raises(type(error)):
        within_limits(work)


def test_what_does_not_end_is_left_alone_and_the_line_is_named(monkeypatch) -> None:
    ended = threading.Event()
    monkeypatch.setenv("PATHLOOM_PLUGIN_SECONDS", "0.05")
    with pytest.raises(pl.PluginError, match=r"is still not imported after 0\.05 s, at .*threading\.py:\d+: .* \(PATH"):
        within_limits(ended.wait)
    ended.set()


@pytest.mark.parametrize(("said", "seconds"), [("2.5", 2.5), ("-1", 0.0), ("soon", LIMIT), ("", LIMIT)])
def test_the_limit_is_a_number_of_seconds(monkeypatch, said, seconds) -> None:
    monkeypatch.setenv("PATHLOOM_PLUGIN_SECONDS", said)
    assert time_limit() == seconds


@pytest.mark.parametrize(
    "requirement", ["pathloom", "pathloom>=0", "PathLoom<99", "numpy>=99", "pathloom>=99; python_version<'3'", "?"]
)
def test_what_asks_for_no_other_pathloom_fits(requirement) -> None:
    assert misfit([requirement]) == ""


@pytest.mark.parametrize("requirement", ["pathloom>=99", "pathloom (<0)", "Pathloom==7; python_version>'3'"])
def test_what_asks_for_another_pathloom_is_told_which_there_is(requirement) -> None:
    assert misfit(["numpy", requirement]).endswith(f"; installed is {pl.__version__}")


def test_only_names_that_pathloom_lacks_are_laid_to_its_version() -> None:
    own = f"; pathloom {pl.__version__} has no such name"
    assert cause(ImportError("no X", name="pathloom.kernel")).endswith(own)
    assert not cause(ImportError("no X", name="pathloom_acme")).endswith(own)
    assert cause(AttributeError("no X", obj=pl)).endswith(own)
    assert not cause(AttributeError("no X", obj=7)).endswith(own)
