"""The linear trial, the operators that ask it, and the greedy walk, against twins written from the paper."""

import itertools
import math
from collections import Counter
from fractions import Fraction

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import Cell, Cells, examples

from pathloom import PathProblem, compiled
from pathloom.compiled.trial import EXACT, FREE, MISSED, TRIAL
from pathloom.paths.context import POLICIES

Step = float | Fraction
"""A float asks for floating point, a fraction for exact arithmetic."""


def trial(blocked: np.ndarray, a: Cell, b: Cell, step: Step) -> bool:
    """Do what section 3 of Hao et al. 2021 says, in the kind of numbers that the step is of."""
    rows, number = blocked.shape[0], type(step)
    (xi, yi), (xj, yj) = ((c + 1, rows - r) for r, c in (a, b))
    steep = abs(yj - yi) > abs(xj - xi)
    if steep:
        xi, yi, xj, yj = yi, xi, yj, xj
    if xi == xj:
        return True
    k = number(yj - yi) / number(xj - xi)
    intercept = yi - k * xi
    x1 = number(min(xi, xj))
    while x1 < max(xi, xj):
        x1 += step
        x, y = rounded(x1), rounded(k * x1 + intercept)
        if steep:
            x, y = y, x
        if blocked[rows - y, x - 1]:
            return False
    return True


def rounded(u: Step) -> int:
    low = math.floor(u)
    return low if u - low <= Fraction(1, 2) else low + 1


def parts(step: Step) -> int:
    return step.denominator if isinstance(step, Fraction) else 0


def free(
    blocked: np.ndarray, first: list[int], second: list[int], step: Step, tests: int = TRIAL, corners: str = "allow"
):
    flat = np.ascontiguousarray(blocked, np.uint8).ravel()
    ends = np.array([first, second], np.int32).reshape(2, -1)
    return compiled.trial.segments_free(
        *ends, flat, *blocked.shape, POLICIES[corners], tests, float(step), parts(step)
    )  # fmt: skip


def of_cells(blocked: np.ndarray, pairs: list[tuple[Cell, Cell]], step: Step, **how) -> list[bool]:
    ids = [[r * blocked.shape[1] + c for r, c in ends] for ends in zip(*pairs, strict=True)] or [[], []]
    return free(blocked, *ids, step, **how)[0].tolist()


steps = st.sampled_from((0.1, 0.07, 0.25, Fraction(1, 10), Fraction(1, 4), Fraction(1, 7)))


@given(data=st.data(), blocked=naive.maps(9), step=steps)
@examples(200)
def test_the_trial_is_that_of_the_paper_in_floats_and_in_fractions(data, blocked: np.ndarray, step: Step) -> None:
    cells = naive.free_cells(blocked)
    if cells:
        cell = st.sampled_from(cells)
        pairs = data.draw(st.lists(st.tuples(cell, cell), max_size=12))
        assert of_cells(blocked, pairs, step) == [trial(blocked, a, b, step) for a, b in pairs]


@pytest.mark.parametrize("step", [0.1, Fraction(1, 10)])
def test_every_segment_of_a_map_agrees_with_its_twin(step: Step) -> None:
    blocked = np.random.default_rng(4).random((6, 7)) < 0.15
    pairs = list(itertools.product(naive.free_cells(blocked), repeat=2))
    assert of_cells(blocked, pairs, step) == [trial(blocked, a, b, step) for a, b in pairs]


def test_diagonals_are_sampled_by_columns() -> None:
    blocked = np.random.default_rng(1).random((40, 50)) < 0.05
    free_cells = set(naive.free_cells(blocked))
    over = [(d * s, d * t) for d in (1, 7) for s in (-1, 1) for t in (-1, 1)]
    pairs = [((r, c), (r + i, c + j)) for r, c in free_cells for i, j in over if (r + i, c + j) in free_cells]
    assert of_cells(blocked, pairs, 0.1) == [trial(blocked, a, b, 0.1) for a, b in pairs]


