"""``python -m pathloom.bench`` as a user meets it."""

import json
import sys

import pytest

from pathloom.bench import __main__ as command
from pathloom.bench.suite import named, suite


def called(monkeypatch, capsys, *words):
    """Return the exit code, standard output and standard error."""
    monkeypatch.setattr(sys, "argv", ["bench", *words])
    with pytest.raises(SystemExit) as ended:
        command.main()
    return ended.value.code, *capsys.readouterr()


QUICK = ("--maps", "random-10:10%", "--planners", "imga", "--peers", "none", "--seeds", "1")


def test_a_table_of_results_and_one_of_methods(monkeypatch, capsys):
    code, out, err = called(monkeypatch, capsys, *QUICK)
    assert (code, err) == (0, "")
    assert [line.split()[0] for line in out.splitlines() if line][:2] == ["maps", "random-10:10%"]
    assert "any-angle search" in out
    assert "used how" in out


def test_markdown_and_json_say_the_same(monkeypatch, capsys, tmp_path):
    file = tmp_path / "bench.json"
    code, out, _ = called(monkeypatch, capsys, *QUICK, "--markdown", "--json", str(file))
    told = json.loads(file.read_text())
    lines = [line.strip("| ").split(" | ") for line in out.splitlines() if line.startswith("| random-10")]
    assert code == 0
    assert [(line[0], line[1], line[2]) for line in lines] == [
        (row["group"], row["who"], f"{row['found']} of {row['runs']}") for row in told["rows"]
    ]


def test_peers_that_are_missing_are_listed_as_such(monkeypatch, capsys):
    from pathloom.bench.peers import PEERS

    monkeypatch.setattr(type(PEERS["pyastar2d"]), "version", lambda self: None)
    code, out, _ = called(monkeypatch, capsys, *QUICK[:4], "--peers", "pyastar2d", "--seeds", "1")
    (line,) = (line for line in out.splitlines() if line.startswith("pyastar2d"))
    assert code == 0
    assert "not installed" in line


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--suite", "smal"), "--suite: no suite is called 'smal'; did you mean 'small'?"),
        (("--peers", "networx"), "--peers: no peer is called 'networx'"),
        (("--planners", "imgaa"), "no planner is called 'imgaa'"),
        (("--planners", "{use = imga}"), "--planners: found '{use = imga}'"),
        (("--maps", "nowhere"), "nowhere: no map and no file is called so"),
        (("--maps", ","), "--maps: found no map"),
        (("--maps", "empty-5@top-left"), "empty-5@top-left: found 1 ends"),
        (("--seeds", "0"), "Invalid value for '--seeds'"),
        (("--time-limit", "0"), "Invalid value for '--time-limit'"),
        (("--corners", "round"), "Invalid value for '--corners'"),
        (("--json", "no/such/folder/x.json"), "--json: found 'no/such/folder/x.json'"),
        (("--suite", "movingai", "--data", "no/such/folder"), "no/such/folder: found no scenario"),
        (("scale", "--sizes", "many"), "--sizes: found 'many'"),
        (("scale", "--plot", "x.jpg"), "'.jpg'"),
        (("scale", "--planner", "imga,iga"), "--planner: found 2 planners"),
        (("parallel", "--map", "nowhere"), "nowhere: no map"),
        (("rows", "imga", "nowhere"), "nowhere: no map"),
        (("--nonsense",), "No such option"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(monkeypatch, capsys, words, said):
    if words[0] == "--maps":
        words = (*words, "--planners", "none", "--peers", "none")
    code, out, err = called(monkeypatch, capsys, *words)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert err.startswith("pathloom.bench: ")
    assert said in err


def test_movingai_needs_a_folder(monkeypatch, capsys):
    monkeypatch.delenv("PATHLOOM_DATA", raising=False)
    code, _, err = called(monkeypatch, capsys, "--suite", "movingai")
    assert code == 2
    assert "PATHLOOM_DATA" in err


@pytest.mark.data
def test_cases_of_a_scenario_are_spread_over_it(data):
    some = suite("movingai", "strict", str(data), 4, False, "arena.map")
    first = suite("movingai", "strict", str(data), 4, True, "arena.map")
    assert [task.group for task in some] == ["arena"] * 4
    assert [task.name.partition("#")[2] for task in first] == ["0", "1", "2", "3"]
    numbers = [int(task.name.partition("#")[2]) for task in some]
    assert numbers == sorted(set(numbers))
    assert numbers[-1] > 100
    assert all(task.problem.reachable for task in some)


def test_many_maps_of_a_family_by_one_name():
    tasks = named("random-10:10%:x3, empty-5", "allow")
    assert [task.name for task in tasks] == ["random-10:10%:s0", "random-10:10%:s1", "random-10:10%:s2", "empty-5"]
    assert len({task.group for task in tasks}) == 2
    assert tasks[1].problem.grid.name == "random-10:10%:s1"


def test_rows_and_scale_print_tables(monkeypatch, capsys, tmp_path):
    code, out, _ = called(monkeypatch, capsys, "rows", "imga", "empty-6", "--seeds", "1")
    assert code == 0
    assert out.splitlines()[2].startswith("| empty-6 | imga | 1 of 1 | 7.0711 |")
    plot, file = tmp_path / "scale.png", tmp_path / "scale.json"
    words = ("--planner", "imga", "--sizes", "36,40", "--seeds", "1", "--no-memory", "--plot", str(plot))
    code, out, _ = called(monkeypatch, capsys, "scale", *words, "--json", str(file))
    assert code == 0
    assert plot.stat().st_size > 5000
    assert len(json.loads(file.read_text())["fits"]) == out.count("N log N)^")
