"""Planning with several objectives: a front instead of a path."""

from pathloom.multiobjective.composing import front_planner, objectives_of
from pathloom.multiobjective.dominance import dominance
from pathloom.multiobjective.running import DEFAULT_PLANNER, pareto

__all__ = ["DEFAULT_PLANNER", "dominance", "front_planner", "objectives_of", "pareto"]
