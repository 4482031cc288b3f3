"""Seeds that keep their distance from obstacles."""

import naive
import numpy as np
import pytest

import pathloom as pl
from pathloom.exact.aloof import Aloof, connected, distances, moves_at
from pathloom.exact.scalarised import Scalarised
from pathloom.kernel.counting import counting
from pathloom.paths.objectives import Clearance, Length, TurnAngle, Turns, UnsafeCells
from pathloom.paths.tree_seeding import PerturbedTrees

WIDE = pl.Terms({"length": Length(), "clearance": Clearance(), "turn-angle": TurnAngle()})
ADDITIVE = pl.Terms({"length": Length(), "unsafe-cells": UnsafeCells(), "turns": Turns()})


def roomy(corners="no-squeeze"):
    """A block in the middle with a narrow way above it and a wide one below."""
    occupied = np.zeros((24, 30), bool)
    occupied[3:9, 10:20] = True
    return pl.PathProblem(pl.OccupancyGrid(occupied), start=(11, 4), goal=(11, 25), corners=corners)


@pytest.mark.parametrize("corners", ["strict", "no-squeeze", "allow"])
def test_the_last_distance_is_the_greatest_at_which_there_is_a_way(corners):
    problem = pl.PathProblem(pl.load_map("blocks-20:20%:s2", corners=corners), corners=corners)
    found = distances(problem, 5)
    known = sorted(set(problem.context.distance.tolist()) - {0.0})
    ends = min(problem.context.distance[[problem.context.start, problem.context.goal]])
    ways = [d for d in known if d <= ends and connected(problem, d)]
    assert found == sorted(set(found))
    assert len(found) <= 5
    assert set(found) <= set(ways[1:])
    assert found[-1:] == ways[1:][-1:]


def test_between_cells_that_are_far_enough_all_legal_steps_are_left_and_no_others():
    problem = roomy("strict")
    it = problem.context
    moves = moves_at(problem, 3.0).reshape(it.rows, it.cols)
    far = (it.distance >= 3.0).reshape(it.rows, it.cols)
    for cell in naive.free_cells(it.occupied):
        steps = {d for d, there in naive.legal_steps(it.occupied, cell, "strict") if far[cell] and far[there]}
        assert {d for d in range(8) if moves[cell] >> d & 1} == steps


def test_the_widest_way_is_among_them_and_the_paths_are_valid():
    problem = roomy()
    found = Aloof(objectives=WIDE).sample(problem, 40, np.random.default_rng(0))
    assert all(pl.validate(problem.representation.decode(row), problem) is None for row in found)
    trees = PerturbedTrees().sample(problem, 40, np.random.default_rng(0))
    clear, lengths = (-Clearance().measure(p, problem) for p in (found, trees)), Length().measure(found, problem)
    widest, by_chance = (one.max() for one in clear)
    assert widest > by_chance
    start = min(problem.context.distance[problem.context.start], problem.context.distance[problem.context.goal])
    assert widest >= start - 1.0
    assert lengths.min() > 0


def test_where_all_is_additive_the_rest_makes_everybody():
    problem = pl.PathProblem(pl.load_map("random-20:75"))
    with counting() as counts:
        found = Aloof(objectives=ADDITIVE, rest=Scalarised(objectives=ADDITIVE)).sample(
            problem, 20, np.random.default_rng(4)
        )
    alone = Scalarised(objectives=ADDITIVE).sample(problem, 20, np.random.default_rng(4))
    assert found.tobytes() == alone.tobytes()
    assert counts["samples by fallback"] >= 20


def test_without_additive_objectives_the_shortest_at_each_distance_is_found():
    problem = roomy()
    terms = pl.Terms({"clearance": Clearance()})
    with counting() as counts:
        found = Aloof(objectives=terms).sample(problem, 30, np.random.default_rng(0))
    assert len(found) == 30
    assert counts["samples by fallback"] < 30


def test_on_large_maps_fewer_searches_are_made():
    problem = roomy()
    with counting() as counts:
        Aloof(objectives=WIDE, work=3 * problem.context.blocked.size).sample(problem, 30, np.random.default_rng(0))
    assert counts["samples by fallback"] >= 27


def test_nothing_comes_of_an_unreachable_goal():
    occupied = np.zeros((5, 5), bool)
    occupied[2] = True
    problem = pl.PathProblem(pl.OccupancyGrid(occupied), start=(0, 0), goal=(4, 4))
    assert len(Aloof(objectives=WIDE).sample(problem, 5, np.random.default_rng(0))) == 0
