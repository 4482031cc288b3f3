"""What has got a new name works on for a version, and says so."""

from dataclasses import dataclass

import pytest

import pathloom as pl
from pathloom.kernel.compose import build, override
from pathloom.kernel.plugins import Source, hookimpl
from pathloom.kernel.registry import Registry


@dataclass(frozen=True, kw_only=True)
class Shuffle(pl.Selection):
    """Choose anybody."""

    formerly = {"mix-up": "0.2"}  # noqa: RUF012
    renamed = {"number": pl.Renamed("draws", "0.3")}  # noqa: RUF012

    draws: pl.Count = 1

    def select(self, fitness, n, rng):
        return rng.integers(len(fitness), size=n)


@pytest.fixture
def registry():
    class Module:
        @staticmethod
        @hookimpl
        def register(add):
            add(Shuffle)

    return Registry([Source("acme", lambda: Module)])


def test_a_deprecated_function_works_on_and_says_what_to_use(recwarn):
    @pl.deprecated("0.2", instead="new()")
    def old(x):
        """Return x."""
        return x

    assert old.__doc__ == "Return x."
    with pytest.warns(pl.PathloomDeprecationWarning) as told:
        assert old(3) == 3
    assert str(told[0].message) == "old() is deprecated since 0.2 and will be gone in the next version; use new()"
    assert told[0].filename == __file__


@pytest.mark.parametrize("name", ["acme/mix-up", "mix-up"])
def test_a_component_is_found_by_the_name_that_it_bore(registry, name):
    with pytest.warns(
        pl.PathloomDeprecationWarning, match=rf"the name '{name}' is deprecated since 0.2.*use 'acme/shuffle'"
    ):
        assert build(pl.Selection, name, registry, "planner.selection") == Shuffle()


def test_a_name_that_nobody_bore_is_refused(registry):
    with pytest.raises(pl.ConfigError, match="no selection is called 'acme/mix-upp'"):
        build(pl.Selection, "acme/mix-upp", registry, "")


def test_a_parameter_is_found_by_the_name_that_it_bore(registry):
    with pytest.warns(
        pl.PathloomDeprecationWarning, match="number of 'acme/shuffle' is deprecated since 0.3.*use 'draws'"
    ):
        assert build(pl.Selection, {"use": "acme/shuffle", "number": 4}, registry, "") == Shuffle(draws=4)
    with pytest.warns(pl.PathloomDeprecationWarning):
        assert override(Shuffle(), "number", 5, registry) == Shuffle(draws=5)


def test_a_name_of_the_package_is_found_after_it_was_renamed(monkeypatch):
    monkeypatch.setitem(pl._RENAMED, "blueprint", ("plan", "0.2"))
    with pytest.warns(pl.PathloomDeprecationWarning, match="pathloom.blueprint is deprecated since 0.2") as told:
        assert pl.blueprint is pl.plan
    assert told[0].filename == __file__
