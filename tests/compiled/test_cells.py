"""Kernels on populations of cell paths, against their twins; operators by what their children must be."""

import math

import naive
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from naive import Cells, examples

from pathloom import PathProblem, compiled
from pathloom.paths.context import Context


@given(data=st.data(), shape=st.tuples(st.integers(1, 60), st.integers(1, 60)))
@examples(100)
def test_lengths_are_sums_of_distances(data, shape) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape), min_size=1, max_size=4))
    population = naive.packed(paths, shape[1], data.draw(st.integers(0, 9)))
    expected = [naive.length(path) for path in paths]
    assert compiled.measures.lengths(population, shape[1]) == pytest.approx(expected, rel=1e-12)


def test_paths_of_single_steps_are_equally_long_in_any_order() -> None:
    up_first = ((3, 0), (2, 0), (1, 1), (0, 1), (0, 2), (1, 3))
    down_first = ((0, 0), (1, 1), (1, 2), (2, 2), (3, 2), (2, 3))
    population = naive.packed([up_first, down_first], 4)
    first, second = compiled.measures.lengths(population, 4)
    assert first == second == 3 + 2 * math.sqrt(2)


@pytest.mark.parametrize("cols", [1, 2, 3, 7, 49, 1491, 4093, 46340])
def test_rows_are_told_apart_at_the_edges_of_every_width(cols: int) -> None:
    rows = np.unique(np.concatenate((np.arange(50), np.geomspace(1, (2**31 - 1) // cols, 50).astype(np.int64))))
    for row in rows.tolist():
        last = min(row * cols + cols - 1, 2**31 - 1)
        assert [compiled.rows.row_of(cell, 1.0 / cols) for cell in (row * cols, last)] == [row, row]


@given(data=st.data(), shape=st.tuples(st.integers(1, 9), st.integers(1, 9)))
@examples(100)
def test_turns_and_angles_are_those_of_directions_in_lowest_terms(data, shape) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape), min_size=1, max_size=4))
    found = compiled.measures.turns(naive.packed(paths, shape[1], data.draw(st.integers(0, 9))), shape[1])
    assert found[:, 0].tolist() == [naive.turns(path) for path in paths]
    assert found[:, 1] == pytest.approx([naive.turn_angle(path) for path in paths], abs=1e-12)


def test_going_straight_back_is_one_turn_of_pi() -> None:
    assert compiled.measures.turns(naive.packed([((0, 0), (0, 2), (0, 1))], 3), 3).tolist() == [[1.0, math.pi]]


def test_steps_of_other_lengths_in_one_direction_are_no_turn() -> None:
    assert compiled.measures.turns(naive.packed([((0, 0), (1, 2), (3, 6))], 7), 7).tolist() == [[0.0, 0.0]]


@given(data=st.data(), shape=st.tuples(st.integers(1, 7), st.integers(1, 7)), skips=st.tuples(*[st.integers(0, 2)] * 2))
@examples(80)
def test_sums_over_nodes_skip_the_ends(data, shape, skips) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape), min_size=1, max_size=4))
    table = (np.arange(shape[0] * shape[1]) * 37 % 256).astype(np.uint8)
    ids = [[r * shape[1] + c for r, c in path] for path in paths]
    expected = [sum(int(table[cell]) for cell in row[skips[0] : max(len(row) - skips[1], 0)]) for row in ids]
    population = naive.packed(paths, shape[1], data.draw(st.integers(0, 9)))
    assert compiled.measures.sum_over_nodes(population, table, *skips).tolist() == expected


