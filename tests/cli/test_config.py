"""A config file: what is wrong in one, and how options and file names meet it."""

from pathlib import Path

import pytest

from .configs import ALL, EVERY_SECTION
from .conftest import moving_ai, write

WRONG = {
    "broken TOML": ("[problem\n", "no TOML: Expected ']'"),
    "no text": (b'[problem]\nmap = "\xff"\n', "no TOML: 'utf-8' codec"),
    "a nest too deep": ("a = " + "[" * 20_000, "no TOML"),
    "a number too long": ("[run]\nseed = " + "9" * 20_000, "no TOML"),
    "an unknown section": ('[planer]\nuse = "imga"\n', "planer: no such section; did you mean 'planner'?"),
    "an unknown key of problem": ('[problem]\nmpa = "x"\n', "problem.mpa: no such key; did you mean 'map'?"),
    "an unknown key of run": ("[run]\nsede = 1\n", "run.sede: no such key; did you mean 'seed'?"),
    "a section that is no table": ("planner = 3\n", "planner: found 3, allowed a table"),
    "a map that is no text": ("[problem]\nmap = 3\n", "problem.map: found 3, allowed a name or a file"),
    "a start that is no cell": ("[problem]\nstart = 3\n", "problem.start: found 3, allowed (row, column)"),
    "half a start": ("[problem]\nstart = [1.5, 2]\n", "problem.start: found [1.5, 2]"),
    "a start of three": ("[problem]\nstart = [1, 2, 3]\n", "problem.start: found [1, 2, 3]"),
    "a start outside": ("[problem]\nstart = [99, 0]\n", "problem.start: found cell 99,0 outside the map"),
    "an unknown policy": ('[problem]\ncorners = "alow"\n', "problem.corners: found 'alow'"),
    "a radius that is no number": ('[problem]\nradius = "wide"\n', "problem.radius: found 'wide'"),
    "a radius below 0": ("[problem]\nradius = -0.1\n", "problem.radius: found -0.1"),
    "world that is no truth": ('[problem]\nworld = "yes"\n', "problem.world: found 'yes', allowed true or false"),
    "unknown as a list": ("[problem]\nunknown = [1]\n", "problem.unknown: found [1]"),
    "a threshold that is no grey": ("[problem]\nthreshold = 999\n", "problem.threshold: found 999"),
    "half a threshold": ("[problem]\nthreshold = 1.5\n", "problem.threshold: found 1.5, allowed an integer"),
    "half a seed": ("[run]\nseed = 1.5\n", "run.seed is an integer in [0, inf); got 1.5"),
    "a negative seed": ("[run]\nseed = -1\n", "run.seed is an integer in [0, inf); got -1"),
    "true for a seed": ("[run]\nseed = true\n", "run.seed is an integer in [0, inf); got True"),
    "no time": ("[run]\ntime_limit = 0\n", "run.time_limit: found 0, allowed seconds above 0"),
    "a time that is no number": ("[run]\ntime_limit = nan\n", "run.time_limit: found nan"),
    "an unknown planner": ('[planner]\nuse = "imgaa"\n', "no planner is called 'imgaa'; did you mean 'imga/imga'?"),
    "an unknown slot": ('[planner]\nselektion = "roulette"\n', "planner.selektion: 'loom/loom' has no such slot"),
    "an unknown component": ('[planner]\nselection = "roulete"\n', "planner.selection: no selection is called"),
    "an unknown field": ("[planner.crossover]\nraet = 0.5\n", "planner.crossover.raet: 'shared-node' has no"),
    "a field out of range": ("[planner.crossover]\nrate = 1.5\n", "planner.crossover.rate is a number in [0, 1]"),
    "a field of another type": (
        '[planner]\npopulation = "many"\n',
        "planner.population is an integer in [1, 2147483647]",
    ),
    "an unknown objective": ("[planner.objectives]\nlenght = 1\n", "planner.objectives.lenght: no objective is called"),
    "no objective": ("[planner.objectives]\n", "planner.objectives is a table with at least one term"),
    "an unknown termination": (
        '[[planner.termination]]\nuse = "max-generatons"\n',
        "planner.termination: no termination is called 'max-generatons'; did you mean 'max-generations'?",
    ),
}


