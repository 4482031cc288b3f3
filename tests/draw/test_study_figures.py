"""Figures of studies: what they show, that nothing overlaps, and that the same figure gives the same bytes."""

from itertools import combinations

import numpy as np
import pytest

from pathloom.draw import study as draw
from pathloom.draw.saving import save
from pathloom.draw.study import Curve, Effect, Sheet
from pathloom.draw.study.series import line

NAMES = ["imga", "selection=roulette", "selection=imaga/three-stage", "sampling=$x_1$", "without mutation",
         "crossover=a-plugin/with-a-name-that-is-much-too-long-for-a-column"]  # fmt: skip


def curves(count: int, *, bands: bool = False) -> dict[str, Curve]:
    x = np.unique(np.rint(np.geomspace(10, 5000, 40)))
    found = {}
    for k, name in enumerate(NAMES[:count]):
        y = 1.0 - 0.9 * (x / 10) ** (-0.3 - 0.1 * k)
        found[name] = Curve(x, y, y * 0.9, y * 1.1) if bands else Curve(x, y)
    return found


def made(kind: str, count: int = 4, *, dark: bool = False, **how):
    sheet = Sheet(title="a title of $some$ length " * 2, caption="a caption " * 9, dark=dark, **how)
    names = NAMES[:count]
    rng = np.random.default_rng(1)
    if kind == "ranks":
        ranks = {name: 1.0 + 0.8 * k for k, name in enumerate(names)}
        groups = [names[k : k + 2] for k in range(count - 1)]
        return draw.critical_difference_figure(ranks, groups, critical=1.1, sheet=sheet)
    if kind == "spread":
        samples = {name: rng.exponential(0.05, 30) for name in names}
        return draw.spread_figure(samples, missing={names[0]: 3}, percent=True, sheet=sheet)
    if kind == "effects":
        effects = [Effect(name, ["1", "2", "3"], rng.normal(size=3), np.ones(3)) for name in names]
        return draw.main_effects_figure(effects, mean=0.0, sheet=sheet)
    if kind == "bands":
        return draw.bands_figure(curves(count, bands=True), percent=True, sheet=sheet)
    return getattr(draw, f"{kind}_figure")(curves(count), sheet=sheet)


KINDS = ["ranks", "ecdf", "profile", "bands", "spread", "effects"]


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("count", [1, 2, 6])
@pytest.mark.parametrize("kind", KINDS)
def test_nothing_overlaps_and_nothing_leaves_the_figure(kind, count, dark):
    figure = made(kind, count, dark=dark)
    figure.draw_without_rendering()
    width, height = figure.get_size_inches() * figure.dpi
    boxes = [axes.get_tightbbox() for axes in figure.axes if axes.get_visible()]
    boxes += [legend.get_window_extent() for legend in figure.legends]
    for one, other in combinations(boxes, 2):
        across = min(one.x1, other.x1) - max(one.x0, other.x0)
        down = min(one.y1, other.y1) - max(one.y0, other.y0)
        assert min(across, down) < 3, (one, other)
    heads = [text.get_window_extent() for text in figure.texts]
    for box in [*boxes, *heads]:
        assert box.x0 > -1
        assert box.y0 > -1
        assert box.x1 < width + 1
        assert box.y1 < height + 1
    assert all(box.y1 <= min(head.y0 for head in heads) + 1 for box in boxes)
    for axes in figure.axes:
        labels = [t.get_window_extent() for t in axes.get_xticklabels() if t.get_text() and axes.get_visible()]
        labels = [box for box in labels if box.width > 0]
        assert all(a.x1 < b.x0 + 1 for a, b in combinations(sorted(labels, key=lambda b: b.x0), 2))


@pytest.mark.parametrize("kind", KINDS)
def test_a_figure_is_as_wide_as_a_column_unless_it_has_many_panels(kind):
    assert made(kind, 2).get_size_inches()[0] == pytest.approx(draw.COLUMN, abs=0.1)
    assert made(kind, 2, width=5.0).get_size_inches()[0] == 5.0


def test_dots_of_ranks_stand_at_the_ranks_and_bars_beside_the_groups():
    figure = draw.critical_difference_figure({"b": 2.0, "a": 1.25, "c": 2.75}, [["a", "b"]])
    (axes,) = figure.axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["a", "b", "c"]
    dots = {float(line.get_ydata()[0]): float(line.get_xdata()[0]) for line in axes.lines if len(line.get_xdata()) == 1}
    assert dots == {0.0: 1.25, 1.0: 2.0, 2.0: 2.75}
    bars = [line for line in axes.lines if line.get_linewidth() == 3.0]
    assert [line.get_ydata().tolist() for line in bars] == [[-0.25, 1.25]]


def test_every_share_ends_at_the_budget():
    figure = draw.ecdf_figure({"a": Curve([10, 20], [0.5, 1.0]), "b": Curve([], [])}, budget=100)
    (axes,) = figure.axes
    one, other = axes.lines
    assert (one.get_xdata()[-1], one.get_ydata()[-1]) == (100, 1.0)
    assert other.get_ydata().tolist() == [0.0, 0.0]


def test_all_runs_are_drawn_and_missing_ones_are_counted():
    figure = draw.spread_figure({"a": [1.0, 2.0, np.nan], "b": []}, missing={"b": 7})
    (axes,) = figure.axes
    assert len(axes.collections[0].get_offsets()) == 2
    assert [label.get_text() for label in axes.get_yticklabels()] == ["a", "b\n+ 7 missing"]


def test_effects_share_one_scale_and_may_have_no_errors():
    figure = draw.main_effects_figure([Effect("p", ["1", "2"], [1.0, 2.0]), Effect("q", ["a"], [5.0], [np.nan])])
    low, high = figure.axes[0].get_ylim()
    assert figure.axes[1].get_ylim() == (low, high)
    assert low < 1.0 < 5.0 < high


def test_many_variants_differ_in_colour_or_dash():
    looks = {(look["color"], str(look["linestyle"])) for look in (line(k, dark=False) for k in range(16))}
    assert len(looks) == 16


@pytest.mark.parametrize("dark", [False, True])
def test_colours_stand_out_from_the_ground(dark):
    from pathloom.draw.colours import rgb, theme

    def light(colour: str) -> float:
        parts = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in rgb(colour)]
        return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]

    ground = light(theme(dark=dark).ground)
    for colour in draw.SERIES[dark]:
        high, low = max(light(colour), ground), min(light(colour), ground)
        assert (high + 0.05) / (low + 0.05) >= 2.9, colour  # WCAG asks for 3 of graphics


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_figure_gives_the_same_bytes(kind, tmp_path):
    for name in ("a.svg", "b.svg", "a.png", "b.png"):
        save(made(kind), tmp_path / name)
    for suffix in ("svg", "png"):
        assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"b.{suffix}").read_bytes()
