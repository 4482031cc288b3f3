"""Where other planners' paths lie beside a front."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

from pathloom import OccupancyGrid, PathProblem, Terms
from pathloom.fronts import place
from pathloom.fronts.against import dominated, dominating, shortcut
from pathloom.fronts.verified import measured
from pathloom.paths.objectives import Length, Turns
from pathloom.result import Result

PROBLEM = PathProblem(OccupancyGrid(np.zeros((3, 3), bool)))
TERMS = Terms({"length": Length(), "turns": Turns()})
STRAIGHT = np.array([(2, 0), (1, 1), (0, 2)])
CORNER = np.array([(2, 0), (1, 0), (0, 0), (0, 1), (0, 2)])


def result(path, unrefined=None):
    return Result("found", "somebody", 3, {}, path=path, unrefined=unrefined)


def test_a_path_is_placed_as_found_and_as_refined():
    front = np.array([[2 * 2**0.5, 0.0]])
    rival = place(result(STRAIGHT, CORNER), PROBLEM, TERMS, front)
    assert (rival.planner, rival.seed, rival.status) == ("somebody", 3, "found")
    found, refined = rival.placements
    assert (found.which, found.verdict, found.dominated_by) == ("unrefined", "dominated", (0,))
    assert found.values == (4.0, 1.0)
    assert found.excess == pytest.approx((4 - 8**0.5, 1.0))
    assert found.epsilon == pytest.approx(-1.0)  # the front is better by at least that in both
    assert (refined.which, refined.verdict, refined.dominated_by) == ("refined", "on the front", ())
    assert rival.verdict("unrefined") == "dominated"


@pytest.mark.parametrize(
    ("front", "verdict"),
    [
        ([[3.0, 0.0], [2.0, 1.0]], "dominated"),
        ([[4.0, 1.0], [9.0, 0.0]], "on the front"),
        ([[5.0, 1.0], [9.0, 0.0]], "beats the front"),
        ([[3.0, 2.0], [9.0, 0.0]], "beside the front"),
    ],
)
def test_there_are_four_verdicts(front, verdict):
    (placement,) = place(result(CORNER), PROBLEM, TERMS, np.array(front)).placements
    assert placement.verdict == verdict


def test_a_path_of_long_segments_is_said_to_be_none_of_cells():
    front = np.array([[1.0, 0.0]])
    single = place(result(STRAIGHT), PROBLEM, TERMS, front).placements[0]
    long = place(result(STRAIGHT[[0, 2]]), PROBLEM, TERMS, front).placements[0]
    assert (single.cells, long.cells) == (True, False)


def test_who_found_nothing_has_no_place():
    rival = place(Result("not-found", "somebody", 0, {}), PROBLEM, TERMS, np.array([[1.0, 1.0]]))
    assert (rival.status, rival.placements) == ("not-found", ())
    assert rival.verdict("refined") is None


def test_what_differs_by_rounding_alone_does_not_dominate():
    front = np.array([[1.0 - 1e-12, 2.0]])
    assert len(dominating(front, np.array([1.0, 2.0]))) == 0
    assert len(dominated(front, np.array([1.0 - 3e-12, 2.0]))) == 0


@given(
    st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=1),
    st.tuples(st.integers(0, 4), st.integers(0, 4)),
)
@examples(80)
def test_dominance_is_as_defined(rows, point):
    def better(a, b):
        return all(x <= y for x, y in zip(a, b, strict=True)) and a != b

    front = np.array(rows, float)
    assert dominating(front, np.array(point, float)).tolist() == [i for i, a in enumerate(rows) if better(a, point)]
    assert dominated(front, np.array(point, float)).tolist() == [i for i, a in enumerate(rows) if better(point, a)]


def test_an_any_angle_path_meets_the_members_without_their_superfluous_points():
    problem = PathProblem(OccupancyGrid(np.zeros((5, 5), bool)), start=(4, 0), goal=(0, 2))
    stairs = np.array([(4, 0), (3, 0), (2, 0), (1, 1), (0, 2)])
    front = measured([stairs], problem, TERMS)
    straight = shortcut([stairs], problem, TERMS)
    assert straight[0, 0] == pytest.approx(np.hypot(4, 2))
    line, cells = result(np.array([(4, 0), (0, 2)])), result(stairs)
    alone, fair = (place(line, problem, TERMS, front, it).verdict("refined") for it in (None, straight))
    assert (alone, fair) == ("beats the front", "on the front")
    assert place(cells, problem, TERMS, front, straight).verdict("refined") == "on the front"
