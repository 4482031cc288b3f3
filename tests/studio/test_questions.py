"""What the page asks by the way: maps, a glance at a scene, forms, and the config that repeats a run."""

import base64
import json
import re
import tomllib

import numpy as np
import pytest

import pathloom as pl
from pathloom.files import one_line
from studio.conftest import quick, scene, wall


def told(answer, status=422):
    """Return the one line that a question was refused with."""
    assert answer.status_code == status
    said = answer.json()
    assert said["message"] == one_line(said["message"])
    assert "Traceback" not in said["message"]
    return said


def test_a_named_map_is_the_same_as_on_the_command_line(client):
    found = client.post("/map", json={"name": "blocks-30:25%:s2"}).json()
    bits = np.frombuffer(base64.b64decode(found["map"]["bits"]), np.uint8)
    grid = pl.load_map("blocks-30:25%:s2")
    assert np.array_equal(np.unpackbits(bits, count=900).reshape(30, 30).astype(bool), grid.occupied)


def test_a_map_that_is_unknown_or_too_large_is_refused_and_no_file_is_read_by_name(client, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "secret.csv").write_text("0,1\n1,0\n")
    assert "did you mean 'blocks-20'" in told(client.post("/map", json={"name": "blokcs-20"}))["message"]
    assert "at most 1024" in told(client.post("/map", json={"name": "empty-5000"}))["message"]
    assert "no map" in told(client.post("/map", json={"name": "secret.csv"}))["message"]


def test_files_of_maps_are_read_by_their_kind(client):
    def sent(**files):
        return {"files": {name: base64.b64encode(text).decode() for name, text in files.items()}}

    octile = b"type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n"
    found = client.post("/files", json={"files": {"a b/../x.map": base64.b64encode(octile).decode()}}).json()
    assert (found["map"]["rows"], found["map"]["cols"]) == (2, 3)
    yaml = b"image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    image = b"P5\n2 2\n255\n\xff\x00\xff\xff"
    ros = client.post("/files", json=sent(**{"m.yaml": yaml, "m.pgm": image})).json()
    assert base64.b64decode(ros["map"]["bits"]) == b"\x40"
    assert "0.5 m" in ros["note"]


def test_a_broken_file_is_refused_without_the_name_of_any_folder(client):
    broken = {"files": {"broken.map": base64.b64encode(b"type hex\nheight 1\nwidth 1\nmap\n.\n").decode()}}
    message = told(client.post("/files", json=broken))["message"]
    assert message.startswith("broken.map: line 1, column 6")
    assert "/" not in message.partition(":")[0]


def test_a_glance_says_what_is_wrong_and_where(client):
    assert client.post("/look", json=scene()).json() == {"fault": None, "closed": None}
    closed = client.post("/look", json=scene(wall(gap=None))).json()["fault"]
    assert (closed["where"], closed["message"]) == (
        "goal", "the goal 0,11 cannot be reached from 11,0 under the corner policy 'strict'",
    )  # fmt: skip
    on_a_wall = client.post("/look", json=scene(wall(), start=[5, 6])).json()["fault"]
    assert on_a_wall["where"] == "start"
    assert "is an obstacle" in on_a_wall["message"]
    grown = client.post("/look", json=scene(wall(), radius=1.0)).json()
    assert np.unpackbits(np.frombuffer(base64.b64decode(grown["closed"]), np.uint8)).sum() > 11


@pytest.mark.parametrize(
    "change",
    [
        {"start": [1]}, {"start": "a"}, {"start": [99, 0]}, {"radius": -1}, {"radius": "x"}, {"corners": "round"},
        {"more": 1}, {"map": {"rows": 12, "cols": 12, "bits": "AA=="}}, {"map": {"rows": 10**9, "cols": 1, "bits": ""}},
        {"map": {"rows": 12, "cols": 12, "bits": "%%%"}}, {"map": None},
    ],
)  # fmt: skip
def test_a_scene_that_is_none_is_told_in_one_line(client, change):
    answer = client.post("/look", json=scene() | change)
    if answer.status_code == 200:
        assert answer.json()["fault"]["message"]
    else:
        told(answer)


