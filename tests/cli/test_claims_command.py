"""`pathloom claims`: what the papers say, measured again."""

import pytest

import pathloom as pl
from pathloom.claims import Bench, smaller, untestable, verdict


class Table9(pl.Claim):
    """A claim about nothing."""

    source = "Nobody 2020, table 9"

    def examine(self, bench):
        yield pl.Finding("table 9", "always 1", f"{bench.seeds(30, 3)} of 30", verdict(bench.full, True))
        yield untestable("table 9", "never 2", "nobody saw it")


@pytest.fixture
def nobodys(monkeypatch):
    monkeypatch.setattr("pathloom.claims.claims_of", lambda plugin: iter([("nobody", Table9())]))


def test_the_table_has_what_is_said_what_is_measured_and_the_verdict(cli, nobodys):
    shown = cli("claims", "nobody").out
    assert "the paper says" in shown
    assert "3 of 30" in shown
    assert "2 statements: 1 holds in direction, 1 not testable." in shown


def test_full_runs_as_often_as_the_paper(cli, nobodys):
    document = cli("claims", "nobody", "--full", "--json").document
    assert document["schema"] == "pathloom.claims/1"
    assert document["full"] is True
    assert document["claims"][0] == {
        "plugin": "nobody", "claim": "table9", "source": "Nobody 2020, table 9", "place": "table 9",
        "says": "always 1", "measured": "30 of 30", "verdict": "holds", "timed": False,
    }  # fmt: skip


def test_markdown_is_a_table_for_the_plugins_page(cli, nobodys):
    lines = cli("claims", "--markdown").out.splitlines()
    assert lines[0] == "| plugin | where | the paper says | we measure | verdict |"
    assert lines[2] == "| nobody | table 9 | always 1 | 3 of 30 | holds in direction |"
    assert len(lines) == 4


def test_an_unknown_plugin_is_named_with_what_was_meant(refused):
    assert "no plugin is called 'imgaa'; did you mean 'imga'" in refused("claims", "imgaa")


def test_a_plugin_without_claims_says_so(refused):
    assert refused("claims", "maps") == "plugin 'maps' claims nothing"


def test_a_broken_claim_is_not_swallowed(cli, monkeypatch):
    class Broken(Table9):
        def examine(self, bench):
            raise ZeroDivisionError

    monkeypatch.setattr("pathloom.claims.claims_of", lambda plugin: iter([("nobody", Broken())]))
    assert cli("claims").code == 1


def test_the_bench_runs_each_combination_once(monkeypatch):
    calls = []
    plan = pl.plan
    monkeypatch.setattr("pathloom.claims.plan", lambda *a, **k: calls.append(k["seed"]) or plan(*a, **k))
    bench = Bench(full=False, data=None)
    problem = bench.problem("iga-map1")
    first = bench.runs("ga-imga", problem, 2)
    assert [r.seed for r in bench.runs({"use": "baselines/ga-imga"}, problem, 3)] == [0, 1, 2]
    assert bench.runs("ga-imga", problem, 1) == first[:1]
    bench.runs("imga", problem, 1)
    assert calls == [0, 1, 2, 0]


def test_a_map_that_is_not_at_hand_is_none(tmp_path):
    assert Bench(data=None).recovered("any.csv") is None
    assert Bench(data=tmp_path).recovered("any.csv") is None


def test_pairs_are_compared_by_signed_ranks():
    lead = smaller([1, 2, 3, 4, 5, 6], [2, 3, 4, 5, 6, 6])
    assert (lead.wins, lead.ties, lead.pairs) == (5, 1, 6)
    assert lead.p < 0.05
    assert smaller([1, 1], [1, 1]).p == 1.0
    assert str(lead).startswith("5 of 6 (1 ties), p = 0.0")


def test_verdicts():
    assert verdict(True) == "holds"
    assert verdict(False, True) == "holds in direction"
    assert verdict(False) == "does not hold"


def test_the_convergence_of_a_result_is_the_generation_that_found_its_best():
    result = pl.plan(pl.PathProblem(pl.load_map("iga-map1")), "imga")
    best = result.history["best"]
    assert best[result.convergence] == best[-1]
    assert result.convergence == 0 or best[result.convergence - 1] < best[-1]
