"""Plugins of other people: a broken one is listed with its cause and costs only itself."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import pathloom as pl

from .conftest import Outcome, one_line, timeless
from .distributions import distribution

HEAD = """
from abc import abstractmethod
from dataclasses import dataclass

import pathloom as pl

"""
JITTER = """
@dataclass(frozen=True, kw_only=True)
class Jitter(pl.PathMutation):
    '''Leave everything as it is.'''

    reach: int = 1

    def mutate(self, path, problem, rng):
        return path

"""
REGISTER = """
@pl.hookimpl
def register(add):
    add(Jitter)
"""
MARK = "import os, sys\nif 'MARK' in os.environ:\n    print('imported', __name__, file=sys.stderr)\n"
"""Tells of the import, where a test wants to know."""

BROKEN = {
    "absent": ("import no_such_module_anywhere\n", "does not import: ModuleNotFoundError: No module named"),
    "quitter": ("raise SystemExit(7)\n", "does not import: SystemExit: 7"),
    "typo": ("def register(add:\n", "does not import: SyntaxError"),
    "thawed": (
        HEAD + JITTER.replace("frozen=True, ", "frozen=False, ") + REGISTER,
        "cannot inherit non-frozen dataclass from a frozen one",
    ),
    "half": (
        HEAD + JITTER.replace("def mutate", "def mutter") + REGISTER,
        "registers Jitter, which lacks mutate",
    ),
    "twice": (
        f"{HEAD}{JITTER}{REGISTER}    add(Jitter)\n",
        "registers two components of kind 'mutation' called 'jitter'",
    ),
    "kindless": (
        f"{HEAD}@dataclass(frozen=True)\nclass Jitter(pl.Component):\n    pass\n{REGISTER}",
        "registers Jitter, which has no kind",
    ),
    "stranger": (f"{HEAD}class Jitter:\n    pass\n{REGISTER}", "registers Jitter, which inherits from no kind"),
    "hookless": (f"{HEAD}{JITTER}", "has no function `register` marked with `pathloom.hookimpl`"),
    "misnamed": (f"{HEAD}{JITTER}{REGISTER.replace('def register', 'def regster')}", "regster"),
    "object": (f"{HEAD}{JITTER}{REGISTER.replace('Jitter', 'Jitter()')}", "which is no class: register Jitter"),
    "torn": (
        HEAD + JITTER.replace("    reach", "    kind = 'selection'\n    reach") + REGISTER,
        "registers Jitter, which is of several kinds: selection, mutation",
    ),
    "vague": (
        HEAD + JITTER.replace("reach: int", "reach: 'Reach'") + REGISTER,
        "registers Jitter, whose fields cannot be read: NameError: name 'Reach' is not defined",
    ),
    "ahead": (
        "from pathloom import Teleport\n",
        f"cannot import name 'Teleport' from 'pathloom' ({pl.__file__}); pathloom {pl.__version__} has no such name",
    ),
    "ahead-too": ("import pathloom\npathloom.Teleport\n", f"; pathloom {pl.__version__} has no such name"),
    "deeper": ("import pathloom.teleport\n", f"; pathloom {pl.__version__} has no such name"),
    "future": ("print('imported')\n", f"is built for pathloom >=99; installed is {pl.__version__}"),
    "thrower": (f"{HEAD}@pl.hookimpl\ndef register(add):\n    raise KeyError('no luck')\n", "no luck"),
}


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with broken plugins, two of one name, one that claims our name, and one that works."""
    site = tmp_path_factory.mktemp("site")
    for name, (source, _) in BROKEN.items():
        module = f"m_{name.replace('-', '_')}"
        requires = ["numpy", "pathloom>=99" if name == "future" else "pathloom>=0", "pathloom>=98; python_version<'3'"]
        distribution(
            site, f"acme-{name}", version="2.5", points={name: module}, modules={module: source}, requires=requires
        )
    distribution(site, "acme", points={"acme": "acme_parts"}, modules={"acme_parts": MARK + HEAD + JITTER + REGISTER})
    for name in ("left-twin", "right-twin"):
        module = name.replace("-", "_")
        distribution(site, name, points={"twin": module}, modules={module: HEAD + JITTER + REGISTER})
    distribution(site, "impostor", points={"imga": "impostor"}, modules={"impostor": MARK + HEAD + JITTER + REGISTER})
    return site


def run(site: Path | None, *args: str, mark: bool = False, **more: str) -> Outcome:
    environment = {**os.environ, **({"MARK": "1"} if mark else {}), **({"PYTHONPATH": str(site)} if site else {})}
    environment |= more
    done = subprocess.run(
        [sys.executable, "-m", "pathloom", *args],
        capture_output=True,
        text=True,
        encoding="utf-8",
        env=environment,
        timeout=60,
        check=False,
    )
    return Outcome(done.returncode, done.stdout, done.stderr)


@pytest.fixture(scope="module")
def listed(site: Path) -> Outcome:
    return run(site, "plugins", "list", "--json", mark=True)


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_plugin_is_listed_with_distribution_version_and_cause(listed, name) -> None:
    cause = listed.document["broken"][name]
    assert cause.startswith(f"plugin '{name}' (acme-{name} 2.5): ")
    assert BROKEN[name][1] in cause
    assert "\n" not in cause


def test_two_plugins_of_one_name_are_both_named_and_neither_works(listed) -> None:
    cause = listed.document["broken"]["twin"]
    assert cause == "plugin name 'twin' is claimed twice: by left-twin 1.0 and right-twin 1.0; uninstall one"
    assert not [row for row in listed.document["components"] if row["plugin"] == "twin"]


