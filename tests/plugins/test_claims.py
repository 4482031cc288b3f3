"""The tables of claims on the plugins' pages: every claim stands there, and a short trial gives the same verdict."""

from pathlib import Path

import pytest

from pathloom.claims import NEEDS_DATA, Bench, claims_of
from pathloom.errors import ConfigError

PAGES = Path(__file__).parents[2] / "plugins"
HEAD = "| where | the paper says | we measure | verdict |"
CLAIMING = ("agacd", "imga", "imaga", "iga", "hga-aco")


def printed(plugin):
    """The verdict that a plugin's page gives on each statement."""
    page = (PAGES / f"pathloom_{plugin.replace('-', '_')}" / "README.md").read_text(encoding="utf-8")
    assert page.count(HEAD) == 1
    rows = {}
    for line in page.split(HEAD)[1].splitlines()[2:]:
        if not line.startswith("|"):
            break
        place, says, _, verdict = (cell.strip() for cell in line.strip("|").split(" | "))
        assert (place, says) not in rows
        rows[place, says] = verdict
    return rows


@pytest.fixture(scope="module")
def bench():
    return Bench(full=False)


def test_every_paper_has_claims():
    for plugin in CLAIMING:
        assert list(claims_of(plugin))
    with pytest.raises(ConfigError):
        list(claims_of("maps"))


@pytest.mark.parametrize("plugin", CLAIMING)
def test_a_short_trial_gives_the_verdicts_that_the_page_prints(plugin, bench):
    page, found = printed(plugin), []
    for _, claim in claims_of(plugin):
        for finding in claim.examine(bench):
            found.append((finding.place, finding.says))
            if finding.timed or finding.measured == NEEDS_DATA:
                continue
            assert finding.verdict == page[finding.place, finding.says], (finding, page[finding.place, finding.says])
    assert found == list(page)
