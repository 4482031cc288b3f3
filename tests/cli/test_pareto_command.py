"""``pathloom pareto``: its document, its tables, its config and what it refuses."""

import json
import signal
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import pathloom as pl

from .conftest import write

QUICK = ("--set", "termination.limit=6", "--set", "population=20")
MAP = ("pareto", "--map", "random-20:75:s1", "--seed", 1, *QUICK)


def timeless(document):
    budget = {k: v for k, v in document["budget"].items() if not k.startswith(("seconds", "phases", "references"))}
    return {**document, "budget": budget}


def test_the_document_is_that_of_the_interface(cli):
    document = cli(*MAP, "--objectives", "length,unsafe-cells,turns", "--exact", "--json").document
    assert document["schema"] == "pathloom.pareto/1"
    assert document["status"] == "found"
    assert document["planner"] == "nsga2"
    assert document["objectives"] == ["length", "unsafe-cells", "turns"]
    for member in document["front"]:
        assert len(member["values"]) == 3
        assert member["path"][0] == document["problem"]["start"]
        assert member["path"][-1] == document["problem"]["goal"]
    wanted = {"hypervolume", "reference_point", "ideal", "nadir", "hypervolume_ratio", "igd_plus", "exact_size"}
    assert wanted <= set(document["indicators"])
    assert {"problem", "seed", "budget", "history", "config", "versions"} <= set(document)
    assert pl.ParetoResult.from_json(json.dumps(document)).found


def test_json_is_one_line_and_the_only_thing_printed(cli):
    done = cli(*MAP, "--against", "ga-imga", "--json")
    assert (done.code, done.err, done.out.count("\n")) == (0, "", 1)


def test_the_tables_name_front_indicators_and_rivals(cli):
    shown = cli(*MAP, "--against", "imga", "--exact", "--prefer", "turns=1", "--runs", 2).out
    for words in ("unsafe-cells", "preferred", "knee", "least length", "hypervolume ratio", "imga", "unrefined", "/2"):
        assert words in shown


def test_a_long_front_is_thinned_and_says_so(cli):
    options = ("--map", "blocks-50:20%:s3", "--objectives", "length,unsafe-cells,turns,clearance")
    done = cli("pareto", *options, "--out", "front.json")
    found = len(json.loads(Path("front.json").read_text())["front"])
    assert found > 12
    assert f"12 of {found} trade-offs" in done.out


def test_quiet_says_nothing_but_the_result(cli, wall):
    done = cli("pareto", "--map", wall, "--quiet")
    assert (done.code, done.out, done.err) == (3, "", "")


def test_an_unreachable_goal_is_said_before_any_search(cli, wall):
    done = cli("pareto", "--map", wall, "--plot", "front.png", "--out", "front.json")
    assert done.code == 3
    assert "cannot be reached" in done.err
    assert not Path("front.png").exists()
    document = cli("pareto", "--map", wall, "--json").document
    assert (document["status"], document["front"]) == ("unreachable", [])


RUNS = {
    "defaults": (),
    "objectives": ("--objectives", "length,imga/unsafe-node"),
    "weights": ("--prefer", "length=2,turns=1", "--reference", "90,80,70"),
    "a weighting": ("--prefer", '{use = "agacd/delphi-ratio", ratios = [1.6, 1.2]}'),
    "rivals": ("--against", "imga,ga-imga", "--runs", "2", "--exact"),
    "parts": ("--set", "mutation.rate=0.2", "--set", "crossover=none"),
    "constraints": ("--constraint", "length<=1.1xoptimum"),
}


@pytest.mark.parametrize("options", RUNS.values(), ids=RUNS)
def test_a_frozen_config_gives_the_same_run(cli, folder, options):
    frozen = cli(*MAP, *options, "--freeze").out
    write(folder / "frozen.toml", frozen)
    assert cli("pareto", "frozen.toml", "--freeze").out == frozen
    again, once = (cli(*run, "--json").document for run in (("pareto", "frozen.toml"), (*MAP, *options)))
    assert json.dumps(timeless(again)) == json.dumps(timeless(once))
    assert once["config"] == tomllib.loads(frozen)


def test_the_schema_knows_what_is_asked_of_a_front(cli):
    import jsonschema

    schema = jsonschema.Draft202012Validator(cli("plugins", "schema").document)
    assert schema.is_valid(tomllib.loads(cli(*MAP, *RUNS["rivals"], *RUNS["weights"], "--freeze").out))
    assert not schema.is_valid({"front": {"exakt": True}})
    assert not schema.is_valid({"front": {"runs": 0}})


def test_options_go_before_the_config(cli, folder):
    text = '[planner]\nuse = "nsga2"\npopulation = 20\ntermination = [{use = "max-generations", limit = 3}]\n'
    write(
        folder / "mine.toml", f'[problem]\nmap = "iga-map1"\ncorners = "allow"\n{text}[front]\nagainst = ["ga-imga"]\n'
    )
    assert [rival["planner"] for rival in cli("pareto", "mine.toml", "--json").document["against"]] == ["ga-imga"]
    changed = cli("pareto", "mine.toml", "--against", "imga", "--objectives", "turns,length", "--json").document
    assert [rival["planner"] for rival in changed["against"]] == ["imga"]
    assert changed["objectives"] == ["turns", "length"]


