"""Bundles: all that another lab needs, and a stranger's is looked at before it is used."""

import hashlib
import json
import sqlite3
import stat
import tomllib
import warnings
import zipfile
import zlib
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import pathloom as pl
from pathloom.study import Study
from pathloom.study.bundle import bundle, verify
from pathloom.study.bundle.opening import opened, unzipped
from pathloom.study.errors import StudyError
from pathloom.study.papers import names, read
from pathloom.study.session import Workers

ONE = Workers(1)


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    """A study of two variants on two maps, and its bundle."""
    folder = tmp_path_factory.mktemp("bundle")
    walls = np.zeros((9, 9), bool)
    walls[3, 1:] = walls[6, :-1] = True
    quick = {"use": "imga", "population": 12, "termination": [{"use": "max-generations", "limit": 4}]}
    with pl.ablate(
        quick, swap={"selection": ["roulette"]}, maps=[pl.OccupancyGrid(walls, name="walls"), "random-8:9"], runs=2,
        budget="own", workers=1, out=folder / "s.db",
    ) as study:  # fmt: skip
        bundle(study, folder / "s.zip")
    return folder / "s.zip"


def members(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def remade(path: Path, content: dict[str, bytes]) -> Path:
    """Write a bundle whose sums are right, whatever is in it."""
    content["SHA256SUMS"] = "".join(
        f"{hashlib.sha256(data).hexdigest()}  {name}\n" for name, data in content.items() if name != "SHA256SUMS"
    ).encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in content.items():
            archive.writestr(name, data)
    return path


def doctored(packed: Path, tmp_path: Path, *statements: str) -> Path:
    """Return the bundle after something was done to its database."""
    content = members(packed)
    file = tmp_path / "x.db"
    file.write_bytes(content["study.db"])
    with sqlite3.connect(file) as db:
        for statement in statements:
            db.execute(statement)
    db.close()
    content["study.db"] = file.read_bytes()
    return remade(tmp_path / "x.zip", content)


def test_a_bundle_has_maps_configs_seeds_versions_and_results(packed):
    content = members(packed)
    design = json.loads(content["study.json"])
    assert (design["runs"], design["seed"], design["kind"]) == (2, 0, "ablate")
    assert design["versions"][0]["pathloom"]
    assert content["results.csv"].count(b"\n") == 9
    assert b"pathloom study verify" in content["README.md"]
    for variant in design["variants"]:
        pl.compose(tomllib.loads(content[variant["config"]].decode())["planner"])
    for place in design["instances"]:
        assert content[place["map"]].startswith(b"type octile")


def test_a_map_of_a_bundle_is_the_studys(packed, tmp_path):
    content = members(packed)
    for place in json.loads(content["study.json"])["instances"]:
        file = tmp_path / "m.map"
        file.write_bytes(content[place["map"]])
        assert pl.load_map(file).sha256 == place["map_sha256"]


def test_equal_studies_make_equal_bundles(packed, tmp_path):
    with Study.open(packed.with_name("s.db")) as study:
        bundle(study, tmp_path / "s.zip")
    assert (tmp_path / "s.zip").read_bytes() == packed.read_bytes()


def test_a_study_in_memory_is_refused(grid, tmp_path, opened):
    study = opened(pl.compare(["imga"], maps=[grid], runs=1, budget="evaluations=40", workers=1))
    with pytest.raises(StudyError, match="in memory"):
        bundle(study, tmp_path / "s.zip")


def test_a_bundle_as_it_was_made_is_verified(packed):
    found = verify(packed, sample=5, seed=1, workers=ONE)
    assert found.same
    assert (len(found.checks), found.runs, found.repeatable) == (5, 8, 8)
    assert len({(it.variant, it.map, it.seed) for it in found.checks}) == 5
    assert [(it.map, it.seed) for it in verify(packed, sample=5, seed=1, workers=ONE).checks] == [
        (it.map, it.seed) for it in found.checks
    ]


@pytest.mark.parametrize(
    ("statement", "what"),
    [
        ("UPDATE runs SET length = length + 1e-13 WHERE seed = 1", "length"),
        ("UPDATE runs SET turns = turns + 1 WHERE seed = 1", "turns"),
        ("UPDATE runs SET status = 'failed' WHERE seed = 1", "status"),
        ("UPDATE traces SET path = x'{}' WHERE run IN (SELECT id FROM runs WHERE seed = 1)", "path"),
    ],
)
def test_what_was_changed_is_found(packed, tmp_path, statement, what):
    path = doctored(packed, tmp_path, statement.format(zlib.compress(b"[[8,0],[0,8]]").hex()))
    found = verify(path, sample=8, workers=ONE)
    assert not found.same
    assert {it.seed for it in found.checks if what in it.differs} == {1}
    assert all(it.same for it in found.checks if it.seed == 0)


def test_an_optimum_that_was_changed_is_found(packed, tmp_path):
    path = doctored(packed, tmp_path, "UPDATE instances SET optimum_any_angle = optimum_any_angle - 0.5 WHERE id = 1")
    found = verify(path, sample=8, workers=ONE)
    assert [("optimum" in it.differs, "gap_any_angle" in it.differs) for it in found.checks] == [(True, True)] * 4 + [
        (False, False)
    ] * 4


def refusal(path: Path) -> str:
    with pytest.raises(StudyError) as error:
        verify(path, sample=1, workers=ONE)
    said = str(error.value)
    assert "\n" not in said
    assert str(path) in said
    return said


@pytest.mark.parametrize("name", ["../evil.txt", "/etc/evil", "a/../../evil", "C:\\evil", "maps\\evil", "a\nb"])
def test_names_that_lead_elsewhere_are_refused(packed, tmp_path, name):
    assert "allowed names within the bundle" in refusal(remade(tmp_path / "x.zip", {**members(packed), name: b"x"}))


def test_links_in_a_bundle_are_refused(packed, tmp_path):
    path = remade(tmp_path / "x.zip", members(packed))
    link = zipfile.ZipInfo("maps/link.map")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(link, "/etc/passwd")
    assert "found a link" in refusal(path)


def test_a_name_that_comes_twice_is_refused(packed, tmp_path):
    path = remade(tmp_path / "x.zip", members(packed))
    with zipfile.ZipFile(path, "a") as archive, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        archive.writestr("study.db", "x")
    assert "twice" in refusal(path)


def test_a_bundle_larger_than_allowed_is_refused(packed, tmp_path, monkeypatch):
    monkeypatch.setattr("pathloom.study.bundle.opening.LARGEST", 100_000)
    assert "allowed at most 100000" in refusal(remade(tmp_path / "x.zip", {**members(packed), "b": bytes(100_000)}))


def test_a_member_that_is_larger_than_it_states_is_refused(packed, tmp_path):
    data = packed.read_bytes()
    size = len(members(packed)["results.csv"]).to_bytes(4, "little")
    assert data.count(size) >= 2
    path = tmp_path / "x.zip"
    path.write_bytes(data.replace(size, (10).to_bytes(4, "little")))
    refusal(path)


@pytest.mark.parametrize("missing", ["study.db", "study.json", "SHA256SUMS"])
def test_a_bundle_without_its_parts_is_refused(packed, tmp_path, missing):
    content = members(packed)
    path = remade(tmp_path / "x.zip", content)
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in content.items():
            if name != missing:
                archive.writestr(name, data)
    assert f"found no {missing}" in refusal(path)


def test_content_other_than_its_sum_is_refused(packed, tmp_path):
    content = members(packed)
    content["results.csv"] += b"more"
    with zipfile.ZipFile(tmp_path / "x.zip", "w") as archive:
        for name, data in content.items():
            archive.writestr(name, data)
    assert "results.csv" in refusal(tmp_path / "x.zip")


@pytest.mark.parametrize(
    "statement",
    [
        "CREATE TRIGGER t AFTER INSERT ON runs BEGIN DELETE FROM runs; END",
        "CREATE VIEW w AS SELECT 1",
        "CREATE TABLE more (x)",
        "ALTER TABLE runs ADD COLUMN more",
        "PRAGMA user_version = 99",
        "PRAGMA application_id = 1",
        "UPDATE maps SET height = 1000000000",
        "UPDATE maps SET cells = x'00'",
        "UPDATE maps SET height = height - 1",
        "UPDATE study SET value = '{' WHERE name = 'budget'",
        "UPDATE study SET value = '[]' WHERE name = 'versions'",
        'UPDATE variants SET config = \'{"use": "os/system"}\'',
        "UPDATE variants SET config = '[[[['",
        "UPDATE runs SET seed = 'zero' WHERE id = 1",
        "UPDATE instances SET start_row = -1",
        "DELETE FROM study",
    ],
)
def test_a_database_that_is_no_study_of_ours_is_refused_in_one_line(packed, tmp_path, statement):
    refusal(doctored(packed, tmp_path, statement))


def test_a_bomb_in_a_map_is_not_unpacked(packed, tmp_path):
    bomb = zlib.compress(bytes(50_000_000), 9)
    said = refusal(doctored(packed, tmp_path, f"UPDATE maps SET cells = x'{bomb.hex()}'"))
    assert "larger than" in said
    with pytest.raises(ValueError, match="larger than"):
        unzipped(bomb, 1000)


@pytest.mark.parametrize("data", [b"", b"PK\x03\x04 nonsense", b"not a zip"])
def test_what_is_no_zip_file_is_refused(tmp_path, data):
    (tmp_path / "x.zip").write_bytes(data)
    assert "zip" in refusal(tmp_path / "x.zip")


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_compression_that_no_bundle_has_is_refused(packed, tmp_path, method):
    content = members(packed)
    with zipfile.ZipFile(tmp_path / "x.zip", "w", method) as archive:
        for name, data in content.items():
            archive.writestr(name, data)
    assert f"compression {method}" in refusal(tmp_path / "x.zip")


def test_an_archive_for_a_newer_zip_than_there_is_is_refused(packed, tmp_path):
    data = bytearray(packed.read_bytes())
    for at in range(len(data) - 4):
        if data[at : at + 4] == b"PK\x01\x02":
            data[at + 6] = 250  # the version that is needed to extract it
    (tmp_path / "x.zip").write_bytes(data)
    assert "no whole zip file" in refusal(tmp_path / "x.zip")


def test_a_fault_of_ours_while_a_bundle_is_open_is_no_fault_of_the_bundle(packed):
    def reads():
        with opened(packed):
            raise RuntimeError("a defect")

    with pytest.raises(RuntimeError, match="a defect"):
        reads()


def test_no_file_is_said_so(tmp_path):
    assert "no such file" in refusal(tmp_path / "none.zip")


# The papers' own ablations.


@pytest.mark.parametrize("name", ["agacd-deletion", "hga-aco-parts", "iga-steps", "imga-deletion", "imga-generations"])
def test_each_papers_ablation_has_a_design(name):
    assert names()[name][0].endswith("?")
    quick, full = read(name), read(name, full=True)
    assert 0 < quick.size < full.size
    assert [v.name for v in quick.variants] == [v.name for v in full.variants]
    assert {it.problem.corners for it in full.instances} == {"allow"}


def test_generations_are_20_50_100_and_200_and_nothing_else_stops_them():
    limits = [[t.limit for t in v.planner.termination] for v in read("imga-generations").variants]
    assert limits == [[20], [50], [100], [200]]


def test_the_steps_to_iga_are_four_and_a_fair_one():
    planners = {v.name: v.planner for v in read("iga-steps").variants}
    assert list(planners) == ["GA", "adaptive", "adaptive+deleting", "adaptive+deleting 600", "IGA"]
    assert [p.repair is not None for p in planners.values()] == [False, False, True, True, True]
    assert [p.migration is not None for p in planners.values()] == [False, False, False, False, True]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("maps = ['empty-8']", "base and planners"),
        ("colour = 1", "colour"),
        ("[base]\nuse = 'imga'\n[swap]\nselection = ['roulette']\n", "maps"),
        ("maps = 3\nwithout = ['refinement']\n[base]\nuse = 'imga'\n", "maps"),
        ("[planners\n", "no TOML"),
        ("maps = ['empty-8']\n[planners.a]\nuse = 'nobody'\n", "nobody"),
    ],
)
def test_a_file_that_is_no_study_is_refused_in_one_line(tmp_path, text, said):
    file = tmp_path / "s.toml"
    file.write_text(text)
    with pytest.raises(pl.PathloomError) as error:
        read(str(file))
    message = str(error.value)
    assert message.startswith(str(file))
    assert said in message
    assert "\n" not in message


