"""Studies of planners that answer with fronts."""

import numpy as np
import pytest

import pathloom as pl
from pathloom.fronts import hypervolume, reference_point
from study.conftest import timeless

ASKED = {"maps": ["blocks-8:20%"], "runs": 2, "budget": "evaluations=200", "workers": 1}


@pytest.fixture(scope="module")
def study():
    with pl.compare(["nsga2", "nsga3"], **ASKED) as done:
        yield done


def test_fronts_are_measured_against_the_exact_one(study):
    rows = study.rows()
    exact = pl.pareto(study.problem(rows[0]), "nsga2", exact=True).exact
    corner = reference_point(exact)
    for row in rows:
        values = study.front(row)["values"]
        assert row.hypervolume == pytest.approx(hypervolume(values, corner))
        assert row.hypervolume_ratio == pytest.approx(row.hypervolume / hypervolume(exact, corner))
        assert 0.0 < row.hypervolume_ratio <= 1.0 + 1e-9


def test_a_front_is_kept_with_its_paths(study):
    row = study.rows()[0]
    front, problem = study.front(row), study.problem(row)
    assert front["objectives"] == list(study.planner(row).objectives.labels)
    assert len(front["paths"]) == len(front["values"])
    assert all(pl.validate(path, problem) is None for path in front["paths"])
    lengths = [np.hypot(*np.diff(path, axis=0).T).sum() for path in front["paths"]]
    assert row.length == pytest.approx(min(lengths))
    assert study.path(row).tolist() == front["paths"][int(np.argmin(lengths))].tolist()


def test_without_an_exact_front_all_fronts_together_are_the_measure():
    planner = {"use": "nsga2", "objectives": ["length", "clearance"]}
    with pl.compare({"one": planner, "other": {**planner, "population": 6}}, **ASKED) as study:
        rows = study.rows()
        assert next(iter(study.instances.values())).exact_front is None
        every = np.concatenate([study.front(row)["values"] for row in rows])
    assert all(0.0 < row.hypervolume_ratio <= 1.0 + 1e-9 for row in rows)
    assert len({tuple(value) for value in every}) >= 1


def test_a_study_of_fronts_is_the_same_every_time(study):
    with pl.compare(["nsga2", "nsga3"], **ASKED) as again:
        assert [timeless(row) for row in again.each()] == [timeless(row) for row in study.each()]
