"""An option that cannot be used costs one line, and nothing is planned or written."""

import shlex
from pathlib import Path

import pytest

from .conftest import moving_ai, one_line, write

PROBLEM = {
    "--start 1,1": "--start: cell 1,1 is an obstacle; the nearest free cell is 0,1",
    "--goal 1,1": "--goal: cell 1,1 is an obstacle; the nearest free cell is 0,1",
    "--start 3,0": "--start: found cell 3,0 outside the map, allowed rows 0 to 2 and columns 0 to 2",
    "--start -1,0": "--start: found cell -1,0 outside the map",
    "--start abc": "--start: found 'abc', allowed ROW,COL or a corner",
    "--start 1": "--start: found '1', allowed ROW,COL",
    "--start 1,2,3": "--start: found '1,2,3', allowed ROW,COL",
    "--start 1.5,2": "--start: found '1.5,2', allowed ROW,COL",
    "--start ''": "--start: found '', allowed ROW,COL",
    "--goal botom-left": "--goal: found 'botom-left', allowed ROW,COL or a corner; did you mean 'bottom-left'?",
    "--world --start a,b": "--start: found 'a,b', allowed X,Y in metres",
    "--world --start 1,1": "--start: ring.map: found no origin",
    "--corners strickt": "--corners: found 'strickt', allowed strict, no-squeeze, allow; did you mean 'strict'?",
    "--radius 9": "start: cell 2,0 is closed, as is every cell of the map",
    "--radius nan": "--radius: found nan, allowed a number in [0, inf)",
    "--radius inf": "--radius: found inf",
    "--radius -1": "--radius: found -1.0",
    "--radius wide": "'--radius': 'wide' is not a valid float",
    "--unknown fre": "--unknown: found 'fre', allowed 'occupied' or 'free'",
    "--threshold 256": "'--threshold': 256 is not in the range",
    "--threshold -1": "'--threshold': -1 is not in the range",
    "--seed -1": "seed is an integer in [0, inf); got -1",
    "--seed 1.5": "'--seed': '1.5' is not a valid integer",
    "--seed one": "'--seed': 'one' is not a valid integer",
    "--time-limit 0": "--time-limit: found 0.0, allowed seconds above 0",
    "--time-limit -1": "--time-limit: found -1.0, allowed seconds above 0",
    "--time-limit nan": "--time-limit: found nan, allowed seconds above 0",
    "--case 1": "--case: needs --scenario FILE",
    "--sed 3": "No such option '--sed'",
    "one.toml two.toml": "unexpected extra argument (two.toml)",
}


@pytest.mark.parametrize("options", PROBLEM)
def test_a_bad_option_is_refused_with_its_name(refused, ring, options) -> None:
    assert PROBLEM[options] in refused("plan", "--map", ring, *shlex.split(options))


def test_a_start_that_the_radius_swallows_is_refused_with_the_radius_and_a_free_cell(refused, folder: Path) -> None:
    write(folder / "corner.map", moving_ai("....", "....", "....", ".@.."))
    message = refused("plan", "--map", "corner.map", "--radius", 1)
    assert message == "start: cell 3,0 is closer to an obstacle than the radius 1 cells; the nearest free cell is 1,0"


def test_a_map_without_a_name_is_refused(refused) -> None:
    assert "no map and no file is called so" in refused("plan", "--map", "")


def test_start_and_goal_in_one_cell_are_a_path_of_length_0(cli, ring) -> None:
    done = cli("plan", "--map", ring, "--start", "0,0", "--goal", "0,0", "--optimum", "--json")
    assert (done.code, done.err) == (0, "")
    assert done.document["path"] == [[0, 0]]
    assert done.document["metrics"]["length"] == 0.0
    assert done.document["gap"] == {"grid": 0.0, "any_angle": 0.0, "any_angle_bound": 0.0}


PLANNER = {
    "--planner imgaa": "--planner: no planner is called 'imgaa'; did you mean 'imga/imga'?",
    "--planner agac/imga": "no plugin is called 'agac'; did you mean 'agacd'?",
    "--planner roulette": "'roulette' is a selection, not a planner",
    "--set selektion=roulette": "'loom/loom' has no such slot or parameter; did you mean 'selection'?",
    "--set selection=roulete": "no selection is called 'roulete'; did you mean 'roulette'?",
    "--set selection=imga/three-leyer": "did you mean 'imga/three-layer'?",
    "--set selection=none": "no selection is called 'none'",
    "--set sampling=roulette": "'roulette' is a selection, not a sampling",
    "--set crossover.raet=1": "'shared-node' has no such parameter; did you mean 'rate'?",
    "--set crossover.rate=1.5": "rate is a number in [0, 1]; got 1.5",
    "--set crossover.rate=abc": "rate is a number in [0, 1]; got 'abc'",
    "--set crossover.rate=nan": "rate is a number in [0, 1]; got nan",
    "--set population=0": "population is an integer in [1, 2147483647]; got 0",
    "--set population=1.5": "population is an integer in [1, 2147483647]; got 1.5",
    "--set population=true": "population is an integer in [1, 2147483647]; got True",
    "--set population.size=3": "has no field 'size'",
    "--set objectives.length=-1": "weight is a number in [0, inf); got -1",
    "--set objectives.length=nan": "weight is a number in [0, inf); got nan",
    "--set objectives.lenght=1": "no objective is called 'lenght'; did you mean 'length'?",
    "--set objectives=none": "objectives are a table of terms; got 'none'",
    "--set termination.max-generatons.limit=5": "did you mean 'max-generations'?",
    "--set termination.limit=0": "limit is an integer in [1, 2147483647]; got 0",
    "--set termination.9.limit=1": "has 2 members, counted from 0; got 9",
    "--set selection": "--set selection: found no SLOT or no '='",
    "--set =roulette": "--set =roulette: found no SLOT or no '='",
    "--set selection.=1": "--set selection.=1: found no SLOT or no '='",
    "--set population=" + "9" * 5000: "population is an integer in [1, 2147483647]; got '999",
}


