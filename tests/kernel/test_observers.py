"""Observers: they see every state, change none, and leave in order whatever ends the run."""

import json
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.json_lines import JsonLines
from pathloom.kernel.run import run
from pathloom.kernel.snapshots import Snapshots
from pathloom.kernel.storing import load_state, pack
from pathloom.study.design import comparison

SHORT = {"use": "imga", "population": 20, "termination": {"use": "max-generations", "limit": 7}}


@pytest.fixture
def problem():
    return pl.PathProblem(pl.load_map("iga-map1"), corners="allow")


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def timeless(state):
    """Return a state, and those within it, without what a clock says."""
    inner = {name: timeless(part) for name, part in vars(state).items() if isinstance(part, pl.State)}
    return replace(state, seconds=0.0, **inner)


@dataclass(frozen=True, kw_only=True)
class Diary(pl.Observer):
    """Note when a run begins, goes on and ends."""

    notes: tuple[str, ...] = ()

    @contextmanager
    def watch(self, problem, planner):
        NOTES.append(f"begin {planner.name}")
        try:
            yield lambda state: NOTES.append(state.generation)
        finally:
            NOTES.append("end")


NOTES = []


@pytest.fixture
def notes():
    NOTES.clear()
    return NOTES


def test_a_watcher_begins_before_the_first_state_and_ends_after_the_last(problem, notes):
    run(problem, pl.compose(SHORT, observers=[Diary()]), 1)
    assert notes == ["begin imga", *range(8), "end"]


def test_a_watcher_ends_at_once_when_nobody_asks_for_more_states(problem, notes):
    for state in pl.iterate(problem, pl.compose(SHORT, observers=[Diary()])):
        if state.generation == 2:
            break
    assert notes == ["begin imga", 0, 1, 2, "end"]


def test_a_watcher_ends_when_a_run_is_interrupted_or_its_time_is_over(problem, notes):
    def press(state):
        if state.generation == 3:
            raise KeyboardInterrupt

    planner = pl.compose(SHORT, observers=[Diary()])
    assert run(problem, planner, 1, watch=press).interrupted
    assert notes == ["begin imga", 0, 1, 2, 3, "end"]
    run(problem, planner, 1, time_limit=1e-9)
    assert notes[6:] == ["begin imga", 0, "end"]


def test_a_watcher_ends_when_the_planner_fails(problem, notes):
    @dataclass(frozen=True, kw_only=True)
    class Faulty(pl.Mutation):
        def apply(self, population, chosen, problem, rng):
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        run(problem, pl.compose(SHORT, observers=[Diary()], mutation=Faulty()), 1)
    assert notes == ["begin imga", 0, "end"]


@pytest.mark.parametrize("planner", ["loom", "imga", "aco", "pso", "nsga2"])
def test_all_observers_together_change_nothing_but_the_config(here, problem, planner):
    everybody = ["progress", "json-lines", {"use": "snapshots", "every": 5}, {"use": "live", "every": 1000.0}]
    short = pl.compose(planner, termination={"use": "max-generations", "limit": 7})
    plain = pl.plan(problem, short, seed=7).to_dict()
    watched = pl.plan(problem, pl.compose(short, observers=everybody), seed=7).to_dict()
    for document in (plain, watched):
        budget = document["budget"]
        document["budget"] = {k: v for k, v in budget.items() if k != "phases" and not k.startswith("seconds")}
    assert [one["use"] for one in watched["config"]["planner"].pop("observers")] == [
        "progress", "json-lines", "snapshots", "live",
    ]  # fmt: skip
    plain["config"]["planner"].pop("observers")
    assert watched == plain


def test_json_lines_tell_each_generation(here, problem):
    result = pl.plan(problem, pl.compose(SHORT, observers={"use": "json-lines", "file": "log.jsonl"}), seed=3)
    lines = [json.loads(line) for line in (here / "log.jsonl").read_text().splitlines()]
    assert [line["generation"] for line in lines] == list(range(8))
    for name in ("evaluations", "best", "generation_best", "mean", "diversity"):
        assert [line[name] for line in lines] == result.history[name]
    assert lines[-1]["values"].keys() == {"length", "safety", "energy"}


def test_json_lines_can_be_read_while_the_run_goes_on(here, problem):
    seen = []
    planner = pl.compose(SHORT, observers=[JsonLines()])
    pl.plan(problem, planner, watch=lambda _: seen.append((here / "run.jsonl").read_text().count("\n")))
    assert seen == list(range(1, 9))


def test_json_lines_say_null_where_nothing_is_known_yet(here):
    from pathloom.kernel.json_lines import line

    state = pl.State(None, {})
    assert line(state, pl.compose("imga"))["best"] is None


@pytest.mark.parametrize("observer", ["json-lines", "snapshots"])
def test_a_place_that_cannot_be_written_is_told_before_the_first_individual(here, problem, observer):
    field = "file" if observer == "json-lines" else "folder"
    planner = pl.compose(SHORT, observers={"use": observer, field: "no/such/place"})
    with pytest.raises(pl.PathloomError, match=r"no/such/place: found no such folder"):
        pl.plan(problem, planner, watch=lambda _: pytest.fail("it had begun"))


