"""Kernels of ants and of guided walks, against their twins."""

import math
from collections.abc import Iterator
from itertools import pairwise

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import Cell, Cells, examples

from pathloom import PathProblem, compiled

Table = dict[tuple[Cell, int], float]


class Words:
    """The random numbers of the kernels."""

    def __init__(self, state: list[int]) -> None:
        self.words = naive.xoshiro(state)

    def below(self, bound: int) -> int:
        return (next(self.words) >> 32) * bound >> 32

    def uniform(self) -> float:
        return (next(self.words) >> 11) / 2**53

    def chosen(self, options: list[tuple[Cell, float]]) -> Cell:
        """Choose in proportion to strength; among the infinite ones if there are any, among all if all are zero."""
        total = 0.0
        for _, strength in options:
            total += strength
        if 0 < total < math.inf:
            left = self.uniform() * total
            for cell, strength in options[:-1]:
                left -= strength
                if left < 0:
                    return cell
            return options[-1][0]
        infinite = [cell for cell, strength in options if strength == math.inf]
        among = infinite or [cell for cell, _ in options]
        return among[self.below(len(among))]


def ids(cells: Cells, cols: int) -> list[int]:
    return [r * cols + c for r, c in cells]


def as_array(table: Table, shape: Cell) -> np.ndarray:
    out = np.zeros((shape[0] * shape[1], 8))
    for ((r, c), d), value in table.items():
        out[r * shape[1] + c, d] = value
    return out


def all_steps(problem: PathProblem) -> Iterator[tuple[Cell, int, Cell]]:
    occupied = problem.context.occupied
    for cell in naive.free_cells(occupied):
        for d, there in naive.legal_steps(occupied, cell, problem.corners):
            yield cell, d, there


def drawn_table(data: st.DataObject, problem: PathProblem, *values: float) -> Table:
    rng = np.random.default_rng(data.draw(st.integers(0, 999)))
    return {(cell, d): float(rng.choice(values)) for cell, d, _ in all_steps(problem)}


def walk(
    start: Cell, goal: Cell, problem: PathProblem, barred: set[Cell], strength, words: Words, retreat: bool = True
) -> tuple[Cells | None, list[Cell]]:
    """Walk to the goal, to no cell twice; return the way, and the cells without a way on."""
    path, visited, stuck = [start], {start} | barred, []
    while path[-1] != goal:
        steps = naive.legal_steps(problem.context.occupied, path[-1], problem.corners)
        options = [(there, strength(path[-1], d, there)) for d, there in steps if there not in visited]
        if options:
            path.append(words.chosen(options))
            visited.add(path[-1])
            continue
        stuck.append(path.pop())
        if not path or not retreat:
            return None, stuck
    return tuple(path), stuck


# March ------------------------------------------------------------------------------------------


@given(data=st.data(), problem=naive.problems(5), words=naive.words, retreat=st.booleans())
@examples(150)
def test_ants_march_as_their_twins_do(data, problem: PathProblem, words: list[int], retreat: bool) -> None:
    it, (start, goal) = problem.context, problem.ends
    alpha = data.draw(st.sampled_from((0.0, 1.0, 2.0, 0.5)))
    pheromone = drawn_table(data, problem, 0.0, 0.25, 1.0, 3.0)
    desire = drawn_table(data, problem, 0.0, 0.5, 1.0, math.inf)
    inside = [cell for cell in naive.free_cells(it.occupied) if cell not in (start, goal)]
    closed = set(data.draw(st.lists(st.sampled_from(inside), max_size=3))) if inside else set()

    def strength(cell: Cell, d: int, there: Cell) -> float:
        wanted = desire[cell, d]
        return wanted if wanted == math.inf else wanted * pheromone[cell, d] ** alpha

    twin, arrived, stuck = Words(words), [], np.zeros(it.occupied.shape, int)
    for _ in range(4):
        path, without = walk(start, goal, problem, closed, strength, twin, retreat)
        arrived += [path] if path else []
        for cell in without:
            stuck[cell] += cell != start
    mask = np.zeros(it.blocked.size, np.uint8)
    mask[ids(tuple(closed), it.cols)] = 1
    shape = it.occupied.shape
    found, counted = compiled.ants.march(
        4, as_array(pheromone, shape), as_array(desire, shape), alpha, it.moves, mask, it.cols, it.start, it.goal,
        retreat, np.array(words, np.uint64),
    )  # fmt: skip
    assert naive.unpacked(found, it.cols) == arrived
    assert counted.tolist() == stuck.ravel().tolist()
    if retreat and compiled.ants.reaches(it.moves, mask, it.cols, it.start, it.goal):
        assert len(arrived) == 4