@given(data=st.data(), shape=st.tuples(st.integers(1, 8), st.integers(1, 8)), by_angle=st.booleans())
@examples(120)
def test_energy_goes_by_the_quadrant_or_the_angle_of_each_new_direction(data, shape, by_angle: bool) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape), min_size=1, max_size=4))
    goal = data.draw(naive.cells_of(shape))
    signs = data.draw(st.sampled_from([(1, 1), (1, -1), (-1, 1), (-1, -1)]))
    population = naive.packed(paths, shape[1], data.draw(st.integers(0, 9)))
    price = (1.0, 3.0, 10.0)
    found = compiled.measures.quadrant_energy(
        population, shape[1], goal[0] * shape[1] + goal[1], *signs, np.array(price), by_angle
    )
    assert found.tolist() == [naive.quadrant_energy(path, goal, signs, price, by_angle) for path in paths]


@given(
    data=st.data(),
    shape=st.tuples(st.integers(1, 3), st.integers(1, 3)),
    paddings=st.tuples(st.integers(0, 5), st.integers(0, 5)),
)
@examples(120)
def test_newcomers_were_not_there_before(data, shape, paddings) -> None:
    paths, before = (data.draw(st.lists(naive.paths_on(shape, 3), max_size=8)) for _ in range(2))
    now, then = (naive.packed(p, shape[1], k) for p, k in zip((paths, before), paddings, strict=True))
    assert compiled.identity.newcomers(now, then).tolist() == naive.newcomers(paths, before)


@given(data=st.data(), shape=st.tuples(st.integers(1, 3), st.integers(1, 3)), padding=st.integers(0, 5))
@examples(120)
def test_paths_are_told_apart_and_each_knows_the_first_of_its_kind(data, shape, padding: int) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape, 3), max_size=12))
    first, which = compiled.identity.distinct(naive.packed(paths, shape[1], padding))
    assert (first.tolist(), which.tolist()) == naive.distinct(paths)


def test_many_paths_of_few_kinds_are_told_apart() -> None:
    rng = np.random.default_rng(0)
    paths = [tuple((0, int(c)) for c in np.flatnonzero(rng.random(5) < 0.5)) or ((0, 0),) for _ in range(3000)]
    first, which = compiled.identity.distinct(naive.packed(paths, 5))
    assert len(first) == 31
    assert (first.tolist(), which.tolist()) == naive.distinct(paths)


@given(path=naive.paths_on((3, 3), 14))
@examples(120)
def test_loops_are_cut_out_and_the_marks_wiped(path: Cells) -> None:
    row = naive.packed([path], 3)[0]
    mark = np.zeros(9, np.int32)
    count = compiled.insertion.remove_loops(row, len(path), mark)
    assert tuple(divmod(cell, 3) for cell in row[:count].tolist()) == naive.without_loops(path)
    assert not mark.any()


def exchanged(paths: list[Cells], pairs: list, cols: int, cells: int, *, loops: bool, state: list[int]):
    population = naive.packed(paths, cols, padding=3)
    before = population.copy()
    children, failed = compiled.exchange.exchange_tails(
        population, np.array(pairs, np.int64).reshape(-1, 2), cells, loops, np.array(state, np.uint64)
    )
    np.testing.assert_array_equal(population, before)
    return naive.unpacked(children, cols), failed


@given(data=st.data(), shape=st.tuples(st.integers(1, 4), st.integers(1, 4)), loops=st.booleans(), state=naive.words)
@examples(150)
def test_children_swap_tails_at_a_common_cell_or_are_their_parents(data, shape, loops: bool, state) -> None:
    paths = data.draw(st.lists(naive.paths_on(shape), min_size=4, max_size=4))
    children, failed = exchanged(paths, [(2, 0)], shape[1], shape[0] * shape[1], loops=loops, state=state)
    possible = naive.exchanges(paths[2], paths[0], loops)
    assert (children[2], children[0]) in possible
    assert (children[1], children[3]) == (paths[1], paths[3])
    assert failed == (not set(paths[2][1:-1]) & set(paths[0][1:-1]))


