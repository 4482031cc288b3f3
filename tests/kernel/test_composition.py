"""Names and tables become components, and components become tables again."""

import tomllib

import pytest
import tomli_w

import pathloom as pl
from kernel.conftest import source
from pathloom.kernel.compose import build, compose, freeze, override
from pathloom.kernel.registry import Registry
from pathloom_imga.crossover import CommonNode
from pathloom_imga.selection import ThreeLayer


def test_a_paper_planner_has_every_default_in_its_frozen_form(registry):
    table = freeze(compose("imga", registry=registry), registry)
    assert table["use"] == "imga/imga"
    assert table["sampling"]["use"] == "imga/median-insertion"
    assert table["objectives"]["energy"]["weight"] == 3.0
    assert table["termination"][0] == {"use": "max-generations", "limit": 50}
    assert table["repair"] == "none"


@pytest.mark.parametrize("name", ["imga", "imga/imga", "ga-imga", "baselines/ga-imga"])
def test_a_frozen_planner_is_composed_to_the_same_planner_through_toml(registry, name):
    planner = compose(name, registry=registry)
    text = tomli_w.dumps(freeze(planner, registry))
    again = compose(tomllib.loads(text), registry=registry)
    assert again == planner
    assert tomli_w.dumps(freeze(again, registry)) == text


def test_a_slot_takes_a_component_a_name_or_a_table(registry):
    for value in (ThreeLayer(), "imga/three-layer", "three-layer", {"use": "three-layer"}):
        assert compose("ga-imga", registry=registry, selection=value).selection == ThreeLayer()


def test_a_table_without_use_refines_what_the_slot_holds(registry):
    planner = compose("imga", registry=registry, crossover={"rate": 0.9})
    assert planner.crossover == CommonNode(rate=0.9)


def test_swapping_an_operator_keeps_the_rate_of_the_slot(registry):
    base = compose("imga", registry=registry, crossover={"rate": 0.55})
    swapped = compose(base, registry=registry, crossover="baselines/single-point")
    assert swapped.crossover.rate == 0.55
    given = compose(base, registry=registry, crossover={"use": "baselines/single-point", "rate": 0.9})
    assert given.crossover.rate == 0.9


def test_objectives_are_replaced_as_a_whole(registry):
    planner = compose("imga", registry=registry, objectives={"length": 2, "safe": {"use": "imga/unsafe-node"}})
    assert planner.objectives.labels == ("length", "safe")
    assert planner.objectives.weights.tolist() == [2.0, 1.0]


