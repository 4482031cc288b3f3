"""The figure of a front: what its panels show, and that nothing of it collides."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from fronts.archive import RandomArchive

import pathloom as pl
from pathloom.draw import save
from pathloom.draw.front import Ground, Look, front_figure, short
from pathloom.fronts.thinning import thinned

LABELS = ("length", "unsafe-cells", "turns", "clearance", "turn-angle")


def look(m, n=6, **more):
    rng = np.random.default_rng(m)
    values = np.round(rng.random((n, m)) * 10, 1)
    values[:, 1] = np.arange(n)
    return Look(values=values, labels=LABELS[:m], **more)


def ground(shape=(8, 12)):
    occupied = np.zeros(shape, bool)
    occupied[shape[0] // 2, : shape[1] // 2] = True
    return Ground(occupied, (shape[0] - 1, 0), (0, shape[1] - 1))


def with_paths(it, over):
    ways = [np.array([over.start, (over.start[0], over.goal[1]), over.goal])] * len(it.values)
    return replace(it, paths=ways)


def axes_of(figure):
    return {axes.get_label(): axes for axes in figure.axes if axes.get_visible()}


def entries(figure):
    parts = [figure, *figure.subfigs, *(inner for part in figure.subfigs for inner in part.subfigs)]
    return [text.get_text() for part in parts for legend in part.legends for text in legend.get_texts()]


@pytest.mark.parametrize("m", [2, 3, 4, 5])
def test_each_pair_of_objectives_is_drawn_once(m):
    shown = [name for name in axes_of(front_figure(look(m), panels=("scatter",))) if " over " in name]
    pairs = {frozenset(name.split(" over ")) for name in shown}
    assert len(shown) == len(pairs) == m * (m - 1) // 2
    assert pairs == {frozenset(pair) for pair in combinations(LABELS[:m], 2)}


def test_the_points_of_the_scatter_are_the_values():
    it = look(2)
    axes = axes_of(front_figure(it, panels=("scatter",)))["unsafe-cells over length"]
    drawn = axes.collections[0].get_offsets().tolist()
    assert sorted(map(tuple, drawn)) == sorted(map(tuple, it.values.tolist()))
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("length", "unsafe-cells")


def test_a_line_of_the_parallel_coordinates_runs_from_best_to_worst():
    it = look(3)
    axes = axes_of(front_figure(it, panels=("parallel",)))["parallel"]
    lines = np.array([line.get_ydata() for line in axes.get_lines()])
    assert len(lines) == len(it.values)
    np.testing.assert_allclose((lines.min(axis=0), lines.max(axis=0)), [[0] * 3, [1] * 3])
    assert axes.get_xticklabels()[1].get_text() == "unsafe-cells\n0 to 5"


def test_the_legend_names_what_is_drawn_and_nothing_else():
    assert entries(front_figure(look(3), panels=("scatter",))) == ["front"]
    full = look(3, knee=1, preferred=2, exact=look(3).values, rivals=[("imga", np.array([[5.0, 5.0, 5.0]]))])
    assert entries(front_figure(full, panels=("scatter",))) == ["front", "exact front", "imga", "preferred", "knee"]
    assert entries(front_figure(full, panels=("parallel",))) == ["preferred", "knee"]


def test_paths_run_through_the_centres_of_their_cells_in_the_colours_of_the_front():
    over = ground()
    it = with_paths(look(2), over)
    figure = front_figure(it, over, panels=("paths",))
    lines = axes_of(figure)["map"].get_lines()
    assert len(lines) == len(it.values)
    np.testing.assert_array_equal(lines[0].get_xydata(), it.paths[0][:, ::-1])
    colours = {tuple(line.get_color()) for line in lines}
    assert len(colours) == len(set(it.values[:, 0].tolist()))


def test_only_the_members_asked_for_are_on_the_map():
    over = ground()
    figure = front_figure(replace(with_paths(look(2), over), shown=[0, 3]), over, panels=("paths",))
    assert len(axes_of(figure)["map"].get_lines()) == 2


@pytest.mark.parametrize("shape", [(8, 12), (1, 1), (40, 4), (6, 90), (120, 120)])
@pytest.mark.parametrize(("m", "dark"), [(2, True), (3, False)])
def test_panels_do_not_overlap_and_nothing_leaves_the_figure(m, shape, dark):
    nothing_collides(m, shape, dark)


def test_nor_do_they_with_as_many_objectives_as_there_may_be():
    nothing_collides(5, (8, 12), dark=False)


def nothing_collides(m, shape, dark):
    over = ground(shape)
    it = with_paths(look(m, knee=0, preferred=1, rivals=[("imga", np.full((1, m), 12.5))]), over)
    figure = front_figure(it, over, title="long " * 30, caption="words " * 40, dark=dark)
    figure.draw_without_rendering()
    boxes = [axes.get_tightbbox() for axes in figure.axes if axes.get_visible()]
    for one, other in combinations(boxes, 2):
        across = min(one.x1, other.x1) - max(one.x0, other.x0)
        down = min(one.y1, other.y1) - max(one.y0, other.y0)
        assert min(across, down) < 2, (one, other)
    width, height = figure.get_size_inches() * figure.dpi
    for box in [*boxes, *(text.get_window_extent() for text in figure.texts)]:
        assert box.x0 > -1
        assert box.y0 > -1
        assert box.x1 < width + 1
        assert box.y1 < height + 1
    lowest = min(text.get_window_extent().y0 for text in figure.texts)
    assert all(box.y1 <= lowest for box in boxes)


@pytest.mark.parametrize("m", [2, 3])
def test_a_front_of_one_point_can_be_drawn(m):
    over = ground()
    one = Look(values=np.zeros((1, m)), labels=LABELS[:m], knee=0, paths=[np.array([over.start, over.goal])])
    figure = front_figure(one, over)
    assert axes_of(figure)["unsafe-cells over length"].get_xlim() == (-1.0, 1.0)


def test_the_same_front_gives_the_same_bytes(tmp_path):
    over = ground()
    for name in ("a", "b"):
        figure = front_figure(with_paths(look(2, knee=0), over), over)
        for suffix in ("png", "svg", "pdf"):
            save(figure, tmp_path / f"{name}.{suffix}")
    for suffix in ("png", "svg", "pdf"):
        assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"b.{suffix}").read_bytes()


@pytest.mark.parametrize(
    ("value", "text"), [(2.0, "2"), (2.345, "2.35"), (-0.0, "0"), (-0.001, "0"), (-0.5, "−0.5"), (100.0, "100")]
)
def test_numbers_are_short(value, text):
    assert short(value) == text


@pytest.fixture(scope="module")
def result():
    problem = pl.PathProblem(pl.load_map("blocks-30:20%:s2"), corners="allow")
    return pl.pareto(problem, RandomArchive(), objectives=["length", "unsafe-cells", "turns"])


def test_a_result_draws_what_is_asked_for(result, tmp_path):
    assert {"map", "parallel", "turns over length"} <= set(axes_of(result.plot(tmp_path / "all.png")))
    assert set(axes_of(result.plot(panels="parallel", colour="turns"))) == {"parallel"}
    assert (tmp_path / "all.png").exists()


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"panels": "scater"}, "did you mean 'scatter'?"),
        ({"panels": ()}, "found none"),
        ({"colour": "lenght"}, "did you mean 'length'?"),
    ],
)
def test_what_cannot_be_drawn_is_refused(result, options, says):
    with pytest.raises(pl.PathloomError, match=says.replace("?", r"\?")):
        result.plot(**options)


def test_a_front_read_from_json_has_no_map_but_can_be_drawn_without(result):
    again = pl.ParetoResult.from_json(result.to_json())
    with pytest.raises(pl.PathloomError, match="read from JSON"):
        again.plot()
    assert "parallel" in axes_of(again.plot(panels=("scatter", "parallel")))


def test_a_thinned_front_keeps_knee_preferred_and_the_best_of_each_objective(result):
    assert thinned(result, len(result)) == list(range(len(result)))
    few = thinned(result, 6)
    assert len(few) == 6
    assert few == sorted(set(few))
    assert {result.choice.knee, *result.values.argmin(axis=0).tolist()} <= set(few)