def test_snapshots_keep_every_so_many_states_and_the_last_one(here, problem):
    pl.plan(problem, pl.compose(SHORT, observers={"use": "snapshots", "every": 3, "folder": "kept"}))
    assert sorted(file.name for file in (here / "kept").iterdir()) == [
        f"generation-{n:06d}.npz" for n in (0, 3, 6, 7)
    ]  # fmt: skip


def test_an_interrupted_run_is_taken_up_where_it_stopped_and_ends_as_the_whole_one(here, problem):
    planner = pl.compose(SHORT, observers=[Snapshots(every=100)])
    whole = list(pl.iterate(problem, planner.unwatched, seed=5))

    def press(state):
        if state.generation == 4:
            raise KeyboardInterrupt

    run(problem, planner, 5, watch=press)
    kept = pl.load_state("snapshots/generation-000004.npz", problem, planner)
    rest = list(pl.iterate(problem, planner.unwatched, state=kept))
    assert [state.generation for state in rest] == [4, 5, 6, 7]
    assert pack(timeless(rest[-1]), planner) == pack(timeless(whole[-1]), planner)


EVERY_KIND_OF_STATE = ["loom", "imga", "mpmga", "aco", "hga-aco", "pso", "gwo", "afsa-grid", "rrt", "nsga3", "rvea", "any-angle"]  # fmt: skip


@pytest.mark.parametrize("name", EVERY_KIND_OF_STATE)
def test_a_state_that_was_saved_goes_on_bit_for_bit(tmp_path, problem, name):
    planner = pl.compose(name)
    state = planner.start(problem, np.random.default_rng(3))
    for _ in range(0 if name == "any-angle" else 3):
        state = planner.step(state)
    (tmp_path / "state.npz").write_bytes(pack(state, planner))
    again = load_state(tmp_path / "state.npz", problem, planner)
    assert type(again) is type(state)
    assert pack(again, planner) == pack(state, planner)
    if name != "any-angle":
        after, later = (pack(timeless(planner.step(one)), planner) for one in (state, again))
        assert after == later


@pytest.fixture
def kept(here, problem):
    pl.plan(problem, pl.compose(SHORT, observers=[Snapshots()]))
    return here / "snapshots" / "generation-000000.npz"


def test_a_state_of_another_problem_or_planner_is_refused_in_one_line(kept, problem):
    with pytest.raises(pl.ConfigError, match=r"generation-000000.npz: found a state of another problem"):
        pl.load_state(kept, replace(problem, start=(0, 0)), "imga")
    with pytest.raises(pl.ConfigError, match="found a state of the planner 'imga/imga', allowed one of 'iga/iga'"):
        pl.load_state(kept, problem, "iga")


def test_a_damaged_file_is_refused_in_one_line(kept, problem):
    whole = kept.read_bytes()
    (kept.parent / "text.npz").write_text("no state")
    np.savez(kept.parent / "other.npz", a=np.zeros(3))
    np.save(kept.parent / "array.npy", np.zeros(3))
    for cut in range(0, len(whole), 997):
        (kept.parent / f"{cut}.npz").write_bytes(whole[:cut] + bytes([whole[cut] ^ 255]) + whole[cut + 1 :])
    refused = []
    for file in sorted(kept.parent.iterdir()):
        try:
            pl.load_state(file, problem, "imga")
        except pl.PathloomError as error:
            refused.append((str(file), str(error)))
    assert len(refused) >= 3 + 0.5 * len(whole) / 997  # a byte of the archive's own padding does no harm
    assert all(said.startswith(f"{file}: ") and "\n" not in said for file, said in refused)


def test_a_file_that_names_a_class_outside_of_the_planners_data_gets_none(tmp_path, problem):
    planner = pl.compose("imga")
    for name in ("subprocess:Popen", "os:stat_result", "pathloom.kernel.registry:Registry", "nowhere:Nothing"):
        form = {"class": name, "fields": {}}
        text = json.dumps(
            {"schema": "pathloom.state/1", "planner": "imga/imga", "problem": problem.fingerprint, "state": form}
        )
        np.savez(tmp_path / "forged.npz", state=np.frombuffer(text.encode(), np.uint8))
        with pytest.raises(pl.ConfigError, match="the planner knows no data of the kind"):
            pl.load_state(tmp_path / "forged.npz", problem, planner)


def test_a_state_that_holds_no_plain_data_is_not_saved(problem):
    planner = pl.compose("imga")
    state = planner.start(problem, np.random.default_rng(0))
    with pytest.raises(pl.ConfigError, match="a state cannot be saved that holds builtins:set"):
        pack(replace(state, counts={"a": {1}}), planner)


def test_a_study_watches_nobody_so_that_its_configs_are_those_of_what_is_computed():
    watched = pl.compose(SHORT, observers=["json-lines", "snapshots"])
    assert comparison({"short": watched})[0].planner == pl.compose(SHORT)