@pytest.mark.parametrize(
    ("path", "value", "found"),
    [
        ("population", 40, lambda p: p.population == 40),
        ("selection", "roulette", lambda p: p.selection.name == "roulette"),
        ("mutation.rate", 0.5, lambda p: p.mutation.rate == 0.5),
        ("sampling.reading", "as-printed", lambda p: p.sampling.reading == "as-printed"),
        ("objectives.length", 1, lambda p: p.objectives.weights.tolist() == [1.0, 1.0, 3.0]),
        ("objectives.safety.per", "obstacle", lambda p: p.objectives[1].objective.per == "obstacle"),
        ("objectives.energy", "none", lambda p: p.objectives.labels == ("length", "safety")),
        ("objectives.turns", 2.0, lambda p: p.objectives.labels[-1] == "turns"),
        ("termination.max-generations.limit", 7, lambda p: p.termination[0].limit == 7),
        ("termination.1.patience", 9, lambda p: p.termination[1].patience == 9),
        ("termination.limit", 8, lambda p: p.termination[0].limit == 8),
        ("refinement", "none", lambda p: p.refinement is None),
        ("refinement.collision", "exact", lambda p: p.refinement.collision.name == "exact"),
    ],
)
def test_a_dotted_path_changes_one_thing(registry, path, value, found):
    assert found(override(compose("imga", registry=registry), path, value, registry))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"selektion": "roulette"}, "planner.selektion: 'imga/imga' has no such slot or parameter; did you mean 'selection'?"),
        ({"selection": "roulete"}, "planner.selection: no selection is called 'roulete'; did you mean 'roulette'?"),
        ({"selection": "imga/tree-layer"}, "planner.selection: no selection is called 'imga/tree-layer'; did you mean 'imga/three-layer'?"),
        ({"selection": "length"}, "planner.selection: 'length' is an objective, not a selection"),
        ({"selection": "igma/three-layer"}, "planner.selection: no plugin is called 'igma'; did you mean 'imga'?"),
        ({"selection": {"use": "roulete", "a": 1}}, "planner.selection.use: no selection is called 'roulete'; did you mean 'roulette'?"),
        ({"selection": {"size": 3}}, "planner.selection.size: 'imga/three-layer' has no such parameter; known: none"),
        ({"selection": {"use": "tournament", "sise": 3}}, "planner.selection.sise: 'tournament' has no such parameter; did you mean 'size'?"),
        ({"selection": 3}, "planner.selection: a selection is a name or a table with 'use'; got 3"),
        ({"selection": "none"}, "planner.selection: no selection is called 'none'"),
        ({"crossover": {"rate": 1.5}}, r"planner.crossover.rate is a number in \[0, 1\]; got 1.5"),
        ({"population": 0}, r"planner.population is an integer in \[1, 2147483647\]; got 0"),
        ({"population": "many"}, r"population is an integer in \[1, 2147483647\]; got 'many'"),
        ({"mutation": {"rate": float("nan")}}, r"rate is a number in \[0, 1\]; got nan"),
        ({"sampling": {"reading": "loose"}}, "reading is one of 'guarded', 'as-printed'; got 'loose'"),
        ({"objectives": {}}, "planner.objectives is a table with at least one term; got none"),
        ({"objectives": {"lenght": 1}}, "planner.objectives.lenght: no objective is called 'lenght'; did you mean 'length'?"),
        ({"objectives": {"length": -1}}, r"objectives.length: weight is a number in \[0, inf\); got -1.0"),
        ({"termination": [{"use": "max-generations", "limit": 0}]}, r"limit is an integer in \[1, 2147483647\]; got 0"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_where_it_is_with_what_is_allowed_and_meant(registry, changes, message):
    with pytest.raises(pl.ConfigError, match=message):
        compose("imga", registry=registry, **changes)


@pytest.mark.parametrize("objectives", [["length", "turns", "length"], ["length", {"use": "length"}]])
def test_an_objective_that_is_listed_twice_is_refused(objectives):
    with pytest.raises(pl.ConfigError, match=r"^planner.objectives: found 'length' twice, allowed each objective once"):
        compose({"use": "nsga2", "objectives": objectives})


def test_an_objective_may_be_listed_by_a_table(registry):
    made = compose({"use": "nsga2", "objectives": ["turns", {"use": "length"}]})
    assert made.terms.labels == ("turns", "length")


def test_a_planner_says_which_slots_it_needs(registry):
    with pytest.raises(
        pl.ConfigError, match="planner: 'evolution' needs 'objectives': a table of objectives with weights"
    ):
        compose("evolution", registry=registry)


def test_an_operator_that_needs_single_steps_is_refused_where_they_are_not_kept(registry):
    with pytest.raises(
        pl.ConfigError, match="mutation 'single-gene' needs 8-connected individuals, which 'point-deletion'"
    ):
        compose("ga-imga", registry=registry, repair="point-deletion")


def test_a_bare_name_means_the_kernels_component_whatever_others_call_theirs(registry):
    class Roulette(pl.Selection):
        name = "roulette"

    other = _plugin([_frozen(Roulette)])
    with_rival = Registry([*registry._sources.values(), source("acme", other)])
    assert with_rival.find(pl.Selection, "roulette").__module__ == "pathloom.kernel.selection"
    assert with_rival.find(pl.Selection, "acme/roulette").__module__ != "pathloom.kernel.selection"


def test_two_foreign_components_of_one_name_are_ambiguous_without_prefix(registry):
    class Odd(pl.Selection):
        pass

    rivals = [source(name, _plugin([_frozen(type("Odd", (Odd,), {}))])) for name in ("acme", "bold")]
    both = Registry([*registry._sources.values(), *rivals])
    with pytest.raises(pl.ConfigError, match="'odd' is ambiguous: 'acme/odd' or 'bold/odd'"):
        both.find(pl.Selection, "odd")


def test_a_plugin_that_nobody_names_is_not_even_loaded():
    def explode():
        raise AssertionError("loaded")

    import pathloom.components
    import pathloom_imga
    from pathloom.kernel.plugins import Source

    sources = [source("core", pathloom.components, "pathloom"), source("imga", pathloom_imga, "pathloom")]
    registry = Registry([*sources, Source("acme", explode, "acme", "1")])
    assert compose("imga", registry=registry, selection="roulette").selection.name == "roulette"


@pytest.mark.parametrize(
    ("components", "cause"),
    [
        (["text"], "registers 'text', which inherits from no kind of component"),
        ([pl.Selection], "registers Selection, which lacks select"),
        ([type("Plain", (pl.Selection,), {"select": print, "__dataclass_params__": type("P", (), {"frozen": False})})],
         "which is not a frozen dataclass"),
        ([ThreeLayer, ThreeLayer], "registers two components of kind 'selection' called 'three-layer'"),
    ],
)  # fmt: skip
def test_a_plugin_that_registers_something_unusable_is_named_with_the_cause(components, cause):
    registry = Registry([source("acme", _plugin(components), "acme-paths", "2.1")])
    with pytest.raises(pl.PluginError, match=r"plugin 'acme' \(acme-paths 2.1\): .*" + cause):
        registry.entries("acme")
    assert "acme" in registry.broken()


def test_a_plugin_without_the_hook_is_named():
    registry = Registry([source("acme", object(), "acme-paths", "2.1")])
    with pytest.raises(pl.PluginError, match="has no function `register` marked with"):
        registry.entries("acme")


def test_a_stranger_who_claims_our_name_loses_and_is_reported(registry):
    clone = source("imga", _plugin([]), "pathloom-clone", "0.1")
    both = Registry([clone, *registry._sources.values()])
    assert compose("imga", registry=both).name == "imga"
    assert "claimed twice: by pathloom-clone 0.1 and pathloom 1.0" in str(next(iter(both.broken().values())))


def test_two_strangers_of_one_name_are_both_out():
    both = Registry([source("acme", _plugin([]), "one", "1"), source("acme", _plugin([]), "two", "2")])
    with pytest.raises(pl.PluginError, match="'acme' is claimed twice: by one 1 and two 2; uninstall one"):
        both.entries("acme")


def test_a_component_of_a_slot_is_built_from_a_name_alone(registry):
    assert build(pl.Sampling, "perturbed-trees", registry, "x").name == "perturbed-trees"


def _frozen(cls):
    import dataclasses

    import numpy as np

    cls.select = lambda self, fitness, n, rng: np.zeros(n, int)
    cls.__abstractmethods__ = frozenset()
    return dataclasses.dataclass(frozen=True, kw_only=True)(cls)


def _plugin(components):
    class Plugin:
        @staticmethod
        @pl.hookimpl
        def register(add):
            for component in components:
                add(component)

    return Plugin
