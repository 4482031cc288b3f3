"""``--freeze`` prints a config that says everything and gives the same run again."""

import tomllib
from pathlib import Path

import pytest

from .configs import ALL, EVERY_SECTION
from .conftest import Cli, timeless, write

IMGA = ("--planner", "imga", "--set")
CHANGES = {
    "components": ("--set", "selection=roulette", "--set", "sampling=perturbed-trees"),
    "fields": ("--set", "population=24", "--set", "crossover.rate=0.5", "--set", "termination.limit=6"),
    "weights": ("--set", "objectives.length=3", "--set", "objectives.turns=2"),
    "empty slots": ("--set", "crossover=none", "--set", "mutation=none", "--set", "control.learning=none"),
    "imga": ("--planner", "imga"),
    "components of imga": (*IMGA, "selection=tournament", "--set", "sampling=perturbed-trees"),
    "fields of imga": (*IMGA, "population=24", "--set", "crossover.rate=0.5", "--set", "termination.limit=6"),
    "weights of imga": (*IMGA, "objectives.length=3", "--set", "objectives.turns=2"),
    "empty slots of imga": (*IMGA, "crossover=none", "--set", "refinement=none", "--set", "archive=none"),
    "another planner": ("--planner", "ga-imga", "--seed", "5"),
    "a problem": ("--start", "8,0", "--goal", "top-right", "--corners", "no-squeeze", "--map", "random-15:20:s4"),
    "a time": ("--planner", "imga", "--time-limit", "60"),  # an anytime planner would use it up
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
    assert frozen["planner"]["use"] == "loom/loom"
    assert frozen["planner"]["crossover"] == {"use": "shared-node", "rate": 0.9, "probability": "none"}
    assert frozen["planner"]["control"] == {
        "use": "memetic",
        "learning": {
            "use": "in-turn",
            "steps": [
                {"use": "loom/string-pulling", "sweeps": 20},
                {"use": "loom/gene-pool", "halo": 2, "room": 20000},
            ],
        },
        "polish": {"use": "loom/band-search", "radius": 2, "rounds": 5},
        "elite": 1,
    }
    assert frozen["planner"]["migration"] == "none"
    assert frozen["run"] == {"seed": 0, "time_limit": "none"}


WITH_A_TIME = {
    "the default planner goes by the clock alone": ((), ["wall-time"]),
    "unless it is told how to end": (("--set", "termination=max-generations"), ["max-generations"]),
    "others end as they always do, or before": (
        ("--planner", "imga"),
        ["max-generations", "stagnation", "wall-time"],
    ),
}


@pytest.mark.parametrize("case", WITH_A_TIME)
def test_with_a_time_limit(cli, case) -> None:
    options, terminations = WITH_A_TIME[case]
    frozen = tomllib.loads(freeze(cli, "plan", "--time-limit", "9", *options))
    assert frozen["run"]["time_limit"] == 9
    assert [t["use"] for t in frozen["planner"]["termination"]] == terminations
    if not options:
        assert frozen["planner"]["termination"] == [{"use": "wall-time", "seconds": 9.0}]


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