@given(problem=naive.problems(6), data=st.data())
@examples(100)
def test_a_way_without_closed_cells_is_found_if_there_is_one(problem: PathProblem, data) -> None:
    it, (start, goal) = problem.context, problem.ends
    inside = [cell for cell in naive.free_cells(it.occupied) if cell not in (start, goal)]
    closed = data.draw(st.sets(st.sampled_from(inside))) if inside else set()
    mask = np.zeros(it.blocked.size, np.uint8)
    mask[ids(tuple(closed), it.cols)] = 1

    def edges(cell: Cell) -> Iterator[tuple[Cell, float]]:
        steps = naive.legal_steps(it.occupied, cell, problem.corners)
        return ((there, 1.0) for _, there in steps if there not in closed)

    there = goal in naive.dijkstra(start, edges)
    assert compiled.ants.reaches(it.moves, mask, it.cols, it.start, it.goal) == there


# Pheromone --------------------------------------------------------------------------------------


def walked_paths(problem: PathProblem, n: int, seed: int) -> list[Cells]:
    it = problem.context
    state = np.random.default_rng(seed).bit_generator.random_raw(4)
    found = compiled.guided.sample_by_guided_walks(n, it.start, it.goal, 0.5, it.moves, it.cols, state)
    return naive.unpacked(found, it.cols)


def direction(a: Cell, b: Cell) -> int:
    return naive.STEPS.index((b[0] - a[0], b[1] - a[1]))


@given(data=st.data(), problem=naive.problems(5), seed=st.integers(0, 999), into=st.booleans())
@examples(100)
def test_pheromone_evaporates_and_is_left_along_paths(data, problem: PathProblem, seed: int, into: bool) -> None:
    it, paths = problem.context, walked_paths(problem, 3, seed)
    before = drawn_table(data, problem, 0.5, 1.0, 2.0)
    amounts = [0.5, 0.125, 2.0][: len(paths)]
    least, most = data.draw(st.sampled_from(((0.0, math.inf), (0.75, 1.5), (0.0, 1.0))))
    expected = {step: value * 0.75 for step, value in before.items()}
    for path, amount in zip(paths, amounts, strict=True):
        for a, b in pairwise(path):
            if not into:
                expected[a, direction(a, b)] += amount
                continue
            for cell, d, there in all_steps(problem):
                if there == b:
                    expected[cell, d] += amount
    expected = {step: min(max(value, least), most) for step, value in expected.items()}
    found = compiled.ants.renew(
        as_array(before, it.occupied.shape), 0.75, naive.packed(paths, it.cols), np.array(amounts), it.moves, it.cols,
        into, least, most,
    )  # fmt: skip
    for (cell, d), value in expected.items():
        assert found[cell[0] * it.cols + cell[1], d] == value


@given(problem=naive.problems(5), seed=st.integers(0, 999), largest=st.booleans())
@examples(100)
def test_pheromone_is_laid_to_and_fro(problem: PathProblem, seed: int, largest: bool) -> None:
    it, paths = problem.context, walked_paths(problem, 3, seed)
    amounts = [0.5, 0.125, 0.25][: len(paths)]
    laid: dict[tuple[Cell, int], list[float]] = {(cell, d): [] for cell, d, _ in all_steps(problem)}
    for path, amount in zip(paths, amounts, strict=True):
        for a, b in pairwise(path):
            laid[a, direction(a, b)].append(amount / math.dist(a, b))
            laid[b, direction(b, a)].append(amount / math.dist(a, b))
    found = compiled.ants.lay(0.2, naive.packed(paths, it.cols), np.array(amounts), it.blocked.size, it.cols, largest)
    for ((r, c), d), values in laid.items():
        together = max(values, default=0.0) if largest else sum(values)
        assert math.isclose(found[r * it.cols + c, d], max(together, 0.2))


