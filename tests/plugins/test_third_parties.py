"""Packages of other people, built and installed as they would be: they add, and leave no trace when they go."""

import json
import os
import re
import shutil
import site
import subprocess
import sys
import venv
from pathlib import Path

import pytest

import pathloom_imga

ROOT = Path(__file__).parents[2]
HEAD = "from dataclasses import dataclass\n\nimport numpy as np\nimport pathloom as pl\n\n"

NUDGE = (
    HEAD
    + '''
@dataclass(frozen=True, kw_only=True)
class Nudge(pl.PathMutation):
    """Move one way-point to a neighbour."""

    def mutate(self, path, problem, rng):
        if len(path) < 3:
            return path
        moved = path.copy()
        moved[rng.integers(1, len(path) - 1)] += rng.integers(-1, 2, 2)
        return moved


@pl.hookimpl
def register(add):
    add(Nudge)
'''
)

MEET = (
    HEAD
    + '''from numba import njit


@njit("i4[:, ::1](i4[:, ::1], i8[:, ::1])", cache=True)
def swapped(population, pairs):
    children = population.copy()
    for k in range(pairs.shape[0]):
        a, b = pairs[k, 0], pairs[k, 1]
        for i in range(1, population.shape[1]):
            if population[a, i] < 0 or population[b, i] < 0:
                break
            if population[a, i] == population[b, i]:
                children[a, i:], children[b, i:] = population[b, i:], population[a, i:]
                break
    return children


@dataclass(frozen=True, kw_only=True)
class Meet(pl.Crossover):
    """Swap tails where two paths meet in step."""

    works_on = "cells"

    def cross(self, population, pairs, problem, rng):
        return swapped(np.ascontiguousarray(population, np.int32), np.ascontiguousarray(pairs, np.int64))


@pl.hookimpl
def register(add):
    add(Meet)
'''
)

WANDER = (
    HEAD
    + '''
@dataclass(frozen=True, kw_only=True)
class Wiggles(pl.PathObjective):
    """Number of way-points."""

    def measure_one(self, path, problem):
        return len(path)


@dataclass(frozen=True, kw_only=True)
class Wander(pl.Evolution):
    """A planner of short paths."""

    population: pl.Count = 8
    sampling: pl.Sampling = pl.part(pl.Sampling, "perturbed-trees")
    objectives: pl.Terms = pl.Terms({"length": (pl.part(pl.Objective, "length"), 1.0), "wiggles": (Wiggles(), 0.1)})
    mutation: pl.Mutation | None = pl.part(pl.Mutation, "imga/d8-gene-median")
    termination: tuple[pl.Termination, ...] = (pl.part(pl.Termination, {"use": "max-generations", "limit": 3}),)


@dataclass(frozen=True, kw_only=True)
class Yard(pl.Map):
    """A yard with one wall."""

    def grid(self, corners="strict"):
        return pl.OccupancyGrid([[row == 3 and 1 < col < 6 for col in range(8)] for row in range(7)], name=self.name)


@pl.hookimpl
def register(add):
    for component in (Wiggles, Wander, Yard):
        add(component)
'''
)

CONFIG = """
[problem]
map = "gamma/yard"

[planner]
use = "gamma/wander"
mutation = "alpha/nudge"
crossover = "beta/meet"

[planner.objectives]
length = 1.0
wiggles = { use = "gamma/wiggles", weight = 0.5 }

[run]
seed = 3
"""

STATE = """
import hashlib, json, pathlib
import pathloom as pl
from pathloom.kernel.registry import default_registry

registry = default_registry()
result = pl.plan(pl.PathProblem(pl.load_map("iga-map1"), corners="allow"), {
    "use": "imga", "population": 10, "termination": {"use": "max-generations", "limit": 3},
}, seed=5).to_dict()
del result["budget"]["phases"]
result["budget"] = {k: v for k, v in result["budget"].items() if not k.startswith("seconds")}
folder = pathlib.Path(pl.__file__).parents[1]
files = {
    str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
    for file in sorted(folder.rglob("*")) if file.is_file() and "__pycache__" not in file.parts
}
names = [entry.name for entry in registry.all_entries()]
print(json.dumps({"at": str(folder), "names": names, "broken": list(registry.broken()), "result": result, "files": files}))
"""


def project(folder: Path, name: str, source: str) -> Path:
    """Write a third party's package of one module."""
    folder.mkdir()
    (folder / "pyproject.toml").write_text(
        '[build-system]\nrequires = ["hatchling"]\nbuild-backend = "hatchling.build"\n\n'
        f'[project]\nname = "{name}-paths"\nversion = "1.0"\ndependencies = ["pathloom"]\n\n'
        f'[project.entry-points.pathloom]\n{name} = "{name}_paths"\n\n'
        f'[tool.hatch.build.targets.wheel]\nonly-include = ["{name}_paths.py"]\n'
    )
    (folder / f"{name}_paths.py").write_text(source)
    return folder


