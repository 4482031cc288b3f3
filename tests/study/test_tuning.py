"""Tuning from factors to the confirmed optimum, with made-up runs and with real ones."""

import json
from collections.abc import Callable

import numpy as np
import pytest

import pathloom as pl
from pathloom.cli import pathloom as command
from pathloom.kernel.compose import freeze
from pathloom.study import Row
from pathloom.study.budget import Budget
from pathloom.study.instances import instances_of
from pathloom.study.statistics import Runs
from pathloom.study.tuning.experiment import OPTIMUM, tune, tuned
from pathloom.study.tuning.factors import experiment
from pathloom.study.tuning.response import response

FACTORS = {"population": [40, 60, 80], "crossover.rate": [0.6, 0.8, 0.95], "mutation.rate": [0.1, 0.3]}


class MadeUp:
    """A study of which the runs follow a formula of the planner's parameters."""

    budget = Budget("own")

    def __init__(self, design, gap: Callable[..., float | None]) -> None:
        self.design, self.gap = design, gap

    def rows(self) -> list[Row]:
        design, found = self.design, []
        for place, instance in enumerate(design.instances):
            for variant in design.variants:
                for seed in range(design.seed, design.seed + design.runs):
                    noise = np.random.default_rng([seed, place, *variant.name.encode()]).normal(0.0, 0.005)
                    gap = self.gap(variant.planner, place, noise)
                    status = "not-found" if gap is None else "found"
                    length = None if gap is None else 20.0 * (1 + gap)
                    found.append(
                        Row(variant.name, "imga", instance.name, seed, status, gap_any_angle=gap, length=length)
                    )
        return found

    def each(self) -> list[Row]:
        return self.rows()

    def close(self) -> None: ...


def made(gap: Callable[..., float | None], maps: int = 6, factors=FACTORS, **how):
    designs = []

    def carry(design, out):
        designs.append((design, out))
        return MadeUp(design, gap)

    places = instances_of([f"random-8:4:x{maps}"])
    found = tuned(experiment("imga", factors), places, carry=carry, budget=Budget("own"), **{"runs": 5, **how})
    return found, designs


def curved(planner, place, noise):
    """Least at a population of 60 and a crossover of 0.95; maps differ far more than settings."""
    return 0.1 * place + abs(planner.population - 60) / 400 - planner.crossover.rate / 10 + noise + 0.3


def test_the_planted_optimum_is_found_predicted_and_confirmed():
    found, designs = made(curved)
    assert found.optimum["population"] == 60
    assert found.optimum["crossover.rate"] == 0.95
    assert found.experiment.array == "L9"
    expected = 0.25 - 0.095 + 0.3
    assert found.model.predicted == pytest.approx(expected, abs=0.004)
    assert abs(found.model.predicted - expected) < 3 * found.model.error
    assert found.confirmed["optimum"] == pytest.approx(expected, abs=0.003)
    assert found.model.p[0] < 1e-6
    assert found.model.p[2] > 0.05
    (first, _), (second, _) = designs
    assert second.seed == first.seed + first.runs
    assert [v.name for v in second.variants] == ["imga", OPTIMUM]
    sentences = " ".join(found.sentences())
    assert "population: best at 60" in sentences
    assert "mutation.rate: no effect shown" in sentences
    assert "predicted best is better than imga" in sentences
    assert "in keeping with the prediction" in sentences
    assert "mixed up with joint effects" in sentences


@pytest.mark.parametrize("by", ["ols", "paper"])
def test_a_linear_model_chooses_a_corner(by):
    found, _ = made(curved, by=by, confirm=0)
    assert found.optimum["population"] in (40, 80)
    assert found.optimum["crossover.rate"] == 0.95
    assert found.confirmation is None


def test_the_papers_divisor_shrinks_slopes_of_three_levels_and_leaves_those_of_two():
    three = {"population": [40, 60, 80], "crossover.rate": [0.6, 0.8, 0.95], "mutation.rate": [0.1, 0.2, 0.3]}
    paper, ols = (made(curved, by=by, confirm=0, factors=three)[0].model.linear.slopes for by in ("paper", "ols"))
    assert paper == pytest.approx(ols * 2 / 3)
    two = {"population": [40, 80], "crossover.rate": [0.6, 0.95]}
    paper, ols = (made(curved, by=by, confirm=0, factors=two)[0].model.linear.slopes for by in ("paper", "ols"))
    assert paper == pytest.approx(ols)


def test_of_what_is_to_be_large_the_largest_is_chosen():
    class Fit(MadeUp):
        def rows(self):
            rows = super().rows()
            return [Row(r.variant, r.planner, r.map, r.seed, r.status, fitness=1 / r.length) for r in rows]

    places = instances_of(["random-8:4:x6"])
    found = tuned(
        experiment("imga", FACTORS), places, carry=lambda d, _: Fit(d, curved), measure="fitness", confirm=0, runs=5
    )
    assert found.optimum["population"] == 60
    assert found.optimum["crossover.rate"] == 0.95


def test_where_nothing_matters_no_effect_is_shown():
    called = 0
    for seed in range(0, 400, 10):
        found, _ = made(lambda planner, place, noise: 0.1 * place + noise, maps=2, runs=5, seed=seed, confirm=0)
        called += bool((found.model.p < 0.05).any())
    assert called <= 7  # 5 % of 40 are 2; 8 and more have a chance of 0.0004


