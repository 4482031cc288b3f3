"""Every check finds what it is for: a component that breaks one promise breaks no other."""

from pathlib import Path

import pytest

from pathloom.testing import CHECKS, Broken, Inapplicable, checks_for
from pathloom.testing.contract import MADE

from .broken import BROKEN, Careless, Wheel


def broken(component):
    """Return the promises that a component breaks, with what was found."""
    found = {}
    for tried, check in checks_for(component):
        try:
            check(tried)
        except Inapplicable:
            continue
        except Broken as error:
            found[check.name] = str(error)
    return found


@pytest.mark.parametrize("component", BROKEN, ids=lambda c: c.name)
def test_a_component_that_breaks_one_promise_breaks_no_other(component) -> None:
    found = broken(component)
    assert list(found) == [component.name]
    assert found[component.name].startswith("expected ")
    assert "found" in found[component.name]


def test_the_guide_names_every_promise() -> None:
    guide = (Path(__file__).parents[2] / "plugins" / "README.md").read_text(encoding="utf-8")
    for check in (MADE, *CHECKS):
        assert f"| `{check.name}` | {check.promise} |\n" in guide


def test_there_is_one_for_every_check() -> None:
    assert {component.name for component in BROKEN} == {"made", *(check.name for check in CHECKS)}


@pytest.mark.parametrize("component", [Wheel, Careless], ids=lambda c: c.name)
def test_what_they_are_made_of_breaks_none(component) -> None:
    assert broken(component) == {}
