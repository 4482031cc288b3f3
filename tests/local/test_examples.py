"""Examples: read from files with all their quirks, or made without end."""

import warnings

import numpy as np
import pytest

import pathloom as pl
from pathloom.local.actions import Action
from pathloom.local.reading import fetch_examples, read_examples
from pathloom.local.rules import FourLeaves, WallFollower
from pathloom.local.sectors import simplified

ROWS = ["0.900,3.0,1.0,1.0,Sharp-Right-Turn", "0.901,0.494,1.0,1.0,Slight-Right-Turn", "2.0,0.9,1.0,1.0,Move-Forward",
        "2.0,0.902,1.0,1.0,Slight-Left-Turn"]  # fmt: skip


def written(tmp_path, content):
    file = tmp_path / "readings.data"
    file.write_bytes(content.encode())
    return file


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("last", [True, False])
def test_line_ends_of_either_kind_are_read_and_the_last_may_lack(tmp_path, end, last):
    examples = read_examples(written(tmp_path, end.join(ROWS) + end * last))
    assert examples.actions.tolist() == [2, 1, 0, 3]
    assert examples.width == 4
    assert examples.notes == ()


def test_a_heading_is_left_out_and_noted_and_numbers_stand_for_actions(tmp_path):
    examples = read_examples(written(tmp_path, "front,left,class\n1.0,0.6,0\n0.5,0.6,2\n"))
    assert examples.actions.tolist() == [0, 2]
    assert "line 1: a heading" in examples.notes[0]


WRONG = {
    "": "an empty file",
    "\n\n": "nothing but blank lines",
    "1.0,2.0,3.0,Move-Forward\n": "line 1: found 4 columns, allowed 2, 4 or 24 distances",
    f"{ROWS[0]}\n1.0,2.0,Move-Forward\n": "line 2: found 3 columns, allowed 5",
    f"{ROWS[0]}\nnan,2.0,1.0,1.0,Move-Forward\n": "line 2, column 1: found 'nan', allowed a distance",
    f"{ROWS[0]}\n1.0,-2.0,1.0,1.0,Move-Forward\n": "line 2, column 2: found '-2.0'",
    f"{ROWS[0]}\n1.0,far,1.0,1.0,Move-Forward\n": "line 2, column 2: found 'far'",
    f"{ROWS[0]}\n1.0,2.0,1.0,1.0,Move-Foward\n": "found 'Move-Foward', allowed Move-Forward, Slight-Right-Turn",
    f"{ROWS[0]}\n1.0,2.0,1.0,1.0,4\n": "found '4'",
}


@pytest.mark.parametrize("content", WRONG)
def test_what_is_wrong_with_a_file_is_one_line(tmp_path, content):
    with pytest.raises(pl.PathloomError) as refused:
        read_examples(written(tmp_path, content))
    assert WRONG[content] in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.data
def test_the_recorded_data_are_read_and_every_row_obeys_the_four_leaves(data):
    folder = data / "uci_wall_following"
    four, two, raw = (read_examples(folder / f"sensor_readings_{width}.data") for width in (4, 2, 24))
    for examples in (four, two, raw):
        assert np.bincount(examples.actions).tolist() == [2205, 826, 2097, 328]
        assert FourLeaves().decide(examples.distances).tolist() == examples.actions.tolist()
    made = simplified(raw.distances)
    assert np.minimum(made[:, :3], 5.0).tolist() == four.distances[:, :3].tolist()
    assert (made[:, 3] == four.distances[:, 3]).mean() == pytest.approx(0.85, abs=0.01)
    assert two.distances.tolist() == four.distances[:, :2].tolist()


