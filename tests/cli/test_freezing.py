"""``--freeze`` prints a config that says everything and gives the same run again."""

import tomllib
from pathlib import Path

import pytest

from .configs import ALL, EVERY_SECTION
from .conftest import Cli, timeless, write

CHANGES = {
    "components": ("--set", "selection=tournament", "--set", "sampling=perturbed-trees"),
    "fields": ("--set", "population=24", "--set", "crossover.rate=0.5", "--set", "termination.limit=6"),
    "weights": ("--set", "objectives.length=3", "--set", "objectives.turns=2"),
    "empty slots": ("--set", "crossover=none", "--set", "refinement=none", "--set", "archive=none"),
    "another planner": ("--planner", "ga-imga", "--seed", "5"),
    "a problem": ("--start", "8,0", "--goal", "top-right", "--corners", "no-squeeze", "--map", "random-15:20:s4"),
    "a time": ("--time-limit", "60"),
}
RUNS: dict[str, tuple[str, tuple[str, ...]]] = {
    **{name: (text, ()) for name, text in ALL.items()},
    **{f"--set of {name}": ("", options) for name, options in CHANGES.items()},
    "every section and a change": (EVERY_SECTION, ("--set", "mutation=none", "--seed", "3")),
}


@pytest.fixture(params=RUNS)
def run(request: pytest.FixtureRequest, folder: Path) -> tuple[str, ...]:
    text, options = RUNS[request.param]
    write(folder / "mine.toml", text)
    return ("plan", "mine.toml", *options)


def freeze(cli: Cli, *run: str) -> str:
    done = cli(*run, "--freeze")
    assert (done.code, done.err) == (0, "")
    return done.out


def test_a_frozen_config_gives_the_same_run(cli, folder: Path, run) -> None:
    write(folder / "frozen.toml", freeze(cli, *run))
    assert timeless(cli("plan", "frozen.toml", "--json").document) == timeless(cli(*run, "--json").document)


def test_freezing_what_is_frozen_changes_nothing(cli, folder: Path, run) -> None:
    frozen = freeze(cli, *run)
    write(folder / "frozen.toml", frozen)
    assert freeze(cli, "plan", "frozen.toml") == frozen


def test_the_json_of_a_run_holds_the_frozen_config(cli, run) -> None:
    frozen = tomllib.loads(freeze(cli, *run))
    config = cli(*run, "--json").document["config"]
    assert config["planner"] == frozen["planner"]
    assert config["run"] == frozen["run"]
    assert config["problem"].items() <= frozen["problem"].items()


def test_a_frozen_config_names_every_default(cli) -> None:
    frozen = tomllib.loads(freeze(cli, "plan"))
    assert frozen["problem"] == {
        "map": "blocks-30:25%",
        "start": [29, 0],
        "goal": [0, 29],
        "corners": "strict",
        "radius": 0.0,
        "unknown": "occupied",
    }
    assert frozen["planner"]["crossover"] == {
        "use": "imga/common-node",
        "rate": 0.8,
        "probability": "none",
        "loops": False,
    }
    assert frozen["planner"]["migration"] == "none"
    assert frozen["run"] == {"seed": 0, "time_limit": "none"}


def test_a_frozen_config_finds_its_map_from_any_folder(cli, folder: Path, ring) -> None:
    frozen = freeze(cli, "plan", "--map", ring)
    (folder / "elsewhere").mkdir()
    write(folder / "elsewhere" / "frozen.toml", frozen)
    assert cli("plan", "elsewhere/frozen.toml").code == 0


def test_freezing_keeps_how_a_file_is_read(cli, folder: Path) -> None:
    write(folder / "grey.pgm", b"P2\n2 2\n255\n90 90 90 200\n")
    options = ("--map", "grey.pgm", "--threshold", "80", "--unknown", "free")
    write(folder / "frozen.toml", freeze(cli, "plan", *options))
    again, once = cli("plan", "frozen.toml", "--json"), cli("plan", *options, "--json")
    assert again.document["problem"]["map_sha256"] == once.document["problem"]["map_sha256"]