def random_pairs(density: float, rng: np.random.Generator, maps: int = 120, each: int = 200):
    """Draw maps of 20 × 20, and pairs of free cells 2 to 6 apart, each distance as likely, by Chebyshev."""
    ring = {d: [p for p in itertools.product(range(-d, d + 1), repeat=2) if max(map(abs, p)) == d] for d in range(2, 7)}
    for _ in range(maps):
        blocked = rng.random((20, 20)) < density
        room = np.pad(blocked, 6, constant_values=True)
        cells = np.argwhere(~blocked)
        firsts: list[int] = []
        seconds: list[int] = []
        while len(firsts) < each:
            here = cells[rng.integers(len(cells), size=each)]
            by = np.array([ring[d][rng.integers(len(ring[d]))] for d in rng.integers(2, 7, size=each).tolist()])
            there = here + by
            inside = ~room[there[:, 0] + 6, there[:, 1] + 6]
            firsts += (here[inside] @ [20, 1]).tolist()
            seconds += (there[inside] @ [20, 1]).tolist()
        yield blocked, firsts[:each], seconds[:each]


@pytest.mark.parametrize(
    ("density", "step", "missed", "alarms"),
    [
        (0.1, 0.1, 0.045, 0.75), (0.2, 0.1, 0.007, 1.65), (0.3, 0.1, 0.0, 2.3), (0.4, 0.1, 0.0, 3.5),
        (0.1, Fraction(1, 10), 0.23, 3.1), (0.2, Fraction(1, 10), 0.08, 6.4),
        (0.3, Fraction(1, 10), 0.03, 9.4), (0.4, Fraction(1, 10), 0.03, 11.8),
    ],
)  # fmt: skip
def test_how_often_the_trial_is_wrong_on_random_maps(density: float, step: Step, missed: float, alarms: float) -> None:
    """Per cent of blocked segments that pass and of free ones that do not; 24 000 pairs."""
    passed, truly = [], []
    for blocked, first, second in random_pairs(density, np.random.default_rng(round(100 * density))):
        passed.append(free(blocked, first, second, step)[0])
        truly.append(free(blocked, first, second, step, tests=EXACT)[0])
    by_trial, by_exact = np.concatenate(passed), np.concatenate(truly)
    assert len(by_trial) == 24_000
    for found, expected, of in (
        ((by_trial & ~by_exact).sum(), missed, (~by_exact).sum()),
        ((~by_trial & by_exact).sum(), alarms, by_exact.sum()),
    ):
        times = expected / 100 * of
        assert abs(found - times) < 4.5 * math.sqrt(2 * times + 2)  # both numbers were counted, on other maps


def test_the_verdict_in_floating_point_depends_on_where_the_segment_lies() -> None:
    found: dict[Step, set[bool]] = {0.1: set(), Fraction(1, 10): set()}
    for r, c in itertools.product(range(3, 28), range(22)):
        blocked = np.zeros((32, 32), bool)
        blocked[r + 1, c + 1] = True  # at (1, -1) from the start, y upwards
        segment = ((r, c), (r + 2, c + 6))  # over (6, -2)
        assert of_cells(blocked, [segment], 0.1, tests=EXACT) == [True]  # touched in a corner
        for step, verdicts in found.items():
            verdicts.update(of_cells(blocked, [segment], step))
    assert found == {0.1: {True, False}, Fraction(1, 10): {False}}


def test_in_exact_arithmetic_one_diagonal_between_two_obstacles_is_open_and_the_other_is_not() -> None:
    rising, falling = np.array([[1, 0], [0, 1]], bool), np.array([[0, 1], [1, 0]], bool)
    assert of_cells(rising, [((1, 0), (0, 1))], Fraction(1, 10)) == [True]
    assert of_cells(falling, [((0, 0), (1, 1))], Fraction(1, 10)) == [False]


@pytest.mark.parametrize("step", [0.1, Fraction(1, 10)])
def test_what_the_strict_test_lets_pass_the_trial_never_refuses(step: Step) -> None:
    for blocked, first, second in random_pairs(0.15, np.random.default_rng(0), maps=20, each=2000):
        by_trial, by_exact = (free(blocked, first, second, step, tests, "strict")[0] for tests in (TRIAL, EXACT))
        assert by_trial[by_exact].all()


