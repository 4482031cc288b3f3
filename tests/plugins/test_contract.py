"""What our own components promise beyond the contract that `pathloom.testing` holds all components against."""

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.counting import counting
from pathloom.kernel.immigrants import RandomImmigrants
from pathloom.kernel.registry import default_registry
from pathloom.paths.maps import MapFamily
from pathloom.testing.making import made
from pathloom.testing.problems import first_population, places

ENTRIES = list(default_registry().all_entries())


def of(kind, but=()):
    found = [e for e in ENTRIES if issubclass(e.component, kind) and not issubclass(e.component, but)]
    assert found
    return pytest.mark.parametrize("component", [made(e.component) for e in found], ids=[e.name for e in found])


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES if "/" in e.name and e.source.namespace != "maps"], ids=lambda e: e.name
)
def test_every_component_of_a_paper_names_its_source(entry):
    assert entry.component.source or entry.component.reference


@of(pl.Sampling)
def test_another_seed_gives_other_samples(component):
    problem = pl.PathProblem(pl.load_map("blocks-12:20%:s3"))
    first, other = (component.sample(problem, 9, np.random.default_rng(s)) for s in (4, 5))
    assert first.tobytes() != other.tobytes()


@of(pl.Mutation, but=RandomImmigrants)
def test_a_path_without_interior_is_left_alone_and_counted(component):
    problem = pl.PathProblem(pl.load_map("empty-5"), start=(0, 0), goal=(1, 1))
    population = problem.representation.encode([np.array([(0, 0), (1, 1)])])
    with counting() as counts:
        mutants = component.apply(population, np.array([0]), problem, np.random.default_rng(0))
    assert problem.representation.decode(mutants[0]).tolist() == [[0, 0], [1, 1]]
    assert counts.get("mutation failed", 0) == 1


@of(pl.Repair)
def test_repair_without_chance_never_lengthens(component):
    for place in places():
        problem = place.problem()
        population = first_population(problem)
        repaired = component.apply(population, problem, np.random.default_rng(0))
        if component.apply(population, problem, np.random.default_rng(1)).tobytes() != repaired.tobytes():
            continue  # it draws new individuals
        lengths = [pl.compiled.measures.lengths(p, problem.context.cols) for p in (population, repaired)]
        assert (lengths[1] <= lengths[0] + 1e-12).all()


@of(MapFamily)
def test_seeds_give_different_maps(component):
    maps = {type(component)(size=17, seed=s).grid().sha256 for s in range(5)}
    assert len(maps) > 1 or component.name == "empty"
