"""No planner knows where north is: what can be said of ours beyond what `pathloom.testing` finds out of all."""

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.compose import build
from pathloom.kernel.registry import default_registry
from pathloom.testing.problems import POLICIES, SYMMETRIES, View, first_population, views


@pytest.mark.parametrize("corners", POLICIES)
@pytest.mark.parametrize("name", ["dijkstra", "any-angle"])
def test_exact_searches_find_the_same_length_from_every_side(name, corners):
    lengths = [pl.plan(view.problem, name).length for view in views(corners)]
    assert lengths == pytest.approx([lengths[0]] * len(lengths), rel=1e-12)


def lengths_from_every_side(repair, name, corners):
    """Lengths (8, n) of the repaired paths: of equally good cells the first in reading order may be taken."""
    occupied = pl.load_map(name, corners=corners).occupied
    ends = (len(occupied) - 1, 0), (0, len(occupied) - 1)
    sides = [View(occupied, *ends, corners, symmetry) for symmetry in SYMMETRIES]
    first = first_population(sides[0].problem, 40)
    repaired = [repair.apply(side.there(first), side.problem, np.random.default_rng(0)) for side in sides]
    return np.array([pl.compiled.measures.lengths(p, len(occupied)) for p in repaired])


@pytest.mark.parametrize(
    ("name", "ties"), [("loom/band-search", 0.0), ("loom/gene-pool", 0.0), ("loom/string-pulling", 0.01)]
)
def test_what_loom_learns_is_as_short_from_every_side(name, ties):
    """Of cells that are equally good string pulling takes the first, which decides of its next step in rare cases."""
    repair, other, all_ = build(pl.Repair, name, default_registry(), ""), 0, 0
    for map_ in ("random-20:20%:s1", "random-20:30%:s2", "random-30:10%:s3", "rooms-25:5", "empty-15"):
        for corners in POLICIES:
            lengths = lengths_from_every_side(repair, map_, corners)
            other += int((np.abs(lengths - lengths[0]) > 1e-9).sum())
            all_ += lengths.size
    assert other <= ties * all_
