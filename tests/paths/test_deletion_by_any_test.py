"""Deletion with tests of segments other than the exact one: side by side, and with points put back."""

from dataclasses import dataclass
from itertools import pairwise

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import Cell, Cells, examples

import pathloom as pl
from pathloom import compiled
from pathloom.kernel.counting import counting
from pathloom.paths.collision import Exact
from pathloom.paths.deletion import PointDeletion, delete_points


@dataclass(frozen=True, kw_only=True)
class Delegating(Exact):
    """The exact test, of which deletion cannot know that it is."""

    def segments_free(self, a, b, problem):
        return super().segments_free(a, b, problem)


@dataclass(frozen=True, kw_only=True)
class Whimsical(pl.Collision):
    """An answer of its own to each pair of cells, always the same."""

    salt: pl.Whole = 0
    of_seven: pl.Whole = 5
    """How many of seven pairs see each other."""

    def sees(self, a: Cell, b: Cell) -> bool:
        number = self.salt
        for k in (*a, *b):
            number = (31 * number + k) * 2654435761 % 2**32
        return (number >> 16) % 7 < self.of_seven

    def segments_free(self, a, b, problem):
        pairs = zip(a.tolist(), b.tolist(), strict=True)
        return np.array([self.sees(tuple(p), tuple(q)) for p, q in pairs], bool)


EVERYTHING = Whimsical(of_seven=7)
whims = st.builds(Whimsical, salt=st.integers(0, 99), of_seven=st.integers(0, 7))


def there_and_back(path: Cells, i: int, k: int) -> Cells:
    """Go from the k-th cell back to the i-th before going on."""
    i, k = sorted((i % len(path), k % len(path)))
    return path[:k] + path[i : k + 1][::-1] + path[i + 1 :]


@st.composite
def walks(draw: st.DrawFn, winding: int = 2) -> tuple[pl.PathProblem, list[Cells]]:
    """Draw a problem that has a solution, and some legal paths, with up to so many turns back in each."""
    problem = draw(naive.problems().filter(lambda problem: problem.reachable))
    it = problem.context
    state = np.array(draw(naive.words), np.uint64)
    found, _ = compiled.walks.sample_by_walking(3, 10_000, it.start, it.goal, it.moves, it.cols, state)
    paths = naive.unpacked(found, it.cols)
    places = st.tuples(st.integers(0, 99), st.integers(0, 99))
    for turn in draw(st.lists(places, max_size=winding)):
        paths = [there_and_back(path, *turn) for path in paths]
    return problem, paths


def deleted(problem: pl.PathProblem, paths: list[Cells], padding: int = 0, **options):
    """Return the shorter paths and the counts; options as for `delete_points`."""
    population = naive.packed(paths, problem.context.cols, padding)
    before = population.copy()
    with counting() as counts:
        shorter = delete_points(population, problem, **options)
    np.testing.assert_array_equal(population, before)
    assert shorter.dtype == np.int32
    assert shorter.flags.c_contiguous
    return naive.unpacked(shorter, problem.context.cols), counts


def is_part(few: Cells, many: Cells) -> bool:
    """Say whether the few stand among the many in the same order."""
    rest = iter(many)
    return all(cell in rest for cell in few)


def put_back(problem: pl.PathProblem, kept: Cells, path: Cells) -> Cells:
    """Give each blocked segment back what stood between its ends, on a path without loops."""
    found = kept[:1]
    for a, b in pairwise(kept):
        free = naive.segment_free(problem.context.occupied, a, b, problem.corners)
        found += (b,) if free else path[path.index(a) + 1 : path.index(b) + 1]
    return found


# Side by side -----------------------------------------------------------------------------------


@given(drawn=walks(), passes=st.integers(0, 3), padding=st.integers(0, 4))
@examples(100)
def test_a_test_that_delegates_to_the_exact_one_deletes_what_the_kernel_deletes(drawn, passes, padding) -> None:
    problem, paths = drawn
    by_kernel = deleted(problem, paths, padding, passes=passes, collision=Exact())
    assert deleted(problem, paths, padding, passes=passes, collision=Delegating()) == by_kernel == (by_kernel[0], {})


@given(data=st.data(), blocked=naive.maps(), whim=whims, passes=st.integers(0, 3))
@examples(150)
def test_side_by_side_is_one_path_after_the_other(data, blocked, whim: Whimsical, passes: int) -> None:
    paths = data.draw(st.lists(naive.paths_on(blocked.shape, 9), min_size=1, max_size=5))
    blocked[0, 0] = False
    problem = pl.PathProblem(blocked, start=(0, 0), goal=(0, 0))
    found, counts = deleted(problem, paths, data.draw(st.integers(0, 3)), passes=passes, collision=whim, restore=False)
    assert found == [naive.without_points_by(whim.sees, path, passes) for path in paths]
    assert counts == {}


def test_each_pass_goes_on_where_the_one_before_left_off() -> None:
    problem = pl.PathProblem(np.zeros((5, 5), bool))
    path = (*((4 - k, k) for k in range(5)), (1, 4), (2, 4), (2, 3), (1, 3), (0, 3), (0, 4))
    whim = Whimsical(salt=20, of_seven=3)
    left = [len(deleted(problem, [path], passes=k, collision=whim, restore=False)[0][0]) for k in (1, 2, 3, 0)]
    assert len(path) > left[0] > left[1] > left[2] > left[3]


