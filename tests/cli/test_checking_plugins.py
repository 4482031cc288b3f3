"""``pathloom plugins check``, and the same as tests of pytest: a package of somebody else against the contract."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import Outcome
from .distributions import distribution

HEAD = """
from dataclasses import dataclass

import pathloom as pl

"""
COUNT = """
@dataclass(frozen=True, kw_only=True)
class Count(pl.PathObjective):
    '''Number of cells that the path names.'''

    def measure_one(self, path, problem):
        return float(len(path))

"""
SPOILER = """
@dataclass(frozen=True, kw_only=True)
class Spoiler(pl.Selection):
    '''Take the first ones, and spoil the fitness.'''

    def select(self, fitness, n, rng):
        print('spoiling')
        fitness[0] = 0.0
        return rng.integers(len(fitness), size=n)

"""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two plugins of one distribution, of which one keeps its promises, and a broken one."""
    site = tmp_path_factory.mktemp("site")
    register = "@pl.hookimpl\ndef register(add):\n    add({})\n"
    modules = {
        "m_good": HEAD + COUNT + register.format("Count"),
        "m_bad": HEAD + SPOILER + register.format("Spoiler"),
    }
    distribution(site, "Acme_Parts", version="2.5", points={"good": "m_good", "bad": "m_bad"}, modules=modules)
    distribution(site, "acme-none", points={"none": "m_none"}, modules={"m_none": "import no_such_module\n"})
    return site


def run(site: Path, *args: str, module: str = "pathloom", folder: Path | None = None) -> Outcome:
    environment = {**os.environ, "PYTHONPATH": str(site)}
    done = subprocess.run(
        [sys.executable, "-m", module, *args],
        capture_output=True,
        text=True,
        encoding="utf-8",
        env=environment,
        timeout=120,
        check=False,
        cwd=folder,
    )
    return Outcome(done.returncode, done.stdout, done.stderr)


def test_a_plugin_that_keeps_its_promises_is_shown_with_their_number_and_the_code_is_0(cli) -> None:
    done = cli("plugins", "check", "maps", "--quiet")
    assert (done.code, done.err) == (0, "")
    (row,) = (line for line in done.out.splitlines() if "maps/maze" in line)
    kind, name, kept = row.split()
    assert (kind, name) == ("map", "maps/maze")
    assert int(kept) > 10


def test_without_a_name_all_plugins_of_others_are_checked_and_what_is_broken_is_said_of_each(site: Path) -> None:
    done = run(site, "plugins", "check", "--json", "--quiet")
    assert done.code == 2
    assert done.err.startswith("pathloom: plugin 'none' (acme-none 1.0): does not import: ModuleNotFoundError")
    assert done.document["schema"] == "pathloom.check/1"
    assert list(done.document["broken"]) == ["none"]
    broken = {row["check"]: row for row in done.document["checks"] if row["found"] == "broken"}
    assert set(broken) == {"inputs-kept", "silent"}
    assert {row["name"] for row in done.document["checks"]} == {"good/count", "bad/spoiler"}
    spoiled = broken["inputs-kept"]
    assert spoiled["plugin"] == "plugin 'bad' (Acme_Parts 2.5)"
    assert spoiled["message"] == "expected its inputs as they were; found input 1 changed of 1 individuals"
    assert spoiled["promise"].startswith("Populations, states, problems")


def test_a_distribution_stands_for_all_its_plugins_and_the_message_names_plugin_version_and_cause(site: Path) -> None:
    done = run(site, "plugins", "check", "acme.parts", "--quiet")
    assert done.code == 2
    assert done.err == (
        "pathloom: plugin 'bad' (Acme_Parts 2.5): selection 'bad/spoiler' breaks 'inputs-kept', and 1 more: "
        "expected its inputs as they were; found input 1 changed of 1 individuals\n"
    )
    assert "good/count" in done.out
    assert "broken: bad/spoiler, silent: It prints nothing on standard output" in done.out


def test_an_unknown_package_is_refused_with_the_one_probably_meant(refused) -> None:
    assert "no plugin and no package with plugins is called 'imgaa'; did you mean 'imga'?" in refused(
        "plugins", "check", "imgaa"
    )


def test_pytest_makes_one_test_of_each_promise(site: Path, tmp_path: Path) -> None:
    (tmp_path / "pyproject.toml").write_text('[tool.pytest.ini_options]\npathloom = "bad"\n')
    (tmp_path / "test_contract.py").write_text("def test_the_contract(promise):\n    promise()\n")
    words = ("-q", "-p", "pathloom.testing.pytest", "-p", "no:cacheprovider", "-k", "silent or shape or inputs-kept")
    done = run(site, *words, module="pytest", folder=tmp_path)
    assert done.code == 1
    assert "2 failed, 1 passed" in done.out
    assert "FAILED test_contract.py::test_the_contract[selection:bad/spoiler:silent]" in done.out
    other = run(site, *words, "--pathloom", "good", module="pytest", folder=tmp_path)
    assert other.code == 0
    assert "3 passed" in other.out
