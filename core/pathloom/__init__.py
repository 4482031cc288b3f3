"""pathloom: evolutionary path planning on occupancy grids.

Names are loaded when they are first used, so that ``import pathloom`` is quick.
"""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathloom import compiled as compiled
    from pathloom.claims import Bench, Claim, Finding
    from pathloom.deprecation import PathloomDeprecationWarning, Renamed, deprecated
    from pathloom.errors import ConfigError, MapError, PathloomError, PluginError, ProblemError
    from pathloom.exact import additive_optimum, additive_path, any_angle_path, exact_front, octile_path, validate
    from pathloom.fronts import ParetoResult
    from pathloom.grid import OccupancyGrid, full_cell_cover, write_map
    from pathloom.kernel.archive import Archive
    from pathloom.kernel.component import Component, Count, Distance, NonNegative, Positive, Share, Unit, Whole
    from pathloom.kernel.constraint import Constraint
    from pathloom.kernel.counting import count
    from pathloom.kernel.evaluation import Fitness, Floats, Objective, Term, Terms, Weighting
    from pathloom.kernel.evolution import Control, Evolution
    from pathloom.kernel.front import Front, FrontPlanner
    from pathloom.kernel.observer import Observer
    from pathloom.kernel.operators import (
        Crossover,
        Indices,
        Migration,
        Mutation,
        Pairing,
        Probability,
        Repair,
        Sampling,
        Selection,
        Survival,
    )
    from pathloom.kernel.planner import Fidelity, Outcome, Planner
    from pathloom.kernel.plugins import Add, hookimpl
    from pathloom.kernel.problem import Problem
    from pathloom.kernel.representation import Population, Representation
    from pathloom.kernel.state import Deme, State
    from pathloom.kernel.termination import Termination
    from pathloom.local import (
        ClosedLoop,
        Episode,
        Examples,
        LearnedPolicy,
        Model,
        Policy,
        Rule,
        generate,
        read_examples,
    )
    from pathloom.local.drivers.driver import Driver
    from pathloom.multiobjective import pareto
    from pathloom.paths.additive import Prices
    from pathloom.paths.ants.colony import Colony
    from pathloom.paths.ants.pheromone import ColonyState, Deadlock, Heuristic, InitialPheromone, PheromoneUpdate
    from pathloom.paths.cell_paths import CellPaths, Path
    from pathloom.paths.collision import Collision
    from pathloom.paths.curves import Curve, Smoother
    from pathloom.paths.maps import Map, load_map
    from pathloom.paths.numbering import Numbering
    from pathloom.paths.pathwise import PathCrossover, PathMutation, PathObjective, PathRepair, PathSampling
    from pathloom.paths.problem import PathProblem
    from pathloom.paths.vectors.decoding import Decoder
    from pathloom.paths.vectors.planner import VectorPlanner, VectorState
    from pathloom.paths.vectors.swarm import Swarm
    from pathloom.planning import compose, freeze, iterate, load_state, part, plan
    from pathloom.result import Result
    from pathloom.study import Study, ablate, compare
    from pathloom.study.tuning.experiment import tune
    from pathloom.study.tuning.result import Tuning

