"""The summary of a study: who enters how, what is said, and in which form."""

import json
from dataclasses import replace

import numpy as np
import pytest

import pathloom as pl
from pathloom.cli import pathloom as command
from pathloom.study import Row
from pathloom.study.statistics import latex, summary
from pathloom.study.statistics.latex import escape


def found(variant: str, place: str, seed: int, length: float, **more) -> Row:
    known = {"gap_any_angle": length / 20.0 - 1.0, "fitness": 1.0 / length, "turns": 4, "evaluations_to_first": 50}
    return Row(variant, "imga", place, seed, "found", length=length, **{**known, **more})


def lost(variant: str, place: str, seed: int, status: str = "not-found") -> Row:
    return Row(variant, "imga", place, seed, status, evaluations=1000)


def study(shift: float = 0.0, instances: int = 8, runs: int = 5, variants: str = "ab") -> list[Row]:
    rng = np.random.default_rng(1)
    return [
        found(variant, f"m{i}", seed, 20.0 + i + rng.gamma(2.0, 0.5) + shift * k)
        for i in range(instances)
        for seed in range(runs)
        for k, variant in enumerate(variants)
    ]


def text(it, metric: str) -> str:
    return " ".join(v.text for v in it.verdicts if v.metric == metric)


def test_the_order_in_which_runs_ended_changes_nothing():
    rows = study(0.4)
    later_seeds_first = sorted(rows, key=lambda row: -row.seed)
    assert summary(rows).to_dict() == summary(later_seeds_first).to_dict()


def test_a_failure_counts_in_the_rate_ranks_worst_and_is_never_dropped():
    rows = [found("a", "m", s, 20.0 + s) for s in range(4)]
    rows += [found("b", "m", 0, 19.0), *(lost("b", "m", s) for s in (1, 2, 3))]
    it = summary(rows)
    cell = it.cell("b", "m")
    assert (cell.rate.found, cell.rate.runs) == (1, 4)
    assert (cell.spreads["length"].known, cell.spreads["length"].missing) == (1, 3)
    assert cell.spreads["length"].median == 19.0
    assert cell.spreads["length"].median_of_all is None
    pair = it.comparison("length").pairs[0]
    assert pair.a12.value == 12 / 16
    assert pair.difference.value is None
    assert it.overall[1].medians["length"] is None
    assert it.overall[1].statuses == {"found": 1, "not-found": 3}


@pytest.mark.parametrize("status", ["failed", "timeout", "crashed"])
def test_a_run_that_broke_is_a_failure_too(status):
    it = summary([found("a", "m", 0, 20.0), lost("a", "m", 1, status)])
    assert (it.overall[0].rate.found, it.overall[0].rate.runs) == (1, 2)
    assert it.overall[0].statuses == {"found": 1, status: 1}


def test_instances_without_a_path_are_nobodys_failure():
    rows = [*study(), *(lost(v, "shut", s, "unreachable") for v in "ab" for s in range(5))]
    it = summary(rows)
    assert it.overall[0].rate.runs == 40
    assert it.comparison("length").instances == 8
    assert any("10 runs on instances that have no path" in note for note in it.notes)


def test_a_target_that_was_missed_is_a_failure_and_one_that_nobody_knows_is_not():
    near = [found("a", "m", s, 20.1, evaluations_to_one_percent=90) for s in range(3)]
    far = [found("b", "m", s, 22.0) for s in range(3)]
    unknown = [found(v, "n", s, 30.0, gap_any_angle=None) for v in "ab" for s in range(3)]
    it = summary([*near, *far, *unknown])
    assert it.cell("b", "m").spreads["evaluations_to_one_percent"].missing == 3
    assert it.cell("b", "n").spreads["evaluations_to_one_percent"].missing == 0
    assert it.comparison("evaluations_to_one_percent").pairs[0].a12.value == 1.0


def test_lengths_that_differ_by_rounding_are_equal():
    rows = [
        found(v, f"m{i}", s, 20.0 * (1 + 2e-16 * k)) for i in range(8) for s in range(3) for k, v in enumerate("ab")
    ]
    pair = summary(rows).comparison("length").pairs[0]
    assert (pair.ties, pair.p, pair.a12.value) == (8, 1.0, 0.5)


def test_an_effect_is_said_with_its_size_its_p_and_its_direction():
    it = summary(study(0.8))
    (verdict,) = [v for v in it.verdicts if v.metric == "length"]
    assert verdict.shown
    assert verdict.text.startswith("Length: a is better than b: median difference −")
    assert "cells (Wilcoxon signed rank, p = 0.0078, 8 instances; A12 0.8" in verdict.text
    assert "Fitness: a is better than b: median difference +" in text(it, "fitness")


def test_no_effect_is_said_with_what_could_have_been_seen():
    assert "no effect shown between a and b" in text(summary(study()), "length")
    assert "smallest effect that could have been seen: 0." in text(summary(study()), "length")
    assert "equal on every instance" in text(summary(study()), "turns")


