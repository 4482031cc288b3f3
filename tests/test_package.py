"""The package as a whole: its public names and its start-up."""

import ast
import inspect
import os
import shutil
import subprocess
import sys
from pathlib import Path

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
