import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pathloom.errors import MapError
from pathloom.grid import OccupancyGrid


def test_cells_are_a_read_only_copy() -> None:
    cells = np.zeros((2, 3), dtype=bool)
    grid = OccupancyGrid(cells)
    cells[0, 0] = True
    assert not grid.occupied.any()
    assert grid.occupied.flags.c_contiguous
    with pytest.raises(ValueError, match="read-only"):
        grid.occupied[0, 0] = True


def test_a_grid_knows_its_size() -> None:
    grid = OccupancyGrid([[0, 1, 0], [0, 0, 0]])
    assert (grid.height, grid.width, grid.shape, grid.free_count) == (2, 3, (2, 3), 5)


@pytest.mark.parametrize(
    ("cells", "says"),
    [
        ([0, 1], r"shape \(2,\)"),
        ([[]], r"shape \(1, 0\)"),
        (np.zeros((2, 2, 2)), r"shape \(2, 2, 2\)"),
        ([[0, 1], [0]], "unequal length"),
        ([[0, 2]], "row 0, col 1: found 2"),
        ([[0.0], [math.nan]], "row 1, col 0: found nan"),
        ([[0, -1]], "found -1"),
        ([[0.5]], "found 0.5"),
        ([["0"]], "type <U1"),
        ([[None]], "type object"),
        ([[1j]], "type complex"),
    ],
)
def test_cells_that_are_not_a_rectangle_of_0_and_1_are_refused(cells: object, says: str) -> None:
    with pytest.raises(MapError, match=says):
        OccupancyGrid(cells)


@pytest.mark.parametrize("resolution", [0.0, -1.0, math.inf, math.nan, None, "a"])
def test_resolution_must_be_positive(resolution: object) -> None:
    with pytest.raises(MapError, match="resolution: found"):
        OccupancyGrid([[0]], resolution=resolution)


@pytest.mark.parametrize("origin", [(0, 0), (0, 0, math.nan), (0, 0, 0, 0), 3, "abc", (10**400, 0, 0)])
def test_origin_must_be_three_finite_numbers(origin: object) -> None:
    with pytest.raises(MapError, match="origin: found"):
        OccupancyGrid([[0]], origin=origin)


def test_nothing_can_be_assigned() -> None:
    with pytest.raises(AttributeError):
        OccupancyGrid([[0]]).resolution = 2.0


def test_equality_is_of_content_and_not_of_name() -> None:
    grid = OccupancyGrid([[0, 1]], name="a")
    assert grid == OccupancyGrid(np.array([[False, True]]), name="b")
    assert hash(grid) == hash(OccupancyGrid([[0, 1]]))
    assert grid != OccupancyGrid([[1, 0]])
    assert grid != OccupancyGrid([[0], [1]])
    assert grid != OccupancyGrid([[0, 1]], resolution=2)
    assert grid != OccupancyGrid([[0, 1]], origin=(0, 0, 0))
    assert grid != "a"


def test_the_digest_tells_shape_and_cells_apart() -> None:
    grids = [[[0, 0]], [[0], [0]], [[0, 1]], [[0, 0, 0]]]
    assert len({OccupancyGrid(cells).sha256 for cells in grids}) == 4
    assert OccupancyGrid([[0, 1]]).sha256 == OccupancyGrid([[0.0, 1.0]], resolution=3).sha256


@pytest.mark.parametrize("through", [lambda g: pickle.loads(pickle.dumps(g)), copy.copy, copy.deepcopy])
def test_a_grid_survives_copying_and_stays_read_only(through) -> None:
    grid = OccupancyGrid([[0, 1]], resolution=0.5, origin=(1, 2, 3), name="a")
    digest = grid.sha256
    twin = through(grid)
    assert twin == grid
    assert (twin.name, twin.sha256) == ("a", digest)
    assert not twin.occupied.flags.writeable


def test_the_lower_left_cell_lies_at_the_origin() -> None:
    grid = OccupancyGrid(np.zeros((2, 3)), resolution=0.5, origin=(10, 20, 0))
    np.testing.assert_allclose(grid.world([(1, 0), (0, 2)]), [[10.25, 20.25], [11.25, 20.75]])
    assert grid.cell_at(10.0, 20.0) == (1, 0)
    assert grid.cell_at(11.49, 20.99) == (0, 2)


def test_yaw_turns_the_map_about_its_origin() -> None:
    grid = OccupancyGrid(np.zeros((2, 3)), origin=(10, 20, math.pi / 2))
    np.testing.assert_allclose(grid.world([(1, 0), (1, 2), (0, 0)]), [[9.5, 20.5], [9.5, 22.5], [8.5, 20.5]])


@given(
    shape=st.tuples(st.integers(1, 40), st.integers(1, 40)),
    resolution=st.floats(0.01, 10),
    origin=st.tuples(st.floats(-100, 100), st.floats(-100, 100), st.floats(-7, 7)),
    pick=st.randoms(use_true_random=False),
)
@settings(deadline=None)
def test_a_cell_centre_leads_back_to_its_cell(shape, resolution, origin, pick) -> None:
    grid = OccupancyGrid(np.zeros(shape), resolution=resolution, origin=origin)
    cell = pick.randrange(shape[0]), pick.randrange(shape[1])
    (x, y) = grid.world([cell])[0]
    assert grid.cell_at(x, y) == cell


def test_no_cells_have_no_places() -> None:
    assert OccupancyGrid([[0]], origin=(0, 0, 0)).world([]).shape == (0, 2)


@pytest.mark.parametrize("point", [(-0.1, 0), (0, 2), (3, 0), (math.nan, 0), (math.inf, 0), (0, 1e300)])
def test_a_point_outside_the_map_is_refused(point, refused) -> None:
    grid = OccupancyGrid(np.zeros((2, 3)), origin=(0, 0, 0), name="hall.yaml")
    assert refused(grid.cell_at, *point).startswith("hall.yaml: found the point (")


def test_a_map_without_origin_has_no_world(refused) -> None:
    assert "no origin" in refused(OccupancyGrid([[0]]).world, [(0, 0)])
    assert "no origin" in refused(OccupancyGrid([[0]]).cell_at, 0, 0)


def test_repr_is_short() -> None:
    assert repr(OccupancyGrid([[0, 1]], name="a")) == "<OccupancyGrid 'a', 1 x 2, 1 free>"