def test_every_common_cell_is_chosen_sometimes() -> None:
    mother = ((0, 0), (0, 1), (1, 2), (2, 3), (2, 4))
    father = ((0, 0), (1, 0), (0, 1), (1, 1), (1, 2), (2, 3), (3, 3), (2, 4))
    seen = {
        tuple(exchanged([mother, father], [(0, 1)], 5, 20, loops=False, state=[1, 2, 3, seed << 40])[0])
        for seed in range(40)
    }
    assert seen == naive.exchanges(mother, father, loops=False)
    assert len(seen) == 2  # behind (0, 1), or behind (1, 2) or (2, 3), which follow each other in both


def test_ends_that_are_common_do_not_count() -> None:
    short = ((0, 0), (0, 1))
    _, failed = exchanged([short, short], [(0, 1)], 2, 2, loops=False, state=[1, 2, 3, 4])
    assert failed == 1


def test_no_pairs_give_the_population_back() -> None:
    paths = [((0, 0), (0, 1)), ((0, 0),)]
    assert exchanged(paths, [], 2, 2, loops=False, state=[1, 2, 3, 4]) == (paths, 0)


def sampled(problem: PathProblem, n: int, state: list[int], *, tries=50, reach=8, cap=40, guarded=True, loops=False):
    it = problem.context
    return compiled.insertion.sample_by_insertion(
        n, tries, it.start, it.goal, it.reachable_cells, it.blocked, it.moves, it.rows, it.cols, *it.signs,
        reach, cap, guarded, loops, np.array(state, np.uint64),
    )  # fmt: skip


def assert_legal(path: Cells, problem: PathProblem, *, loops: bool = False) -> None:
    assert (path[0], path[-1]) == problem.ends
    assert naive.steps_singly(path)
    assert naive.path_free(problem.context.occupied, path, problem.corners)
    assert loops or len(set(path)) == len(path)


@given(
    problem=naive.problems(),
    state=naive.words,
    reach=st.sampled_from([4, 8]),
    guarded=st.booleans(),
    loops=st.booleans(),
)
@examples(100)
def test_insertion_draws_distinct_legal_paths(problem, state, reach, guarded, loops) -> None:
    assume(problem.context.start != problem.context.goal)
    found, failed, again = sampled(problem, 6, state, reach=reach, guarded=guarded, loops=loops)
    paths = naive.unpacked(found, problem.context.cols)
    assert len(paths) == 6 or failed + again >= 50
    assert len(set(paths)) == len(paths)
    for path in paths:
        assert_legal(path, problem, loops=loops)


@given(problem=naive.problems(), state=naive.words)
@examples(30)
def test_insertion_gives_the_same_bytes_for_the_same_words(problem, state) -> None:
    assume(problem.context.start != problem.context.goal)
    first, second = (sampled(problem, 5, state) for _ in range(2))
    assert first[0].tobytes() == second[0].tobytes()
    assert first[1:] == second[1:]


def test_insertion_on_an_empty_map_goes_straight_where_it_can() -> None:
    problem = PathProblem(np.zeros((1, 5), bool), start=(0, 4), goal=(0, 0))
    found, _, again = sampled(problem, 3, [1, 2, 3, 4], tries=20)
    assert naive.unpacked(found, 5) == [((0, 4), (0, 3), (0, 2), (0, 1), (0, 0))]
    assert again == 20


def test_insertion_without_any_cell_between_start_and_goal_joins_them_directly() -> None:
    problem = PathProblem(np.zeros((1, 2), bool), start=(0, 0), goal=(0, 1))
    found, _, _ = sampled(problem, 2, [1, 2, 3, 4], tries=5)
    assert naive.unpacked(found, 2) == [((0, 0), (0, 1))]


def test_insertion_gives_up_after_as_many_failures_in_a_row_as_tries() -> None:
    blocked = np.array([[0, 1, 0]], bool)
    it = Context(blocked, "strict", 0, 2)
    found, failed, again = compiled.insertion.sample_by_insertion(
        4, 7, 0, 2, np.empty(0, np.int32), it.blocked, it.moves, 1, 3, 1, 1, 8, 16, True, False,
        np.array([1, 2, 3, 4], np.uint64),
    )  # fmt: skip
    assert (found.shape, failed, again) == ((0, 1), 7, 0)