def test_openml_is_asked_by_name_and_its_numbers_are_told_by_how_often_they_occur(monkeypatch):
    asked = {}

    class Fetched:
        target = np.repeat(["1", "2", "3", "4"], [826, 2097, 328, 2205])
        data = np.ones((5456, 4))

    def fetch(name, **options):
        asked.update(options, name=name)
        return Fetched

    monkeypatch.setattr("sklearn.datasets.fetch_openml", fetch)
    examples = fetch_examples("openml")
    assert (asked["name"], asked["version"]) == ("wall-robot-navigation", 3)
    assert examples.actions[[0, 826, 2923, 5455]].tolist() == [1, 2, 3, 0]
    with pytest.raises(pl.ConfigError, match="openml:3: found no such data"):
        fetch_examples("openml:3")
    monkeypatch.setattr(Fetched, "data", np.ones((5456, 3)))
    with pytest.raises(pl.ConfigError, match="not the wall-following data"):
        fetch_examples("openml")


def test_of_the_versions_on_openml_the_one_with_as_many_distances_is_taken(monkeypatch):
    class Fetched:
        target = np.repeat(["1", "2", "3", "4"], [826, 2097, 328, 2205])

        def __init__(self, version):
            self.data = np.ones((5456, {1: 24, 2: 4, 3: 2}[version]))

    monkeypatch.setattr("sklearn.datasets.fetch_openml", lambda name, *, version, **_: Fetched(version))
    for width in (2, 4, 24):
        assert fetch_examples(f"openml:{width}").width == width


def test_no_network_is_one_line(monkeypatch, recwarn):
    def fetch(name, **options):
        warnings.warn("trying again", stacklevel=1)
        raise OSError("no route\nto host")

    monkeypatch.setattr("sklearn.datasets.fetch_openml", fetch)
    with pytest.raises(pl.ConfigError, match="openml: not fetched \\(no route to host\\)"):
        fetch_examples("openml")
    assert not recwarn.list


@pytest.mark.parametrize("driven", [False, True])
@pytest.mark.parametrize("width", [2, 4, 24])
def test_generated_examples_depend_on_the_generator_alone_and_obey_their_expert(width, driven):
    grid = pl.load_map("blocks-15:10%")
    first, again, other = (
        pl.generate(grid, 60, FourLeaves(), rng=np.random.default_rng(seed), width=width, driven=driven)
        for seed in (1, 1, 2)
    )
    assert first.sha256 == again.sha256 != other.sha256
    assert first.width == width
    assert FourLeaves().decide(first.distances).tolist() == first.actions.tolist()
    assert first.distances.max() <= 5.0


def test_a_driven_expert_finds_walls_and_takes_all_four_actions():
    rng = np.random.default_rng(0)
    examples = pl.generate(pl.load_map("blocks-30:15%"), 3000, FourLeaves(), rng=rng, driven=True)
    assert np.bincount(examples.actions, minlength=4).min() > 30


def test_a_map_without_room_is_refused():
    with pytest.raises(pl.ConfigError, match="hardly any room"):
        pl.generate(pl.OccupancyGrid(np.ones((4, 4))), 1, FourLeaves(), rng=np.random.default_rng(0))


def test_the_smoother_follower_turns_less_the_less_is_wrong():
    rule = WallFollower()
    rows = np.array([[0.5, 0.6, 1, 1], [3.0, 0.65, 1, 1], [3.0, 0.4, 1, 1], [3.0, 1.2, 1, 1]])
    assert rule.decide(rows).tolist() == [Action.SHARP_RIGHT, Action.FORWARD, Action.SLIGHT_RIGHT, Action.SLIGHT_LEFT]


def test_a_tree_finds_the_thresholds_in_generated_examples():
    from pathloom.local.classifiers import Classifier

    rng = np.random.default_rng(0)
    examples = pl.generate(pl.load_map("blocks-30:15%"), 6000, FourLeaves(), rng=rng)
    tree = Classifier().trained(examples, rng).classifier.tree_
    inner = tree.feature >= 0
    found = sorted(zip(tree.feature[inner].tolist(), tree.threshold[inner].tolist(), strict=True))
    assert [feature for feature, _ in found] == [0, 1, 1]
    assert [threshold for _, threshold in found] == pytest.approx([0.900, 0.494, 0.900], abs=0.01)