def test_maps_of_a_file_are_beside_it(tmp_path):
    (tmp_path / "m.csv").write_text("0,0\n0,0\n")
    (tmp_path / "s.toml").write_text("maps = ['m.csv']\nruns = 1\nwithout = ['refinement']\n[base]\nuse = 'imga'\n")
    assert read(str(tmp_path / "s.toml")).instances[0].problem.grid.width == 2


def test_a_name_that_is_not_known_is_told_the_nearest():
    with pytest.raises(pl.ConfigError, match="did you mean 'imga-deletion'"):
        read("imga-deletions")


# The commands.


def call(module: str, *arguments: object) -> int | None:
    return import_module(f"pathloom.cli.{module}").command.main([*map(str, arguments)], standalone_mode=False)


def test_the_commands_pack_and_verify(packed, tmp_path, capsys):
    target = tmp_path / "b.zip"
    call("study_bundle", packed.with_name("s.db"), "-o", target)
    assert str(target) in capsys.readouterr().err
    assert call("study_verify", target, "--sample", 2, "--workers", 1, "--json") == 0
    document = json.loads(capsys.readouterr().out)
    assert (document["schema"], document["same"], document["runs"]) == ("pathloom.study-verification/1", True, 8)
    assert [it["differs"] for it in document["checks"]] == [[], []]


def test_the_command_says_what_differs_and_exits_with_2(packed, tmp_path, capsys):
    path = doctored(packed, tmp_path, "UPDATE runs SET nodes = 1 WHERE id = 1")
    assert call("study_verify", path, "--sample", 8, "--workers", 1) == 2
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 2
    assert said[0].endswith("differs in nodes")
    assert said[1].startswith("7 of 8 runs are as they were")


def test_the_command_lists_the_papers_ablations_and_runs_a_file(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call("study_run")
    assert "imga-deletion" in capsys.readouterr().out
    Path("mine.toml").write_text(
        "question = 'Why?'\nmaps = ['empty-6']\nruns = 9\nbudget = 'evaluations=60'\nwithout = ['refinement']\n"
        "[base]\nuse = 'imga'\npopulation = 12\n[quick]\nruns = 2\n"
    )
    assert call("study_run", "mine.toml", "--workers", 1) == 0
    assert "Success rate" in capsys.readouterr().out
    with Study.open("mine.db") as study:
        assert (len(study), study.facts["notes"][0]) == (4, "question: Why?")
