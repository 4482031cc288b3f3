"""``pathloom plugins new``: a package that installs, passes and is clean as it is."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

FILES = {
    ".github/workflows/tests.yml", ".gitignore", "README.md", "pyproject.toml",
    "src/pathloom_my_acme/__init__.py", "src/pathloom_my_acme/kernels.py", "src/pathloom_my_acme/nudge.py",
    "src/pathloom_my_acme/py.typed", "src/pathloom_my_acme/swap_tails.py",
    "tests/test_contract.py", "tests/test_kernels.py", "tests/test_planning.py",
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("Acme", "did you mean 'acme'?"),
        ("my_acme", "did you mean 'my-acme'?"),
        ("my--acme", "did you mean 'my-acme'?"),
        ("7up", "a letter first"),
        ("", "a letter first"),
        ("../acme", "did you mean 'acme'?"),
        ("pathloom-acme", "did you mean 'acme'?"),
        ("imga", "it is that of plugin 'imga' (pathloom "),
        ("core", "it is that of plugin 'core' (pathloom "),
        ("a" * 31, "found 31 letters, allowed 30"),
    ],
)
def test_a_name_that_no_plugin_can_have_is_refused_in_one_line(refused, name, hint) -> None:
    message = refused("plugins", "new", name)
    assert message.startswith("NAME: found ")
    assert hint in message


def test_a_folder_that_is_there_already_stays_as_it_is(refused, folder: Path) -> None:
    (folder / "acme").mkdir()
    (folder / "acme" / "mine.txt").write_text("mine")
    assert refused("plugins", "new", "acme").startswith("acme: found what is there already, allowed a new folder")


def test_a_place_that_is_not_there_is_told_in_one_line(refused) -> None:
    assert "found no such folder" in refused("plugins", "new", "acme", "--into", "nowhere")


def test_the_files_are_listed(cli, folder: Path) -> None:
    document = cli("plugins", "new", "my-acme", "--json").document
    assert set(document["files"]) == FILES
    assert {
        file.relative_to(folder / "my-acme").as_posix() for file in (folder / "my-acme").rglob("*.*") if file.is_file()
    } == FILES
    assert not [file for file in document["files"] if "<<" in (folder / "my-acme" / file).read_text(encoding="utf-8")]


def test_the_longest_name_leaves_the_package_clean(cli, folder: Path) -> None:
    if importlib.util.find_spec("ruff") is None:
        pytest.skip("ruff is not installed")
    assert cli("plugins", "new", "abcdefghi-abcdefghij-abcdefghi").code == 0
    for words in (("check",), ("format", "--check")):
        done = subprocess.run(
            [sys.executable, "-m", "ruff", *words, "."], cwd=folder, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout


def test_the_package_installs_passes_its_tests_and_is_clean(cli, folder: Path, tmp_path: Path) -> None:
    for tool in ("hatchling", "pip"):
        if importlib.util.find_spec(tool) is None:
            pytest.skip(f"{tool} is not installed: it builds and installs packages")
    assert cli("plugins", "new", "my-acme").code == 0
    site = tmp_path / "site"
    env = {**os.environ, "PYTHONPATH": str(site)}
    install = ("pip", "install", "-q", "--no-deps", "--no-index", "--no-build-isolation", "--target", str(site), ".")
    checks = [install, ("pytest",), ("ruff", "check", "."), ("ruff", "format", "--check", "."), ("mypy",)]
    running = {}
    for words in checks:
        if importlib.util.find_spec(words[0]) is not None:  # where only the wheel is tested there are no linters
            running[words] = subprocess.Popen(
                [sys.executable, "-m", *words],
                cwd=folder / "my-acme", env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            )  # fmt: skip
            if words is install:
                running[words].wait()
    said = {words: process.communicate()[0] for words, process in running.items()}
    failed = {words: said[words] for words, process in running.items() if process.returncode}
    assert not failed, "\n".join(f"{' '.join(words)}\n{text}" for words, text in failed.items())
