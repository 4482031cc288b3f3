"""What is public changes only when that is meant, and what plugins rely on only grows."""

import difflib
import inspect

import pytest
from public_api import LIST, listed

import pathloom as pl
from pathloom.kernel.component import Component
from pathloom.kernel.plugins import Hooks

HOOKS = {"register": ("add",)}
"""What a plugin of 0.1 may implement, with the arguments that it may ask for."""

DEMANDED = {
    "Archive": {"update"}, "Claim": {"examine"}, "Collision": {"segments_free"}, "Constraint": {"violation"},
    "Control": {"advance"}, "Crossover": {"cross"}, "Deadlock": {"retreats"}, "Decoder": {"axes", "decode", "straight"},
    "Driver": {"steer"}, "LearnedPolicy": {"estimator"}, "Policy": {"trained"}, "Rule": {"decide"},
    "Fitness": {"combine"}, "FrontPlanner": {"front", "result", "start", "step"}, "Heuristic": {"desirability"},
    "InitialPheromone": {"lay"}, "Map": {"grid"}, "Migration": {"demes", "exchange"}, "Mutation": {"apply"},
    "Objective": {"measure"}, "Observer": set(), "Pairing": {"pair"},
    "PathCrossover": {"cross_one"}, "PathMutation": {"mutate"}, "PathObjective": {"measure_one"},
    "PathRepair": {"repair"}, "PathSampling": {"sample_one"}, "PheromoneUpdate": {"deposits"},
    "Planner": {"result", "start", "step"}, "Probability": {"rates"}, "Problem": {"representation"},
    "Repair": {"apply"}, "Representation": {"decode"}, "Sampling": {"sample"}, "Selection": {"select"},
    "Smoother": {"smooth"}, "Survival": {"survive"}, "Swarm": {"move"}, "Termination": {"done"},
    "VectorPlanner": {"evaluate_genes", "first_genes", "move"}, "Weighting": {"weights"},
}  # fmt: skip
"""What a component of each kind had to have in 0.1. One more, and no plugin of the kind would load."""


def test_the_public_names_and_signatures_are_those_on_the_list():
    changes = list(
        difflib.unified_diff(LIST.read_text(encoding="utf-8").splitlines(), listed().splitlines(), lineterm="")
    )
    assert not changes, "\n".join(["if this is meant, run python tests/public_api.py", *changes])


@pytest.mark.parametrize("name", HOOKS)
def test_a_hook_keeps_its_name_and_all_its_arguments(name):
    arguments = tuple(inspect.signature(getattr(Hooks, name)).parameters)
    assert arguments[0] == "self"
    assert arguments[1 : 1 + len(HOOKS[name])] == HOOKS[name]


def test_a_kind_asks_for_no_more_than_it_always_did():
    kinds = {n: thing for n in pl.__all__ if inspect.isclass(thing := getattr(pl, n)) and issubclass(thing, Component)}
    for name, kind in kinds.items():
        if inspect.isabstract(kind) or name in DEMANDED:
            assert kind.__abstractmethods__ <= DEMANDED[name], name