@pytest.mark.parametrize(("text", "says"), WRONG.values(), ids=WRONG)
def test_a_wrong_config_is_refused_with_file_and_key(refused, folder: Path, text, says) -> None:
    write(folder / "mine.toml", text)
    message = refused("plan", "mine.toml")
    assert message.startswith("mine.toml: ")
    assert says in message


def test_a_missing_config_is_refused_with_the_one_probably_meant(refused, folder: Path) -> None:
    write(folder / "mine.toml", "")
    assert refused("plan", "mien.toml").endswith("did you mean 'mine.toml'?")


def test_a_folder_is_no_config(refused) -> None:
    assert refused("plan", ".").startswith(".: found an unreadable file")


@pytest.mark.parametrize("name", ALL)
def test_every_good_config_is_planned(cli, folder: Path, name) -> None:
    write(folder / "mine.toml", ALL[name])
    done = cli("plan", "mine.toml", "--json")
    assert (done.code, done.err) == (0, "")
    assert done.document["status"] == "found"


def test_a_map_is_found_from_the_folder_of_the_config(cli, folder: Path) -> None:
    (folder / "sub" / "maps").mkdir(parents=True)
    write(folder / "sub" / "maps" / "small.map", moving_ai("..", ".."))
    write(folder / "sub" / "mine.toml", '[problem]\nmap = "maps/small.map"\n')
    assert cli("plan", "sub/mine.toml", "--json").document["problem"]["height"] == 2


def test_a_map_given_as_option_is_found_from_where_one_is(cli, folder: Path, ring) -> None:
    (folder / "sub").mkdir()
    write(folder / "sub" / "mine.toml", '[problem]\nmap = "gone.map"\n')
    assert cli("plan", "sub/mine.toml", "--map", ring, "--json").document["problem"]["map"] == ring


def test_a_named_map_in_a_config_is_no_file_of_its_folder(cli, folder: Path) -> None:
    (folder / "sub").mkdir()
    write(folder / "sub" / "mine.toml", '[problem]\nmap = "iga-map1"\n')
    assert cli("plan", "sub/mine.toml", "--json").document["problem"]["map"] == "iga-map1"


def test_options_go_before_what_the_config_says(cli, folder: Path) -> None:
    write(folder / "mine.toml", EVERY_SECTION)
    options = ("--seed", 8, "--start", "8,0", "--corners", "strict", "--set", "population=12", "--time-limit", 5)
    document = cli("plan", "mine.toml", *options, "--json").document
    config = document["config"]
    assert document["seed"] == 8
    assert config["problem"]["start"] == [8, 0]
    assert config["problem"]["corners"] == "strict"
    assert config["planner"]["population"] == 12
    assert config["run"]["time_limit"] == 5


def test_a_planner_given_as_option_leaves_nothing_of_the_one_in_the_config(cli, folder: Path) -> None:
    write(folder / "mine.toml", EVERY_SECTION)
    planner = cli("plan", "mine.toml", "--planner", "ga-imga", "--json").document["config"]["planner"]
    assert planner["use"] == "baselines/ga-imga"
    assert planner["population"] == 100


def test_a_fault_in_an_option_is_not_blamed_on_the_config(refused, folder: Path) -> None:
    write(folder / "mine.toml", EVERY_SECTION)
    assert refused("plan", "mine.toml", "--start", "99,0").startswith("--start: found cell 99,0")
    assert refused("plan", "mine.toml", "--planner", "imgaa").startswith("--planner: ")


def test_metres_for_one_end_do_not_turn_the_config_s_cell_for_the_other_into_metres(refused, folder: Path) -> None:
    write(folder / "mine.toml", "[problem]\nstart = [9, 0]\n")
    assert refused("plan", "mine.toml", "--world", "--goal", "1,2").startswith("--world: needs --start as well")