def test_what_the_trial_misses_the_exact_test_refuses_and_that_is_counted() -> None:
    blocked = np.zeros((6, 7), bool)
    blocked[0, 1] = (
        True  # between 0.5 and 0.6 of the way in columns, where no sample lies, the first segment crosses it
    )
    pairs = [((0, 0), end) for end in ((5, 6), (5, 5), (0, 6))]
    first, second = ([r * 7 + c for r, c in ends] for ends in zip(*pairs, strict=True))
    step = Fraction(1, 10)
    assert of_cells(blocked, pairs, step) == [True, True, False]
    assert of_cells(blocked, pairs, step, tests=EXACT, corners="allow") == [False, True, False]
    assert of_cells(blocked, pairs, step, tests=EXACT, corners="strict") == [False, False, False]
    for corners, missed in (("allow", 1), ("strict", 2)):
        both, found = free(blocked, first, second, step, TRIAL + EXACT, corners)
        assert both.tolist() == of_cells(blocked, pairs, step, tests=EXACT, corners=corners)
        assert found == missed
        assert free(blocked, first, second, step, EXACT, corners)[1] == 0


# Crossover and mutation -------------------------------------------------------------------------


def judged(blocked: np.ndarray, a: Cell, b: Cell, tests: int, step: Step, corners: str) -> int:
    if tests & TRIAL and not trial(blocked, a, b, step):
        return 0
    if tests & EXACT and not naive.segment_free(blocked, a, b, corners):
        return MISSED if tests & TRIAL else 0
    return FREE


hows = st.tuples(st.sampled_from((0, TRIAL, EXACT, TRIAL + EXACT)), st.sampled_from((0.1, Fraction(1, 10))))


def drawn_paths(data, blocked: np.ndarray, count: int) -> list[Cells]:
    """Draw sequences of free cells, legal segments or not, none of which directly follows itself."""
    cell = st.sampled_from(naive.free_cells(blocked))
    paths = st.lists(cell, min_size=1, max_size=6)
    return [
        tuple(c for k, c in enumerate(path) if k == 0 or c != path[k - 1])
        for path in data.draw(st.lists(paths, min_size=count, max_size=count))
    ]


@given(data=st.data(), blocked=naive.maps(6), how=hows, corners=st.sampled_from(naive.POLICIES), state=naive.words)
@examples(200)
def test_children_are_heads_joined_to_tails_where_the_segment_is_free(data, blocked, how, corners, state) -> None:
    if not naive.free_cells(blocked):
        return
    tests, step = how
    mother, father, third = paths = drawn_paths(data, blocked, 3)
    cols = blocked.shape[1]
    population = naive.packed(paths, cols, data.draw(st.integers(0, 3)))
    before = population.tobytes()
    out, failed, missed = compiled.trial.cut_and_join(
        population, np.array([[0, 1]]), np.ascontiguousarray(blocked, np.uint8).ravel(), *blocked.shape,
        POLICIES[corners], tests, float(step), parts(step), np.array(state, np.uint64),
    )  # fmt: skip
    assert population.tobytes() == before
    children = naive.unpacked(out, cols)
    assert children[2] == third
    possible = set()
    for i, j in itertools.product(range(len(mother) - 1), range(len(father) - 1)):
        made, lost, only = [], 0, 0
        for x, y, at, to in ((mother, father, i, j), (father, mother, j, i)):
            found = judged(blocked, x[at], y[to + 1], tests, step, corners) if tests else FREE
            made.append(naive.without_loops(x[: at + 1] + y[to + 1 :]) if found == FREE else x)
            lost += found != FREE
            only += found == MISSED
        possible.add((*made, lost, only))
    assert (*children[:2], failed, missed) in (possible or {(mother, father, 2, 0)})


def test_every_pair_of_cuts_occurs_about_as_often() -> None:
    mother, father = ((0, 0), (1, 0), (2, 0), (4, 4)), ((0, 0), (0, 2), (0, 3), (0, 4), (4, 4))
    population = naive.packed([mother, father], 5)
    state = np.random.default_rng(0).bit_generator.random_raw(4)
    at, joints = compiled.trial.draw_cuts(population, np.tile([0, 1], (12_000, 1)), state)
    counts = Counter(map(tuple, at.tolist()))
    assert set(counts) == set(itertools.product(range(3), range(4)))
    assert max(abs(times - 1000) for times in counts.values()) < 5 * math.sqrt(1000)
    for (i, j), joint in zip(at.tolist(), joints.reshape(-1, 2, 2).tolist(), strict=True):
        ends = [(mother[i], father[j + 1]), (father[j], mother[i + 1])]
        assert joint == [[r * 5 + c for r, c in pair] for pair in ends]