def copied(folder: Path) -> Path:
    """Copy our folder of IMGA as the guide says."""
    guide = (ROOT / "plugins" / "README.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```toml\n# copy/pyproject.toml\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    ours = Path(pathloom_imga.__file__).parent
    shutil.copytree(ours, folder / "copied_imga", ignore=shutil.ignore_patterns("__pycache__"))
    for file in (folder / "copied_imga").glob("*.py"):
        file.write_text(file.read_text(encoding="utf-8").replace("pathloom_imga", "copied_imga"), encoding="utf-8")
    (folder / "pyproject.toml").write_text(text)
    return folder


def build(*folders: Path, into: Path) -> list[Path]:
    """Build the wheels of several projects, side by side."""
    into.mkdir(exist_ok=True)  # else they race for making it
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(into)]
    running = [
        subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        for folder in folders
    ]
    for process in running:
        said, _ = process.communicate()
        assert process.returncode == 0, said
    return sorted(into.glob("*.whl"))


class Environment:
    """A fresh environment with the libraries of this one, but a pathloom of its own."""

    def __init__(self, folder: Path) -> None:
        venv.create(folder, with_pip=False)
        self.folder = folder
        self.python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
        found = self.run("-c", "import sysconfig; print(sysconfig.get_path('purelib'))")
        (Path(found.stdout.strip()) / "libraries.pth").write_text("\n".join(site.getsitepackages()))

    def run(self, *arguments: str, code: int = 0) -> subprocess.CompletedProcess[str]:
        # uncompiled: kernels at a new place would be compiled anew
        env = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "VIRTUAL_ENV")} | {
            "NUMBA_DISABLE_JIT": "1"
        }
        done = subprocess.run(
            [str(self.python), *arguments], cwd=self.folder, env=env, capture_output=True, text=True, encoding="utf-8",
            check=False,
        )  # fmt: skip
        assert done.returncode == code, done.stdout + done.stderr
        return done

    def pip(self, *arguments: str) -> None:
        command = [sys.executable, "-m", "pip", "--python", str(self.python), "--disable-pip-version-check", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr

    def install(self, *wheels: Path) -> None:
        self.pip("install", "--no-index", "--no-deps", "--no-compile", *map(str, wheels))

    def state(self) -> dict:
        return json.loads(self.run("-c", STATE).stdout)


@pytest.mark.skipif(not (ROOT / "core").is_dir(), reason="beside a wheel there are no sources to build one of")
def test_wheels_of_third_parties_are_installed_composed_ablated_and_leave_no_trace(tmp_path):
    sources = {"alpha": NUDGE, "beta": MEET, "gamma": WANDER}
    folders = [project(tmp_path / name, name, source) for name, source in sources.items()]
    wheels = build(ROOT, *folders, copied(tmp_path / "copy"), into=tmp_path / "dist")
    assert len(wheels) == 5
    ours = [wheel for wheel in wheels if wheel.name.startswith("pathloom-")]
    fresh = Environment(tmp_path / "env")
    fresh.install(*ours)
    before = fresh.state()
    assert before["at"].startswith(str(fresh.folder))
    assert before["broken"] == []

    fresh.install(*(wheel for wheel in wheels if wheel not in ours))
    config = fresh.folder / "mine.toml"
    config.write_text(CONFIG)
    composed = json.loads(fresh.run("-m", "pathloom", "plan", "mine.toml", "--json").stdout)
    assert composed["status"] == "found"
    table = composed["config"]["planner"]
    assert (table["use"], table["mutation"]["use"], table["crossover"]["use"]) == (
        "gamma/wander", "alpha/nudge", "beta/meet",
    )  # fmt: skip
    assert composed["objectives"].keys() == {"length", "wiggles"}
    copy = fresh.run("-c", STATE.replace('"use": "imga"', '"use": "copied/imga"'))
    assert json.loads(copy.stdout)["result"]["path"] == before["result"]["path"]

    ablate = ("ablate", "mine.toml", "--swap", "mutation=imga/d8-gene-median", "--maps", "gamma/yard", "--runs", "2")
    fresh.run("-m", "pathloom", *ablate, "--workers", "1", "--out", "study.db", "--quiet")
    assert (fresh.folder / "study.db").is_file()

    fresh.pip("uninstall", "-y", *(f"{name}-paths" for name in sources), "copied-imga")
    assert fresh.state() == before
    refused = fresh.run("-m", "pathloom", "plan", "mine.toml", code=2)
    assert refused.stdout == ""
    assert refused.stderr.startswith("pathloom: mine.toml: planner.use: no plugin is called 'gamma'")
    assert refused.stderr.count("\n") == 1