REFUSED = {
    "one objective": (("--objectives", "length"), "--objectives: found 1 (length), allowed 2 to 5"),
    "an unknown objective": (("--objectives", "length,trns"), "did you mean 'turns'?"),
    "a duplicate": (("--objectives", "length,length"), "--objectives: found 'length' twice"),
    "no objective left": (("--set", "objectives.length=none", "--set", "objectives.turns=none"), "2 to 5"),
    "an unknown algorithm": (("--algorithm", "nsga22"), "--algorithm: no planner is called 'nsga22'; did you mean"),
    "an algorithm of one path": (("--algorithm", "imga"), "--algorithm: 'imga' answers with one path"),
    "no constraint": (("--constraint", "length"), "--constraint"),
    "an unknown constraint": (("--constraint", "lenght<=3"), "did you mean 'length'?"),
    "a contradiction": (("--constraint", "length<=3", "--constraint", "length>=4"), "--constraint: "),
    "an unknown rival": (("--against", "imgaa"), "--against: no planner is called 'imgaa'; did you mean"),
    "a preference without weight": (("--prefer", "length=1,turns"), "allowed NAME=WEIGHT"),
    "a preference for nothing": (("--prefer", "foo=1"), "--prefer: no objective of this front is 'foo'"),
    "a preference that is no weighting": (("--prefer", "roulette"), "--prefer: 'roulette' is a selection"),
    "a weighting of fewer": (
        ("--objectives", "length,turns", "--prefer", "agacd/delphi-ratio"),
        "--prefer: delphi-ratio: ratios",
    ),
    "a short reference point": (("--reference", "1,2"), "--reference: found 2 numbers for 3 objectives"),
    "a reference point of words": (("--reference", "a,b,c"), "allowed a number"),
    "no runs": (("--runs", "0"), "--runs: found 0"),
    "a plot that moves": (("--plot", "front.gif"), "--plot: found the suffix '.gif'"),
    "a folder that is not there": (("--out", "nowhere/front.json"), "nowhere"),
    "an unknown slot": (("--set", "mutatoin=none"), "did you mean 'mutation'?"),
    "a bad seed": (("--seed", "-1"), "seed"),
    "a bad start": (("--start", "99,99"), "--start"),
}


@pytest.mark.parametrize(("options", "says"), REFUSED.values(), ids=REFUSED)
def test_bad_input_is_refused_in_one_line(refused, options, says):
    assert says in refused("pareto", *options)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[front]\nexakt = true\n", "front.exakt: no such key; did you mean 'exact'?"),
        ("[front]\nruns = 0\n", "front.runs: found 0"),
        ('[front]\nagainst = "imga"\n', "front.against: found 'imga', allowed a list"),
        ('[front]\nagainst = ["imgaa"]\n', "front.against: no planner is called 'imgaa'"),
        ("[front.prefer]\nfoo = 1\n", "front.prefer: no objective of this front is 'foo'"),
        ('[planner]\nuse = "imga"\n', "planner: 'imga' answers with one path"),
        ("[planner.objectives]\nlength = 1\n", "objectives"),
    ],
)
def test_a_bad_config_is_refused_with_file_and_key(refused, folder, text, says):
    write(folder / "mine.toml", text)
    message = refused("pareto", "mine.toml")
    assert message.startswith("mine.toml: ")
    assert says in message


def test_help_names_every_option_of_the_interface(cli):
    shown = cli("pareto", "--help").out
    for option in (
        *("--algorithm", "--objectives", "--constraint", "--map", "--start", "--goal", "--corners", "--radius"),
        *("--exact", "--against", "--runs", "--prefer", "--reference", "--plot", "--out", "--json", "--set"),
        *("--seed", "--time-limit", "--freeze", "--quiet"),
    ):
        assert option in shown


def test_a_plot_is_drawn(cli):
    for suffix in ("png", "svg", "pdf"):
        done = cli(*MAP, "--objectives", "length,turns", "--plot", f"front.{suffix}", "--quiet")
        assert done.code == 0
        assert Path(f"front.{suffix}").stat().st_size > 5000


def test_the_objective_that_colours_the_paths_can_be_chosen(cli):
    asked = (*MAP, "--objectives", "length,turns", "--plot", "front.svg", "--quiet")
    pictures = []
    for colour in ("length", "turns"):
        assert cli(*asked, "--colour", colour).code == 0
        pictures.append(Path("front.svg").read_text())
    assert pictures[0] != pictures[1]
    refused = cli(*asked, "--colour", "turn")
    assert refused.code == 2
    assert "--colour: no objective of this front is 'turn'; did you mean 'turns'?" in refused.err


ENDLESS = ("pareto", "--map", "random-20:75:s1", "--set", "termination.limit=1000000", "--set", "population=20")
UNDER_WAY = """
import sys
from pathloom.cli import main
from pathloom_pymoo.planner import MultiObjective

step = MultiObjective.step

def telling(planner, state):
    if state.generation == 20:
        print("under way", file=sys.stderr, flush=True)
    return step(planner, state)

MultiObjective.step = telling
main()
"""


def test_ctrl_c_ends_a_run_with_the_front_so_far_and_writes_what_was_asked_for(folder):
    command = [sys.executable, "-c", UNDER_WAY, *ENDLESS, "--out", "front.json", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        assert child.stderr is not None
        assert child.stderr.readline() == "under way\n"
        child.send_signal(signal.SIGINT)
        out, err = child.communicate(timeout=60)
    document = json.loads(out)
    assert (child.returncode, document["status"], document["interrupted"]) == (130, "found", True)
    assert 20 <= document["budget"]["generations"] < 1_000_000
    assert err == "pathloom: interrupted; this is the front so far\n"
    assert json.loads(Path("front.json").read_text()) == document
