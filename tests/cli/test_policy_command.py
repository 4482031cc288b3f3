"""``pathloom policy``: train, evaluate, drive, and one line for what cannot be."""

import numpy as np
import pytest

from .conftest import write

ROWS = "".join(
    f"{front:.3f},{left:.3f},1.000,1.000,{'Sharp-Right-Turn' if front <= 0.9 else 'Move-Forward'}\r\n"
    for front, left in ((0.5 + 0.05 * (k % 20), 0.5 + 0.01 * (k % 7)) for k in range(60))
)
SHORT = ("--data", "readings.data")
DRIVE = ("policy", "drive", "--maps", "empty-8", "--episodes", 2, "--examples", 200, "--set", "hazards.clear=1")


@pytest.fixture
def readings(folder):
    return write(folder / "readings.data", ROWS)


def timeless(document):
    return {key: value for key, value in document.items() if key != "timing"}


def test_evaluate_answers_as_the_interface_says(cli, readings):
    asked = ("policy", "evaluate", *SHORT, "--policies", "gnb,rf", "--set", "rf.trees=5", "--seed", 1, "--json")
    done = cli(*asked)
    assert done.code == 0
    found = done.document
    assert found["schema"] == "pathloom.policy/1"
    assert set(found["policies"]) == {"gnb", "rf"}
    assert {"accuracy", "precision", "recall", "f1", "mcc", "confusion"} <= set(found["policies"]["rf"]["holdout"])
    assert {"tenfold", "tenfold_shuffled"} <= set(found["policies"]["rf"])
    assert found["policies"]["rf"]["config"]["trees"] == 5
    assert cli(*asked).out == done.out


def test_evaluate_draws_and_shows_a_table(cli, readings, folder):
    done = cli(
        "policy", "evaluate", *SHORT, "--policies", "gnb,four-leaves", "--curve", "--plot", "c.png", "--out", "c.json"
    )
    assert done.code == 0
    assert "four-leaves" in done.out
    assert (folder / "c.png").read_bytes().startswith(b"\x89PNG")
    assert (folder / "c.json").exists()


def test_the_worst_and_the_best_of_several_hold_outs_are_shown(cli, readings):
    done = cli("policy", "evaluate", *SHORT, "--policies", "four-leaves", "--runs", 3, "--quiet")
    assert "means of 3 draws" in done.out
    assert done.out.splitlines()[-1].split()[0] == "four-leaves"
    each = cli("policy", "evaluate", *SHORT, "--policies", "four-leaves", "--runs", 3, "--json").document
    found = each["policies"]["four-leaves"]["holdout"]
    assert f"{100 * found['mean']:.1f} [{100 * found['least']:.1f}, {100 * found['most']:.1f}]" in done.out


def test_a_small_tree_is_shown(cli, readings, folder):
    tree = ("policy", "train", "--policy", "sklearn.tree.DecisionTreeClassifier", *SHORT, "--out", "tree.skops")
    assert "front <= 0.9" in cli(*tree).out
    assert "class: Sharp-Right-Turn" in cli(*tree).out
    assert "front" not in cli("policy", "train", "--policy", "gnb", *SHORT, "--out", "gnb.skops").out


def test_a_trained_model_is_measured_and_drives(cli, readings, folder):
    trained = cli("policy", "train", "--policy", "gnb", *SHORT, "--out", "gnb.skops", "--json").document
    assert trained["examples"]["rows"] == 60
    found = cli("policy", "evaluate", "--model", "gnb.skops", *SHORT, "--json").document
    assert found["policies"]["gnb"]["all"]["accuracy"] == trained["accuracy_on_its_examples"]
    drives = cli(*DRIVE, "--policies", "pure-pursuit", "--model", "gnb.skops", "--json").document
    assert set(drives["policies"]) == {"pure-pursuit", "gnb.skops"}
    asked = ("--policies", "guarded:gnb.skops", "--model", "gnb.skops", "--json")
    guarded = cli(*DRIVE, *asked).document["policies"]["guarded:gnb.skops"]
    assert guarded["driver"]["use"] == "guarded"
    assert guarded["trained_on"]["sha256"] == trained["examples"]["sha256"]


def test_a_model_in_a_file_called_like_a_policy_does_not_drive(cli, refused, readings):
    cli("policy", "train", "--policy", "gnb", *SHORT, "--out", "gnb")
    assert "which is a name already" in refused("policy", "drive", "--model", "gnb")


