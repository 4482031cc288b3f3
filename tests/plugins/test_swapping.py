"""Everything swaps: each component works in planners of other papers, or says by name why it cannot."""

import pytest

import pathloom as pl
from pathloom.kernel.component import parameters
from pathloom.kernel.compose import build, compose
from pathloom.kernel.registry import default_registry
from pathloom.kernel.run import run

from .filled import FILLED

ENTRIES = [e for e in default_registry().all_entries() if not any(p.required for p in parameters(e.component))]
PLANNERS = [e for e in ENTRIES if issubclass(e.component, pl.Evolution)]
SLOTS = {p.name: p.slot for e in PLANNERS for p in parameters(e.component) if p.slot is not None}
SWAPS = [
    (slot, e)
    for slot, kind in SLOTS.items()
    for e in ENTRIES
    if issubclass(e.component, kind) and e.component.works_on in ("", "cells")
]
PROBLEM = pl.PathProblem(pl.load_map("random-12:20:s1", corners="allow"), corners="allow")


def short(planner, **slots):
    return compose(planner, population=12, termination=[{"use": "max-generations", "limit": 4}], **slots)


def foreign(entry):
    """One planner of every plugin that the component does not come from."""
    by_plugin = {p.source.namespace: p for p in PLANNERS if p.source.namespace != entry.source.namespace}
    return list(by_plugin.values())


def answers(planner):
    """Run a planner; its answer has passed the validator, and its generations all happened."""
    finished = run(PROBLEM, planner, 3)
    assert finished.state.generation == 4
    assert finished.outcome.solution is not None
    assert pl.validate(PROBLEM.representation.decode(finished.outcome.solution), PROBLEM) is None


@pytest.mark.parametrize(("slot", "entry"), SWAPS, ids=lambda x: x if isinstance(x, str) else x.name)
def test_each_component_runs_in_planners_of_other_plugins(slot, entry):
    ran, refused = 0, []
    for planner in foreign(entry):
        try:
            composed = short(planner.name, **{slot: entry.name})
        except pl.ConfigError as error:
            refused.append(str(error))
            continue
        answers(composed)
        ran += 1
    assert ran, refused
    assert all(entry.component.name in reason for reason in refused)


@pytest.mark.parametrize("component", FILLED, ids=lambda c: c.name)
def test_each_component_of_parts_runs_in_planners_of_every_plugin(component):
    slots = [slot for slot, kind in SLOTS.items() if isinstance(component, kind)]
    assert slots
    for planner in {p.source.namespace: p for p in PLANNERS}.values():
        for slot in slots:
            answers(short(planner.name, **{slot: component}))


@pytest.mark.parametrize("slot", ["crossover", "mutation"])
@pytest.mark.parametrize("entry", [e for e in ENTRIES if issubclass(e.component, pl.Probability)], ids=lambda e: e.name)
def test_each_probability_drives_the_operators_of_other_papers(entry, slot):
    for planner in foreign(entry):
        composed = short(planner.name, **{slot: {"probability": entry.name}})
        assert getattr(composed, slot).probability == build(pl.Probability, entry.name, default_registry(), "")
        answers(composed)


@pytest.mark.parametrize("entry", [e for e in ENTRIES if issubclass(e.component, pl.Objective)], ids=lambda e: e.name)
def test_each_objective_serves_in_planners_of_other_papers(entry):
    for planner in foreign(entry):
        answers(short(planner.name, weighting="none", objectives={"length": 1.0, "more": {"use": entry.name}}))


@pytest.mark.parametrize("entry", [e for e in ENTRIES if issubclass(e.component, pl.Collision)], ids=lambda e: e.name)
def test_each_test_of_segments_serves_point_deletion(entry):
    answers(short("imga", refinement={"use": "point-deletion", "collision": entry.name}))
