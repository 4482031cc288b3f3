"""Cell paths: between lists of cells and rows of ids."""

import naive
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

from pathloom import CellPaths


@given(data=st.data(), shape=st.tuples(st.integers(1, 300), st.integers(1, 300)))
@examples(60)
def test_what_is_encoded_is_decoded(data, shape) -> None:
    cells = CellPaths(rows=shape[0], cols=shape[1])
    paths = data.draw(st.lists(naive.paths_on(shape), min_size=1, max_size=4))
    population = cells.encode([np.array(path) for path in paths])
    assert population.dtype == np.int32
    assert population.shape == (len(paths), max(map(len, paths)))
    assert naive.unpacked(population, shape[1]) == paths
    for row, path in zip(population, paths, strict=True):
        np.testing.assert_array_equal(cells.decode(row), path)


def test_a_cell_is_its_row_times_the_width_plus_its_column() -> None:
    cells = CellPaths(rows=3, cols=7)
    assert cells.encode([np.array([(2, 0), (1, 3), (0, 6)]), np.array([(2, 6)])]).tolist() == [
        [14, 10, 6],
        [20, -1, -1],
    ]


def test_no_paths_are_a_population_of_no_rows() -> None:
    assert CellPaths(rows=2, cols=2).encode([]).shape == (0, 1)


@pytest.mark.parametrize("dtype", [np.uint8, np.int8, np.int16, np.uint32, np.int64])
def test_cells_of_any_integer_type_are_encoded_alike(dtype) -> None:
    population = CellPaths(rows=100, cols=90).encode([np.array([(99, 0), (50, 44), (0, 89)], dtype)])
    assert population.tolist() == [[8910, 4544, 89]]


@pytest.mark.parametrize(("first", "second"), [(2, 4), (4, 2), (3, 3)])
def test_populations_of_any_width_are_stacked(first: int, second: int) -> None:
    upper, lower = np.full((2, first), 5, np.int32), np.full((1, second), 6, np.int32)
    both = CellPaths(rows=3, cols=3).stack(upper, lower)
    width = max(first, second)
    assert both.dtype == np.int32
    assert both.tolist() == [
        *[[5] * first + [-1] * (width - first)] * 2,
        [6] * second + [-1] * (width - second),
    ]


def test_an_empty_population_is_stacked_on_any() -> None:
    some = np.array([[3, 4]], np.int32)
    cells = CellPaths(rows=3, cols=3)
    assert cells.stack(some, some[:0]).tolist() == cells.stack(some[:0], some).tolist() == [[3, 4]]


def test_padding_makes_no_difference_between_paths() -> None:
    cells = CellPaths(rows=3, cols=3)
    population = np.array([[1, 2, -1], [1, 2, 3], [1, 2, -1], [2, 1, -1]], np.int32)
    first, which = cells.distinct(population)
    assert (first.tolist(), which.tolist()) == ([0, 1, 3], [0, 1, 0, 2])
    assert cells.newcomers(population, np.array([[1, 2]], np.int32)).tolist() == [1, 3]
