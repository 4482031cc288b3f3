"""The papers' cell numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pathloom as pl


@given(rows=st.integers(1, 30), cols=st.integers(1, 30), first=st.sampled_from([0, 1]))
def test_numbers_and_cells_are_each_others_inverse(rows, cols, first) -> None:
    numbering = pl.Numbering(rows, cols, first)
    every = np.arange(first, first + rows * cols)
    assert numbering.numbers(numbering.cells(every)).tolist() == every.tolist()
    assert numbering.cells([first]).tolist() == [[rows - 1, 0]]
    assert numbering.cells([first + rows * cols - 1]).tolist() == [[0, cols - 1]]


def test_the_individual_that_a_paper_shows_stands_on_free_cells_of_its_map() -> None:
    shown = pl.Numbering(10, 10).cells([1, 12, 23, 36, 47, 59, 70, 80])
    assert not pl.load_map("iga-map1").occupied[tuple(shown.T)].any()


@pytest.mark.parametrize("number", [0, 101, -1])
def test_a_number_outside_the_map_is_refused(number) -> None:
    with pytest.raises(pl.ProblemError, match="allowed those of the map, numbers 1 to 100"):
        pl.Numbering(10, 10).cells([5, number])


@pytest.mark.parametrize("cell", [(10, 0), (0, 10), (-1, 3)])
def test_a_cell_outside_the_map_has_no_number(cell) -> None:
    with pytest.raises(pl.ProblemError, match="cells: found"):
        pl.Numbering(10, 10).numbers([cell])
