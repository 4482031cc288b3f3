"""The file of a study: what goes in comes out, and nothing half-done ever stands in it."""

import csv
import sqlite3
from contextlib import closing

import numpy as np
import pytest

import pathloom as pl
from pathloom.study import NAMES, StudyError, schema
from pathloom.study.lock import Lock
from pathloom.study.store import Finished, Key, Store, packed, unpacked
from study.conftest import rows_of

ASKED = {"swap": {"population": [10]}, "runs": 2, "budget": "generations=3", "corners": "allow", "workers": 1}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A small study, to be read only."""
    out = tmp_path_factory.mktemp("study") / "s.db"
    pl.ablate("imga", maps=["iga-map1", "random-8:9"], out=out, **ASKED).close()
    return out


@pytest.fixture
def copy(file, tmp_path):
    """The same, to be spoilt."""
    out = tmp_path / "s.db"
    out.write_bytes(file.read_bytes())
    return out


def test_a_study_is_one_file(file):
    assert [path.name for path in file.parent.iterdir()] == ["s.db"]


def test_rows_come_by_map_seed_and_variant(file):
    with pl.Study.open(file) as study:
        found = [(row.map, row.seed, row.variant) for row in study.each()]
        assert study.rows() == list(study.each())
    assert found == [
        (m, seed, v) for m in ("iga-map1", "random-8:9") for seed in (0, 1) for v in ("imga", "population=10")
    ]  # fmt: skip


def test_a_row_says_what_planning_alone_would_have_said(file):
    with pl.Study.open(file) as study:
        for row in study.each():
            alone = pl.plan(study.problem(row), study.planner(row), seed=row.seed, optimum=True)
            assert row.status == alone.status == "found"
            assert (row.length, row.turns, row.fitness) == (alone.length, alone.metrics["turns"], alone.fitness)
            assert (row.gap_grid, row.gap_any_angle) == (alone.gap["grid"], alone.gap["any_angle"])
            assert (row.evaluations, row.generations) == (alone.budget["evaluations"], 3)
            assert study.path(row).tolist() == alone.path.tolist()
            history = study.history(row)
            for name in ("evaluations", "best", "generation_best", "mean", "diversity"):
                assert getattr(history, name).tolist() == alone.history[name]


def test_the_answers_on_the_way_end_with_the_last_one(file):
    with pl.Study.open(file) as study:
        for row in study.each():
            history = study.history(row)
            assert history.answer_lengths[-1] == pytest.approx(row.length, abs=1e-12)
            assert history.answer_evaluations[0] == row.evaluations_to_first
            near = np.flatnonzero(history.answer_lengths <= 1.01 * study.instances[row.map].any_angle)
            assert row.evaluations_to_one_percent == (history.answer_evaluations[near[0]] if len(near) else None)


def test_maps_and_planners_come_out_as_they_went_in(file):
    with pl.Study.open(file) as study:
        assert study.problem("iga-map1").grid == pl.load_map("iga-map1")
        assert study.problem("iga-map1").corners == "allow"
        assert study.planner("population=10").population == 10
        assert list(study.variants) == ["imga", "population=10"]
        assert study.changes["population=10"] == {"population": "10"}


def test_status_counts(file):
    with pl.Study.open(file) as study:
        status = study.status
    assert (status.done, status.total, status.complete, status.instances, status.runs) == (8, 8, True, 2, 2)
    assert status.variants == {"imga": {"found": 4}, "population=10": {"found": 4}}


def test_the_same_again_does_nothing(copy):
    before = rows_of(copy)
    told = []
    pl.ablate("imga", maps=["iga-map1", "random-8:9"], out=copy, watch=told.append, **ASKED).close()
    assert (rows_of(copy), told) == (before, [])


def test_more_runs_maps_and_variants_are_added(copy):
    more = {**ASKED, "runs": 3, "swap": {"population": [10, 12]}}
    with pl.ablate("imga", maps=["iga-map1", "random-8:9:s1"], out=copy, **more) as study:
        assert study.status.done == study.status.total == 3 * 3 * 3


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"budget": "generations=4"}, "its budget is 3 generations, not 4 generations"),
        ({"seed": 1}, "its seed is 0, not 1"),
        ({"corners": "strict"}, "map 'iga-map1' is another one there"),
        ({"time_limit": 3.0}, "its time limit is None, not 3.0"),
    ],
)
def test_another_study_in_the_file_is_left_alone(copy, change, says):
    before = copy.read_bytes()
    with pytest.raises(StudyError, match="holds another study") as refused:
        pl.ablate("imga", maps="iga-map1", out=copy, **{**ASKED, **change})
    assert says in str(refused.value)
    assert copy.read_bytes() == before


def test_another_base_is_another_study(copy):
    with pytest.raises(StudyError, match="its base is 'imga', not 'agacd'"):
        pl.ablate("agacd", maps="iga-map1", out=copy, **ASKED)
    with pytest.raises(StudyError, match="variant 'imga' has other parameters there"):
        pl.ablate({"use": "imga", "crossover": {"rate": 0.5}}, maps="iga-map1", out=copy, **ASKED)


def test_two_processes_do_not_write_to_one_study(copy):
    with Lock(copy), pytest.raises(StudyError, match=r"process \d+ on .* is adding runs to it"):
        pl.ablate("imga", maps="iga-map1", out=copy, **ASKED)
    with Lock(copy), pl.Study.open(copy) as study, pytest.raises(StudyError, match="is adding runs to it"):
        study.resume()
    assert not copy.with_name("s.db-lock").exists()


def test_other_versions_are_not_mixed_unawares(copy, monkeypatch):
    from pathloom.study import session

    def other(configs, real=session.environment):
        return {**real(configs), "numpy": "9.9"}

    monkeypatch.setattr(session, "environment", other)
    with pl.Study.open(copy) as study:
        with pytest.raises(StudyError, match=r"began with numpy .*, found 9.9 here"):
            study.resume()
        study.resume(mixed=True)


# Files that are no study, or none any more.


def refused(path, says):
    with pytest.raises(StudyError) as error:
        pl.Study.open(path)
    assert says in str(error.value)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_a_file_that_is_no_study_is_refused(tmp_path):
    path = tmp_path / "s.db"
    refused(path, "found no such file")
    path.write_text("This is not a database, and it is long enough to look at. " * 40)
    refused(path, "found a file that is no study")
    before = path.read_bytes()
    with pytest.raises(StudyError, match="no study"):
        pl.ablate("imga", maps="iga-map1", out=path, **ASKED)
    assert path.read_bytes() == before
    other = tmp_path / "other.db"
    with closing(sqlite3.connect(other)) as db:
        db.executescript("CREATE TABLE t (x); INSERT INTO t VALUES (1);")
    refused(other, "a database that is no study")
    refused(tmp_path, "found no such file")


def test_a_study_of_a_newer_version_is_refused(copy):
    db = sqlite3.connect(copy)
    db.execute("PRAGMA user_version = 99")
    db.close()
    refused(copy, "found a study of version 99, allowed up to 1: it was written by a newer pathloom")


def test_a_study_of_an_older_version_is_brought_up_to_date(copy, monkeypatch):
    before = rows_of(copy)
    monkeypatch.setattr(
        "pathloom.study.store.MIGRATIONS", (*schema.MIGRATIONS, "ALTER TABLE runs ADD COLUMN mood TEXT")
    )
    monkeypatch.setattr("pathloom.study.store.VERSION", 2)
    with pl.Study.open(copy) as study:
        assert list(study._store.reading("SELECT DISTINCT mood FROM runs")) == [(None,)]
    assert rows_of(copy) == before
    with closing(sqlite3.connect(copy)) as db:
        assert db.execute("PRAGMA user_version").fetchone() == (2,)


def test_a_migration_that_fails_leaves_the_file_as_it_was(copy, monkeypatch):
    monkeypatch.setattr(
        "pathloom.study.store.MIGRATIONS",
        (*schema.MIGRATIONS, "ALTER TABLE runs ADD COLUMN mood TEXT; SELECT nonsense"),
    )
    monkeypatch.setattr("pathloom.study.store.VERSION", 2)
    with pytest.raises(StudyError):
        pl.Study.open(copy)
    monkeypatch.undo()
    assert len(rows_of(copy)) == 8


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_a_damaged_file_is_told_and_not_written_to(copy, share):
    content = bytearray(copy.read_bytes())
    at = int(len(content) * share) // 4096 * 4096
    content[at : at + 4096] = b"\xff" * 4096
    copy.write_bytes(content)
    with pytest.raises(StudyError, match=r"damaged|no study|another study") as refused:
        pl.ablate("imga", maps=["iga-map1", "random-8:9"], out=copy, **{**ASKED, "runs": 5})
    assert "\n" not in str(refused.value)
    assert copy.read_bytes() == bytes(content)


def test_a_full_disk_costs_no_run_that_is_done(tmp_path, monkeypatch):
    out, real = tmp_path / "s.db", Store.write

    def write(store, finished):
        if store.count() >= 3:
            pages = store._pragma("page_count")
            store._db.execute(f"PRAGMA max_page_count = {pages}")
        real(store, finished)

    asked = {**ASKED, "runs": 20}
    monkeypatch.setattr(Store, "write", write)
    with pytest.raises(StudyError, match=r"no room to write .*the runs so far are kept") as refused:
        pl.ablate("imga", maps=["iga-map1"], out=out, **asked)
    assert "\n" not in str(refused.value)
    monkeypatch.undo()
    kept = len(rows_of(out))
    assert 3 <= kept < 40
    pl.ablate("imga", maps=["iga-map1"], out=out, **asked).close()
    whole = pl.ablate("imga", maps=["iga-map1"], out=tmp_path / "whole.db", **asked)
    whole.close()
    assert rows_of(out) == rows_of(tmp_path / "whole.db")


def test_runs_are_written_all_or_none(copy):
    store = Store(copy)
    store.environment({"numpy": "1"})
    wrong = Finished(Key(99, 0, 1), {"status": "found", "attempts": 1})
    right = Finished(Key(1, 7, 1), {"status": "found", "attempts": 1})
    with pytest.raises((StudyError, TypeError)):
        store.write([right, wrong])
    assert store.count() == 8
    store.write([right, right])
    assert store.count() == 9
    store.close()


# Taking results elsewhere.


def test_a_table_has_a_line_for_each_run(file, tmp_path):
    with pl.Study.open(file) as study:
        assert study.export(csv=tmp_path / "s.csv", parquet=tmp_path / "s.parquet") == 8
        rows = study.rows()
    with (tmp_path / "s.csv").open(newline="") as lines:
        found = list(csv.DictReader(lines))
    assert list(found[0]) == list(NAMES)
    assert [float(line["length"]) for line in found] == [row.length for row in rows]
    assert {line["hypervolume"] for line in found} == {""}


def test_parquet_says_the_same(file, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    with pl.Study.open(file) as study:
        study.export(parquet=tmp_path / "s.parquet")
        rows = study.rows()
    table = parquet.read_table(tmp_path / "s.parquet").to_pylist()
    assert [list(line.values()) for line in table] == [[getattr(row, name) for name in NAMES] for row in rows]
    assert [p.name for p in tmp_path.iterdir()] == ["s.parquet"]


def test_an_export_that_fails_leaves_nothing_behind(file, tmp_path):
    with pl.Study.open(file) as study, pytest.raises(pl.MapError, match="not writable|a folder"):
        study.export(csv=tmp_path / "nowhere" / "s.csv")
    with pl.Study.open(file) as study, pytest.raises(pl.MapError, match="a folder"):
        study.export(csv=tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_the_view_says_what_the_rows_say(file):
    with pl.Study.open(file) as study:
        rows = study.rows()
    db = sqlite3.connect(file)
    found = db.execute(f"SELECT {', '.join(NAMES)} FROM results").fetchall()
    db.close()
    assert found == [tuple(getattr(row, name) for name in NAMES) for row in rows]


def test_what_is_packed_can_be_unpacked():
    assert unpacked(packed({"a": [1, 0.1, None], "b": "é"})) == {"a": [1, 0.1, None], "b": "é"}
    assert unpacked(packed([float("inf"), float("nan")])) == [None, None]
