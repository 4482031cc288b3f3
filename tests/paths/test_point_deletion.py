"""Deletion of points whose neighbours see each other."""

from dataclasses import dataclass

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, Cells, examples

import pathloom as pl
from pathloom import compiled
from pathloom.paths.collision import Exact
from pathloom.paths.deletion import PointDeletion
from pathloom_imga.deletion import SequentialPointDeletion

RNG = np.random.default_rng(0)


@dataclass(frozen=True, kw_only=True)
class InFractions(pl.Collision):
    """The exact test once more, of which deletion cannot know that the kernel does the same."""

    def segments_free(self, a, b, problem):
        blocked = problem.context.occupied
        pairs = zip(a.tolist(), b.tolist(), strict=True)
        return np.array([naive.segment_free(blocked, tuple(p), tuple(q), problem.corners) for p, q in pairs], bool)


@dataclass(frozen=True, kw_only=True)
class Never(pl.Collision):
    """Nothing sees anything."""

    def segments_free(self, a, b, problem):
        return np.zeros(len(a), bool)


@dataclass(frozen=True, kw_only=True)
class NeverAnyMore(Exact):
    """An exact test that somebody has made stricter."""

    def segments_free(self, a, b, problem):
        return super().segments_free(a, b, problem) & False


@st.composite
def walks(draw: st.DrawFn) -> tuple[pl.PathProblem, list[Cells]]:
    """Draw a problem that has a solution, and some legal paths of single steps."""
    problem = draw(naive.problems().filter(lambda problem: problem.reachable))
    it = problem.context
    state = np.array(draw(naive.words), np.uint64)
    found, _ = compiled.walks.sample_by_walking(3, 10_000, it.start, it.goal, it.moves, it.cols, state)
    return problem, naive.unpacked(found, it.cols)


def deleted(problem: pl.PathProblem, paths: list[Cells], **options) -> list[Cells]:
    population = problem.representation.encode([np.array(path) for path in paths])
    return naive.unpacked(PointDeletion(**options).apply(population, problem, RNG), problem.context.cols)


@given(drawn=walks(), passes=st.integers(0, 3))
@examples(60)
def test_any_collision_that_says_the_same_deletes_the_same(drawn, passes: int) -> None:
    problem, paths = drawn
    by_kernel = deleted(problem, paths, passes=passes)
    assert deleted(problem, paths, passes=passes, collision=InFractions()) == by_kernel


@given(drawn=walks(), passes=st.integers(0, 3))
@examples(100)
def test_deletion_leaves_legal_paths_neither_longer_nor_with_more_turns(drawn, passes: int) -> None:
    problem, paths = drawn
    for path, shorter in zip(paths, deleted(problem, paths, passes=passes), strict=True):
        assert pl.validate(shorter, problem) is None
        assert set(shorter) <= set(path)
        assert naive.length(shorter) <= naive.length(path) + 1e-12
        assert naive.turns(shorter) <= naive.turns(path)


@given(drawn=walks())
@examples(60)
def test_after_deletion_until_nothing_changes_nothing_can_be_deleted(drawn) -> None:
    problem, paths = drawn
    done = deleted(problem, paths, passes=0)
    assert deleted(problem, done, passes=1) == done


@pytest.mark.parametrize("passes", [0, 1])
def test_where_nothing_sees_anything_nothing_is_deleted(passes: int) -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool))
    path = ((2, 0), (1, 0), (0, 0), (0, 1), (0, 2))
    assert deleted(problem, [path], passes=passes, collision=Never()) == [path]


def test_a_collision_that_inherits_from_the_exact_one_is_asked() -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool))
    path = ((2, 0), (1, 0), (0, 0), (0, 1), (0, 2))
    assert deleted(problem, [path], collision=NeverAnyMore()) == [path]


@pytest.mark.parametrize("collision", [Exact(), InFractions()], ids=["kernel", "Python"])
@pytest.mark.parametrize("path", [((1, 1),), ((2, 0), (0, 2))], ids=["one cell", "two cells"])
def test_paths_without_interior_stay(path: Cells, collision: pl.Collision) -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool), start=path[0], goal=path[-1])
    assert deleted(problem, [path], collision=collision) == [path]


def test_the_papers_deletion_is_this_one() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    _, path = pl.octile_path(problem)
    row = problem.representation.encode([path])
    expected = PointDeletion(passes=1).apply(row, problem, RNG)
    np.testing.assert_array_equal(SequentialPointDeletion().apply(row, problem, RNG), expected)


@pytest.mark.parametrize("corners", POLICIES)
def test_the_exact_collision_answers_for_one_segment_and_for_many(corners: str) -> None:
    problem = pl.PathProblem([[0, 1], [0, 0]], start=(0, 0), goal=(1, 1), corners=corners)
    ends = np.array([[(0, 0), (1, 1)], [(0, 0), (1, 0)], [(0, 1), (1, 1)]])
    expected = [corners != "strict", True, False]
    assert Exact().segments_free(ends[:, 0], ends[:, 1], problem).tolist() == expected
    assert [Exact().free(a, b, problem) for a, b in ends.tolist()] == expected


def test_the_exact_collision_takes_cells_of_short_integers() -> None:
    blocked = np.zeros((200, 200), bool)
    blocked[100, 1:] = True
    a, b = np.array([(199, 100)], np.uint8), np.array([(0, 100)], np.uint8)
    assert Exact().segments_free(a, b, pl.PathProblem(blocked)).tolist() == [False]
