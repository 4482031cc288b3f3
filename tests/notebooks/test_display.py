"""What a notebook shows of an object that ends a cell."""

from xml.etree import ElementTree as ET

import numpy as np
import pytest

import pathloom as pl


def test_a_map_is_drawn_cell_by_cell_or_as_an_image_where_it_is_large() -> None:
    small = ET.fromstring(pl.OccupancyGrid(np.eye(3))._repr_svg_())
    assert "".join(small.itertext()) == ""
    assert small.find("{*}path").get("d") == "M0 0h1v1h-1zM1 1h1v1h-1zM2 2h1v1h-1z"
    large = ET.fromstring(pl.load_map("random-200:20%")._repr_svg_())
    assert large.find("{*}image").get("href").startswith("data:image/png;base64,")


def test_a_result_and_a_front_are_drawn_unless_they_do_not_hold_their_map() -> None:
    problem = pl.PathProblem(pl.load_map("iga-map1"), corners="allow")
    for found in (pl.plan(problem, seed=1), pl.pareto(problem, "nsga2", objectives=["length", "turns"], seed=1)):
        assert ET.fromstring(found._repr_svg_()).tag.endswith("svg")
        assert type(found).from_json(found.to_json())._repr_svg_() is None


def test_a_study_shows_its_progress_its_summary_and_the_figures_that_it_allows(tmp_path) -> None:
    swap = {"selection": ["roulette"]}
    planner = pl.compose("imga", population=20, termination=[{"use": "max-generations", "limit": 5}])
    with pl.ablate(planner, swap=swap, maps=["iga-map1", "random-20:75:s1"], runs=2, workers=1) as study:
        table = ET.fromstring(study._repr_html_())
        assert [cell.text for cell in table.find("tbody")[1]] == ["selection=roulette", "4"]
        summary = study.summary()
        page = ET.fromstring(f"<div>{summary._repr_html_()}</div>")
        assert [item.text for item in page.find("ul")] == [verdict.text for verdict in summary.verdicts]
        for name in ("spread", "convergence"):
            light, dark = (study.plot(tmp_path / f"{name}.png", figure=name, dark=d) for d in (False, True))
            assert (tmp_path / f"{name}.png").stat().st_size > 1000
            assert light.get_facecolor() != dark.get_facecolor()
        with pytest.raises(pl.PathloomError, match=r"figure: found 'bands', allowed of these runs .*spread"):
            study.plot(figure="bands")
