"""What tests of studies share."""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import pathloom as pl
from pathloom.study import Row

SOON = {"budget": "own", "runs": 2, "workers": 1}


@pytest.fixture
def grid() -> pl.OccupancyGrid:
    """Six by six cells with an obstacle in the middle, so that the straight way is closed."""
    cells = np.zeros((6, 6), bool)
    cells[2:4, 2:4] = True
    return pl.OccupancyGrid(cells, name="block")


@pytest.fixture
def opened() -> Iterator[Callable[[pl.Study], pl.Study]]:
    """Close studies when the test is over."""
    studies: list[pl.Study] = []

    def keep(study: pl.Study) -> pl.Study:
        studies.append(study)
        return study

    yield keep
    for study in studies:
        study.close()


def timeless(row: Row) -> dict[str, object]:
    """Return what of a row no clock says."""
    return {name: getattr(row, name) for name in row.__slots__ if name != "seconds"}


def rows_of(path: Path) -> list[dict[str, object]]:
    """Return the rows in a file without what a clock says."""
    with pl.Study.open(path) as study:
        return [timeless(row) for row in study.each()]