def mutated(
    problem: PathProblem, paths: list[Cells], chosen: list[int], state: list[int], *, cap=40, reach=8, loops=False
):
    it = problem.context
    population = naive.packed(paths, it.cols, padding=2)
    before = population.copy()
    changed, failed = compiled.insertion.mutate_neighbour(
        population, np.array(chosen, np.int64), it.blocked, it.moves, it.rows, it.cols, *it.signs,
        reach, cap, True, loops, np.array(state, np.uint64),
    )  # fmt: skip
    np.testing.assert_array_equal(population, before)
    return naive.unpacked(changed, it.cols), failed


@given(
    problem=naive.problems(),
    state=naive.words,
    reach=st.sampled_from([4, 8]),
    cap=st.sampled_from([0, 1, 40]),
    loops=st.booleans(),
)
@examples(120)
def test_mutation_keeps_paths_legal_and_leaves_the_others_alone(problem, state, reach, cap, loops) -> None:
    assume(problem.context.start != problem.context.goal)
    paths = naive.unpacked(sampled(problem, 5, state)[0], problem.context.cols)
    assume(len(paths) > 1)
    changed, failed = mutated(problem, paths, [len(paths) - 1, 0], state, cap=cap, reach=reach, loops=loops)
    assert changed[1:-1] == paths[1:-1]
    assert sum(old == new for old, new in zip(paths, changed, strict=True)) >= len(paths) - 2 + failed
    for path in changed:
        assert_legal(path, problem, loops=loops)


def test_mutation_of_one_gene_moves_one_cell_to_where_it_fits() -> None:
    problem = PathProblem(np.zeros((3, 5), bool), start=(1, 0), goal=(1, 4))
    path = tuple((1, c) for c in range(5))
    for seed in range(30):
        (changed,), failed = mutated(problem, [path], [0], [1, 2, 3, seed << 40], cap=0)
        assert len(changed) == 5
        assert sum(a != b for a, b in zip(path, changed, strict=True)) == 1 - failed


def test_mutation_of_a_path_without_interior_fails_and_is_counted() -> None:
    problem = PathProblem(np.zeros((2, 2), bool), start=(0, 0), goal=(0, 1))
    paths = [((0, 0), (0, 1))]
    assert mutated(problem, paths, [0], [1, 2, 3, 4]) == (paths, 1)


def test_mutation_in_a_corridor_has_nowhere_to_go() -> None:
    problem = PathProblem(np.zeros((1, 4), bool), start=(0, 0), goal=(0, 3))
    paths = [((0, 0), (0, 1), (0, 2), (0, 3))]
    assert mutated(problem, paths, [0], [1, 2, 3, 4]) == (paths, 1)


def test_nobody_chosen_is_nobody_changed() -> None:
    problem = PathProblem(np.zeros((2, 2), bool))
    paths = [((1, 0), (0, 1))]
    assert mutated(problem, paths, [], [1, 2, 3, 4]) == (paths, 0)


def test_empty_populations_give_empty_answers() -> None:
    nobody = np.empty((0, 1), np.int32)
    assert compiled.measures.lengths(nobody, 3).shape == (0,)
    assert compiled.measures.turns(nobody, 3).shape == (0, 2)
    assert compiled.measures.sum_over_nodes(nobody, np.zeros(9, np.uint8), 0, 1).shape == (0,)
    assert compiled.measures.quadrant_energy(nobody, 3, 2, 1, 1, np.ones(3), False).shape == (0,)
    assert compiled.identity.newcomers(nobody, nobody).shape == (0,)
    assert [part.shape for part in compiled.identity.distinct(nobody)] == [(0,), (0,)]
