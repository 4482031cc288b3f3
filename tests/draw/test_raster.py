"""Which cells a path crosses, against the definition, and maps at another size."""

from fractions import Fraction

import numpy as np
import pytest

from pathloom.draw.raster import coarse, crossed


def naive(a, b) -> set[tuple[int, int]]:
    """Return the cells whose interior shares a stretch of the segment, by clipping it to each."""
    found = set()
    for r in range(min(a[0], b[0]), max(a[0], b[0]) + 1):
        for c in range(min(a[1], b[1]), max(a[1], b[1]) + 1):
            low, high = Fraction(0), Fraction(1)
            for at, start, end in ((r, a[0], b[0]), (c, a[1], b[1])):
                if start == end:
                    continue
                t = sorted(Fraction(2 * (at - start) + side, 2 * (end - start)) for side in (-1, 1))
                low, high = max(low, t[0]), min(high, t[1])
            if low < high:
                found.add((r, c))
    return found


def test_crossed_cells_are_those_of_the_definition() -> None:
    rng = np.random.default_rng(1)
    for a, b in rng.integers(0, 12, (200, 2, 2)):
        cells = crossed(np.array([a, b]))
        assert {tuple(cell) for cell in cells.tolist()} == naive(a.tolist(), b.tolist())
        assert len(cells) == len({tuple(cell) for cell in cells.tolist()})
        np.testing.assert_array_equal(cells[[0, -1]], [a, b])


def test_no_path_crosses_no_cell() -> None:
    assert crossed(np.empty((0, 2), np.int64)).shape == (0, 2)


@pytest.mark.parametrize("times", [1, 2, 5])
def test_at_its_own_size_or_larger_a_map_stays_as_it_is(times) -> None:
    mask = np.random.default_rng(2).random((7, 9)) < 0.4
    np.testing.assert_array_equal(coarse(mask, 7 * times, 9 * times), mask.repeat(times, 0).repeat(times, 1))