def test_all_paths_are_asked_for_at_once_and_each_inner_point_once() -> None:
    asked = []

    class Witness(pl.Collision):
        def segments_free(self, a, b, problem):
            asked.append(len(a))
            return np.zeros(len(a), bool)

    problem = pl.PathProblem(np.zeros((1, 6), bool), start=(0, 0), goal=(0, 5))
    paths = [tuple((0, c) for c in range(k)) for k in (1, 2, 3, 6, 6)]
    assert deleted(problem, paths, 3, collision=Witness(), restore=False)[0] == paths
    assert asked == [3, 2, 2, 2]


@pytest.mark.parametrize("collision", [Exact(), Delegating(), Whimsical()], ids=["kernel", "delegating", "whimsical"])
@pytest.mark.parametrize("passes", [0, 1, 2])
def test_nobody_stays_nobody(collision: pl.Collision, passes: int) -> None:
    problem = pl.PathProblem(np.zeros((3, 3), bool))
    assert delete_points(np.empty((0, 4), np.int32), problem, collision, passes).shape == (0, 1)


# Put back ---------------------------------------------------------------------------------------


@given(drawn=walks(winding=0), whim=whims, passes=st.integers(0, 2))
@examples(150)
def test_between_the_ends_of_a_blocked_segment_everything_comes_back(drawn, whim: Whimsical, passes: int) -> None:
    problem, paths = drawn
    shorter, _ = deleted(problem, paths, passes=passes, collision=whim, restore=False)
    expected = [put_back(problem, *both) for both in zip(shorter, paths, strict=True)]
    restored, counts = deleted(problem, paths, passes=passes, collision=whim)
    assert restored == expected
    assert counts.get("points restored", 0) == sum(map(len, restored)) - sum(map(len, shorter))


@given(drawn=walks(), whim=whims | st.just(EVERYTHING), passes=st.integers(0, 2))
@examples(150)
def test_paths_that_were_legal_are_legal_again_even_with_loops(drawn, whim: Whimsical, passes: int) -> None:
    problem, paths = drawn
    shorter, _ = deleted(problem, paths, passes=passes, collision=whim, restore=False)
    restored, counts = deleted(problem, paths, passes=passes, collision=whim)
    for path, few, more in zip(paths, shorter, restored, strict=True):
        assert naive.path_free(problem.context.occupied, more, problem.corners)
        assert (more[0], more[-1]) == problem.ends
        assert is_part(few, more)
        assert is_part(more, path)
    assert counts.get("points restored", 0) == sum(map(len, restored)) - sum(map(len, shorter))


@given(drawn=walks(winding=0), passes=st.integers(0, 2))
@examples(60)
def test_where_everything_seems_to_see_everything_only_what_is_blocked_stays_whole(drawn, passes: int) -> None:
    problem, paths = drawn
    for path, restored in zip(paths, deleted(problem, paths, passes=passes, collision=EVERYTHING)[0], strict=True):
        free = naive.segment_free(problem.context.occupied, path[0], path[-1], problem.corners)
        if len(path) > 1:
            assert restored == ((path[0], path[-1]) if free else path)


def test_only_the_path_that_is_blocked_gets_points_back() -> None:
    problem = pl.PathProblem([[0, 0, 0], [0, 1, 0], [0, 0, 0]], start=(0, 0), goal=(2, 2))
    around = ((0, 0), (0, 1), (0, 2), (1, 2), (2, 2))
    straight = ((0, 0), (0, 1), (0, 2))
    found, counts = deleted(problem, [straight, around, straight], collision=EVERYTHING)
    assert found == [((0, 0), (0, 2)), around, ((0, 0), (0, 2))]
    assert counts == {"points restored": 3}


def test_only_the_stretch_that_is_blocked_gets_points_back() -> None:
    # S . . # G    to the third cell it can go straight, from there on it leads around the obstacle
    # . . . . .
    blocked = np.zeros((2, 5), bool)
    blocked[0, 3] = True
    problem = pl.PathProblem(blocked, start=(0, 0), goal=(0, 4))
    path = ((0, 0), (1, 1), (0, 2), (1, 2), (1, 3), (1, 4), (0, 4))

    class AllBut(pl.Collision):
        def segments_free(self, a, b, problem):
            return np.array([(p, q) != ([0, 0], [1, 2]) for p, q in zip(a.tolist(), b.tolist(), strict=True)])

    shorter, _ = deleted(problem, [path], collision=AllBut(), restore=False)
    restored, counts = deleted(problem, [path], collision=AllBut())
    assert shorter == [((0, 0), (0, 2), (0, 4))]
    assert restored == [((0, 0), (0, 2), (1, 2), (1, 3), (1, 4), (0, 4))]
    assert counts == {"points restored": 3}


def test_the_component_puts_back_unless_it_is_told_not_to() -> None:
    problem = pl.PathProblem([[0, 0, 0], [0, 1, 0], [0, 0, 0]], start=(0, 0), goal=(2, 2))
    path = ((0, 0), (0, 1), (0, 2), (1, 2), (2, 2))
    population = naive.packed([path], 3)
    whole = PointDeletion(collision=EVERYTHING).apply(population, problem, np.random.default_rng(0))
    bare = PointDeletion(collision=EVERYTHING, restore=False).apply(population, problem, np.random.default_rng(0))
    assert naive.unpacked(whole, 3) == [path]
    assert naive.unpacked(bare, 3) == [((0, 0), (2, 2))]
