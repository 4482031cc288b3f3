import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from pathloom.errors import ProblemError
from pathloom.grid import inflate


def naive(occupied: np.ndarray, radius: Fraction) -> np.ndarray:
    """Inflate cell by cell, with exact distances from centres to squares."""
    blocked = occupied.copy()
    for r, c in np.ndindex(occupied.shape):
        for i, j in np.argwhere(occupied):
            up = max(abs(int(i) - r) - Fraction(1, 2), 0)
            aside = max(abs(int(j) - c) - Fraction(1, 2), 0)
            blocked[r, c] |= up * up + aside * aside < radius * radius
    return blocked


@given(
    occupied=arrays(bool, array_shapes(min_dims=2, max_dims=2, max_side=9)),
    radius=st.builds(Fraction, st.integers(0, 400), st.sampled_from([1, 2, 4, 10, 20])),
)
@settings(deadline=None)
def test_inflation_is_that_of_the_definition(occupied: np.ndarray, radius: Fraction) -> None:
    np.testing.assert_array_equal(inflate(occupied, float(radius)), naive(occupied, radius))


def test_a_disc_of_one_cell_blocks_the_eight_neighbours() -> None:
    occupied = np.zeros((5, 5), dtype=bool)
    occupied[2, 2] = True
    blocked = inflate(occupied, 1.0)
    assert blocked.sum() == 9
    assert blocked[1:4, 1:4].all()


@pytest.mark.parametrize("radius", [0, 0.0, 0.3, 0.5])
def test_a_disc_within_its_cell_blocks_nothing_more(radius: float) -> None:
    occupied = np.eye(4, dtype=bool)
    np.testing.assert_array_equal(inflate(occupied, radius), occupied)


def test_touching_is_free_whatever_a_division_left() -> None:
    occupied = np.zeros((1, 20), dtype=bool)
    occupied[0, 0] = True
    assert inflate(occupied, 11.5).sum() == 12  # the centre of cell 12 is 11.5 from the square
    noisy = 3.45 / 0.3
    assert noisy > 11.5
    assert inflate(occupied, noisy).sum() == 12
    assert inflate(occupied, 11.5001).sum() == 13


def test_the_outside_does_not_inflate() -> None:
    assert not inflate(np.zeros((3, 4), dtype=bool), 100.0).any()


@pytest.mark.parametrize("radius", [1e3, 1e200])
def test_a_disc_larger_than_the_map_blocks_all_of_it(radius: float) -> None:
    occupied = np.zeros((3, 70), dtype=bool)
    occupied[2, 69] = True
    assert inflate(occupied, radius).all()


@pytest.mark.parametrize("radius", [0.0, 1.5])
def test_the_map_given_stays_as_it_is(radius: float) -> None:
    occupied = np.eye(5, dtype=bool)
    occupied.setflags(write=False)
    blocked = inflate(occupied, radius)
    blocked[:] = True
    np.testing.assert_array_equal(occupied, np.eye(5, dtype=bool))


@pytest.mark.parametrize("radius", [-1.0, math.nan, math.inf])
def test_a_radius_is_finite_and_not_negative(radius: float) -> None:
    with pytest.raises(ProblemError, match="radius: found"):
        inflate(np.eye(2, dtype=bool), radius)


def test_a_large_map_with_a_large_radius_agrees_with_a_distance_transform() -> None:
    from scipy.ndimage import distance_transform_edt

    occupied = np.random.default_rng(1).random((150, 300)) < 0.001
    # Four half cells: the nearest point of a square is a corner or a side's midpoint away from centres.
    fine = np.zeros((2 * 150 + 1, 2 * 300 + 1), dtype=bool)
    for r, c in np.argwhere(occupied):
        fine[2 * r : 2 * r + 3, 2 * c : 2 * c + 3] = True
    distance = distance_transform_edt(~fine)[1::2, 1::2] / 2
    np.testing.assert_array_equal(inflate(occupied, 20.3), distance < 20.3)