@given(
    data=st.data(), blocked=naive.maps(6), how=hows, corners=st.sampled_from(naive.POLICIES), anywhere=st.booleans(),
    state=naive.words,
)  # fmt: skip
@examples(200)
def test_mutants_have_one_other_cell_where_both_segments_are_free(data, blocked, how, corners, anywhere, state) -> None:
    cells = naive.free_cells(blocked)
    if not cells:
        return
    tests, step = how
    other, path = paths = drawn_paths(data, blocked, 2)
    cols = blocked.shape[1]
    population = naive.packed(paths, cols, data.draw(st.integers(0, 3)))
    before = population.tobytes()
    library = np.array([r * cols + c for r, c in cells] if anywhere else [], np.int32)
    out, failed, missed = compiled.trial.replace_genes(
        population, np.array([1]), library, np.ascontiguousarray(blocked, np.uint8).ravel(), *blocked.shape,
        POLICIES[corners], tests, float(step), parts(step), np.array(state, np.uint64),
    )  # fmt: skip
    assert population.tobytes() == before
    kept, mutant = naive.unpacked(out, cols)
    assert kept == other
    possible = {(path, 1, 0)} if len(path) < 3 else set()
    for i in range(1, len(path) - 1):
        wanted = (
            cells if anywhere else [c for c in cells if 0 < max(abs(c[0] - path[i][0]), abs(c[1] - path[i][1])) < 2]
        )
        wanted = [c for c in wanted if c not in path[i - 1 : i + 2]]
        for new in wanted:
            found = FREE
            for a, b in ((path[i - 1], new), (new, path[i + 1])):
                if tests and found == FREE:
                    found = judged(blocked, a, b, tests, step, corners)
            changed = naive.without_loops((*path[:i], new, *path[i + 1 :])) if found == FREE else path
            possible.add((changed, int(found != FREE), int(found == MISSED)))
        if not wanted or anywhere:
            possible.add((path, 1, 0))  # nowhere to go, or drawn where it was
    assert (mutant, failed, missed) in possible


def test_every_place_and_every_neighbour_is_drawn_about_as_often() -> None:
    population = naive.packed([((0, 0), (1, 1), (2, 2), (4, 4))], 5)
    blocked = np.zeros(25, np.uint8)
    blocked[1 * 5 + 3] = 1
    state = np.random.default_rng(0).bit_generator.random_raw(4)
    nowhere = np.empty(0, np.int32)
    places, cells = compiled.trial.draw_genes(population, np.zeros(12_000, np.int64), nowhere, blocked, 5, 5, state)
    counts = Counter(zip(places.tolist(), (divmod(cell, 5) for cell in cells.tolist()), strict=True))
    around = set(itertools.product((0, 1, 2), repeat=2)) - {
        (0, 0),
        (1, 1),
        (2, 2),
    }  # neither itself nor those beside it
    assert set(counts) == {
        *((1, cell) for cell in around),
        *((2, cell) for cell in set(itertools.product((1, 2, 3), repeat=2)) - {(1, 1), (2, 2), (1, 3)}),
    }  # (1, 3) is an obstacle
    assert max(abs(times - 1000) for times in counts.values()) < 5 * math.sqrt(1000)


def test_a_cell_from_anywhere_is_none_of_the_three_that_stand_there() -> None:
    population = naive.packed([((0, 0), (2, 2), (0, 1))], 3)
    anywhere = np.arange(9, dtype=np.int32)
    state = np.random.default_rng(0).bit_generator.random_raw(4)
    how = (anywhere, np.zeros(9, np.uint8), 3, 3, state)
    places, cells = compiled.trial.draw_genes(population, np.zeros(9000, np.int64), *how)
    counts = Counter(cells.tolist())
    assert set(counts) == {-1, 2, 3, 4, 5, 6, 7}
    assert abs(counts.pop(-1) - 3000) < 5 * math.sqrt(2000)
    assert max(abs(times - 1000) for times in counts.values()) < 5 * math.sqrt(1000)
    assert ((places == 1) == (cells >= 0)).all()


# Walks ------------------------------------------------------------------------------------------


def walked(problem: PathProblem, n: int, state, *, bias=0.5, loops=True, limit=400, tries=20):
    it = problem.context
    free_ids = np.flatnonzero(it.blocked == 0).astype(np.int32)
    return compiled.walks.sample_by_greedy_walks(
        n, limit, tries, bias, loops, it.start, it.goal, free_ids, it.moves, it.cols, np.array(state, np.uint64)
    )


