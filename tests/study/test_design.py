"""What runs: variants, instances, budgets."""

import pytest

import pathloom as pl
from pathloom.errors import ConfigError, MapError, PathloomError
from pathloom.kernel.termination import MaxEvaluations, MaxGenerations, Stagnation, WallTime
from pathloom.paths.maps import names_of
from pathloom.study.budget import Budget, unhurried
from pathloom.study.design import ablation, comparison
from pathloom.study.instances import instances_of


def names(*args, **keywords):
    return [variant.name for variant in ablation(*args, **keywords)[0]]


def test_one_slot_is_swapped_at_a_time():
    found = names("imga", swap={"selection": ["roulette", "imaga/three-stage"], "sampling": ["iga/row-wise"]})
    assert found == ["imga", "selection=roulette", "selection=imaga/three-stage", "sampling=iga/row-wise"]


def test_a_variant_differs_from_its_base_in_the_one_slot_only():
    base, other = (v.planner for v in ablation("imga", swap={"selection": ["roulette"]})[0])
    assert pl.freeze(other) | {"selection": None} == pl.freeze(base) | {"selection": None}


def test_the_design_is_the_same_every_time():
    asked = {
        "swap": {"selection": ["roulette"], "crossover.rate": [0.5, 0.9]},
        "without": ["mutation"],
        "factorial": True,
    }
    assert ablation("imga", **asked) == ablation("imga", **asked)


def test_the_bases_own_choice_is_the_base_and_is_said_to_be():
    variants, notes = ablation("imga", swap={"selection": ["imga/three-layer", "roulette"]})
    assert [v.name for v in variants] == ["imga", "selection=roulette"]
    assert notes == ("swap selection: imga/three-layer is the base's own",)


def test_a_part_is_left_out():
    base, other = ablation("imga", without=["mutation"])[0]
    assert (other.name, other.planner.mutation, other.changes) == ("without mutation", None, {"mutation": "none"})
    assert base.planner.mutation is not None


def test_terms_and_members_of_lists_are_left_out():
    found = ablation("imga", without=["objectives.energy", "termination.stagnation"], budget=Budget("own"))[0]
    assert found[1].planner.terms.labels == ("length", "safety")
    assert len(found[2].planner.termination) == len(found[0].planner.termination) - 1


def test_a_full_factorial_has_all_combinations():
    found = names(
        "imga", swap={"selection": ["roulette"], "population": [40, 50]}, without=["mutation"], factorial=True
    )
    assert len(found) == len(set(found)) == 2 * 3 * 2
    assert "selection=roulette, population=50, without mutation" in found


def test_one_is_added_at_a_time():
    found = names("imga", without=["mutation", "crossover", "refinement"], add_one_in=True)
    assert found[4:] == [
        "without mutation, without crossover, without refinement", "without crossover, without refinement",
        "without mutation, without refinement", "without mutation, without crossover",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({}, "found nothing to change"),
        ({"swap": {"selektion": ["roulette"]}}, "swap selektion: 'imga/imga' has no such slot or parameter; did you mean 'selection'"),
        ({"swap": {"selection": ["roulete"]}}, "did you mean 'roulette'"),
        ({"swap": {"selection": ["roulette", "roulette"]}}, "swap selection: found 'roulette' twice, allowed each once"),
        ({"swap": {"selection": ["imaga/three-stage", "three-stage"]}}, "'three-stage' twice (also called 'imaga/three-stage')"),
        ({"swap": {"selection": ["imga/three-layer"]}}, "'imga/three-layer' is the base's own"),
        ({"swap": {"selection": []}}, "swap selection: found nothing"),
        ({"swap": {"population": [0]}}, "population is an integer in [1,"),
        ({"without": ["selection"]}, "without selection: it cannot be empty"),
        ({"without": ["migration"]}, "without migration: 'imga' has none"),
        ({"without": ["mutation", "mutation"]}, "without mutation: comes twice"),
        ({"swap": {"termination": ["stagnation"]}}, "--budget own"),
        ({"without": ["mutation"], "add_one_in": True}, "needs two or more"),
        ({"swap": {"population": list(range(10, 100)), "crossover.rate": [k / 100 for k in range(79)]}, "factorial": True}, "combinations"),
    ],
)  # fmt: skip
def test_what_cannot_be_ablated_is_refused_in_one_line(asked, says):
    with pytest.raises(ConfigError) as refused:
        ablation("imga", **asked)
    assert says in str(refused.value)
    assert "\n" not in str(refused.value)


def test_planners_are_compared_under_the_names_they_were_asked_for():
    assert [v.name for v in comparison(["imga", {"use": "imga", "population": 40}, "agacd"])] == [
        "imga",
        "imga #2",
        "agacd",
    ]
    assert [v.name for v in comparison({"small": {"use": "imga", "population": 40}})] == ["small"]


def test_a_planner_is_compared_once(grid):
    with pytest.raises(ConfigError, match="'imga' twice"):
        pl.compare(["imga", "imga"], maps=grid)
    with pytest.raises(ConfigError, match="'imga/imga' and 'imga' are the same"):
        pl.compare(["imga", "imga/imga"], maps=grid)


