"""A run over the socket: nothing moves that nobody asked for, and nothing that is said breaks it."""

import contextlib
import json
import threading
import time

import numpy as np
import pytest

import pathloom as pl
from pathloom.exact import validate
from studio.conftest import HOME, SOCKET, TOKEN, quick, scene, wall


@contextlib.contextmanager
def page(client):
    with client.websocket_connect(SOCKET, headers={"Origin": HOME}) as socket:
        yield socket


def begin(socket, planner=None, lane=0, run=1, seed=3, **settings):
    asked = {"scene": settings.pop("scene", None) or scene(wall(gap=2)), "planner": planner or quick(), "seed": seed}
    socket.send_json({"type": "begin", "lane": lane, "run": run, "asked": asked | settings})


def more(socket, generations=1, lane=0, run=1):
    socket.send_json({"type": "more", "lane": lane, "run": run, "generations": generations})


def heard(socket):
    while (message := socket.receive_json())["type"] == "compiling":
        pass
    return message


def whole(socket, generations=64):
    """Return all that is said of a run to its end."""
    more(socket, generations)
    said = [heard(socket)]
    while said[-1]["type"] not in ("ended", "refused"):
        said.append(heard(socket))
    return said


def test_a_run_is_the_same_as_without_the_page(client):
    with page(client) as socket:
        begin(socket)
        begun, *generations, ended = whole(socket)
    problem = pl.PathProblem(wall(gap=2))
    result = pl.plan(problem, quick(), seed=3, optimum=True)
    assert (begun["type"], begun["planner"], begun["generations"]) == ("begun", "imga", 5)
    assert [frame["generation"] for frame in generations] == list(range(6))
    assert ended["path"] == (result.path @ [12, 1]).tolist()
    for part in ("metrics", "history", "gap", "config", "objectives"):
        document = json.loads(result.to_json())
        document["config"]["problem"]["map"] = document["problem"]["map"] = "studio"
        assert ended["result"][part] == document[part]
    assert generations[-1]["fitness"] == result.history["best"][-1]
    assert generations[-1]["evaluations"] == result.history["evaluations"][-1]


def test_every_frame_holds_what_is_drawn(client):
    problem = pl.PathProblem(wall(gap=2))
    with page(client) as socket:
        begin(socket)
        _, *generations, _ = whole(socket)
    states = list(pl.iterate(problem, quick(), seed=3))
    for frame, state in zip(generations, states, strict=True):
        assert frame["individuals"] == 20
        rows = {tuple(row[row >= 0].tolist()) for row in state.population}
        assert {tuple(path) for path in frame["paths"]} == rows
        best = problem.representation.decode(np.array(frame["best"], np.int32))
        assert validate(best, problem) is None
        assert frame["length"] == pytest.approx(np.hypot(*np.diff(best, axis=0).T).sum())
        assert frame["rates"] == {"crossover": pytest.approx([0.8] * 3), "mutation": pytest.approx([0.2] * 3)}


def test_adaptive_probabilities_are_told_with_their_spread(client):
    planner = quick(crossover={"use": "imga/common-node", "probability": "iga/sinc-adaptive"})
    with page(client) as socket:
        begin(socket, planner)
        _, first, *_ = whole(socket)
    low, mean, high = first["rates"]["crossover"]
    assert 0 <= low < mean < high <= 1


def test_nothing_moves_that_nobody_asked_for(client):
    with page(client) as socket:
        begin(socket)
        assert heard(socket)["type"] == "begun"
        more(socket, 2)
        assert [heard(socket)["generation"] for _ in range(2)] == [0, 1]
        time.sleep(0.1)
        more(socket)
        assert heard(socket)["generation"] == 2  # the next one, not one that came meanwhile