@given(data=st.data(), problem=naive.problems(5))
@examples(60)
def test_steps_into_marked_cells_are_weakened(data, problem: PathProblem) -> None:
    it, before = problem.context, drawn_table(data, problem, 1.0, 2.0)
    marked = data.draw(st.sets(st.sampled_from(naive.free_cells(it.occupied))))
    mask = np.zeros(it.blocked.size, bool)
    mask[ids(tuple(marked), it.cols)] = True
    found = compiled.ants.weaken(as_array(before, it.occupied.shape), mask, it.moves, it.cols, 0.25)
    expected = {
        (cell, d): before[cell, d] * (0.25 if there in marked else 1.0) for cell, d, there in all_steps(problem)
    }
    assert found.tolist() == as_array(expected, it.occupied.shape).tolist()


@given(problem=naive.problems(6))
@examples(40)
def test_steps_are_counted_per_cell_that_has_any(problem: PathProblem) -> None:
    steps = [cell for cell, _, _ in all_steps(problem)]
    assert compiled.ants.mean_steps(problem.context.moves) == len(steps) / max(len(set(steps)), 1)


# Guided walks -----------------------------------------------------------------------------------


def drawn_to(target: Cell, pull: float):
    def strength(cell: Cell, _: int, there: Cell) -> float:
        if there == target:
            return math.inf
        far = [math.sqrt((r - target[0]) ** 2 + (c - target[1]) ** 2) for r, c in (cell, there)]
        return math.exp(pull * (far[0] - far[1]))

    return strength


@given(problem=naive.problems(6), words=naive.words, pull=st.sampled_from((0.0, 0.5, 2.0, 100.0)))
@examples(100)
def test_guided_walks_go_as_their_twins_do_and_always_arrive(
    problem: PathProblem, words: list[int], pull: float
) -> None:
    it, (start, goal) = problem.context, problem.ends
    twin = Words(words)
    expected = [walk(start, goal, problem, set(), drawn_to(goal, pull), twin)[0] for _ in range(3)]
    state = np.array(words, np.uint64)
    found = compiled.guided.sample_by_guided_walks(3, it.start, it.goal, pull, it.moves, it.cols, state)
    assert naive.unpacked(found, it.cols) == [path for path in expected if path is not None]
    assert len(found) == 3 * problem.reachable


@given(problem=naive.problems(6), words=naive.words, seed=st.integers(0, 999))
@examples(100)
def test_both_parts_of_a_path_are_searched_again(problem: PathProblem, words: list[int], seed: int) -> None:
    it, paths = problem.context, walked_paths(problem, 3, seed)
    chosen = list(range(len(paths)))[::-2]
    twin, before = Words(words), naive.packed(paths, it.cols, 2)
    genes = [1 + twin.below(len(paths[k]) - 2) if len(paths[k]) > 2 else 0 for k in chosen]
    expected = []
    for k, gene in zip(chosen, genes, strict=True):  # from the gene back to the start
        path = paths[k]
        if gene:
            anew, _ = walk(path[gene], path[0], problem, set(path[gene + 1 :]), drawn_to(path[0], 2.0), twin)
            path = (*anew[::-1], *path[gene + 1 :])
        expected.append(path)
    for k, gene in zip(chosen, genes, strict=True):  # from the goal back to the gene
        path = paths[k]
        if gene:
            anew, _ = walk(path[-1], path[gene], problem, set(path[:gene]), drawn_to(path[gene], 2.0), twin)
            path = (*path[:gene], *anew[::-1])
        expected.append(path)
    found, failed = compiled.guided.search_again(
        before, np.array(chosen, np.int64), 2.0, it.moves, it.cols, np.array(words, np.uint64)
    )
    assert naive.unpacked(found, it.cols) == expected
    assert failed == genes.count(0)
    assert before.tolist() == naive.packed(paths, it.cols, 2).tolist()


def test_a_part_that_cannot_be_walked_round_the_other_stays() -> None:
    it = PathProblem(np.zeros((1, 5), bool), start=(0, 0), goal=(0, 2)).context
    there_and_back = np.array([[0, 1, 2, 3, 2]], np.int32)  # whoever walks from 3 to 0 must pass 2, which is kept
    found, failed = compiled.guided.search_again(
        there_and_back, np.array([0]), 2.0, it.moves, it.cols, np.array([5, 6, 7, 9], np.uint64)
    )
    assert found[0].tolist() == [0, 1, 2, 3, 2]
    assert failed == 0


