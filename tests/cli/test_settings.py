"""``--set SLOT=COMPONENT`` and ``--set SLOT.FIELD=VALUE``."""

import tomllib
from typing import Any

import pytest

from .conftest import Cli


def freezing(cli: Cli, *options: str):
    def frozen(*settings: str) -> dict[str, Any]:
        done = cli("plan", *options, *(word for setting in settings for word in ("--set", setting)), "--freeze")
        assert (done.code, done.err) == (0, "")
        return tomllib.loads(done.out)["planner"]

    return frozen


@pytest.fixture
def planner(cli: Cli):
    """Return the planner that the settings make of the default one."""
    return freezing(cli)


@pytest.fixture
def imga(cli: Cli):
    """Return the planner that the settings make of `imga`, which has three objectives."""
    return freezing(cli, "--planner", "imga")


def test_a_slot_takes_a_component_with_its_defaults(planner) -> None:
    assert planner("selection=tournament")["selection"]["use"] == "tournament"


def test_a_slot_takes_a_component_by_its_full_name(planner) -> None:
    assert planner("crossover=baselines/single-point")["crossover"]["use"] == "baselines/single-point"


def test_a_slot_takes_a_table_of_toml(planner) -> None:
    chosen = planner('survival={use = "keep-best", elites = 3}')["survival"]
    assert chosen == {"use": "keep-best", "elites": 3}


def test_a_field_is_set_and_its_neighbours_stay(planner) -> None:
    before, after = planner()["crossover"], planner("crossover.rate=0.25")["crossover"]
    assert after == {**before, "rate": 0.25}


def test_a_parameter_of_the_planner_is_set_without_a_slot(planner) -> None:
    assert planner("population=12")["population"] == 12


def test_a_whole_number_will_do_where_a_real_one_is_wanted(planner) -> None:
    assert planner("crossover.rate=1")["crossover"]["rate"] == 1.0


def test_blanks_around_the_equals_sign_do_not_matter(planner) -> None:
    assert planner("population = 12")["population"] == 12


def test_none_empties_a_slot(planner) -> None:
    assert planner("mutation=none")["mutation"] == "none"


def test_a_number_for_an_objective_is_its_weight(planner) -> None:
    before, after = planner()["objectives"], planner("objectives.length=3")["objectives"]
    assert after == {**before, "length": {**before["length"], "weight": 3.0}}


def test_a_number_for_one_of_several_objectives_leaves_the_others(imga) -> None:
    before, after = imga()["objectives"], imga("objectives.length=3")["objectives"]
    assert after == {**before, "length": {**before["length"], "weight": 3.0}}
    assert list(before) == ["length", "safety", "energy"]


def test_a_field_of_a_part_of_a_part_is_set(planner) -> None:
    control = planner("control.polish.radius=3", "control.learning.steps.gene-pool.halo=1")["control"]
    assert control["polish"]["radius"] == 3
    assert [step.get("halo") for step in control["learning"]["steps"]] == [None, 1]


def test_a_number_for_a_new_objective_adds_it(imga) -> None:
    terms = imga("objectives.turns=2")["objectives"]
    assert list(terms) == ["length", "safety", "energy", "turns"]
    assert terms["turns"] == {"use": "turns", "weight": 2.0}


def test_none_takes_an_objective_away(imga) -> None:
    assert list(imga("objectives.energy=none")["objectives"]) == ["length", "safety"]


def test_a_field_of_an_objective_is_set(imga) -> None:
    assert imga("objectives.safety.penalty=2")["objectives"]["safety"]["penalty"] == 2.0


@pytest.mark.parametrize("path", ["termination.max-generations.limit", "termination.0.limit", "termination.limit"])
def test_a_member_of_a_list_is_meant_by_name_by_place_or_by_its_only_field_of_that_name(planner, path) -> None:
    before, after = planner()["termination"], planner(f"{path}=5")["termination"]
    assert after == [{"use": "max-generations", "limit": 5}, *before[1:]]


def test_one_component_for_a_list_is_its_only_member(planner) -> None:
    assert planner("termination=max-evaluations")["termination"] == [{"use": "max-evaluations", "limit": 5000}]


def test_a_list_takes_a_list(planner) -> None:
    members = planner('termination=["max-evaluations", {use = "stagnation", patience = 3}]')["termination"]
    assert members == [{"use": "max-evaluations", "limit": 5000}, {"use": "stagnation", "patience": 3}]


@pytest.mark.parametrize(
    ("slot", "other"), [("crossover", "baselines/single-point"), ("mutation", "baselines/single-gene")]
)
def test_the_rate_belongs_to_the_slot_and_outlives_a_swap(planner, slot, other) -> None:
    assert planner(f"{slot}.rate=0.35", f"{slot}={other}")[slot]["rate"] == 0.35


def test_a_rate_of_its_own_goes_before_the_slot_s(planner) -> None:
    own = '{use = "baselines/single-point", rate = 0.1}'
    assert planner("crossover.rate=0.35", f"crossover={own}")["crossover"]["rate"] == 0.1


def test_settings_act_in_their_order(planner) -> None:
    assert planner("population=10", "population=20")["population"] == 20
    swapped = planner("selection=tournament", "selection.size=4")["selection"]
    assert swapped == {"use": "tournament", "size": 4}


def test_a_field_of_a_component_that_a_later_setting_brings_is_refused(refused) -> None:
    options = ("--planner", "imga", "--set", "selection.size=4", "--set", "selection=tournament")
    assert "no such parameter" in refused("plan", *options)


def test_a_setting_changes_the_run(cli) -> None:
    options = ("--map", "iga-map1", "--set", "termination=max-generations")
    budget = cli("plan", *options, "--set", "termination.limit=5", "--json").document["budget"]
    assert budget["generations"] == 5