@pytest.mark.parametrize("body", [b"", b"nothing", b"\xff\xfe", b"[" * 100_000, b'{"map": NaN}', b"null"])
def test_garbage_is_refused_by_every_route(client, body):
    for route in ("/look", "/map", "/files", "/config"):
        told(client.post(route, content=body))


def test_more_than_a_map_can_be_is_refused_while_it_comes(client, monkeypatch):
    from pathloom.studio import app

    monkeypatch.setattr(app, "LARGEST_REQUEST", 1000)
    assert "1000 bytes" in told(client.post("/files", content=b"x" * 2000), 413)["message"]


def test_the_forms_know_every_planner_and_what_it_needs(client):
    found = client.get("/catalogue").json()
    planners = found["components"]["planner"]
    assert {"imga/imga", "loom/loom", "pymoo/nsga2"} <= planners.keys()
    assert planners["pymoo/nsga2"]["front"]
    assert not planners["imga/imga"]["front"]
    assert not planners["evolution"]["usable"]  # nothing without objectives
    fields = {field["name"]: field for field in planners["imga/imga"]["fields"]}
    assert fields["population"]["schema"] == {"type": "integer", "minimum": 1, "maximum": 2**31 - 1}
    assert fields["population"]["meaning"] == "Number of individuals in each population."
    assert (fields["selection"]["form"], fields["selection"]["kind"]) == ("slot", "selection")
    assert fields["objectives"]["form"] == "terms"
    assert found["components"]["mutation"]["reroute"]["keeps"] == ["rate", "probability"]
    assert {"name": "iga-map1", "family": False} in [{k: m[k] for k in ("name", "family")} for m in found["maps"]]


def test_every_table_of_the_forms_is_a_planner(client):
    from pathloom.kernel.compose import freeze

    for name, form in client.get("/catalogue").json()["components"]["planner"].items():
        if form["usable"]:
            frozen = freeze(pl.compose(form["table"]))
            frozen.pop("observers")
            assert json.loads(json.dumps(frozen)) == form["table"], name


def test_the_colours_are_those_of_the_pictures(client):
    from pathloom.draw.colours import DARK, LIGHT

    css = client.get("/colours.css").text
    light, dark = (dict(re.findall(r"--([\w-]+): (#\w+);", block)) for block in re.findall(r"{([^{}]*)}", css)[:2])
    assert light == vars(LIGHT)
    assert dark == vars(DARK)


def test_a_config_of_a_drawn_map_comes_with_the_map(client):
    asked = {"scene": scene(wall(), corners="allow"), "planner": quick(), "seed": 7}
    saved = client.post("/config", json=asked).json()
    table = tomllib.loads(saved["toml"])
    assert table["problem"]["map"] == saved["map_file"] == "studio.map"
    assert table["run"]["seed"] == 7
    assert saved["map"].startswith("type octile\nheight 12\nwidth 12\nmap\n")


def test_a_config_of_a_map_with_a_name_does_without_unless_somebody_drew_on_it(client):
    occupied = pl.load_map("iga-map1").occupied.copy()
    asked = {"scene": scene(occupied, name="iga-map1", corners="allow"), "planner": quick()}
    saved = client.post("/config", json=asked).json()
    assert saved["map"] is None
    assert tomllib.loads(saved["toml"])["problem"]["map"] == "iga-map1"
    occupied[4, 4] ^= True
    asked["scene"] = scene(occupied, name="iga-map1", corners="allow")
    assert client.post("/config", json=asked).json()["map_file"] == "studio.map"


def test_a_planner_that_is_none_is_told_with_what_was_meant(client):
    refused = told(client.post("/config", json={"scene": scene(), "planner": {"use": "imag"}}))
    assert refused["where"] == "planner"
    assert "did you mean" in refused["message"]
