"""What every registered component promises, whoever registered it."""

import inspect
import pickle

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.component import parameters
from pathloom.kernel.compose import build, freeze
from pathloom.kernel.counting import counting
from pathloom.kernel.immigrants import RandomImmigrants
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import run
from pathloom.paths.maps import MapFamily

from .filled import FILLED

ENTRIES = list(default_registry().all_entries())
BUILDABLE = [e for e in ENTRIES if not any(p.required for p in parameters(e.component))]
MAPS = ("iga-map1", "imaga-fig1", "blocks-12:20%:s3", "random-9:10:s1", "empty-5", "maze-11:1", "rooms-13:3")
POLICIES = ("strict", "no-squeeze", "allow")


def of(kind, but=()):
    found = [e for e in BUILDABLE if issubclass(e.component, kind) and e.component.works_on in ("", "cells")]
    assert found
    filled = [c for c in FILLED if isinstance(c, kind) and not isinstance(c, but)]
    components = [e.component() for e in found] + filled
    return pytest.mark.parametrize("component", components, ids=[e.name for e in found] + [c.name for c in filled])


def problems():
    for name in MAPS:
        for corners in POLICIES:
            yield pl.PathProblem(pl.load_map(name, corners=corners), corners=corners)


def connected(row, problem):
    """Whether a row is a legal path of single steps without repeated cells."""
    path = problem.representation.decode(row)
    steps = np.abs(np.diff(path, axis=0)).max(axis=1) if len(path) > 1 else np.ones(1)
    cells = {tuple(c) for c in path.tolist()}
    return pl.validate(path, problem) is None and (steps == 1).all() and len(cells) == len(path)


def first_population(problem, n=12, seed=0):
    return build(pl.Sampling, "perturbed-trees", default_registry(), "").sample(problem, n, np.random.default_rng(seed))


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda e: f"{e.component.kind}:{e.name}")
def test_every_component_says_what_it_is(entry):
    about = inspect.getdoc(entry.component)
    assert about
    assert about.partition("\n")[0].endswith((".", ":"))
    assert entry.component.name == entry.component.name.lower()


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES if "/" in e.name and e.source.namespace != "maps"], ids=lambda e: e.name
)
def test_every_component_of_a_paper_names_its_source(entry):
    assert entry.component.source or entry.component.reference


@pytest.mark.parametrize("entry", BUILDABLE, ids=lambda e: f"{e.component.kind}:{e.name}")
def test_every_component_is_frozen_hashable_picklable_and_rebuilt_from_its_table(entry):
    component = entry.component()
    assert hash(component) == hash(entry.component())
    assert pickle.loads(pickle.dumps(component)) == component
    assert build(entry.component, freeze(component), default_registry(), "") == component


@pytest.mark.parametrize("component", FILLED, ids=lambda c: c.name)
def test_every_component_of_parts_is_frozen_hashable_picklable_and_rebuilt_from_its_table(component):
    assert hash(component) == hash(pickle.loads(pickle.dumps(component)))
    assert pickle.loads(pickle.dumps(component)) == component
    assert build(type(component), freeze(component), default_registry(), "") == component


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES if issubclass(e.component, pl.Planner) and e.component.reference], ids=lambda e: e.name
)
def test_every_planner_of_a_paper_says_how_faithful_it_is(entry):
    assert entry.component.fidelity in ("faithful", "standard", "reconstructed")
    assert entry.component.assumptions
    assert entry.component.bibtex.startswith("@")


@of(pl.Sampling)
def test_samples_are_connected_paths_of_the_problem(component):
    for problem in problems():
        population = component.sample(problem, 7, np.random.default_rng(1))
        assert population.dtype == np.int32
        assert population.flags.c_contiguous
        assert len(population) in (0, 7)
        if "8-connected" in component.gives:
            assert all(connected(row, problem) for row in population)
        assert all(pl.validate(problem.representation.decode(row), problem) is None for row in population)


@of(pl.Sampling)
def test_samples_depend_on_the_generator_alone(component):
    problem = pl.PathProblem(pl.load_map("blocks-12:20%:s3"))
    first, again, other = (component.sample(problem, 9, np.random.default_rng(s)) for s in (4, 4, 5))
    assert first.tobytes() == again.tobytes() != other.tobytes()


@of(pl.Sampling)
def test_start_and_goal_may_be_one_cell_or_neighbours(component):
    grid = pl.load_map("imaga-fig1")
    for goal in ((9, 0), (9, 1), (8, 1)):
        problem = pl.PathProblem(grid, start=(9, 0), goal=goal)
        population = component.sample(problem, 3, np.random.default_rng(0))
        assert len(population) == 3
        assert all(connected(row, problem) for row in population)