def test_who_claims_our_name_loses_and_ours_goes_on_working(listed, site: Path) -> None:
    assert "pathloom" in listed.document["broken"]["imga of impostor"]
    assert "impostor 1.0" in listed.document["broken"]["imga of impostor"]
    names = [row["name"] for row in listed.document["components"]]
    assert "imga/imga" in names
    assert "imga/jitter" not in names
    assert "imported impostor" not in listed.err


def test_a_plugin_that_works_is_listed_beside_broken_ones(listed) -> None:
    (row,) = (row for row in listed.document["components"] if row["plugin"] == "acme")
    assert (row["name"], row["kind"], row["distribution"]) == ("acme/jitter", "mutation", "acme 1.0")


def test_the_table_shows_broken_plugins_too(site: Path) -> None:
    done = run(site, "plugins", "list")
    assert done.code == 0
    assert "broken: plugin 'absent' (acme-absent 2.5): does not import" in done.out


@pytest.mark.parametrize(
    "words",
    [
        ("plan", "--set", "mutation=quitter/jitter"),
        ("plan", "--set", "mutation=twin/jitter"),
        ("plan", "--planner", "absent/planner"),
        ("plugins", "show", "half"),
    ],
    ids=" ".join,
)
def test_who_names_a_broken_plugin_gets_its_cause_in_one_line(site: Path, words) -> None:
    message = one_line(run(site, *words), code=2)
    name = words[-1].partition("=")[2].partition("/")[0] or words[-1].partition("/")[0]
    assert f"'{name}'" in message
    assert "2.5" in message or "left-twin 1.0 and right-twin 1.0" in message


def test_installed_plugins_that_nobody_names_change_nothing_and_are_not_imported(site: Path) -> None:
    words = ("plan", "--map", "random-12:20", "--set", "selection=roulette", "--json")
    with_them, without = run(site, *words, mark=True), run(None, *words)
    assert with_them.err == ""
    assert timeless(with_them.document) == timeless(without.document)


def test_the_name_of_a_map_of_ours_imports_no_plugin_of_others(site: Path) -> None:
    assert run(site, "maps", "show", "iga-map1", mark=True).err == ""


def test_a_component_without_decorator_of_its_own_is_refused(tmp_path: Path) -> None:
    source = HEAD + JITTER.replace("@dataclass(frozen=True, kw_only=True)\n", "") + REGISTER
    distribution(tmp_path, "acme", points={"acme": "acme_parts"}, modules={"acme_parts": source})
    broken = run(tmp_path, "plugins", "list", "--json").document["broken"]
    assert "registers Jitter, which is not a frozen dataclass" in broken["acme"]


def test_a_bare_name_that_nobody_of_ours_bears_is_looked_for_in_other_plugins(site: Path) -> None:
    done = run(
        site,
        "plan",
        "--map",
        "random-12:20",
        "--set",
        "mutation=jitter",
        "--set",
        "mutation.reach=2",
        "--json",
        mark=True,
    )
    assert done.code == 0
    chosen = done.document["config"]["planner"]["mutation"]
    assert (chosen["use"], chosen["reach"]) == ("acme/jitter", 2)
    assert "imported acme_parts" in done.err


def test_the_schema_knows_the_parts_of_others(site: Path) -> None:
    done = run(site, "plugins", "schema")
    assert done.code == 0
    assert "mutation:acme.jitter" in done.document["$defs"]


def test_a_part_of_another_is_shown_with_its_parameters(site: Path) -> None:
    shown = run(site, "plugins", "show", "acme/jitter").out
    assert shown.startswith("acme/jitter, mutation, plugin 'acme' (acme 1.0)\nLeave everything as it is.\n")
    assert "reach" in shown


@pytest.fixture(scope="module")
def slow_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a plugin whose import does not end, and one that prints when it is imported and when it is used."""
    site = tmp_path_factory.mktemp("slow-site")
    stuck = "import time\nprint('before')\ntime.sleep(1000)\n"
    talker = "print('hello\\nthere')\n" + HEAD + JITTER.replace("return", "print('moving'); return") + REGISTER
    for name, source in (("stuck", stuck), ("talker", talker)):
        distribution(site, f"acme-{name}", version="2.5", points={name: f"m_{name}"}, modules={f"m_{name}": source})
    return site


def test_a_plugin_whose_import_does_not_end_is_given_up_and_one_that_prints_is_remarked(slow_site: Path) -> None:
    document = run(slow_site, "plugins", "list", "--json", PATHLOOM_PLUGIN_SECONDS="1.5").document
    cause = document["broken"]["stuck"]
    assert cause.startswith("plugin 'stuck' (acme-stuck 2.5): is still not imported after 1.5 s, at ")
    assert "m_stuck.py:3: time.sleep(1000)" in cause
    assert document["remarks"] == ["plugin 'talker' (acme-talker 2.5): prints when it is imported: 'hello\\nthere\\n'"]
    assert "talker/jitter" in {row["name"] for row in document["components"]}


def test_what_a_plugin_prints_when_it_is_imported_or_used_does_not_reach_the_document(slow_site: Path) -> None:
    words = ("plan", "--map", "random-12:20", "--json", "--planner", "imga", "--set", "mutation=talker/jitter")
    told = run(slow_site, *words)
    assert told.document["status"] == "found"
    first, *others = told.err.splitlines()
    assert first == "pathloom: plugin 'talker' (acme-talker 2.5): prints when it is imported: 'hello\\nthere\\n'"
    assert set(others) == {"moving"}