def test_asking_far_ahead_is_bounded(client, monkeypatch):
    from pathloom.studio import lane

    kept = []
    monkeypatch.setattr(
        lane.Lane, "more", lambda self, n, real=lane.Lane.more: (real(self, n), kept.append(self._wanted))
    )
    with page(client) as socket:
        begin(socket, quick(generations=1000))
        for _ in range(20):
            more(socket, 64)
        begin(socket, quick(generations=2), run=2)
        more(socket, 64, run=2)
        while (message := heard(socket))["type"] != "ended":
            pass
    assert message["run"] == 2
    assert max(kept) <= 64


def test_two_planners_run_side_by_side(client):
    with page(client) as socket:
        begin(socket, lane=0)
        begin(socket, quick("iga", 3), lane=1, run=2)
        more(socket, 64)
        more(socket, 64, lane=1, run=2)
        ended = {}
        while len(ended) < 2:
            message = heard(socket)
            if message["type"] == "ended":
                ended[message["lane"]] = message["result"]["planner"]
    assert ended == {0: "imga", 1: "iga"}


def test_a_front_is_told_generation_by_generation_and_verified_at_the_end(client):
    problem = pl.PathProblem(wall(gap=2))
    with page(client) as socket:
        begin(socket, {"use": "nsga2", "population": 20, "termination": [{"use": "max-generations", "limit": 6}]})
        begun, *generations, ended = whole(socket)
    front = pl.pareto(
        problem, {"use": "nsga2", "population": 20, "termination": [{"use": "max-generations", "limit": 6}]}, seed=3
    )
    assert begun["objectives"] == list(front.objectives)
    assert all(frame["front"]["values"] for frame in generations)
    assert ended["front"]["values"] == front.values.tolist()
    assert [(path @ [12, 1]).tolist() for path in front.paths] == ended["front"]["paths"]
    assert ended["front"]["knee"] == front.choice.knee


@pytest.mark.parametrize("planner", ["any-angle", "dijkstra", "rrt", "s-rrt", "aco", "pso", "hga-aco", "bezier-ga"])
def test_planners_of_every_sort_can_be_watched(client, planner):
    table = {"use": planner}
    if planner in ("aco", "pso", "bezier-ga"):
        table["termination"] = [{"use": "max-generations", "limit": 2}]
    with page(client) as socket:
        begin(socket, table)
        begun, *generations, ended = whole(socket) if planner != "hga-aco" else (heard(socket), None, None)
        if planner == "hga-aco":
            more(socket, 2)
            generations, ended = [heard(socket), heard(socket)], {"type": "ended"}
    assert begun["type"] == "begun"
    assert generations
    assert ended["type"] == "ended", ended


def test_an_unreachable_goal_is_said_before_any_generation(client):
    with page(client) as socket:
        begin(socket, scene=scene(wall(gap=None)))
        refused = heard(socket)
    assert (refused["type"], refused["where"], refused["lane"], refused["run"]) == ("refused", "goal", 0, 1)
    assert "cannot be reached" in refused["message"]


@pytest.mark.parametrize(
    ("planner", "says"),
    [
        ({"use": "imag"}, "did you mean"),
        ({}, "needs 'use'"),
        ({"use": "imga", "selection": "roulete"}, "roulette"),
        ({"use": "imga", "population": 10**9}, "at most 5000"),
        ({"use": "hga-aco", "genetic": {"use": "ga-hga-aco", "population": 10**6}}, "at most 5000"),
        ({"use": "imga", "population": -1}, "integer"),
    ],
)
def test_a_planner_that_cannot_be_is_refused_where_it_is_chosen(client, planner, says):
    with page(client) as socket:
        begin(socket, planner or {"nothing": 1})
        refused = heard(socket)
    assert (refused["type"], refused["where"]) == ("refused", "planner")
    assert says in refused["message"]