def test_drives_are_the_same_for_the_same_seed_and_compared(cli, folder):
    asked = (*DRIVE, "--policies", "pure-pursuit,guarded:four-leaves,dynamic-window", "--json", "--quiet")
    first, again, other = (cli(*asked, "--seed", seed).document for seed in (3, 3, 4))
    assert timeless(first) == timeless(again) != timeless(other)
    assert {it["metric"] for it in first["comparisons"]} == {"unhurt", "arrived", "seconds", "min_clearance"}
    assert all(len(it["episodes"]) == 2 for it in first["policies"].values())
    assert set(first["timing"]) == set(first["policies"])


def test_no_clearance_is_nought_and_not_below(cli, folder):
    done = cli(*DRIVE, "--policies", "pure-pursuit", "--set", "hazards.standing=6", "--json")
    assert done.document["policies"]["pure-pursuit"]["ends"] == {"collided": 2}
    assert "-0.0," not in done.out


def test_only_a_path_nearer_to_walls_than_the_radius_is_noted(cli, folder):
    from PIL import Image

    grey = np.full((60, 60), 254, np.uint8)
    grey[20:60, 30] = 0
    Image.fromarray(grey).save(folder / "office.png")
    facts = (
        "image: office.png\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
    )
    write(folder / "office.yaml", facts)
    ends = ("--maps", "office.yaml", "--start", "50,10", "--goal", "50,50")
    asked = ("policy", "drive", *ends, "--policies", "dynamic-window", "--episodes", 1)
    assert "nearer than" not in cli(*asked).err
    asked = ("policy", "drive", "--maps", "random-20:15%", "--policies", "dynamic-window", "--episodes", 1)
    assert "nearer than" not in cli(*asked).err
    assert "nearer than the robot's radius" in cli(*asked, "--planner", "any-angle").err


def test_a_drive_becomes_a_picture_or_a_film(cli, folder):
    for name, head in (("drive.png", b"\x89PNG"), ("drive.gif", b"GIF8")):
        done = cli(*DRIVE, "--policies", "four-leaves,pure-pursuit", "--plot", name, "--dark")
        assert done.code == 0, done.err
        assert (folder / name).read_bytes().startswith(head)


BAD = {
    ("evaluate", *SHORT, "--policies", "rff"): "--policies: no policy is called 'rff'; did you mean 'hga-aco/rf'?",
    ("evaluate", *SHORT, "--policies", ""): "--policies: found none or an empty name",
    ("evaluate", *SHORT, "--policies", "gnb,gnb"): "--policies: found 'gnb' twice",
    ("evaluate", *SHORT, "--policies", "sklearn.svm.Svc"): "did you mean 'sklearn.svm.SVC'?",
    (
        "evaluate",
        *SHORT,
        "--policies",
        "rf",
        "--set",
        "rf.tres=3",
    ): "'hga-aco/rf' has no such parameter; did you mean 'trees'?",
    ("evaluate", *SHORT, "--policies", "rf", "--set", "rg.trees=3"): "--set rg.trees: nothing here is called so",
    ("evaluate", "--data", "reading.data"): "reading.data: found no such file",
    ("evaluate", *SHORT, "--model", "readings.data"): "found no zip file, or a damaged one",
    ("evaluate", *SHORT, "--seed", "-1"): "seed is an integer in [0, inf); got -1",
    ("train", *SHORT): "--out: found none",
    (
        "train",
        "--policy",
        "knn",
        *SHORT,
        "--set",
        "knn.neighbours=99",
        "--out",
        "m.skops",
    ): "not trained on 60 examples",
    ("train", "--policy", "four-leaves", *SHORT, "--out", "m.skops"): "a rule that has nothing to learn",
    ("drive", "--radius", "-1"): "--set robot.radius",
    ("drive", "--policies", "gard:rf"): "no driver is called 'gard'",
    ("drive", "--planner", "dijkstr", "--policies", "pure-pursuit"): "--planner: no planner is called 'dijkstr'",
    ("drive", "--expert", "rf"): "--expert: found 'rf', which has to learn itself",
}


@pytest.mark.parametrize("options", BAD, ids=" ".join)
def test_a_bad_option_is_refused_in_one_line(refused, readings, options):
    assert BAD[options] in refused("policy", *options, "--quiet")