_HOME = {
    "claims": ("Bench", "Claim", "Finding"),
    "deprecation": ("PathloomDeprecationWarning", "Renamed", "deprecated"),
    "errors": ("ConfigError", "MapError", "PathloomError", "PluginError", "ProblemError"),
    "exact": ("additive_optimum", "additive_path", "any_angle_path", "exact_front", "octile_path", "validate"),
    "fronts": ("ParetoResult",),
    "grid": ("OccupancyGrid", "full_cell_cover", "write_map"),
    "kernel.archive": ("Archive",),
    "kernel.component": ("Component", "Count", "Distance", "NonNegative", "Positive", "Share", "Unit", "Whole"),
    "kernel.counting": ("count",),
    "kernel.constraint": ("Constraint",),
    "kernel.evaluation": ("Fitness", "Floats", "Objective", "Term", "Terms", "Weighting"),
    "kernel.evolution": ("Control", "Evolution"),
    "kernel.front": ("Front", "FrontPlanner"),
    "kernel.observer": ("Observer",),
    "kernel.operators": (
        "Crossover", "Indices", "Migration", "Mutation", "Pairing", "Probability", "Repair", "Sampling", "Selection",
        "Survival",
    ),
    "kernel.planner": ("Fidelity", "Outcome", "Planner"),
    "kernel.plugins": ("Add", "hookimpl"),
    "kernel.problem": ("Problem",),
    "kernel.representation": ("Population", "Representation"),
    "kernel.state": ("Deme", "State"),
    "kernel.termination": ("Termination",),
    "local": (
        "ClosedLoop", "Episode", "Examples", "LearnedPolicy", "Model", "Policy", "Rule", "generate", "read_examples",
    ),
    "local.drivers.driver": ("Driver",),
    "multiobjective": ("pareto",),
    "paths.cell_paths": ("CellPaths", "Path"),
    "paths.collision": ("Collision",),
    "paths.additive": ("Prices",),
    "paths.ants.colony": ("Colony",),
    "paths.curves": ("Curve", "Smoother"),
    "paths.vectors.decoding": ("Decoder",),
    "paths.maps": ("Map", "load_map"),
    "paths.numbering": ("Numbering",),
    "paths.pathwise": ("PathCrossover", "PathMutation", "PathObjective", "PathRepair", "PathSampling"),
    "paths.ants.pheromone": ("ColonyState", "Deadlock", "Heuristic", "InitialPheromone", "PheromoneUpdate"),
    "paths.problem": ("PathProblem",),
    "paths.vectors.swarm": ("Swarm",),
    "paths.vectors.planner": ("VectorPlanner", "VectorState"),
    "planning": ("compose", "freeze", "iterate", "load_state", "part", "plan"),
    "result": ("Result",),
    "study": ("Study", "ablate", "compare"),
    "study.tuning.experiment": ("tune",),
    "study.tuning.result": ("Tuning",),
}  # fmt: skip
_RENAMED: dict[str, tuple[str, str]] = {}
"""Names of this module that are no more: what took their place, and the version that made it so."""
_FROM = {name: module for module, names in _HOME.items() for name in names}

__all__ = [
    "Add",
    "Archive",
    "Bench",
    "CellPaths",
    "Claim",
    "ClosedLoop",
    "Collision",
    "Colony",
    "ColonyState",
    "Component",
    "ConfigError",
    "Constraint",
    "Control",
    "Count",
    "Crossover",
    "Curve",
    "Deadlock",
    "Decoder",
    "Deme",
    "Distance",
    "Driver",
    "Episode",
    "Evolution",
    "Examples",
    "Fidelity",
    "Finding",
    "Fitness",
    "Floats",
    "Front",
    "FrontPlanner",
    "Heuristic",
    "Indices",
    "InitialPheromone",
    "LearnedPolicy",
    "Map",
    "MapError",
    "Migration",
    "Model",
    "Mutation",
    "NonNegative",
    "Numbering",
    "Objective",
    "Observer",
    "OccupancyGrid",
    "Outcome",
    "Pairing",
    "ParetoResult",
    "Path",
    "PathCrossover",
    "PathMutation",
    "PathObjective",
    "PathProblem",
    "PathRepair",
    "PathSampling",
    "PathloomDeprecationWarning",
    "PathloomError",
    "PheromoneUpdate",
    "Planner",
    "PluginError",
    "Policy",
    "Population",
    "Positive",
    "Prices",
    "Probability",
    "Problem",
    "ProblemError",
    "Renamed",
    "Repair",
    "Representation",
    "Result",
    "Rule",
    "Sampling",
    "Selection",
    "Share",
    "Smoother",
    "State",
    "Study",
    "Survival",
    "Swarm",
    "Term",
    "Termination",
    "Terms",
    "Tuning",
    "Unit",
    "VectorPlanner",
    "VectorState",
    "Weighting",
    "Whole",
    "__version__",
    "ablate",
    "additive_optimum",
    "additive_path",
    "any_angle_path",
    "compare",
    "compiled",
    "compose",
    "count",
    "deprecated",
    "exact_front",
    "freeze",
    "full_cell_cover",
    "generate",
    "hookimpl",
    "iterate",
    "load_map",
    "load_state",
    "octile_path",
    "pareto",
    "part",
    "plan",
    "read_examples",
    "tune",
    "validate",
    "write_map",
]


def __getattr__(name: str) -> Any:
    if name in _FROM:
        value = getattr(importlib.import_module(f"pathloom.{_FROM[name]}"), name)
    elif name == "compiled":
        value = importlib.import_module("pathloom.compiled")
    elif name == "__version__":
        from importlib.metadata import version

        value = version("pathloom")
    elif name in _RENAMED:
        from pathloom.deprecation import warn

        new, since = _RENAMED[name]
        warn(f"pathloom.{name}", since, f"pathloom.{new}", depth=3)
        return getattr(importlib.import_module("pathloom"), new)
    else:
        raise AttributeError(f"module 'pathloom' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