GARBAGE = [
    "", "nothing", "null", "[]", "{}", '{"type": "begin"}', '{"type": "evil", "lane": 0}', '{"type": "more", "lane": 7}',
    '{"type": "more", "lane": 0, "run": 1, "generations": 1e9}', '{"type": "stop", "lane": 0, "more": 1}', "[" * 100_000,
    '{"type":"begin","lane":0,"run":1,"asked":{"scene":' + json.dumps(scene()) + ',"planner":{"use":' + '{"use":' * 5000,
    "\x00\x01", '"' + "x" * 100_000 + '"',
]  # fmt: skip


def test_garbage_over_the_socket_is_refused_and_the_run_goes_on(client):
    with page(client) as socket:
        begin(socket)
        assert heard(socket)["type"] == "begun"
        for text in GARBAGE:
            socket.send_text(text)
            refused = heard(socket)
            assert (refused["type"], refused["run"]) == ("refused", None)
            assert len(refused["message"]) < 400
            assert "\n" not in refused["message"]
        socket.send_bytes(b"\xff\x00")
        assert heard(socket)["type"] == "refused"
        assert whole(socket)[-1]["type"] == "ended"


def test_parts_within_parts_without_end_are_refused(client):
    deep = {"use": "in-turn", "steps": []}
    for _ in range(300):
        deep = {"use": "in-turn", "steps": [deep]}
    with page(client) as socket:
        begin(socket, quick(repair=deep))
        assert heard(socket)["type"] == "refused"
        begin(socket, run=2)
        assert heard(socket)["type"] == "begun"


def test_a_new_run_silences_the_one_before(client):
    with page(client) as socket:
        begin(socket)
        more(socket, 64)
        begin(socket, quick(generations=2), run=2)
        more(socket, 64, run=2)
        said = [heard(socket)]
        while said[-1]["type"] != "ended" or said[-1]["run"] != 2:
            said.append(heard(socket))
        assert "refused" not in {message["type"] for message in said}
        first = next(k for k, message in enumerate(said) if message["run"] == 2)
        assert all(message["run"] == 2 for message in said[first:])


def test_what_a_plugin_raises_is_said_and_not_lost(client, monkeypatch):
    from pathloom_imga.selection import ThreeLayer

    def fail(self, fitness, n, rng):
        raise ZeroDivisionError("in the midst")

    monkeypatch.setattr(ThreeLayer, "select", fail)
    with page(client) as socket:
        begin(socket)
        refused = whole(socket)[-1]
    assert "a defect, please report it: ZeroDivisionError: in the midst" in refused["message"]


def test_a_closed_page_ends_its_runs_and_frees_its_place(client):
    from pathloom.studio.app import MOST_PAGES

    for run in range(MOST_PAGES + 4):
        with page(client) as socket:
            begin(socket, quick(generations=10**6), run=run)
            assert heard(socket)["type"] == "begun"
            more(socket, 64, run=run)
    with page(client) as socket:  # there is room, and there are hands
        begin(socket)
        assert whole(socket)[-1]["type"] == "ended"
    deadline = time.monotonic() + 10
    while (left := [t for t in threading.enumerate() if t.name == "pathloom studio"]) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert left == []


def test_too_many_pages_are_told_so(client):
    from starlette.websockets import WebSocketDisconnect

    from pathloom.studio.app import MOST_PAGES

    with contextlib.ExitStack() as stack:
        for _ in range(MOST_PAGES):
            stack.enter_context(page(client))
        with page(client) as socket, pytest.raises(WebSocketDisconnect) as left:
            socket.receive_json()
    assert left.value.reason == f"{MOST_PAGES} pages are open already"


def test_a_second_page_does_not_disturb_the_first(client):
    assert client.get("/", params={"token": TOKEN}).status_code == 200
    with page(client) as first, page(client) as second:
        begin(first)
        begin(second, seed=9)
        mine, other = whole(first), whole(second)
    with page(client) as alone:
        begin(alone)
        again = whole(alone)
    assert [m.get("paths") for m in mine] == [m.get("paths") for m in again]
    assert mine[-1]["result"]["seed"] == 3
    assert other[-1]["result"]["seed"] == 9
