"""Indicators of fronts: against numbers worked out by hand, and against their definitions."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

from pathloom import ConfigError
from pathloom.fronts import (
    additive_epsilon,
    attainment,
    hypervolume,
    hypervolume_ratio,
    igd_plus,
    indicators,
    non_dominated,
    reference_point,
)

from .archive import exhaustive

FRONT = np.array([[1.0, 3.0], [2.0, 2.0], [4.0, 1.0]])
EXACT = np.array([[1.0, 3.0], [2.0, 1.0]])


def points(m):
    row = st.tuples(*[st.integers(0, 5)] * m)
    return st.lists(row, min_size=1, max_size=12).map(lambda rows: np.array(rows, float))


several = st.integers(2, 5).flatmap(points)


def test_the_hypervolume_is_the_area_of_the_steps():
    # up to (5, 4): 4 × 1 above y = 3, 3 × 1 above y = 2, 1 × 1 above y = 1
    assert hypervolume(FRONT, (5, 4)) == 4 + 3 + 1


def test_points_that_do_not_beat_the_reference_point_add_nothing():
    assert hypervolume(FRONT, (4, 3)) == 2 * 1
    assert hypervolume(FRONT, (1, 1)) == 0


@given(several)
@examples(40)
def test_the_hypervolume_counts_the_unit_cells_that_some_point_dominates(values):
    m = values.shape[1]
    if m > 3:
        values = values[:, :3]
        m = 3
    corner = np.full(m, 6.0)
    cells = itertools.product(range(6), repeat=m)
    count = sum(bool((values <= np.array(cell)).all(axis=1).any()) for cell in cells)
    assert hypervolume(values, corner) == pytest.approx(count)


def test_the_reference_point_lies_a_tenth_of_the_range_beyond_the_nadir():
    np.testing.assert_allclose(reference_point(FRONT), (4.3, 3.2))
    np.testing.assert_allclose(reference_point(np.array([[2.0, 7.0]])), (3.0, 8.0))


def test_the_ratio_is_that_of_the_hypervolumes_up_to_the_reference_point_of_the_exact_front():
    # EXACT: range 1 and 2, reference (2.1, 3.2): 1.1 × 0.2 + 0.1 × 2; FRONT: 1.1 × 0.2 + 0.1 × 1
    assert hypervolume_ratio(FRONT, EXACT) == pytest.approx((0.22 + 0.1) / (0.22 + 0.2))
    assert hypervolume_ratio(EXACT, EXACT) == 1.0
    assert hypervolume_ratio(FRONT, EXACT, (1, 1)) is None


def test_igd_plus_counts_only_how_much_worse_a_front_is():
    # (1, 3) is there; to (2, 1) the nearest is (2, 2), worse by 1
    assert igd_plus(FRONT, EXACT) == pytest.approx(0.5)
    assert igd_plus(EXACT, FRONT) == 0.0


def test_the_additive_epsilon_is_the_greatest_step_that_is_missing():
    assert additive_epsilon(FRONT, EXACT) == pytest.approx(1.0)
    assert additive_epsilon(EXACT, FRONT) == pytest.approx(0.0)
    assert additive_epsilon(EXACT - 0.25, EXACT) == pytest.approx(-0.25)


@given(several)
@examples(60)
def test_what_is_left_is_not_dominated_and_dominates_all_the_rest(values):
    kept = non_dominated(values)
    assert kept.tolist() == [list(row) for row in sorted({tuple(values[i]) for i in exhaustive(values)})]
    for row in values:
        assert (kept <= row).all(axis=1).any()


def test_the_median_attainment_is_what_half_of_the_runs_reach():
    fronts = [np.array([[0.0, 2.0]]), np.array([[1.0, 1.0]]), np.array([[2.0, 0.0]])]
    assert attainment(fronts, 100).tolist() == [[2.0, 2.0]]
    assert attainment(fronts, 1).tolist() == [[0.0, 2.0], [1.0, 1.0], [2.0, 0.0]]
    assert attainment(fronts, 60).tolist() == [[1.0, 2.0], [2.0, 1.0]]


@pytest.mark.parametrize(
    ("fronts", "percent"),
    [([], 50), ([FRONT], 0), ([FRONT], 101), ([np.zeros((1, 4))], 50), ([FRONT, FRONT[:0]], 50)],
)
def test_an_attainment_that_means_nothing_is_refused(fronts, percent):
    with pytest.raises(ConfigError, match="allowed"):
        attainment(fronts, percent)


def test_a_document_says_which_reference_point_it_used():
    alone = indicators(FRONT)
    assert alone["reference_of"] == "front"
    assert alone["ideal"] == [1.0, 1.0]
    assert alone["nadir"] == [4.0, 3.0]
    assert "hypervolume_ratio" not in alone
    beside = indicators(FRONT, EXACT)
    assert beside["reference_of"] == "exact"
    assert beside["reference_point"] == pytest.approx([2.1, 3.2])
    assert (beside["exact_size"], beside["exact_found"]) == (2, 1)
    assert indicators(FRONT, EXACT, (9, 9))["reference_of"] == "given"
    assert indicators(FRONT, EXACT, (9, 9))["hypervolume"] == hypervolume(FRONT, (9, 9))