def test_few_instances_are_compared_by_runs_and_so_it_is_said():
    assert "van Elteren" in text(summary(study(0.8, instances=3, runs=20)), "length")
    assert "Mann-Whitney" in text(summary(study(0.8, instances=1, runs=20)), "length")
    assert "Fisher" in text(summary(study(0.8, instances=1, runs=20)), "success")
    assert "holds for these 3 maps" in " ".join(summary(study(instances=3)).notes)


def test_many_variants_are_ranked_and_corrected():
    it = summary(study(0.5, instances=12, variants="abcd")).comparison("length")
    assert (it.omnibus, len(it.pairs)) == ("Friedman", 6)
    assert list(it.ranking.ranks) == list("abcd")
    assert all(pair.adjusted >= pair.p for pair in it.pairs)
    many = summary(study(0.5, instances=12, variants="abcd"), baseline="a").comparison("length")
    assert [(pair.one, pair.other) for pair in many.pairs] == [("b", "a"), ("c", "a"), ("d", "a")]
    assert many.pairs[0].adjusted <= it.pairs[0].adjusted


def test_the_same_rows_and_seed_give_the_same_document():
    assert summary(study(0.3)).to_dict() == summary(study(0.3)).to_dict()
    assert summary(study(0.3), seed=1).to_dict() != summary(study(0.3)).to_dict()


def test_the_document_is_json_without_nan():
    rows = [*study(0.3), lost("a", "m0", 99), lost("b", "m1", 99, "crashed")]
    document = json.loads(json.dumps(summary(rows).to_dict(), allow_nan=False))
    assert document["schema"] == "pathloom.study-summary/1"
    assert document["overall"][0]["rate"]["share"] == pytest.approx(40 / 41)
    assert [c["metric"] for c in document["comparisons"]] == list(document["metrics"])


def test_a_single_variant_is_described():
    it = summary(study(variants="a"))
    assert it.comparisons == ()
    assert it.verdicts == ()
    assert len(it.cells) == 8


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ({"metrics": ["lenght"]}, "metric: none is called 'lenght'; did you mean 'length'"),
        ({"baseline": "c"}, "baseline: no variant is called 'c'"),
        ({"variants": ["z"]}, "variants: none is called 'z'"),
    ],
)
def test_what_is_unknown_is_refused(how, message):
    with pytest.raises(pl.ConfigError, match=message):
        summary(study(), **how)


def test_an_empty_study_is_refused():
    with pytest.raises(pl.ConfigError, match="no runs yet"):
        summary([])


def test_many_runs_are_read_one_by_one():
    row = found("a", "m", 0, 20.0)
    rows = (replace(row, variant="ab"[k % 2], seed=k // 2, length=20.0 + (k * 7919 % 101) / 50) for k in range(20_000))
    assert summary(rows).runs == 20_000


def test_latex_has_balanced_tables_and_escaped_names():
    rows = [replace(row, variant=f"50%_{row.variant}&") for row in study(0.5)]
    tables = latex(summary(rows))
    assert tables.count(r"\begin{table}") == tables.count(r"\end{table}") == 1 + len(summary(rows).metrics)
    assert r"50\%\_a\&" in tables
    for table in tables.split(r"\begin{tabular}")[1:]:
        body = [line for line in table.splitlines() if line.endswith(r"\\")]
        assert len({line.count("&") - line.count(r"\&") for line in body}) == 1
    assert escape(r"a\b_{c}") == r"a\textbackslash{}b\_\{c\}"


# The command.


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A finished study of two variants on two small maps."""
    out = tmp_path_factory.mktemp("studies") / "s.db"
    pl.ablate(
        "imga", swap={"selection": ["roulette"]}, maps=["random-8:8:x2"], runs=3, workers=1, out=out,
        budget="generations=3",
    ).close()  # fmt: skip
    return out


def run(capsys, *arguments: object) -> str:
    command.main([str(a) for a in arguments], standalone_mode=False)
    return capsys.readouterr().out


def test_the_command_prints_tables_verdicts_json_and_latex(file, capsys):
    shown = run(capsys, "study", "summary", file, "--instances")
    assert "selection=roulette" in shown
    assert "van Elteren" in shown
    document = json.loads(run(capsys, "study", "summary", file, "--json"))
    assert document["settings"]["baseline"] == "imga"
    assert document["runs"] == 12
    assert run(capsys, "study", "summary", file, "--latex").startswith(r"\begin{table}")


def test_the_command_refuses_what_it_cannot_take(file):
    with pytest.raises(pl.ConfigError, match="--json and --latex"):
        command.main(["study", "summary", str(file), "--json", "--latex"], standalone_mode=False)
    with pytest.raises(pl.ConfigError, match="no variant is called 'x'"):
        command.main(["study", "summary", str(file), "--baseline", "x"], standalone_mode=False)
