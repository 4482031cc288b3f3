"""The generator inside kernels, and walks at random."""

import itertools

import naive
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

from pathloom import PathProblem, compiled
from pathloom.compiled import random


@given(state=naive.words)
@examples(30)
def test_words_are_those_of_xoshiro256_plus_plus(state: list[int]) -> None:
    array = np.array(state, np.uint64)
    found = [int(random.next_word(array)) for _ in range(50)]
    assert found == list(itertools.islice(naive.xoshiro(state), 50))


def test_the_first_words_of_a_small_state_are_as_published() -> None:
    # state 1, 2, 3, 4: the reference vector that implementations of xoshiro256++ share
    state = np.array([1, 2, 3, 4], np.uint64)
    assert [int(random.next_word(state)) for _ in range(4)] == [
        41943041,
        58720359,
        3588806011781223,
        3591011842654386,
    ]


@given(state=naive.words, bound=st.integers(1, 2**31 - 1))
@examples(60)
def test_integers_are_the_upper_half_of_a_word_scaled_to_the_bound(state: list[int], bound: int) -> None:
    expected = [(word >> 32) * bound >> 32 for word in itertools.islice(naive.xoshiro(state), 20)]
    array = np.array(state, np.uint64)
    assert [random.below(array, bound) for _ in range(20)] == expected
    assert all(0 <= k < bound for k in expected)


@given(state=naive.words)
@examples(30)
def test_numbers_are_the_upper_53_bits_of_a_word(state: list[int]) -> None:
    expected = [(word >> 11) / 2**53 for word in itertools.islice(naive.xoshiro(state), 20)]
    array = np.array(state, np.uint64)
    assert [random.uniform(array) for _ in range(20)] == expected


def test_a_die_shows_every_face_about_as_often() -> None:
    state = np.random.default_rng(0).bit_generator.random_raw(4)
    counts = np.bincount([random.below(state, 6) for _ in range(6000)], minlength=6)
    assert (abs(counts - 1000) < 5 * np.sqrt(1000 * 5 / 6)).all()


def walked(problem: PathProblem, n: int, state: list[int], steps: int = 5000):
    it = problem.context
    return compiled.walks.sample_by_walking(n, steps, it.start, it.goal, it.moves, it.cols, np.array(state, np.uint64))


@given(problem=naive.problems(max_side=6), state=naive.words)
@examples(60)
def test_walks_are_legal_and_free_of_loops(problem: PathProblem, state: list[int]) -> None:
    it = problem.context
    found, failed = walked(problem, 4, state)
    again, failed_again = walked(problem, 4, state)
    assert (found.tobytes(), failed) == (again.tobytes(), failed_again)
    paths = naive.unpacked(found, it.cols)
    assert len(paths) == 4 or failed == 4
    assert it.reachable == (len(paths) > 0)
    for path in paths:
        assert (path[0], path[-1]) == problem.ends
        assert naive.steps_singly(path)
        assert naive.path_free(it.occupied, path, problem.corners)
        assert len(set(path)) == len(path)


def test_walks_that_are_too_short_fail_and_are_given_up_after_as_many_as_wanted() -> None:
    problem = PathProblem(np.zeros((5, 5), bool))
    found, failed = walked(problem, 3, [1, 2, 3, 4], steps=3)
    assert (found.shape, failed) == ((0, 1), 3)


def test_walks_into_a_cell_without_exit_fail() -> None:
    problem = PathProblem(np.array([[0, 1, 0]], bool), start=(0, 0), goal=(0, 2))
    found, failed = walked(problem, 2, [1, 2, 3, 4])
    assert (found.shape, failed) == ((0, 1), 2)


def test_walks_from_a_start_that_is_the_goal_stay() -> None:
    problem = PathProblem(np.zeros((3, 3), bool), start=(1, 1), goal=(1, 1))
    assert walked(problem, 2, [1, 2, 3, 4])[0].tolist() == [[4], [4]]