@pytest.mark.parametrize("options", PLANNER, ids=lambda text: text[:50])
def test_a_bad_planner_or_part_is_refused_with_what_was_probably_meant(refused, options) -> None:
    message = refused("plan", *shlex.split(options))
    assert message.startswith((options.split()[0], "no plugin"))
    assert PLANNER[options] in message


FILES = {
    "--out gone/a.json": "gone/a.json: the folder 'gone' does not exist or is not writable",
    "--out ring.map/a.json": "ring.map/a.json: the folder 'ring.map' does not exist",
    "--out .": ".: is a folder",
    "--out ''": "--out: found no name, allowed a file",
    "--plot gone/a.png": "gone/a.png: the folder 'gone' does not exist",
    "--plot a.bmp": "--plot: found the suffix '.bmp', allowed .png .svg .pdf .gif .mp4",
    "--plot picture": "--plot: found the suffix ''",
    "--export gone/a.csv": "gone/a.csv: the folder 'gone' does not exist",
    "--export a.txt": "--export: found the suffix '.txt', allowed .csv .json",
}


@pytest.mark.parametrize("options", FILES)
def test_a_file_that_could_not_be_written_is_refused_before_planning(refused, ring, monkeypatch, options) -> None:
    monkeypatch.setattr("pathloom.planning.plan", lambda *_args, **_keywords: pytest.fail("it was planned"))
    assert refused("plan", "--map", ring, *shlex.split(options)).startswith(FILES[options])


def test_a_folder_without_leave_to_write_is_refused_before_planning(refused, ring, monkeypatch) -> None:
    monkeypatch.setattr("os.access", lambda *_args: False)
    assert "is not writable" in refused("plan", "--map", ring, "--out", "a.json")


COMMANDS = {
    "plna": "no command is called 'plna'; did you mean 'plan'?",
    "--bogus": "No such option '--bogus'",
    "maps lsit": "maps: no command is called 'lsit'; did you mean 'list'?",
    "plugins shwo imga": "plugins: no command is called 'shwo'; did you mean 'show'?",
    "plugins show": "plugins show: Missing argument 'NAME'",
    "plan --set": "Option '--set' requires an argument",
}


@pytest.mark.parametrize("words", COMMANDS)
def test_an_unknown_command_or_option_is_refused_in_one_line(refused, words) -> None:
    assert COMMANDS[words] in refused(*words.split())


@pytest.mark.parametrize("words", ["", "maps", "plugins"])
def test_a_group_called_alone_shows_its_help(cli, words) -> None:
    done = cli(*words.split())
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("Usage: pathloom")


def test_a_lack_of_memory_is_no_defect(cli, monkeypatch) -> None:
    def greedy(*_args, **_keywords):
        raise MemoryError("Unable to allocate 74.5 GiB")

    monkeypatch.setattr("pathloom.planning.plan", greedy)
    assert "found too little memory" in one_line(cli("plan"), code=2)


def test_a_defect_of_ours_is_one_line_that_says_so(cli, monkeypatch) -> None:
    def broken(*_args, **_keywords):
        raise ZeroDivisionError("by accident")

    monkeypatch.setattr("pathloom.planning.plan", broken)
    assert one_line(cli("plan"), code=1).startswith("a defect, please report it: ZeroDivisionError: by accident")


def test_an_interrupt_within_a_compiled_kernel_is_no_defect(cli, monkeypatch) -> None:
    def interrupted(*_args, **_keywords):
        raise SystemError("CPUDispatcher returned a result with an exception set") from KeyboardInterrupt()

    monkeypatch.setattr("pathloom.planning.plan", interrupted)
    assert one_line(cli("plan"), code=130) == "interrupted"


def test_bad_input_in_a_process_of_its_own_is_one_line_without_traceback(process, folder: Path) -> None:
    assert one_line(process("plan", "--map", "gone.map"), code=2).startswith("gone.map: found no such file")
    assert list(folder.iterdir()) == []