def test_paths_and_fronts_are_not_compared(grid):
    with pytest.raises(ConfigError, match="compare like with like"):
        pl.compare(["imga", "nsga2"], maps=grid)
    with pytest.raises(ConfigError, match="different objectives"):
        pl.compare(["nsga2", {"use": "nsga3", "objectives": ["length", "turns"]}], maps=grid)


# Budgets.


def test_a_budget_takes_the_place_of_limits_and_of_nothing_else():
    planner = Budget("evaluations", 1234).applied(pl.compose("imga"))
    assert planner.termination == (MaxEvaluations(limit=1234), MaxGenerations(limit=1234), Stagnation(patience=40))
    assert Budget("seconds", 2.0).applied(planner).termination == (WallTime(seconds=2.0), Stagnation(patience=40))
    assert Budget("generations", 7).applied(planner).termination[0] == MaxGenerations(limit=7)
    assert Budget("own").applied(planner) == planner


def test_a_planner_with_no_limit_of_its_own_keeps_what_ends_it():
    assert Budget("evaluations", 10).applied(pl.compose("dijkstra")).termination == (MaxEvaluations(limit=10),)
    assert unhurried(pl.compose("dijkstra")).termination == ()


def test_what_a_planner_would_spend_is_seen_without_its_early_ends():
    assert unhurried(pl.compose("imga")).termination == (MaxGenerations(limit=50),)


@pytest.mark.parametrize(
    "text",
    [
        "evals",
        "evaluations=",
        "evaluations=0",
        "evaluations=1.5",
        "evaluations=x",
        "seconds",
        "own=3",
        "seconds=inf",
        "seconds=nan",
    ],
)
def test_a_budget_that_makes_no_sense_is_refused(text):
    with pytest.raises(ConfigError, match="^budget: found"):
        Budget.parse(text)


def test_budgets_are_read():
    assert Budget.parse("evaluations") == Budget()
    assert Budget.parse("evaluations=5000") == Budget("evaluations", 5000)
    assert Budget.parse("seconds=0.5") == Budget("seconds", 0.5)
    assert Budget.parse("own") == Budget("own")


# Instances.


def test_a_count_stands_for_that_many_seeds():
    assert names_of("random-20:75:x3") == ("random-20:75:s0", "random-20:75:s1", "random-20:75:s2")
    assert names_of("random-20:75:s5:x2") == ("random-20:75:s5", "random-20:75:s6")
    assert names_of("iga-map1") == ("iga-map1",)


@pytest.mark.parametrize("name", ["random-20:75:x0", "random-20:75:x99999999", "random-20:75:x2:x3"])
def test_counts_have_bounds(name):
    with pytest.raises(MapError, match="allowed one count from x1"):
        names_of(name)


def test_maps_are_names_files_grids_and_problems(grid, tmp_path):
    file = tmp_path / "small.csv"
    file.write_text("0,0\n0,0\n")
    problem = pl.PathProblem(grid, start=(0, 0), goal=(0, 5))
    found = instances_of(["iga-map1", str(file), grid, problem, "random-10:5:x2"])
    assert [i.name for i in found] == ["iga-map1", "small.csv", "block", "block #2", "random-10:5:s0", "random-10:5:s1"]
    assert found[3].problem.ends == ((0, 0), (0, 5))


@pytest.mark.parametrize(
    ("maps", "says"),
    [([], "found none"), ([""], "empty name"), (["iga-map1", "iga-map1"], "'iga-map1' comes twice"),
     (["empty-8:x2"], "'empty-8:s1' is the same as 'empty-8:s0'"), (["iga-map9"], "iga-map1"), (["nothing.map"], "no such file")],
)  # fmt: skip
def test_maps_that_cannot_be_used_are_refused_in_one_line(maps, says):
    with pytest.raises(PathloomError) as refused:
        instances_of(maps)
    assert says in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.fixture
def scenario(tmp_path):
    (tmp_path / "m.map").write_text("type octile\nheight 3\nwidth 3\nmap\n...\n.@.\n...\n")
    lines = [f"0\tm.map\t3\t3\t0\t0\t{x}\t{y}\t{length}" for x, y, length in ((2, 0, 2.0), (2, 2, 4.0), (0, 2, 2.0))]
    file = tmp_path / "m.map.scen"
    file.write_text("version 1\n" + "\n".join(lines) + "\n")
    return file


def test_cases_of_a_scenario_are_instances(scenario):
    found = instances_of(scenarios=[scenario], cases="0,2")
    assert [(i.name, i.problem.ends, i.stated) for i in found] == [
        ("m.map.scen:0", ((0, 0), (0, 2)), 2.0), ("m.map.scen:2", ((0, 0), (2, 0)), 2.0),
    ]  # fmt: skip
    assert [i.name[-1] for i in instances_of(scenarios=[scenario])] == ["0", "1", "2"]
    assert [i.name[-1] for i in instances_of(scenarios=[scenario], cases="0-1")] == ["0", "1"]


@pytest.mark.parametrize("cases", ["3", "0-3", "2-1", "x", "-1", "", "0-999999999"])
def test_cases_that_are_not_there_are_refused(scenario, cases):
    with pytest.raises(ConfigError, match="^cases: found"):
        instances_of(scenarios=[scenario], cases=cases)