@of(pl.Crossover)
def test_children_are_valid_and_parents_unharmed(component):
    for problem in problems():
        population = first_population(problem)
        before = population.copy()
        pairs = np.arange(8).reshape(-1, 2)
        children = component.cross(population, pairs, problem, np.random.default_rng(2))
        assert population.tobytes() == before.tobytes()
        assert len(children) == len(population)
        assert all(pl.validate(problem.representation.decode(row), problem) is None for row in children)
        if "8-connected" not in component.breaks:
            assert all(connected(row, problem) for row in children)
        for k in range(8, 12):
            assert (
                problem.representation.decode(children[k]).tolist()
                == problem.representation.decode(population[k]).tolist()
            )


@of(pl.Mutation)
def test_mutants_are_valid_and_the_others_untouched(component):
    for problem in problems():
        population = first_population(problem)
        before = population.copy()
        mutants = component.apply(population, np.array([0, 3, 5]), problem, np.random.default_rng(3))
        assert population.tobytes() == before.tobytes()
        assert all(pl.validate(problem.representation.decode(row), problem) is None for row in mutants)
        if "8-connected" not in component.breaks:
            assert all(connected(row, problem) for row in mutants)
        for k in set(range(12)) - {0, 3, 5}:
            assert (
                problem.representation.decode(mutants[k]).tolist()
                == problem.representation.decode(population[k]).tolist()
            )


@of(pl.Mutation, but=RandomImmigrants)
def test_a_path_without_interior_is_left_alone_and_counted(component):
    problem = pl.PathProblem(pl.load_map("empty-5"), start=(0, 0), goal=(1, 1))
    population = problem.representation.encode([np.array([(0, 0), (1, 1)])])
    with counting() as counts:
        mutants = component.apply(population, np.array([0]), problem, np.random.default_rng(0))
    assert problem.representation.decode(mutants[0]).tolist() == [[0, 0], [1, 1]]
    assert counts.get("mutation failed", 0) == 1


@of(pl.Repair)
def test_repair_keeps_ends_and_validity_and_never_lengthens(component):
    for problem in problems():
        population = first_population(problem)
        repaired = component.apply(population, problem, np.random.default_rng(0))
        assert len(repaired) == len(population)
        assert all(pl.validate(problem.representation.decode(row), problem) is None for row in repaired)
        if component.apply(population, problem, np.random.default_rng(1)).tobytes() != repaired.tobytes():
            continue  # it draws new individuals
        lengths = [pl.compiled.measures.lengths(p, problem.context.cols) for p in (population, repaired)]
        assert (lengths[1] <= lengths[0] + 1e-12).all()


@of(pl.Objective)
def test_objectives_give_one_finite_value_a_path(component):
    for problem in problems():
        population = first_population(problem)
        before = population.tobytes()
        values = component.measure(population, problem)
        assert values.shape == (12,)
        assert np.isfinite(values).all()
        assert population.tobytes() == before


@of(pl.Objective)
def test_objectives_do_not_mind_the_padding(component):
    problem = pl.PathProblem(pl.load_map("imaga-fig1"))
    population = first_population(problem)
    wider = np.pad(population, ((0, 0), (0, 9)), constant_values=-1)
    assert component.measure(wider, problem).tolist() == component.measure(population, problem).tolist()


@of(pl.Selection)
def test_selection_gives_rows_that_exist_and_favours_the_fit(component):
    for m in (1, 2, 3, 5, 99, 100, 101):
        fitness = np.random.default_rng(m).random(m)
        chosen = component.select(fitness, m, np.random.default_rng(0))
        assert chosen.shape == (m,)
        assert set(chosen.tolist()) <= set(range(m))
    fitness = np.linspace(0.1, 1, 300)
    assert fitness[component.select(fitness, 300, np.random.default_rng(0))].mean() >= fitness.mean()


@of(pl.Selection)
def test_selection_bears_equal_fitness(component):
    assert len(component.select(np.ones(10), 10, np.random.default_rng(0))) == 10


@pytest.mark.parametrize("entry", [e for e in ENTRIES if issubclass(e.component, MapFamily)], ids=lambda e: e.name)
@pytest.mark.parametrize("corners", POLICIES)
def test_generated_maps_are_connected_from_corner_to_corner_and_repeatable(entry, corners):
    for seed in range(5):
        family = entry.component(size=17, seed=seed)
        grid = family.grid(corners)
        assert grid == entry.component(size=17, seed=seed).grid(corners)
        assert pl.PathProblem(grid, corners=corners).reachable
    assert (
        len({entry.component(size=17, seed=s).grid(corners).sha256 for s in range(5)}) > 1
        or entry.component.name == "empty"
    )


@pytest.mark.parametrize("entry", [e for e in BUILDABLE if issubclass(e.component, pl.Planner)], ids=lambda e: e.name)
def test_every_planner_is_deterministic_and_its_answer_valid(entry):
    planner = entry.component()
    for name in ("iga-map1", "blocks-12:20%:s3"):
        problem = pl.PathProblem(pl.load_map(name, corners="allow"), corners="allow")
        first, again = run(problem, planner, 11), run(problem, planner, 11)
        assert first.outcome.solution.tobytes() == again.outcome.solution.tobytes()
        assert first.state.history == again.state.history
        assert pl.validate(problem.representation.decode(first.outcome.solution), problem) is None
