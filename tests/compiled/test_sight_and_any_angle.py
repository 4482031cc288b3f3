"""What cells see, and the search for the shortest path among what they see, against their twins."""

import math

import naive
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from naive import POLICIES, examples

from pathloom import PathProblem, compiled
from pathloom.exact.taut import taut_distances


@given(blocked=naive.maps(8), data=st.data())
@examples(120)
def test_a_cell_sees_the_cells_to_which_the_segment_is_free(blocked: np.ndarray, data) -> None:
    here = data.draw(naive.cells_of(blocked.shape))
    blocked[here] = False
    cols = blocked.shape[1]
    flat = blocked.ravel().astype(np.uint8)
    for policy, corners in enumerate(POLICIES):
        seen = compiled.sight.cells_in_sight(flat, cols, here[0] * cols + here[1], policy).tolist()
        expected = [c for c in naive.free_cells(blocked) if naive.segment_free(blocked, here, c, corners)]
        assert sorted(divmod(cell, cols) for cell in seen) == expected


@given(seed=st.integers(0, 2**32), share=st.sampled_from((0.05, 0.2, 0.4)))
@examples(30)
def test_on_larger_maps_a_cell_sees_what_the_test_of_segments_lets_through(seed: int, share: float) -> None:
    rng = np.random.default_rng(seed)
    blocked = (rng.random((40, 90)) < share).astype(np.uint8).ravel()
    free = np.flatnonzero(blocked == 0).astype(np.int32)
    here = rng.choice(free)
    for policy in range(3):
        clear = compiled.segments.segments_free(blocked, 90, np.full_like(free, here), free, policy)
        seen = compiled.sight.cells_in_sight(blocked, 90, here, policy)
        assert sorted(seen.tolist()) == free[clear].tolist()


def straight(it) -> tuple[np.ndarray, np.ndarray]:
    """Return the plainest bounds there are."""
    row, col = np.divmod(np.arange(it.blocked.size), it.cols)
    before, after = (np.hypot(row - end // it.cols, col - end % it.cols) for end in (it.start, it.goal))
    return before, after


def search(problem: PathProblem, upper: float = math.inf, work: int = 10**9):
    it = problem.context
    return compiled.any_angle.any_angle_path(
        it.blocked, it.cols, it.start, it.goal, it.policy, *straight(it), upper, work
    )


@given(problem=naive.problems(max_side=6))
@examples(60)
def test_the_any_angle_path_is_free_and_as_short_as_its_twin(problem: PathProblem) -> None:
    it = problem.context
    cells, bound, _ = search(problem)
    best = naive.any_angle_distances(it.occupied, problem.start, problem.corners).get(problem.goal)
    if best is None:
        assert len(cells) == 0
        assert bound == math.inf
        return
    path = tuple(divmod(cell, it.cols) for cell in cells.tolist())
    assert (path[0], path[-1]) == problem.ends
    assert naive.path_free(it.occupied, path, problem.corners)
    assert math.isclose(naive.length(path), best, rel_tol=1e-12)
    assert math.isclose(bound, best, rel_tol=1e-12)


@given(problem=naive.problems(max_side=6), share=st.floats(0.0, 1.5))
@examples(80)
def test_a_path_no_longer_than_the_limit_is_found_and_else_the_limit_is_a_bound(
    problem: PathProblem, share: float
) -> None:
    best = naive.any_angle_distances(problem.context.occupied, problem.start, problem.corners).get(problem.goal)
    if best is None:
        return
    upper = share * best
    cells, bound, _ = search(problem, upper)
    if upper >= best:
        assert len(cells) > 0
    assert bound <= best + 1e-9
    assert len(cells) > 0 or bound == upper


@given(problem=naive.problems(max_side=6), work=st.integers(0, 200))
@examples(60)
def test_a_search_that_is_given_up_leaves_a_bound(problem: PathProblem, work: int) -> None:
    best = naive.any_angle_distances(problem.context.occupied, problem.start, problem.corners).get(problem.goal)
    cells, bound, done = search(problem, work=work)
    assert len(cells) > 0 or done > work or best is None
    assert best is None or bound <= best + 1e-9


@given(seed=st.integers(0, 2**32), share=st.sampled_from((0.05, 0.15, 0.3)), corners=st.sampled_from(POLICIES))
@examples(40)
def test_the_sharpest_bounds_lose_no_path(seed: int, share: float, corners: str) -> None:
    blocked = np.random.default_rng(seed).random((30, 45)) < share
    blocked[29, 0] = blocked[0, 44] = False
    problem = PathProblem(blocked, corners=corners)
    cells, best, _ = search(problem)
    if len(cells) == 0:
        return
    it = problem.context
    known = best * (1 + 1e-9)
    bounds = taut_distances(problem, known + math.sqrt(2) + 1e-6)
    path, length, _ = compiled.any_angle.any_angle_path(
        it.blocked, it.cols, it.start, it.goal, it.policy, *bounds, known, 10**9
    )
    assert len(path) > 0
    assert math.isclose(length, best, rel_tol=1e-12)


def test_the_search_stops_when_its_work_is_done() -> None:
    problem = PathProblem(np.zeros((9, 9), bool))
    cells, _, needed = search(problem)
    assert cells.tolist() == [72, 8]
    assert search(problem, work=needed)[0].tolist() == [72, 8]
    assert search(problem, work=-1)[0].tolist() == []
