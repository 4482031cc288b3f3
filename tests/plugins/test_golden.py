"""Golden runs: a map and a seed give these numbers. A change here is a change for every user, and told in the changelog."""

import pytest

import pathloom as pl

GOLDEN = {  # length, turns, generations, evaluations
    ("imga", "iga-map1", "allow", 7): (13.790083, 4, 46, 4700),
    ("imga", "blocks-30:25%", "strict", 0): (43.257453, 3, 50, 5100),
    ("imga", "random-20:75:s3", "no-squeeze", 1): (27.311295, 6, 50, 5100),
    ("ga-imga", "iga-map1", "allow", 7): (14.485281, 5, 50, 5100),
    ("ga-imga", "random-20:75:s3", "strict", 1): (32.970563, 22, 50, 5100),
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
