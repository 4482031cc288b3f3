"""The picture in the terminal: its size, what every cell becomes, and what survives in a small one."""

import io

import numpy as np
import pytest

from pathloom.draw import picture


def lines(*args, **options) -> list[str]:
    """Return the picture without its frame."""
    rows = picture(*args, **options).plain.split("\n")
    assert rows[0] == "┌" + "─" * (len(rows[0]) - 2) + "┐"
    assert rows[-1] == "└" + "─" * (len(rows[0]) - 2) + "┘"
    return [row[1:-1] for row in rows[1:-1]]


@pytest.mark.parametrize("shape", [(1, 1), (10, 10), (22, 35), (23, 36), (43, 43), (1, 900), (900, 1), (307, 604)])
@pytest.mark.parametrize("room", [(72, 24), (30, 9), (3, 3)])
def test_start_and_goal_are_there_and_the_picture_fits(shape, room) -> None:
    rows, cols = shape
    text = picture(np.zeros(shape, bool), start=(rows - 1, 0), goal=(0, cols - 1), width=room[0], height=room[1]).plain
    assert "G" in text
    assert "S" in text or shape == (1, 1) or room == (3, 3)
    assert len(text.split("\n")) <= room[1]
    assert len({len(line) for line in text.split("\n")}) == 1
    assert len(text.split("\n")[0]) <= room[0]


def test_every_obstacle_of_a_small_map_is_two_solid_characters(walls) -> None:
    rows = lines(walls, start=(9, 0), goal=(0, 9))
    seen = np.array([[sign == "█" for sign in row] for row in rows])
    np.testing.assert_array_equal(seen, walls.repeat(2, axis=1))


def test_cells_closed_by_the_radius_look_different(walls) -> None:
    rows = lines(walls, closed=walls | np.roll(walls, 1, axis=0), start=(9, 0), goal=(0, 9))
    assert "".join(rows).count("░") == 2 * walls.sum()
    assert "".join(rows).count("█") == 2 * walls.sum()


def test_a_path_marks_every_cell_that_it_crosses() -> None:
    # From (0, 0) to (2, 4) it leaves row 0 and enters row 1 in the middle of column 1.
    rows = lines(np.zeros((4, 5), bool), start=(0, 0), goal=(3, 4), path=[(0, 0), (2, 4), (3, 4)])
    assert rows == ["S ••      ", "  ••••••  ", "      ••●●", "        G "]


def test_a_diagonal_marks_no_cell_at_its_side() -> None:
    assert lines(np.zeros((3, 3), bool), start=(0, 0), goal=(2, 2), path=[(0, 0), (2, 2)]) == [
        "S     ",
        "  ••  ",
        "    G ",
    ]


def test_a_path_of_one_cell_is_its_end() -> None:
    assert lines(np.zeros((1, 2), bool), start=(0, 0), goal=(0, 0), path=[(0, 0)]) == ["G   "]


@pytest.mark.parametrize("at", range(200, 212))
def test_a_wall_of_one_cell_survives_in_a_small_picture(at) -> None:
    walls = np.zeros((512, 512), bool)
    walls[at] = True
    across = lines(walls, start=(0, 0), goal=(511, 511))
    assert [row for row in across if set(row) - set(" SG")] == [row for row in across if " " not in row]
    assert any(" " not in row for row in across)
    down = lines(walls.T, start=(0, 0), goal=(511, 511))
    assert sum(all(row[i] != " " for row in down) for i in range(len(down[0]))) == 1


def test_stray_cells_of_a_large_map_do_not_fill_it() -> None:
    walls = np.zeros((512, 512), bool)
    walls[::16, ::16] = True
    assert set("".join(lines(walls, start=(1, 1), goal=(511, 511)))) == {" ", "S", "G"}


def test_the_path_through_a_large_map_has_no_gap() -> None:
    rows = lines(np.zeros((300, 500), bool), start=(299, 0), goal=(0, 499), path=[(299, 0), (40, 200), (0, 499)])
    marks = np.argwhere([[sign != " " for sign in row] for row in rows])
    steps = marks[np.lexsort((-marks[:, 0], marks[:, 1]))]
    assert np.abs(np.diff(steps, axis=0)).max() == 1


def test_it_reads_the_same_without_colour(walls, scene) -> None:
    from rich.console import Console

    stream = io.StringIO()
    text = picture(walls, start=(9, 0), goal=(0, 9), path=scene["path"])
    Console(file=stream, width=80, no_color=True).print(text)
    assert stream.getvalue().rstrip("\n") == text.plain
