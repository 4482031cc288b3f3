"""The commands that make studies, and those that look at them."""

import csv

import pytest

from cli.conftest import one_line
from pathloom.cli.studying import duration, split
from pathloom.study.lock import Lock

ABLATE = ("ablate", "imga", "--swap", "population=10,12", "--maps", "iga-map1,random-8:9:x2", "--runs", 2, "--workers", 1,
          "--budget", "generations=3", "--corners", "allow", "--out", "s.db")  # fmt: skip


def test_an_ablation_from_beginning_to_end(cli, folder):
    done = cli(*ABLATE)
    assert done.code == 0, done.err
    assert done.out.splitlines()[0].split() == ["variant", "found", "of"]
    assert "s.db: 18 of 18 runs, 3 variants x 3 maps x 2 seeds, 3 generations" in done.out
    assert cli(*ABLATE).code == 0
    status = cli("study", "status", "s.db", "--json").document
    assert (status["schema"], status["done"], status["complete"]) == ("pathloom.study-status/1", 18, True)
    assert status["variants"]["population=12"] == {"found": 6}
    assert "18 of 18" in cli("study", "status", "s.db").out
    assert cli("study", "resume", "s.db", "--quiet").code == 0
    assert cli("study", "export", "s.db", "--csv", "s.csv", "--parquet", "s.parquet").code == 0
    with (folder / "s.csv").open() as lines:
        assert len(list(csv.DictReader(lines))) == 18
    with Lock(folder / "s.db"):
        assert "is adding runs to it" in one_line(cli(*ABLATE), code=2)


def test_a_config_is_a_base_and_brings_its_map(cli, folder):
    (folder / "c.toml").write_text(
        '[problem]\nmap = "iga-map1"\ncorners = "allow"\n[planner]\nuse = "imga"\npopulation = 20\n[run]\ntime_limit = 60\n'
    )
    done = cli("ablate", "c.toml", "--without", "mutation", "--runs", 1, "--workers", 1, "--budget", "generations=2",
               "--out", "s.db", "--json")  # fmt: skip
    assert done.document["variants"] == {"imga": {"found": 1}, "without mutation": {"found": 1}}
    assert done.document["time_limit"] == 60


def test_a_comparison_is_named_as_it_was_asked_for(cli, folder):
    (folder / "small.toml").write_text('[planner]\nuse = "imga"\npopulation = 20\n')
    done = cli("compare", "--planners", "dijkstra,small.toml", "--maps", "empty-6", "--runs", 1, "--workers", 1,
               "--budget", "evaluations=100", "--out", "c.db", "--json")  # fmt: skip
    assert done.document["variants"] == {"dijkstra": {"found": 1}, "small": {"found": 1}}


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        (("ablate", "imga", "--out", "s.db"), "found nothing to change"),
        (("ablate", "imgaa", "--swap", "selection=roulette", "--maps", "iga-map1", "--out", "s.db"), "imga"),
        (("ablate", "imga", "--swap", "selection=roulette", "--maps", "iga-map1"), "--out: found none"),
        (("ablate", "imga", "--swap", "selection=roulette", "--out", "s.db"), "--maps: found none"),
        (("ablate", "imga", "--swap", "selection", "--maps", "iga-map1", "--out", "s.db"), "--swap selection: found no SLOT"),
        (("ablate", "imga", "--swap", "selektion=roulette", "--maps", "iga-map1", "--out", "s.db"), "--swap selektion"),
        (("ablate", "imga", "--swap", "selection=roulette,roulette", "--maps", "iga-map1", "--out", "s.db"), "--swap selection: found 'roulette' twice"),
        (("ablate", "imga", "--without", "selection", "--maps", "iga-map1", "--out", "s.db"), "--without selection: it cannot be empty"),
        (("compare", "--maps", "iga-map1", "--out", "s.db"), "--planners: found none"),
        (("compare", "--planners", "imga,imga", "--maps", "iga-map1", "--out", "s.db"), "--planners: found 'imga' twice"),
        (("compare", "--planners", "imgaa", "--maps", "iga-map1", "--out", "s.db"), "--planners: no planner is called 'imgaa'"),
        (("compare", "--planners", "imga", "--maps", ",", "--out", "s.db"), "--maps: found an empty name"),
        (("compare", "--planners", "imga", "--maps", "nothing.map", "--out", "s.db"), "nothing.map"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--runs", 0, "--out", "s.db"), "--runs: found 0"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--seed", -1, "--out", "s.db"), "--seed: found -1"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--workers", 0, "--out", "s.db"), "--workers: found 0"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--budget", "x", "--out", "s.db"), "--budget: found 'x'"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--time-limit", -1, "--out", "s.db"), "--time-limit: found -1"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--corners", "round", "--out", "s.db"), "corners: found 'round'"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--goal", "99,99", "--out", "s.db"), "outside the map"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--cases", "0-3", "--out", "s.db"), "--cases: needs --scenario"),
        (("compare", "--planners", "imga", "--maps", "iga-map1", "--out", "nowhere/s.db"), "nowhere"),
        (("study", "status", "nothing.db"), "found no such file"),
        (("study", "export", "nothing.db"), "found no file to write"),
        (("study", "export", "nothing.db", "--csv", "s.csv"), "found no such file"),
        (("study", "resume", "nothing.db"), "found no such file"),
    ],
)  # fmt: skip
def test_what_cannot_be_studied_is_refused_in_one_line(refused, asked, says):
    assert says in refused(*asked)


def test_commas_within_brackets_and_quotes_do_not_split():
    assert split('a,{use="b", rate=0.5},"c,d", e') == ["a", '{use="b", rate=0.5}', '"c,d"', "e"]
    assert split("a,") == ["a", ""]


def test_times_are_told_in_two_units():
    assert [duration(s) for s in (3.4, 75, 3725)] == ["3 s", "1 min 15 s", "1 h 2 min"]
