"""The package as a whole: its public names, its start-up, and a folder of ours as somebody else's plugin."""

import ast
import inspect
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import pathloom as pl
import pathloom_imga


def test_every_public_name_exists_and_is_documented():
    for name in pl.__all__:
        thing = getattr(pl, name)
        if inspect.isclass(thing) or inspect.isfunction(thing) or inspect.ismodule(thing):
            assert inspect.getdoc(thing), name


def test_type_checkers_see_the_names_that_are_there():
    tree = ast.parse(inspect.getsource(pl))
    guarded = next(node for node in tree.body if isinstance(node, ast.If))
    seen = {alias.asname or alias.name for node in guarded.body for alias in node.names}
    assert seen | {"__version__"} == set(pl.__all__)


def test_the_packages_say_that_they_are_typed():
    for package in (pl, pathloom_imga):
        assert (Path(package.__file__).parent / "py.typed").exists()


def test_importing_pathloom_loads_nothing_heavy():
    code = "import sys, pathloom, pathloom.cli; print([m for m in ('numba', 'scipy', 'numpy', 'matplotlib', 'rich') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_kernel_that_cannot_be_cached_is_compiled_all_the_same(tmp_path):
    # neither beside the source nor in the user's folder can anything be written
    package = tmp_path / "site" / "pathloom"
    shutil.copytree(Path(pl.__file__).parent, package, ignore=shutil.ignore_patterns("__pycache__"))
    for folder in [package, *package.rglob("*")]:
        if folder.is_dir():
            (folder / "__pycache__").write_text("no folder")
    code = (
        "import numpy as np; from pathloom.compiled.random import below;"
        "print(below(np.ones(4, np.uint64), 1), type(below._cache).__name__)"
    )
    env = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    env |= {"PYTHONPATH": str(tmp_path / "site"), "HOME": str(tmp_path / "nowhere"), "XDG_CACHE_HOME": "/dev/null"}
    done = subprocess.run(
        [sys.executable, "-B", "-c", code], env=env, capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["0", "NullCache"]


@pytest.fixture
def copied(tmp_path):
    """Our folder of IMGA under another name, installed as a distribution of its own."""
    site = tmp_path / "site"
    shutil.copytree(
        Path(pathloom_imga.__file__).parent, site / "copied_imga", ignore=shutil.ignore_patterns("__pycache__")
    )
    for file in (site / "copied_imga").glob("*.py"):
        file.write_text(file.read_text().replace("pathloom_imga", "copied_imga"))
    info = site / "copied-1.2.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: copied\nVersion: 1.2\n")
    (info / "entry_points.txt").write_text("[pathloom]\ncopied = copied_imga\n")
    return {**os.environ, "PYTHONPATH": str(site)}


def pathloom(*arguments, env):
    return subprocess.run(
        [sys.executable, "-m", "pathloom", *arguments], env=env, capture_output=True, text=True, check=False
    )


def test_a_copy_of_our_folder_is_a_plugin(copied):
    same = ("plan", "--map", "iga-map1", "--corners", "allow", "--seed", "7", "--json")
    ours = json.loads(pathloom(*same, "--planner", "imga", env=copied).stdout)
    theirs = json.loads(pathloom(*same, "--planner", "copied/imga", env=copied).stdout)
    assert theirs["path"] == ours["path"]
    assert theirs["config"]["planner"]["use"] == "copied/imga"
    assert "copied 1.2" in pathloom("plugins", "list", env=copied).stdout
