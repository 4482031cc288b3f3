"""Golden runs: a map and a seed give these numbers. A change here is a change for every user, and told in the changelog."""

import pytest

import pathloom as pl
from pathloom.kernel.registry import default_registry

GOLDEN = {  # length, turns, generations, evaluations
    ("loom", "iga-map1", "allow", 7): (13.790083, 4, 3, 243),
    ("loom", "blocks-30:25%", "strict", 0): (43.101522, 3, 3, 243),
    ("loom", "random-20:75:s3", "no-squeeze", 1): (27.311295, 6, 3, 243),
    ("loom", "random-50:30%:s2", "strict", 3): (74.487678, 16, 3, 243),
    ("imga", "iga-map1", "allow", 7): (13.790083, 4, 46, 4700),
    ("imga", "blocks-30:25%", "strict", 0): (43.257453, 3, 50, 5100),
    ("imga", "random-20:75:s3", "no-squeeze", 1): (27.311295, 6, 50, 5100),
    ("ga-imga", "iga-map1", "allow", 7): (14.485281, 5, 50, 5100),
    ("ga-imga", "random-20:75:s3", "strict", 1): (32.970563, 22, 50, 5100),
    ("agacd", "iga-map1", "allow", 7): (14.577728, 4, 300, 18060),
    ("agacd", "random-20:75:s3", "strict", 1): (28.846446, 4, 300, 18060),
    ("agacd-50", "blocks-50:20%", "allow", 0): (70.609902, 2, 500, 40080),
    ("imaga", "iga-map1", "allow", 7): (13.790083, 4, 50, 20000),
    ("imaga", "random-20:75:s3", "no-squeeze", 1): (27.313089, 6, 50, 17300),
    ("iga", "iga-map1", "allow", 7): (13.790083, 4, 150, 90600),
    ("iga", "random-20:75:s3", "strict", 1): (28.618376, 5, 150, 90600),
    ("basic-ga", "random-20:75:s3", "allow", 0): (28.627417, 4, 50, 10200),
    ("bga", "random-20:75:s3", "allow", 0): (28.627417, 4, 300, 18060),
    ("bga-50", "random-20:75:s3", "allow", 0): (28.627417, 4, 500, 30060),
    ("mpmga", "random-20:75:s3", "allow", 0): (28.627417, 5, 500, 32265),
    ("mpga-textbook", "random-20:75:s3", "allow", 0): (28.627417, 4, 44, 18000),
    ("ga-imaga", "random-20:75:s3", "allow", 0): (28.041631, 8, 50, 5100),
    ("ga-iga", "random-20:75:s3", "allow", 0): (28.041631, 8, 150, 45300),
    ("ga-lit37", "random-20:75:s3", "strict", 0): (30.970563, 17, 50, 5100),
    ("aco", "random-20:75:s3", "allow", 0): (28.041631, 7, 100, 5050),
    ("aco-ga", "random-20:75:s3", "allow", 0): (27.740892, 3, 200, 15100),
    ("smartpath", "random-20:75:s3", "strict", 0): (30.970563, 14, 20, 6100),
    ("pso", "random-20:75:s3", "allow", 0): (27.322384, 6, 500, 50100),
    ("gwo", "random-20:75:s3", "allow", 0): (31.477604, 4, 500, 50100),
    ("afsa", "random-20:75:s3", "allow", 0): (28.715951, 5, 100, 142377),
    ("afsa-grid", "random-20:75:s3", "strict", 0): (30.970563, 16, 41, 20),
    ("ssa", "iga-map1", "allow", 0): (14.233345, 6, 500, 51127),
    ("bezier-ga", "random-20:75:s3", "allow", 0): (38.0, 27, 100, 10100),
    ("aco-hga-aco", "random-20:75:s3", "allow", 0): (28.041631, 7, 100, 4960),
    ("ga-hga-aco", "random-20:75:s3", "strict", 0): (31.556349, 12, 100, 6056),
    ("hga-aco", "random-20:75:s3", "allow", 0): (28.041631, 8, 201, 11102),
    ("hga-aco", "random-20:75:s3", "strict", 0): (30.970563, 17, 201, 11106),
    ("dijkstra", "random-20:75:s3", "strict", 0): (30.970563, 13, 0, 1),
    ("any-angle", "random-20:75:s3", "allow", 0): (27.311295, 6, 0, 1),
    ("any-angle", "random-20:75:s3", "strict", 0): (28.317904, 5, 0, 1),
    ("rrt", "random-20:75:s3", "strict", 0): (40.131185, 23, 1, 1),
    ("s-rrt", "random-20:75:s3", "strict", 0): (28.738856, 5, 1, 1),
    ("nsga2", "random-20:75:s3", "allow", 0): (29.213203, 4, 50, 2222),
    ("nsga3", "random-20:75:s3", "allow", 0): (29.213203, 4, 50, 2226),
    ("sms-emoa", "random-20:75:s3", "allow", 0): (29.213203, 4, 50, 2361),
    ("age-moea", "random-20:75:s3", "allow", 0): (29.213203, 4, 50, 2256),
    ("moead", "random-20:75:s3", "allow", 0): (29.213203, 4, 50, 4633),
    ("rvea", "random-20:75:s3", "allow", 0): (29.213203, 4, 50, 2233),
    ("spea2", "random-20:75:s3", "allow", 0): (29.213203, 4, 50, 2232),
}


@pytest.mark.parametrize("run", GOLDEN, ids=lambda run: "-".join(map(str, run)))
def test_a_seed_gives_the_numbers_that_it_always_gave(run):
    planner, name, corners, seed = run
    result = pl.plan(pl.PathProblem(pl.load_map(name, corners=corners), corners=corners), planner, seed=seed)
    assert result.found
    found = (
        round(result.length, 6),
        result.metrics["turns"],
        result.budget["generations"],
        result.budget["evaluations"],
    )
    assert found == GOLDEN[run]


def test_every_planner_of_ours_has_a_golden_run():
    ours = [e for e in default_registry().all_entries(pl.Planner) if e.source.ours and "/" in e.name]
    exact = {"dijkstra", "any-angle"}
    assert {e.component.name for e in ours} | exact == {planner for planner, *_ in GOLDEN}
