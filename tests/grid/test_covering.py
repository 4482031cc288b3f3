"""Cells that any part of an obstacle touches are obstacles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from pathloom.errors import MapError
from pathloom.grid import full_cell_cover


@given(hnp.arrays(bool, hnp.array_shapes(min_dims=2, max_dims=2, max_side=12)), st.integers(1, 5))
def test_a_cell_is_blocked_iff_one_of_its_pixels_is(raster, factor) -> None:
    cells = full_cell_cover(raster, factor)
    for (r, c), blocked in np.ndenumerate(cells):
        part = raster[r * factor : (r + 1) * factor, c * factor : (c + 1) * factor]
        assert part.size
        assert blocked == part.any()


@pytest.mark.parametrize(("raster", "factor"), [(np.zeros(3), 2), (np.zeros((2, 2)), 0)])
def test_a_raster_has_two_dimensions_and_a_cell_a_pixel(raster, factor) -> None:
    with pytest.raises(MapError, match="cover: found"):
        full_cell_cover(raster, factor)