@given(data=st.data())
@examples(60)
def test_paths_meet_where_they_share_a_cell_between_their_ends(data) -> None:
    paths = data.draw(st.lists(naive.paths_on((3, 3)), min_size=2, max_size=5))
    pairs = data.draw(st.lists(st.tuples(*[st.integers(0, len(paths) - 1)] * 2), min_size=1, max_size=4))
    found = compiled.guided.meet(naive.packed(paths, 3), np.array(pairs), 9)
    assert found.tolist() == [bool(set(paths[x][1:-1]) & set(paths[y][1:-1])) for x, y in pairs]


# Included angles --------------------------------------------------------------------------------


def class_of(before: Cell, here: Cell, after: Cell) -> int:
    """Measure the angle between the ways back and on, in degrees, and round it down to one of the table."""
    back, on = (math.atan2(r - here[0], c - here[1]) for r, c in (before, after))
    degrees = abs(math.degrees(back - on))
    degrees = round(min(degrees, 360 - degrees), 9)
    return next(k for k, least in enumerate((180, 135, 90, 45, 0)) if degrees >= least)


@given(paths=st.lists(naive.paths_on((9, 7)), min_size=1, max_size=4), padding=st.integers(0, 2))
@examples(150)
def test_included_angles_are_those_that_a_protractor_shows(paths: list[Cells], padding: int) -> None:
    expected = np.zeros((len(paths), 5))
    for k, path in enumerate(paths):
        for three in zip(path[:-2], path[1:-1], path[2:], strict=True):
            expected[k, class_of(*three)] += 1
    assert compiled.angles.included_angles(naive.packed(paths, 7, padding), 7).tolist() == expected.tolist()


# Merging ----------------------------------------------------------------------------------------


def merged(mother: Cells, father: Cells) -> Cells:
    """Take, between common cells that follow each other in both, the shorter way."""
    child, i, j = [mother[0]], 0, 0
    for b, cell in enumerate(father):
        if cell in mother and mother.index(cell) > i:
            a = mother.index(cell)
            ways = mother[i : a + 1], father[j : b + 1]
            child += min(ways, key=naive.length)[1:]
            i, j = a, b
    return naive.without_loops(tuple(child))


@given(problem=naive.problems(6, corners=("allow",)), seed=st.integers(0, 999))
@examples(100)
def test_the_child_of_a_pair_goes_the_shorter_way_from_meeting_to_meeting(problem: PathProblem, seed: int) -> None:
    it, paths = problem.context, walked_paths(problem, 5, seed)
    if not paths:
        return
    expected, failed = list(paths), 0
    for x, y in ((0, 1), (3, 2)):
        child, lengths = merged(paths[x], paths[y]), [naive.length(paths[x]), naive.length(paths[y])]
        worse = x if lengths[0] > lengths[1] + 1e-9 else y
        if naive.length(child) < max(lengths) - 1e-9:
            expected[worse] = child
        else:
            failed += 1
    found, count = compiled.merging.merge(
        naive.packed(paths, it.cols), np.array([[0, 1], [3, 2]]), it.blocked.size, it.cols
    )
    assert naive.unpacked(found, it.cols) == expected
    assert count == failed


def test_a_child_may_have_more_cells_than_either_parent() -> None:
    pair = np.array([[0, 1, 2, 3, 4, 24, 8], [0, 20, 4, 5, 6, 7, 8]], np.int32)  # on 3 rows of 9
    found, failed = compiled.merging.merge(pair, np.array([[0, 1]]), 27, 9)
    assert [list(range(9)), failed] in ([row.tolist(), 0] for row in found)


def test_strengths_that_are_all_zero_leave_the_choice_to_chance() -> None:
    it = PathProblem(np.zeros((3, 3), bool), start=(0, 0), goal=(2, 2)).context
    nothing = np.zeros((9, 8))
    found, _ = compiled.ants.march(
        400, nothing, nothing, 1.0, it.moves, np.zeros(9, np.uint8), 3, 0, 8, True, np.array([1, 2, 3, 4], np.uint64)
    )
    first = np.bincount(found[:, 1], minlength=9)
    assert set(np.flatnonzero(first)) == {1, 3, 4}
    assert first[first > 0] == pytest.approx(400 / 3, abs=40)
