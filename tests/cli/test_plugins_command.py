"""``pathloom plugins``: list, show, cite."""

import tomllib
from pathlib import Path

import pytest

from pathloom.kernel.component import meanings, parameters
from pathloom.kernel.registry import default_registry

from .conftest import write

PARTS = [
    "imga/median-insertion",
    "imga/three-layer",
    "imga/common-node",
    "imga/unsafe-node",
    "imga/quadrant-energy",
    "roulette",
    "perturbed-trees",
    "max-generations",
]


def test_list_knows_the_parts_that_the_interface_fixes_and_nothing_is_broken(cli) -> None:
    document = cli("plugins", "list", "--json").document
    assert set(PARTS) <= {row["name"] for row in document["components"]}
    assert document["broken"] == {}


def test_list_can_be_held_to_one_kind(cli) -> None:
    rows = cli("plugins", "list", "--kind", "selection", "--json").document["components"]
    assert {row["kind"] for row in rows} == {"selection"}


def test_an_unknown_kind_is_refused_with_the_one_probably_meant(refused) -> None:
    assert "did you mean 'selection'?" in refused("plugins", "list", "--kind", "selektion")


def test_show_of_a_planner_tells_reference_fidelity_assumptions_and_parameters_with_ranges(cli) -> None:
    shown = cli("plugins", "show", "imga/imga").out
    assert shown.startswith("imga/imga, planner, plugin 'imga' (pathloom ")
    assert "doi:10.1155/2021/8836615" in shown
    assert "Fidelity: faithful" in shown
    assert "  - There is no elitism" in shown
    assert "an integer in [1, 2147483647]" in shown
    assert "Number of individuals" in shown


def test_show_of_a_planner_as_json_holds_its_complete_config(cli) -> None:
    document = cli("plugins", "show", "imga/imga", "--json").document
    assert document["fidelity"] == "faithful"
    assert document["config"] == tomllib.loads(cli("plan", "--planner", "imga", "--freeze").out)["planner"]


@pytest.mark.parametrize("name", PARTS)
def test_every_fixed_part_can_be_shown(cli, name) -> None:
    document = cli("plugins", "show", name, "--json").document
    assert document["name"] == name
    assert document["about"]


def test_show_of_a_bare_name_finds_the_part_and_of_a_plugin_all_its_parts(cli) -> None:
    assert cli("plugins", "show", "d8-gene-median", "--json").document["name"] == "imga/d8-gene-median"
    assert len(cli("plugins", "show", "baselines", "--json").document) > 1


def test_show_of_an_unknown_name_is_refused_with_the_one_probably_meant(refused) -> None:
    assert "did you mean 'imga/d8-gene-median'?" in refused("plugins", "show", "d8-gene-medain")


def test_cite_prints_bibtex_of_the_planner_named(cli) -> None:
    assert cli("plugins", "cite", "imga").out.startswith("@article{")


def test_cite_of_a_config_cites_the_papers_of_its_parts(cli, folder: Path) -> None:
    write(folder / "mine.toml", '[planner]\nuse = "ga-imga"\ncrossover = "imga/common-node"\n')
    assert "10.1155/2021/8836615" in cli("plugins", "cite", "mine.toml").out


def test_cite_of_an_unknown_planner_or_file_is_refused(refused) -> None:
    assert "did you mean 'imga/imga'?" in refused("plugins", "cite", "imgaa")
    assert refused("plugins", "cite", "gone.toml").startswith("gone.toml: found no such file")


def test_list_tells_the_fidelity_of_planners(cli) -> None:
    rows = cli("plugins", "list", "--kind", "planner", "--json").document["components"]
    assert {row["fidelity"] for row in rows} == {"faithful", "standard", "reconstructed"}


def test_show_tells_type_range_unit_default_and_meaning_of_each_parameter(cli) -> None:
    document = cli("plugins", "show", "rrt", "--json").document
    found = {row["name"]: row for row in document["parameters"]}
    assert found["step_length"] == {
        "name": "step_length",
        "type": {"type": "number", "exclusiveMinimum": 0.0},
        "allowed": "a number in (0.0, inf)",
        "unit": "cells",
        "default": "1.7",
        "about": "Length of a branch in cells: δ.",
    }
    assert found["refinement"]["type"] == {"kind": "repair", "many": False, "optional": True}
    assert found["termination"]["type"] == {"kind": "termination", "many": True, "optional": False}


def test_show_tells_what_a_part_works_on_and_may_break(cli) -> None:
    shown = cli("plugins", "show", "point-deletion").out
    assert "Works on: cells\n" in shown
    assert "May break: 8-connected\n" in shown


def test_every_parameter_of_ours_says_what_it_means() -> None:
    silent = [
        f"{entry.name}.{parameter.name}"
        for entry in default_registry().all_entries()
        if entry.source.ours
        for parameter in parameters(entry.component)
        if not meanings(entry.component).get(parameter.name)
    ]
    assert silent == []


def test_cite_reads_the_smoother_and_the_rivals_of_a_front_too(cli, folder: Path) -> None:
    write(folder / "mine.toml", '[planner]\nuse = "nsga2"\n[front]\nagainst = ["imga"]\n[run]\nsmooth = "b-spline"\n')
    cited = cli("plugins", "cite", "mine.toml").out
    assert cited.startswith("@article{deb2002nsga2,")
    assert "\n\n@article{li2021imga," in cited


def test_cite_says_when_there_is_nothing_to_cite(cli) -> None:
    done = cli("plugins", "cite", "any-angle")
    assert (done.code, done.out) == (0, "")
    assert done.err == "pathloom: any-angle: found nothing that names a publication\n"