def nearest(problem: PathProblem, here: Cell, target: Cell) -> list[Cell]:
    """Return the neighbours nearest to a target."""
    around = [there for _, there in naive.legal_steps(problem.context.occupied, here, problem.corners)]
    far = [math.dist(there, target) for there in around]
    return [there for there, d in zip(around, far, strict=True) if d == min(far)]


@given(problem=naive.problems(max_side=6), state=naive.words)
@examples(80)
def test_every_step_goes_to_a_nearest_neighbour_of_some_target(problem: PathProblem, state: list[int]) -> None:
    it = problem.context
    found, failed = walked(problem, 4, state)
    paths = naive.unpacked(found, it.cols)
    assert len(paths) == 4 or failed >= 20
    assert it.reachable or not paths
    for path in paths:
        assert (path[0], path[-1]) == problem.ends
        for here, there in itertools.pairwise(path):
            assert any(there in nearest(problem, here, target) for target in naive.free_cells(it.occupied))


@given(problem=naive.problems(max_side=6), state=naive.words)
@examples(80)
def test_a_walk_that_knows_the_goal_alone_always_steps_nearest_to_it(problem: PathProblem, state: list[int]) -> None:
    found, _ = walked(problem, 3, state, bias=1.0)
    for path in naive.unpacked(found, problem.context.cols):
        for here, there in itertools.pairwise(path):
            assert there in nearest(problem, here, problem.ends[1])


@given(problem=naive.problems(max_side=7), state=naive.words)
@examples(60)
def test_walks_without_loops_are_the_same_walks_with_the_loops_cut_out(problem: PathProblem, state: list[int]) -> None:
    cols = problem.context.cols
    kept, failed = walked(problem, 5, state)
    cut, failed_again = walked(problem, 5, state, loops=False)
    assert failed == failed_again
    assert naive.unpacked(cut, cols) == [naive.without_loops(path) for path in naive.unpacked(kept, cols)]


def test_of_two_neighbours_equally_near_each_is_taken_half_of_the_time() -> None:
    blocked = np.zeros((5, 5), bool)
    blocked[2, 1] = True
    problem = PathProblem(blocked, start=(2, 0), goal=(2, 4), corners="allow")
    found, _ = walked(problem, 4000, [1, 2, 3, 4], bias=1.0)
    counts = Counter(path[1] for path in naive.unpacked(found, 5))
    assert set(counts) == {(1, 1), (3, 1)}
    assert abs(counts[1, 1] - 2000) < 5 * math.sqrt(1000)


def test_the_goal_is_the_target_as_often_as_the_bias_says() -> None:
    # from the middle of a row of three the goal lies right; of the three free cells so do two, in effect: the goal
    # itself, and the middle, from which both ends are as far
    problem = PathProblem(np.zeros((1, 3), bool), start=(0, 1), goal=(0, 2))
    for bias in (0.0, 0.5, 1.0):
        found, _ = walked(problem, 4000, [1, 2, 3, 4], bias=bias)
        at_once = sum(len(path) == 2 for path in naive.unpacked(found, 3)) / 4000
        assert abs(at_once - (bias + (1 - bias) / 2)) < 0.04


def test_walks_that_take_too_long_fail_and_are_given_up_after_so_many_in_a_row() -> None:
    problem = PathProblem(np.zeros((9, 9), bool))
    found, failed = walked(problem, 3, [1, 2, 3, 4], limit=7, tries=11)
    assert (found.shape, failed) == ((0, 1), 11)
    found, failed = walked(problem, 3, [1, 2, 3, 4], bias=1.0, limit=8, tries=1)
    assert (found.shape, failed) == ((3, 9), 0)


def test_walks_from_a_cell_without_neighbours_fail_and_from_the_goal_stay() -> None:
    split = PathProblem(np.array([[0, 1, 0]], bool), start=(0, 0), goal=(0, 2))
    assert walked(split, 2, [1, 2, 3, 4], tries=4)[1] == 4
    there = PathProblem(np.zeros((3, 3), bool), start=(1, 1), goal=(1, 1))
    assert walked(there, 2, [1, 2, 3, 4])[0].tolist() == [[4], [4]]