def test_where_the_base_is_a_setting_it_runs_once_and_where_it_is_best_nothing_is_confirmed():
    best = lambda planner, place, noise: abs(planner.population - 100) / 400 + noise / 10  # noqa: E731
    found, designs = made(best, factors={"population": [60, 80, 100]})
    assert [v.name for v in designs[0][0].variants] == ["imga", "population=60", "population=80"]
    assert found.optimum == {"population": 100}
    assert len(designs) == 1
    assert found.confirmation is None
    assert found.base_mean == pytest.approx(found.means[2])


def test_runs_that_fail_count_as_the_worst_of_their_map_and_are_counted():
    def failing(planner, place, noise):
        return None if planner.population == 40 and noise > 0 else 0.1 * place + 0.02 + noise

    found, _ = made(failing, confirm=0)
    assert found.response.penalised > 0
    assert "count as the worst of their map" in " ".join(found.sentences())
    assert found.optimum["population"] != 40


def test_maps_where_the_response_is_unknown_are_left_out_and_hard_maps_are_no_spread():
    rows = [
        Row(v, "p", m, s, "found", gap_any_angle=None if m == "x" else 5.0 * k + 0.01 * s + 0.1 * n, length=20.0)
        for k, m in enumerate("uvwx")
        for n, v in enumerate("ab")
        for s in range(3)
    ]
    found = response(Runs.read(rows), ["a", "b"])
    assert (found.metric.name, found.maps, found.left_out, found.trials.shape) == ("gap_any_angle", 3, 1, (2, 9))
    assert found.trials.mean(axis=1) == pytest.approx([5.01, 5.11])
    assert found.trials.std(axis=1).max() < 0.01
    with pytest.raises(pl.ConfigError, match="no map has a fitness of every run"):
        response(Runs.read(rows), ["a", "b"], "fitness")


@pytest.mark.parametrize(
    ("factors", "message"),
    [
        ({}, "factor: found none"),
        ({"populaton": [1, 2]}, "factor populaton: .*did you mean 'population'"),
        ({"population": [40, 40]}, "factor population: found 40 twice"),
        ({"population": [40]}, "factor: found 1 levels, allowed 2 or 3"),
        ({"crossover.rate": [0.5, 1.5]}, "factor crossover.rate"),
    ],
)
def test_bad_factors_are_refused(factors, message):
    with pytest.raises(pl.ConfigError, match=message):
        experiment("imga", factors)


@pytest.mark.parametrize(
    ("how", "message"),
    [({"by": "best"}, "by: found 'best'"), ({"confirm": -1}, "confirm: found -1"), ({"measure": "success"}, "measure"),
     ({"measure": "lenght"}, "did you mean 'length'")],
)  # fmt: skip
def test_bad_questions_are_refused(how, message):
    with pytest.raises(pl.ConfigError, match=message):
        made(curved, **how)


def test_settings_are_the_base_with_the_values_that_they_name():
    plan = experiment("imga", FACTORS)
    for variant, row in zip(plan.variants(), plan.levels.tolist(), strict=True):
        assert variant.planner.population == plan.setting(row)["population"]
        assert variant.planner.mutation.rate == plan.setting(row)["mutation.rate"]
        assert freeze(variant.planner)["selection"] == freeze(plan.base)["selection"]
    assert set(np.unique(plan.coded[:, 2])) == {-1, 1}
    assert plan.values_at([0, 1, -1]) == {"population": 60, "crossover.rate": 0.95, "mutation.rate": 0.1}


def test_a_real_planner_is_tuned_and_its_files_are_taken_up(tmp_path, capsys):
    out = tmp_path / "t.db"
    arguments = ["tune", "imga", "--factor", "population=10,20", "--maps", "random-8:8:x2", "--runs", "2", "--out", out,
                 "--budget", "generations=3", "--workers", "1", "--plot", tmp_path / "t.png", "--json"]  # fmt: skip
    command.main([str(a) for a in arguments], standalone_mode=False)
    first = json.loads(capsys.readouterr().out)
    assert first["schema"] == "pathloom.tune/1"
    assert [setting["values"] for setting in first["settings"]] == [{"population": 10}, {"population": 20}]
    assert (tmp_path / "t.png").exists()
    with pl.Study.open(out) as study, pl.Study.open(tmp_path / "t-confirmation.db") as confirmation:
        assert (study.kind, len(study), len(confirmation)) == ("tune", 12, 8)
    again = tune("imga", {"population": [10, 20]}, maps="random-8:8:x2", runs=2, out=out, budget="generations=3")
    with again.study:
        assert json.loads(json.dumps(again.to_dict(), allow_nan=False)) == first


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--factor", "population"], "--factor population: found no parameter, no '='"),
        (["--factor", "population=1,2", "--factor", "population=3,4"], "--factor population: comes twice"),
        (["--factor", "population=1,2,3,4"], "--factor: found 4 levels"),
        ([], "--factor: found none"),
        (["--factor", "population=1,2", "--plot", "x.gif"], "allowed .png"),
    ],
)
def test_the_command_refuses_what_it_cannot_take(arguments, message, tmp_path):
    with pytest.raises(pl.PathloomError, match=message):
        command.main(
            ["tune", "imga", "--maps", "empty-8", "--out", str(tmp_path / "t.db"), *arguments], standalone_mode=False
        )
