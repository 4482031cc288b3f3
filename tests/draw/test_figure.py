"""The figure of a run: what it shows, at whatever size of map, and that it leaves the world as it was."""

import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest

from pathloom.draw import path_figure


def labels(figure) -> set[str]:
    return {axes.get_label() for axes in figure.axes}


def entries(figure) -> list[str]:
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_map_fitness_and_diversity_each_have_their_panel(walls, scene) -> None:
    assert labels(path_figure(walls, **scene)) == {"map", "fitness", "diversity"}


@pytest.mark.parametrize(
    "history",
    [None, {}, {"best": [1.0], "mean": [0.5]}, {"best": [None, None]}, {"evaluations": [1, 2, 3]}],
)
def test_a_history_with_nothing_to_show_has_no_panel(walls, scene, history) -> None:
    assert labels(path_figure(walls, **{**scene, "history": history})) == {"map"}


def test_a_history_may_miss_any_of_its_lists(walls, scene) -> None:
    figure = path_figure(walls, **{**scene, "history": {"best": [1.0, 2.0, 3.0]}})
    assert labels(figure) == {"map", "fitness"}
    assert figure.axes[1].get_xlabel() == "generation"


def test_the_legend_names_what_is_drawn_and_nothing_else(walls, scene) -> None:
    every = entries(path_figure(walls, closed=walls | np.roll(walls, 1, 0), **{**scene, "history": None}))
    assert every == ["obstacle", "closed by radius", "path", "before refinement", "optimum"]
    bare = path_figure(walls, closed=walls, start=(9, 0), goal=(0, 9), path=None)
    assert entries(bare) == ["obstacle"]
    assert entries(path_figure(np.zeros((4, 4)), start=(3, 0), goal=(0, 3))) == []


def test_the_line_of_the_path_runs_through_the_centres_of_its_cells(walls, scene) -> None:
    line = path_figure(walls, **scene).axes[0].get_lines()[0]
    np.testing.assert_array_equal(line.get_xydata(), scene["path"][:, ::-1])


def test_with_a_resolution_the_axes_are_in_metres_from_the_lower_left(walls, scene) -> None:
    axes = path_figure(walls, resolution=0.5, **scene).axes[0]
    assert (axes.get_xlim(), axes.get_ylim()) == ((0.0, 5.0), (0.0, 5.0))
    np.testing.assert_allclose(axes.get_lines()[0].get_xydata()[0], (0.25, 0.25))


@pytest.mark.parametrize("shape", [(1, 1), (10, 10), (60, 1), (400, 30), (20, 300), (307, 604), (500, 1500)])
def test_cells_are_square_and_nothing_leaves_the_figure(shape, scene) -> None:
    walls = np.zeros(shape, bool)
    rows, cols = shape
    ends = {"start": (rows - 1, 0), "goal": (0, cols - 1)}
    for history in (None, scene["history"]):
        path = np.array(list(ends.values()))
        figure = path_figure(walls, **ends, path=path, history=history, title="long " * 20, caption="words " * 20)
        box = figure.axes[0].get_window_extent()
        assert box.width / cols == pytest.approx(box.height / rows)
        around = figure.get_tightbbox()
        width, height = figure.get_size_inches()
        assert min(around.x0, around.y0) >= 0
        assert around.x1 <= width
        assert around.y1 <= height


def test_the_legend_hides_nothing_of_the_map(walls, scene) -> None:
    figure = path_figure(walls, **scene)
    for legend in figure.legends:
        extent = legend.get_window_extent()
        assert not any(extent.overlaps(axes.get_window_extent()) for axes in figure.axes)


def test_discs_of_close_ends_do_not_cover_each_other() -> None:
    for goal in [(100, 100), (101, 102)]:
        figure = path_figure(np.zeros((300, 300)), start=(100, 100), goal=goal)
        figure.canvas.draw()
        start, end = (text.get_bbox_patch().get_window_extent() for text in figure.axes[0].texts)
        centres = [((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2) for box in (start, end)]
        assert np.hypot(*np.subtract(*centres)) > 0.9 * start.width


def test_light_and_dark_differ_in_ground_and_ink(walls, scene) -> None:
    light, dark = (path_figure(walls, dark=dark, **scene) for dark in (False, True))
    assert np.mean(light.get_facecolor()[:3]) > 0.9
    assert np.mean(dark.get_facecolor()[:3]) < 0.2


def test_neither_pyplot_nor_the_settings_of_matplotlib_are_touched(walls, scene) -> None:
    before = dict(mpl.rcParams)
    path_figure(walls, **scene)
    assert dict(mpl.rcParams) == before
    code = (
        "import sys; from pathloom.draw import path_figure;"
        "assert not {'matplotlib', 'PIL', 'rich'} & set(sys.modules), 'the import is heavy';"
        "path_figure([[0, 0]], start=(0, 0), goal=(0, 1));"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
